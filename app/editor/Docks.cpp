#include "app/editor/Docks.h"

#include "app/editor/DockTabs.h"

#include <QAction>
#include <QApplication>
#include <QDockWidget>
#include <QEvent>
#include <QMainWindow>
#include <QScreen>
#include <algorithm>
#include <tuple>

namespace patina::editor {
namespace {

constexpr int kInstrumentHeight = 280;
constexpr int kFloatMargin = 32; // of a floating dock to the edges of the picture and to others

// In which order the keys go round: left, the picture, right, below, what floats.
enum Region { kLeft, kTop, kPicture, kRight, kBottom, kFloating };

Region regionOf(Qt::DockWidgetArea area) {
    switch (area) {
    case Qt::LeftDockWidgetArea:
        return kLeft;
    case Qt::TopDockWidgetArea:
        return kTop;
    case Qt::RightDockWidgetArea:
        return kRight;
    default:
        return kBottom;
    }
}

bool takesKeys(const QWidget* widget) {
    return widget->isVisible() && widget->isEnabled() && (widget->focusPolicy() & Qt::TabFocus) &&
           widget->focusProxy() == nullptr;
}

// Where the keys were last in `station`, or its first control, or itself.
QWidget* focusTarget(QWidget* station) {
    if (takesKeys(station))
        return station;
    QWidget* last = station->focusWidget();
    if (last && last != station && station->isAncestorOf(last) && takesKeys(last))
        return last;
    for (QWidget* next = station->nextInFocusChain(); next != station;
         next = next->nextInFocusChain())
        if (station->isAncestorOf(next) && takesKeys(next))
            return next;
    return station;
}

} // namespace

Docks::Docks(QMainWindow& window)
    : QObject(&window)
    , m_window(window)
    , m_tabs(new DockTabs(window)) {
    window.setDockNestingEnabled(true);
    window.setTabPosition(Qt::AllDockWidgetAreas, QTabWidget::North);
    window.setCorner(Qt::BottomLeftCorner, Qt::LeftDockWidgetArea);
    window.setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);
    window.installEventFilter(this);
}

QDockWidget* Docks::add(QAction* toggle, const QString& name, QWidget* panel) {
    auto* dock = new QDockWidget(toggle->iconText(), &m_window); // without the mnemonic
    dock->setObjectName(name);                                   // saveState() finds it by this
    panel->setAttribute(Qt::WA_StyledBackground);
    dock->setWidget(panel);
    m_docks << dock;
    // Not the dock's own action: that one counts a dock behind a tab as shown, and would close it.
    toggle->setCheckable(true);
    connect(dock, &QDockWidget::visibilityChanged, toggle, &QAction::setChecked);
    connect(toggle, &QAction::triggered, dock, [this, dock](bool on) {
        if (on)
            open(dock);
        else
            dock->hide();
    });
    connect(dock, &QDockWidget::topLevelChanged, this,
            [this, dock](bool floating) { floatingChanged(dock, floating); });
    // In a group of tabs the tab is title enough.
    for (auto signal : {&QDockWidget::topLevelChanged, &QDockWidget::visibilityChanged})
        connect(dock, signal, this, &Docks::refreshTitles, Qt::QueuedConnection);
    connect(dock, &QDockWidget::dockLocationChanged, this, &Docks::refreshTitles,
            Qt::QueuedConnection);
    return dock;
}

QDockWidget* Docks::addInstrument(QAction* toggle, const QString& name, QWidget* panel) {
    QDockWidget* dock = add(toggle, name, panel);
    m_instruments << dock;
    return dock;
}

void Docks::open(QDockWidget* dock) {
    dock->show();
    dock->raise();
    if (m_instruments.contains(dock) && !dock->isFloating() && dock->height() < kInstrumentHeight &&
        m_window.dockWidgetArea(dock) == Qt::BottomDockWidgetArea)
        m_window.resizeDocks({dock}, {kInstrumentHeight}, Qt::Vertical);
}

// --- Floating ------------------------------------------------------------------------------------

