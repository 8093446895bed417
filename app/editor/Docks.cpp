#include "app/editor/Docks.h"

#include "app/editor/style/Icons.h"

#include <QAction>
#include <QDockWidget>
#include <QMainWindow>
#include <algorithm>

namespace patina::editor {
namespace {

constexpr int kInstrumentHeight = 280;

} // namespace

Docks::Docks(QMainWindow& window)
    : QObject(&window)
    , m_window(window) {
    window.setDockNestingEnabled(true);
    window.setTabPosition(Qt::AllDockWidgetAreas, QTabWidget::North);
    window.setCorner(Qt::BottomLeftCorner, Qt::LeftDockWidgetArea);
    window.setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);
}

QDockWidget* Docks::add(const QString& name, const QString& title, const QString& iconName,
                        const QString& help, QWidget* panel) {
    auto* dock = new QDockWidget(title, &m_window);
    dock->setObjectName(name); // saveState() finds it by this
    panel->setAttribute(Qt::WA_StyledBackground);
    dock->setWidget(panel);
    QAction* toggle = dock->toggleViewAction();
    toggle->setIcon(icon(iconName));
    toggle->setStatusTip(help);
    toggle->setToolTip(help);
    m_docks << dock;
    // In a group of tabs the tab is title enough.
    for (auto signal : {&QDockWidget::topLevelChanged, &QDockWidget::visibilityChanged})
        connect(dock, signal, this, &Docks::refreshTitles, Qt::QueuedConnection);
    connect(dock, &QDockWidget::dockLocationChanged, this, &Docks::refreshTitles,
            Qt::QueuedConnection);
    return dock;
}

QDockWidget* Docks::addInstrument(QAction* toggle, const QString& name, QWidget* panel) {
    const QString title = toggle->iconText(); // without the mnemonic
    QDockWidget* dock = add(name, title, QStringLiteral("view"), toggle->statusTip(), panel);
    dock->toggleViewAction()->setIcon(toggle->icon());
    m_instruments << dock;
    // Not the dock's own action: that one counts a dock behind a tab as shown, and would close it.
    connect(dock, &QDockWidget::visibilityChanged, toggle, &QAction::setChecked);
    connect(toggle, &QAction::triggered, dock, [this, dock](bool on) {
        dock->setVisible(on);
        if (!on)
            return;
        dock->raise();
        if (!dock->isFloating() && dock->height() < kInstrumentHeight &&
            m_window.dockWidgetArea(dock) == Qt::BottomDockWidgetArea)
            m_window.resizeDocks({dock}, {kInstrumentHeight}, Qt::Vertical);
    });
    return dock;
}

void Docks::refreshTitles() {
    for (QDockWidget* dock : std::as_const(m_docks)) {
        // Docks that are closed have no tab; those behind the current one are not hidden.
        const QList<QDockWidget*> others = m_window.tabifiedDockWidgets(dock);
        const bool tabbed = !dock->isFloating() &&
                            std::any_of(others.begin(), others.end(), [](const QDockWidget* other) {
                                return !other->isHidden();
                            });
        QWidget* custom = dock->titleBarWidget();
        if (tabbed && !custom) {
            auto* none = new QWidget;
            none->setFixedHeight(0);
            dock->setTitleBarWidget(none);
        } else if (!tabbed && custom) {
            dock->setTitleBarWidget(nullptr);
            delete custom;
        }
    }
}

QList<QAction*> Docks::toggles() const {
    QList<QAction*> actions;
    for (const QDockWidget* dock : m_docks)
        if (!m_instruments.contains(dock))
            actions << dock->toggleViewAction();
    return actions;
}

void Docks::reset() {
    enum { Scene, MaterialDock, EnvironmentDock, Lights, ViewDock, Bake, Model, Jobs, Log };
    for (QDockWidget* dock : std::as_const(m_docks)) {
        dock->setFloating(false);
        m_window.removeDockWidget(dock);
    }
    m_window.addDockWidget(Qt::LeftDockWidgetArea, m_docks[Scene]);
    m_window.addDockWidget(Qt::LeftDockWidgetArea, m_docks[EnvironmentDock]);
    m_window.tabifyDockWidget(m_docks[EnvironmentDock], m_docks[Lights]);
    m_window.tabifyDockWidget(m_docks[Lights], m_docks[ViewDock]);
    m_window.addDockWidget(Qt::RightDockWidgetArea, m_docks[MaterialDock]);
    m_window.tabifyDockWidget(m_docks[MaterialDock], m_docks[Model]);
    m_window.tabifyDockWidget(m_docks[Model], m_docks[Bake]);
    m_window.addDockWidget(Qt::BottomDockWidgetArea, m_docks[Jobs]);
    m_window.tabifyDockWidget(m_docks[Jobs], m_docks[Log]);
    for (QDockWidget* dock : std::as_const(m_instruments))
        m_window.tabifyDockWidget(m_docks[Log], dock);
    for (QDockWidget* dock : std::as_const(m_docks))
        dock->setVisible(dock != m_docks[Jobs] && dock != m_docks[Log] &&
                         !m_instruments.contains(dock));
    m_docks[EnvironmentDock]->raise();
    m_docks[MaterialDock]->raise();
    m_window.resizeDocks({m_docks[Scene], m_docks[MaterialDock]}, {304, 356}, Qt::Horizontal);
    m_window.resizeDocks({m_docks[Scene], m_docks[EnvironmentDock]}, {340, 420}, Qt::Vertical);
}

} // namespace patina::editor
