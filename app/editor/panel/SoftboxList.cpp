#include "app/editor/panel/SoftboxList.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/panel/ParameterList.h"
#include "app/editor/style/Icons.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/widget/ListButton.h"
#include "app/editor/widget/ListItems.h"
#include "core/edit/EditSession.h"
#include "core/library/SoftboxRigs.h"

#include <QHBoxLayout>
#include <QListWidget>
#include <QMenu>
#include <QSignalBlocker>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

namespace patina::editor {
SoftboxList::SoftboxList(DocumentController& controller, Thumbnails& thumbnails, QWidget* parent)
    : QWidget(parent)
    , m_controller(controller)
    , m_list(new QListWidget)
    , m_duplicate(makeListButton(QStringLiteral("duplicate"), {}, tr("Duplicate the softbox")))
    , m_remove(makeListButton(QStringLiteral("remove"), {}, tr("Remove the softbox")))
    , m_parameters(new ParameterList(controller, thumbnails,
                                     {Scope::Softbox,
                                      [this]() -> std::optional<Target> {
                                          if (m_selected == 0)
                                              return std::nullopt;
                                          return Target{Scope::Softbox, m_selected};
                                      },
                                      {"softbox.enabled"}, // the list has it
                                      false,
                                      Scope::Environment})) {
    m_list->setAccessibleName(tr("Softboxes"));
    m_list->setStatusTip(tr("Tick to switch a softbox on, F2 to rename it"));
    m_list->setEditTriggers(QAbstractItemView::EditKeyPressed | QAbstractItemView::DoubleClicked);

    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(tokens::kGap);
    layout->addWidget(makeButtons());
    layout->addWidget(m_list);
    layout->addWidget(m_parameters);

    connect(m_duplicate, &QToolButton::clicked, this,
            [this] { select(m_controller.duplicateSoftbox(m_selected)); });
    connect(m_remove, &QToolButton::clicked, this, [this] { remove(m_selected); });
    connect(m_list, &QListWidget::currentItemChanged, this, [this](QListWidgetItem* item) {
        if (!m_refreshing && item)
            select(idOf(*item));
    });
    connect(m_list, &QListWidget::itemChanged, this, [this](QListWidgetItem* item) {
        if (m_refreshing)
            return;
        const Target target{Scope::Softbox, idOf(*item)};
        m_controller.setParameter(parameter("softbox.enabled"), target,
                                  item->checkState() == Qt::Checked);
        m_controller.rename(target, item->text());
    });
    connect(&controller, &DocumentController::changed, this, [this](const Change& change) {
        if (change.isAnotherDocument()) { // another document, in which ids mean others
            const QSignalBlocker silent(m_list);
            m_list->clear();
        }
        if (!change.target || change.target->scope == Scope::Softbox)
            refresh();
    });
    refresh();
}

QWidget* SoftboxList::makeButtons() {
    auto* add =
        makeListButton(QStringLiteral("add"), tr("Add"), tr("Add a softbox in front of the model"));
    auto* rigs = makeListButton(QStringLiteral("library"), tr("Rigs"),
                                tr("Set up an arrangement of softboxes in place of these"));
    rigs->setPopupMode(QToolButton::InstantPopup);
    auto* menu = new QMenu(rigs);
    menu->setToolTipsVisible(true);
    for (const library::SoftboxRig& rig : library::softboxRigs()) {
        QAction* action = menu->addAction(QString::fromStdString(rig.title), this, [this, &rig] {
            m_controller.setSoftboxRig(rig);
            selectFirst();
        });
        action->setToolTip(QString::fromStdString(rig.help));
        action->setStatusTip(action->toolTip());
    }
    rigs->setMenu(menu);

    auto* buttons = new QWidget;
    auto* row = new QHBoxLayout(buttons);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(4);
    row->addWidget(add);
    row->addWidget(rigs);
    row->addStretch(1);
    row->addWidget(m_duplicate);
    row->addWidget(m_remove);
    connect(add, &QToolButton::clicked, this, [this] {
        const Softbox usual;
        select(m_controller.addSoftbox(usual.azimuthDeg, usual.elevationDeg));
    });
    return buttons;
}

void SoftboxList::select(Id softbox) {
    if (!m_controller.document().softbox(softbox))
        softbox = 0;
    const bool other = softbox != m_selected;
    m_selected = softbox;
    refresh();
    m_parameters->refresh();
    if (other)
        Q_EMIT selectionChanged();
}

void SoftboxList::selectFirst() {
    const std::vector<Softbox>& softboxes = m_controller.document().environment().softboxes;
    select(softboxes.empty() ? 0 : softboxes.front().id);
}

void SoftboxList::remove(Id softbox) {
    const std::vector<Softbox>& softboxes = m_controller.document().environment().softboxes;
    const auto found = std::ranges::find(softboxes, softbox, &Softbox::id);
    if (found == softboxes.end())
        return;
    Id next = 0;
    if (found + 1 != softboxes.end())
        next = (found + 1)->id;
    else if (found != softboxes.begin())
        next = (found - 1)->id;
    m_controller.removeSoftbox(softbox);
    select(next);
}

void SoftboxList::refresh() {
    const std::vector<Softbox>& softboxes = m_controller.document().environment().softboxes;
    if (!m_controller.document().softbox(m_selected) && m_selected != 0) {
        m_selected = 0;
        Q_EMIT selectionChanged();
    }
    m_refreshing = true;
    removeItems(*m_list, [&](Id id) { return !m_controller.document().softbox(id); });
    int current = -1;
    for (int row = 0; row < static_cast<int>(softboxes.size()); ++row) {
        const Softbox& softbox = softboxes[static_cast<std::size_t>(row)];
        QListWidgetItem* item =
            placeItem(*m_list, softbox.id, row, Qt::ItemIsEditable | Qt::ItemIsUserCheckable);
        item->setText(QString::fromStdString(softbox.name));
        item->setCheckState(softbox.enabled ? Qt::Checked : Qt::Unchecked);
        if (softbox.id == m_selected)
            current = row;
    }
    m_list->setCurrentRow(current);
    const bool any = m_selected != 0;
    m_list->setVisible(!softboxes.empty());
    fitHeight(*m_list);
    m_parameters->setVisible(any);
    m_duplicate->setEnabled(any);
    m_remove->setEnabled(any);
    m_refreshing = false;
}

} // namespace patina::editor