void Docks::floatingChanged(QDockWidget* dock, bool floating) {
    if (!floating || m_floatedBefore.contains(dock))
        return;
    m_floatedBefore << dock;
    if (m_restoring)
        return;
    // Once it is known whether the mouse is dragging it.
    QMetaObject::invokeMethod(
        dock,
        [this, dock] {
            if (dock->isFloating() && QWidget::mouseGrabber() != dock)
                placeFloating(dock);
        },
        Qt::QueuedConnection);
}

// Over the picture: its neighbours have taken the place where it was.
void Docks::placeFloating(QDockWidget* dock) {
    const QWidget* centre = m_window.centralWidget();
    const QRect picture(centre->mapToGlobal(QPoint(0, 0)), centre->size());
    const QRect screen = m_window.screen()->availableGeometry();
    const QRect room =
        picture.adjusted(kFloatMargin, kFloatMargin, -kFloatMargin, -kFloatMargin) & screen;
    const QSize size = dock->size().boundedTo(room.size()).expandedTo(dock->minimumSizeHint());
    dock->resize(size);
    // As near as may be to where it was.
    QPoint at(
        std::clamp(dock->x(), room.left(), std::max(room.left(), room.right() - size.width())),
        std::clamp(dock->y(), room.top(), std::max(room.top(), room.bottom() - size.height())));
    const auto taken = [&] {
        return std::any_of(m_docks.begin(), m_docks.end(), [&](const QDockWidget* other) {
            return other != dock && other->isFloating() && other->isVisible() &&
                   (other->pos() - at).manhattanLength() < kFloatMargin;
        });
    };
    for (qsizetype tries = 0; tries < m_docks.size() && taken(); ++tries)
        at += QPoint(kFloatMargin, kFloatMargin);
    at.setX(
        std::clamp(at.x(), screen.left(), std::max(screen.left(), screen.right() - size.width())));
    at.setY(
        std::clamp(at.y(), screen.top(), std::max(screen.top(), screen.bottom() - size.height())));
    dock->move(at);
}

bool Docks::restore(const QByteArray& state, int version) {
    m_restoring = true;
    const bool restored = m_window.restoreState(state, version);
    m_restoring = false;
    if (m_window.isVisible())
        return restored;
    // On screen before the window, they would not belong to it and lie behind it.
    for (QDockWidget* dock : std::as_const(m_docks)) {
        if (dock->isFloating() && !dock->isHidden()) {
            dock->hide();
            m_waiting << dock;
        }
    }
    return restored;
}

QStringList Docks::closeOpened() {
    QStringList closed;
    for (QDockWidget* dock : std::as_const(m_docks)) {
        if (isOpenAtFirst(dock))
            continue;
        const bool waits = m_waiting.removeOne(dock);
        if (dock->isHidden() && !waits)
            continue;
        dock->hide();
        closed << dock->windowTitle();
    }
    return closed;
}

void Docks::showWaiting() {
    for (QDockWidget* dock : std::exchange(m_waiting, {})) {
        dock->show();
        dock->raise();
    }
}

bool Docks::eventFilter(QObject*, QEvent* event) {
    if (event->type() == QEvent::Show && !m_waiting.isEmpty()) // it is on screen afterwards
        QMetaObject::invokeMethod(this, &Docks::showWaiting, Qt::QueuedConnection);
    return false;
}

// --- Keys ----------------------------------------------------------------------------------------

std::vector<QWidget*> Docks::stations() const {
    using Order = std::tuple<Region, int, int, qsizetype>;
    std::vector<std::pair<Order, QWidget*>> found;
    found.emplace_back(Order{kPicture, 0, 0, 0}, m_window.centralWidget());
    for (qsizetype i = 0; i < m_docks.size(); ++i) {
        QDockWidget* dock = m_docks[i];
        if (dock->isHidden())
            continue;
        // A group of tabs is where the one in front is.
        const QWidget* front = dock;
        for (const QDockWidget* other : m_window.tabifiedDockWidgets(dock))
            if (dock->visibleRegion().isEmpty() && !other->visibleRegion().isEmpty())
                front = other;
        const Region region =
            dock->isFloating() ? kFloating : regionOf(m_window.dockWidgetArea(dock));
        found.emplace_back(Order{region, front->y(), front->x(), i}, dock);
    }
    std::sort(found.begin(), found.end());
    std::vector<QWidget*> widgets;
    for (const auto& [order, widget] : found)
        widgets.push_back(widget);
    return widgets;
}

