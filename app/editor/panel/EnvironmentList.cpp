#include "app/editor/panel/EnvironmentList.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/FileKinds.h"
#include "app/editor/document/ProposedFolder.h"
#include "app/editor/style/Icons.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/widget/ListButton.h"
#include "app/editor/widget/ListItems.h"
#include "core/document/EnvironmentTitle.h"
#include "core/library/Library.h"
#include "core/scene/ImageProblem.h"

#include <QFileDialog>
#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QMenu>
#include <QSignalBlocker>
#include <QToolButton>
#include <QVBoxLayout>

namespace patina::editor {
QString EnvironmentList::titleOf(const Environment& environment) {
    return QString::fromStdString(environmentTitle(environment));
}

EnvironmentList::EnvironmentList(DocumentController& controller, QWidget* parent)
    : QWidget(parent)
    , m_controller(controller)
    , m_list(new QListWidget)
    , m_duplicate(makeListButton(QStringLiteral("duplicate"), {}, tr("Duplicate the environment")))
    , m_remove(makeListButton(QStringLiteral("remove"), {}, tr("Remove the environment"))) {
    m_list->setAccessibleName(tr("Environments of the scene"));
    m_list->setIconSize({16, 16});
    m_list->setStatusTip(tr("Choose the environment that lights the scene, F2 to rename it"));
    m_list->setEditTriggers(QAbstractItemView::EditKeyPressed | QAbstractItemView::DoubleClicked);

    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(tokens::kGap);
    layout->addWidget(makeButtons());
    layout->addWidget(m_list);

    connect(m_duplicate, &QToolButton::clicked, this,
            [this] { m_controller.duplicateEnvironment(m_controller.document().mix.first); });
    connect(m_remove, &QToolButton::clicked, this,
            [this] { m_controller.removeEnvironment(m_controller.document().mix.first); });
    connect(m_list, &QListWidget::currentItemChanged, this, [this](QListWidgetItem* item) {
        if (!m_refreshing && item)
            m_controller.lightWith(idOf(*item));
    });
    connect(m_list, &QListWidget::itemChanged, this, [this](QListWidgetItem* item) {
        if (m_refreshing)
            return;
        const Target target{Scope::Environment, idOf(*item)};
        const Environment* environment = m_controller.document().environment(target.id);
        if (environment && item->text() != titleOf(*environment))
            m_controller.rename(target, item->text());
        refresh(); // without a name it shows what the environment shows
    });
    connect(&controller, &DocumentController::changed, this, [this](const Change& change) {
        if (change.isAnotherDocument()) { // another document, in which ids mean others
            const QSignalBlocker silent(m_list);
            m_list->clear();
        }
        if (!change.target || change.target->scope == Scope::Environment)
            refresh();
    });
    refresh();
}

QWidget* EnvironmentList::makeButtons() {
    QToolButton* add = makeListButton(QStringLiteral("add"), tr("Add"),
                                      tr("Add an environment that the scene can be lit with"));
    add->setPopupMode(QToolButton::InstantPopup);
    auto* menu = new QMenu(add);
    menu->setToolTipsVisible(true);
    add->setMenu(menu);
    fillAdd(*menu);

    auto* buttons = new QWidget;
    auto* row = new QHBoxLayout(buttons);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(4);
    row->addWidget(new QLabel(tr("Environments")), 1);
    row->addWidget(add);
    row->addWidget(m_duplicate);
    row->addWidget(m_remove);
    return buttons;
}

void EnvironmentList::fillAdd(QMenu& menu) {
    const auto add = [&](const QString& text, const QString& help, const auto& use) {
        QAction* action = menu.addAction(text, this, use);
        action->setToolTip(help);
        action->setStatusTip(help);
    };
    for (const library::Entry& entry : library::environments())
        add(QString::fromStdString(entry.title), QString::fromStdString(entry.help),
            [this, source = QStringLiteral("builtin:") + QString::fromStdString(entry.name)] {
                m_controller.addEnvironment(source, DocumentController::EnvironmentUse::Light);
            });
    menu.addSeparator();
    add(tr("&Sky"), tr("A clear sky with its sun"),
        [this] { m_controller.addEnvironment(EnvironmentKind::Sky); });
    add(tr("Soft&boxes"), tr("Softboxes in a dark room"),
        [this] { m_controller.addEnvironment(EnvironmentKind::Softboxes); });
    menu.addSeparator();
    add(tr("Open &Image…"), tr("An HDR or EXR panorama from a file"), [this] { openImage(); });
}

void EnvironmentList::openImage() {
    const QString key = QStringLiteral("folders/environments");
    const QString file = QFileDialog::getOpenFileName(
        this, tr("Add Environment"), proposedFolder(m_controller, key), environmentFilter());
    if (file.isEmpty())
        return;
    rememberFolder(m_controller, key, file);
    m_controller.addEnvironment(file, DocumentController::EnvironmentUse::Light);
}

void EnvironmentList::refresh() {
    const Document& document = m_controller.document();
    m_refreshing = true;
    removeItems(*m_list, [&](Id id) { return !document.environment(id); });
    int current = 0;
    for (int row = 0; row < static_cast<int>(document.environments.size()); ++row) {
        const Environment& environment = document.environments[static_cast<std::size_t>(row)];
        QListWidgetItem* item = placeItem(*m_list, environment.id, row, Qt::ItemIsEditable);
        const bool second = environment.id == document.mix.second;
        item->setText(titleOf(environment));
        const QString problem = QString::fromStdString(environmentProblem(environment));
        item->setToolTip(!problem.isEmpty() ? tr("%1; a neutral grey stands in").arg(problem)
                         : second           ? tr("The second environment of the cross-fade")
                         : environment.id == document.mix.first
                             ? tr("The environment that lights the scene")
                             : tr("Light the scene with it"));
        item->setIcon(!problem.isEmpty()
                          ? icon(QStringLiteral("warning"), tokens::kCopper)
                          : icon(second ? QStringLiteral("mixer") : QStringLiteral("environment")));
        if (environment.id == document.mix.first)
            current = row;
    }
    m_list->setCurrentRow(current);
    const bool several = document.environments.size() > 1;
    m_list->setVisible(several);
    fitHeight(*m_list);
    m_remove->setEnabled(several);
    m_refreshing = false;
}

} // namespace patina::editor
