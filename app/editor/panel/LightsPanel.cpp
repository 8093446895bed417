#include "app/editor/panel/LightsPanel.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/SelectionModel.h"
#include "app/editor/panel/ParameterList.h"
#include "app/editor/style/Icons.h"
#include "app/editor/style/LightIcon.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/widget/PanelScroll.h"
#include "core/edit/EditSession.h"
#include "core/light/Light.h"
#include "core/light/Lights.h"
#include "core/mix/LightMix.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QSignalBlocker>
#include <QStyledItemDelegate>
#include <QToolButton>
#include <QTreeWidget>
#include <QVBoxLayout>

namespace patina::editor {
namespace {

constexpr int kNameColumn = 0, kSoloColumn = 1;
constexpr int kTypeRole = Qt::UserRole + 1; // of the light whose icon an item has

Id idOf(const QTreeWidgetItem& item) {
    return item.data(kNameColumn, Qt::UserRole).toUInt();
}

// The solo column has a switch and no text to edit.
class NoEditor : public QStyledItemDelegate {
  public:
    using QStyledItemDelegate::QStyledItemDelegate;
    QWidget* createEditor(QWidget*, const QStyleOptionViewItem&,
                          const QModelIndex&) const override {
        return nullptr;
    }
};

QToolButton* iconButton(const QString& iconName, const QString& tip) {
    auto* button = new QToolButton;
    button->setIcon(icon(iconName));
    button->setToolTip(tip);
    button->setStatusTip(tip);
    button->setAccessibleName(tip);
    button->setFocusPolicy(Qt::TabFocus);
    return button;
}

// Keeps the selected light in sight when its parameters take the room.
class LightList : public QTreeWidget {
  protected:
    void resizeEvent(QResizeEvent* event) override {
        QTreeWidget::resizeEvent(event);
        if (currentItem())
            scrollToItem(currentItem());
    }
};

} // namespace

LightsPanel::LightsPanel(DocumentController& controller, SelectionModel& selection,
                         Thumbnails& thumbnails, QWidget* parent)
    : QWidget(parent)
    , m_controller(controller)
    , m_selection(selection)
    , m_list(new LightList)
    , m_empty(new QLabel(tr("Only the environment lights the scene.\nAdd a light above.")))
    , m_duplicate(iconButton(QStringLiteral("duplicate"), tr("Duplicate the selected light")))
    , m_remove(iconButton(QStringLiteral("remove"), tr("Remove the selected light")))
    , m_parameters(new ParameterList(controller, thumbnails,
                                     {Scope::Light,
                                      [&selection]() -> std::optional<Target> {
                                          if (selection.light() == 0)
                                              return std::nullopt;
                                          return Target{Scope::Light, selection.light()};
                                      },
                                      {"light.enabled", "light.solo"}})) { // the list has them
    m_list->setAccessibleName(tr("Lights"));
    m_list->setStatusTip(tr("Tick to turn a light on, or to solo it; F2 renames it"));
    m_list->setEditTriggers(QAbstractItemView::EditKeyPressed | QAbstractItemView::DoubleClicked);
    m_list->setIconSize({16, 16});
    m_list->setMinimumHeight(104); // three lights, where the dock is low
    m_list->setMaximumHeight(150);
    m_list->setRootIsDecorated(false);
    m_list->setColumnCount(2);
    m_list->setHeaderLabels({tr("Light"), tr("Solo")});
    m_list->headerItem()->setToolTip(kSoloColumn,
                                     tr("While any light is solo, only solo lights are on"));
    m_list->header()->setStretchLastSection(false);
    m_list->header()->setSectionResizeMode(kNameColumn, QHeaderView::Stretch);
    m_list->header()->setSectionResizeMode(kSoloColumn, QHeaderView::ResizeToContents);
    m_list->setItemDelegateForColumn(kSoloColumn, new NoEditor(this));
    m_empty->setObjectName(QStringLiteral("dim"));
    m_empty->setAlignment(Qt::AlignCenter);

    auto* head = new QHBoxLayout;
    head->setSpacing(4);
    const struct {
        LightType type;
        QString tip;
    } kinds[] = {{LightType::Point, tr("Add a point light")},
                 {LightType::Directional, tr("Add a directional light")},
                 {LightType::Spot, tr("Add a spot light")},
                 {LightType::Sphere, tr("Add a sphere light")},
                 {LightType::Rectangle, tr("Add a rectangle light")}};
    auto* addLabel = new QLabel(tr("Add"));
    addLabel->setObjectName(QStringLiteral("dim"));
    head->addWidget(addLabel);
    for (const auto& kind : kinds) {
        QToolButton* button = iconButton(lightIcon(kind.type), kind.tip);
        button->setObjectName(QStringLiteral("raised"));
        head->addWidget(button);
        connect(button, &QToolButton::clicked, this,
                [this, type = kind.type] { m_selection.selectLight(m_controller.addLight(type)); });
    }
    head->addStretch(1);
    head->addWidget(m_duplicate);
    head->addWidget(m_remove);
    auto* scroll = new PanelScroll;
    scroll->contents()->addLayout(head);
    scroll->contents()->addWidget(m_list);
    scroll->contents()->addWidget(m_empty);
    scroll->contents()->addWidget(m_parameters);
    scroll->contents()->addStretch(1);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(scroll);

    connect(m_duplicate, &QToolButton::clicked, this,
            [this] { m_selection.selectLight(m_controller.duplicateLight(m_selection.light())); });
    connect(m_remove, &QToolButton::clicked, this,
            [this] { m_controller.removeLight(m_selection.light()); });
    connect(m_list, &QTreeWidget::currentItemChanged, this, [this](QTreeWidgetItem* item) {
        if (!m_refreshing && item)
            m_selection.selectLight(idOf(*item));
    });
    connect(m_list, &QTreeWidget::itemChanged, this, [this](QTreeWidgetItem* item) {
        if (m_refreshing)
            return;
        const Target target{Scope::Light, idOf(*item)};
        const QString name = item->text(kNameColumn);
        const bool enabled = item->checkState(kNameColumn) == Qt::Checked;
        const bool solo = item->checkState(kSoloColumn) == Qt::Checked;
        m_controller.setParameter(parameter("light.enabled"), target, enabled);
        m_controller.setParameter(parameter("light.solo"), target, solo);
        m_controller.rename(target, name);
    });
    connect(&controller, &DocumentController::changed, this, [this](const Change& change) {
        if (change.isAnotherDocument()) { // another document, in which ids mean others
            const QSignalBlocker silent(m_list);
            m_list->clear();
        }
        if (touches(change.affects, Affects::Structure))
            refreshList();
    });
    connect(&selection, &SelectionModel::selectionChanged, this, [this] {
        refreshList();
        m_parameters->refresh();
    });
    refreshList();
}

// The light's item, at this row.
QTreeWidgetItem* LightsPanel::placed(Id light, int row) {
    int from = row;
    while (from < m_list->topLevelItemCount() && idOf(*m_list->topLevelItem(from)) != light)
        ++from;
    if (from == row && from < m_list->topLevelItemCount())
        return m_list->topLevelItem(row);
    QTreeWidgetItem* item = m_list->takeTopLevelItem(from); // null: none yet
    if (!item) {
        item = new QTreeWidgetItem;
        item->setData(kNameColumn, Qt::UserRole, light);
        // Once: setting flags brings the old name back into an open editor.
        item->setFlags(item->flags() | Qt::ItemIsEditable | Qt::ItemIsUserCheckable);
    }
    m_list->insertTopLevelItem(row, item);
    return item;
}

void LightsPanel::refreshList() {
    m_refreshing = true;
    const std::vector<Light>& lights = m_controller.document().lights;
    // An item stays with its light, and so does the name that is being typed into it.
    const int count = static_cast<int>(lights.size());
    for (int row = m_list->topLevelItemCount() - 1; row >= 0; --row)
        if (!m_controller.document().light(idOf(*m_list->topLevelItem(row))))
            delete m_list->takeTopLevelItem(row);
    for (int row = 0; row < count; ++row) {
        const Light& light = lights[static_cast<std::size_t>(row)];
        QTreeWidgetItem* item = placed(light.id, row);
        item->setText(kNameColumn, QString::fromStdString(light.name));
        if (const int type = static_cast<int>(light.type); item->data(0, kTypeRole) != type) {
            item->setData(0, kTypeRole, type);
            item->setIcon(kNameColumn, icon(lightIcon(light.type)));
        }
        item->setCheckState(kNameColumn, light.enabled ? Qt::Checked : Qt::Unchecked);
        item->setCheckState(kSoloColumn, light.solo ? Qt::Checked : Qt::Unchecked);
        // What does not shine is dimmed, whoever silences it.
        item->setForeground(kNameColumn, isActive(m_controller.document(), light)
                                             ? QBrush()
                                             : QBrush(QColor(tokens::kTextOff)));
        if (light.id == m_selection.light())
            m_list->setCurrentItem(item);
    }
    if (m_selection.light() == 0)
        m_list->setCurrentItem(nullptr);
    const bool any = !lights.empty();
    m_list->setVisible(any);
    m_parameters->setVisible(m_selection.light() != 0);
    m_empty->setVisible(!any);
    m_duplicate->setEnabled(m_selection.light() != 0);
    m_remove->setEnabled(m_selection.light() != 0);
    m_refreshing = false;
}

} // namespace patina::editor