void Docks::focusBy(int step) {
    const std::vector<QWidget*> all = stations();
    const auto count = static_cast<int>(all.size());
    const QWidget* focus = QApplication::focusWidget();
    int at = 0;
    for (int i = 0; i < count; ++i) {
        const QWidget* station = all[static_cast<std::size_t>(i)];
        if (station == m_window.centralWidget() && !focus)
            at = i;
        if (focus && (station == focus || station->isAncestorOf(focus)))
            at = i;
    }
    QWidget* next = all[static_cast<std::size_t>((at + step + count) % count)];
    if (auto* dock = qobject_cast<QDockWidget*>(next)) {
        open(dock);
        if (dock->isFloating())
            dock->activateWindow();
    }
    if (!next->isWindow())
        m_window.activateWindow();
    focusTarget(next)->setFocus(Qt::TabFocusReason);
}

void Docks::focusNext() {
    focusBy(1);
}

void Docks::focusPrevious() {
    focusBy(-1);
}

// --- Layout --------------------------------------------------------------------------------------

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
    m_tabs->watch();
}

namespace {
// In the order in which MainWindow adds them.
enum {
    Scene,
    MaterialDock,
    EnvironmentDock,
    Lights,
    ViewDock,
    Bake,
    Model,
    Jobs,
    Log,
    History,
    Snapshots
};
} // namespace

bool Docks::isOpenAtFirst(QDockWidget* dock) const {
    return dock != m_docks[Jobs] && dock != m_docks[Log] && dock != m_docks[History] &&
           dock != m_docks[Snapshots] && !m_instruments.contains(dock);
}

void Docks::reset() {
    for (QDockWidget* dock : std::as_const(m_docks)) {
        dock->setFloating(false);
        m_window.removeDockWidget(dock);
    }
    m_window.addDockWidget(Qt::LeftDockWidgetArea, m_docks[Scene]);
    m_window.addDockWidget(Qt::LeftDockWidgetArea, m_docks[EnvironmentDock]);
    m_window.tabifyDockWidget(m_docks[EnvironmentDock], m_docks[Lights]);
    m_window.tabifyDockWidget(m_docks[Lights], m_docks[ViewDock]);
    m_window.addDockWidget(Qt::LeftDockWidgetArea, m_docks[History]);
    m_window.tabifyDockWidget(m_docks[ViewDock], m_docks[History]);
    m_window.addDockWidget(Qt::RightDockWidgetArea, m_docks[MaterialDock]);
    m_window.tabifyDockWidget(m_docks[MaterialDock], m_docks[Model]);
    m_window.tabifyDockWidget(m_docks[Model], m_docks[Bake]);
    m_window.addDockWidget(Qt::RightDockWidgetArea, m_docks[Snapshots]);
    m_window.tabifyDockWidget(m_docks[Bake], m_docks[Snapshots]);
    m_window.addDockWidget(Qt::BottomDockWidgetArea, m_docks[Jobs]);
    m_window.tabifyDockWidget(m_docks[Jobs], m_docks[Log]);
    for (QDockWidget* dock : std::as_const(m_instruments))
        m_window.tabifyDockWidget(m_docks[Log], dock);
    for (QDockWidget* dock : std::as_const(m_docks))
        dock->setVisible(isOpenAtFirst(dock));
    m_docks[EnvironmentDock]->raise();
    m_docks[MaterialDock]->raise();
    m_window.resizeDocks({m_docks[Scene], m_docks[MaterialDock]}, {304, 356}, Qt::Horizontal);
    m_window.resizeDocks({m_docks[Scene], m_docks[EnvironmentDock]}, {340, 420}, Qt::Vertical);
}

} // namespace patina::editor
