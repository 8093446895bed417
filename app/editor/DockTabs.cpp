#include "app/editor/DockTabs.h"

#include <QApplication>
#include <QContextMenuEvent>
#include <QDockWidget>
#include <QLayout>
#include <QMainWindow>
#include <QMenu>
#include <QMouseEvent>
#include <QTabBar>

namespace patina::editor {
namespace {

constexpr QPoint kGrip(40, 12); // of the title bar, where a dock that is torn off is held

} // namespace

DockTabs::DockTabs(QMainWindow& window)
    : QObject(&window)
    , m_window(window) {}

void DockTabs::watch() {
    for (QTabBar* bar : m_window.findChildren<QTabBar*>(QString(), Qt::FindDirectChildrenOnly)) {
        if (bar->accessibleName().isEmpty()) {
            bar->setAccessibleName(tr("Docks"));
            bar->setStatusTip(tr("Drag a tab off its bar, or double-click it, to float the dock; "
                                 "right-click to float or close it"));
            bar->setUsesScrollButtons(true); // before names are cut
            bar->setElideMode(Qt::ElideNone);
        }
        bar->installEventFilter(this);
    }
}

QDockWidget* DockTabs::dockOf(const QTabBar& bar, int tab) const {
    if (tab < 0 || tab >= bar.count())
        return nullptr;
    for (QDockWidget* dock : m_window.findChildren<QDockWidget*>())
        if (dock->windowTitle() == bar.tabText(tab))
            return dock;
    return nullptr;
}

bool DockTabs::eventFilter(QObject* watched, QEvent* event) {
    auto* bar = qobject_cast<QTabBar*>(watched);
    if (!bar)
        return false;
    switch (event->type()) {
    case QEvent::MouseButtonPress: {
        const auto& mouse = *static_cast<QMouseEvent*>(event);
        m_pressed = mouse.button() == Qt::LeftButton
                        ? dockOf(*bar, bar->tabAt(mouse.position().toPoint()))
                        : nullptr;
        return false;
    }
    case QEvent::MouseMove: {
        const auto& mouse = *static_cast<QMouseEvent*>(event);
        const int reach = 3 * QApplication::startDragDistance(); // nearer: tabs change places
        if (!m_pressed || !(mouse.buttons() & Qt::LeftButton) ||
            bar->rect().adjusted(-reach, -reach, reach, reach).contains(mouse.position().toPoint()))
            return false;
        tearOff(*bar, mouse);
        return true;
    }
    case QEvent::MouseButtonRelease:
        m_pressed = nullptr;
        return false;
    case QEvent::MouseButtonDblClick: {
        const auto& mouse = *static_cast<QMouseEvent*>(event);
        m_pressed = nullptr;
        if (mouse.button() != Qt::LeftButton)
            return false;
        if (QDockWidget* dock = dockOf(*bar, bar->tabAt(mouse.position().toPoint())))
            dock->setFloating(true);
        return true;
    }
    case QEvent::ContextMenu: {
        const auto& request = *static_cast<QContextMenuEvent*>(event);
        const bool byKey = request.reason() == QContextMenuEvent::Keyboard;
        const int tab = byKey ? bar->currentIndex() : bar->tabAt(request.pos());
        if (QDockWidget* dock = dockOf(*bar, tab))
            openMenu(*dock, byKey ? bar->mapToGlobal(bar->tabRect(tab).bottomLeft())
                                  : request.globalPos());
        return true;
    }
    default:
        return false;
    }
}

void DockTabs::openMenu(QDockWidget& dock, const QPoint& global) {
    auto* menu = new QMenu(&m_window);
    menu->setObjectName(QStringLiteral("dockTabMenu"));
    menu->setAttribute(Qt::WA_DeleteOnClose);
    menu->addAction(tr("&Float"), &dock, [&dock] { dock.setFloating(true); });
    menu->addAction(tr("&Close"), &dock, &QWidget::hide);
    menu->popup(global);
}

// From here on the dock is moved like any floating one: it docks again where it is let go.
void DockTabs::tearOff(QTabBar& bar, const QMouseEvent& move) {
    QDockWidget* dock = m_pressed;
    m_pressed = nullptr;
    QMouseEvent release(QEvent::MouseButtonRelease, move.position(), move.globalPosition(),
                        Qt::LeftButton, Qt::NoButton, move.modifiers());
    QCoreApplication::sendEvent(&bar, &release); // it must not go on moving its tab
    const QSize size = dock->size();
    dock->setFloating(true);
    if (QWidget* custom = dock->titleBarWidget()) { // there is no tab any more
        dock->setTitleBarWidget(nullptr);
        custom->deleteLater();
    }
    dock->resize(size);
    dock->move(move.globalPosition().toPoint() - kGrip);
    dock->layout()->activate(); // which places the title bar
    dock->grabMouse();
    QMouseEvent press(QEvent::MouseButtonPress, kGrip, move.globalPosition(), Qt::LeftButton,
                      Qt::LeftButton, move.modifiers());
    QCoreApplication::sendEvent(dock, &press);
}

} // namespace patina::editor
