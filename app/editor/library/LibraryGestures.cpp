#include "app/editor/library/LibraryGestures.h"

#include "app/editor/document/QtText.h"
#include "app/editor/library/EnvironmentLibrary.h"
#include "app/editor/library/EnvironmentPreview.h"
#include "app/editor/library/LibraryDelegate.h"
#include "app/editor/library/LibraryModel.h"
#include "app/editor/library/LibraryView.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QScrollBar>
#include <utility>

namespace patina::editor {
namespace {

constexpr double kKeyDegrees = 5.0; // of a key press

} // namespace

LibraryGestures::LibraryGestures(EnvironmentLibrary& library, EnvironmentPreview& preview,
                                 LibraryView& view, QWidget& panel)
    : QObject(&view)
    , m_library(library)
    , m_preview(preview)
    , m_view(view)
    , m_turn(library.controller(), view) {
    m_rest.setSingleShot(true);
    m_rest.setInterval(kRestMs);
    connect(&m_rest, &QTimer::timeout, this, [this] {
        if (const LibraryItem* item = m_library.item(m_hovered);
            item != nullptr && m_hovered != m_library.current())
            m_preview.show(m_hovered, toQString(item->entry->title));
    });
    connect(view.verticalScrollBar(), &QScrollBar::valueChanged, this, [this] {
        const QPoint at = m_view.viewport()->mapFromGlobal(QCursor::pos());
        endHover(m_view.indexAt(at).data(LibraryModel::SourceRole).toString());
    });
    connect(&library, &EnvironmentLibrary::currentChanged, this, [this] {
        // What is used is previewed until it is there; what is stepped to is another one.
        if (m_library.current() != m_hovered)
            endHover(m_hovered);
    });
    view.installEventFilter(this);
    view.viewport()->installEventFilter(this);
    panel.installEventFilter(this); // Esc passes lists by, and arrives at what they are in
}

bool LibraryGestures::eventFilter(QObject* watched, QEvent* event) {
    switch (event->type()) {
    case QEvent::MouseButtonPress:
        return watched == m_view.viewport() && press(*static_cast<QMouseEvent*>(event));
    case QEvent::MouseMove:
        return watched == m_view.viewport() && move(*static_cast<QMouseEvent*>(event));
    case QEvent::MouseButtonRelease:
        return watched == m_view.viewport() && release(*static_cast<QMouseEvent*>(event));
    case QEvent::KeyPress: {
        const auto& key = *static_cast<QKeyEvent*>(event);
        return (watched == &m_view && pressKey(key)) || (key.key() == Qt::Key_Escape && leave());
    }
    case QEvent::Leave:
    case QEvent::Hide:
        if (watched == m_view.viewport())
            endHover({});
        return false;
    case QEvent::FocusOut:
        m_turnsByKey = false;
        return false;
    default:
        return false;
    }
}

// --- Preview -------------------------------------------------------------------------------------

void LibraryGestures::hover(const QPoint& position) {
    const QString source = m_view.indexAt(position).data(LibraryModel::SourceRole).toString();
    if (source != m_hovered) {
        endHover(source);
        if (!source.isEmpty())
            m_rest.start();
    } else if (m_rest.isActive()) {
        m_rest.start(); // it does not rest yet
    }
}

void LibraryGestures::endHover(const QString& source) {
    m_rest.stop();
    m_hovered = source;
    m_preview.end();
}

// --- Rotation ------------------------------------------------------------------------------------

bool LibraryGestures::canTurnAt(const QPoint& position, Qt::KeyboardModifiers keys) const {
    const QModelIndex index = m_view.indexAt(position);
    if (!index.data(LibraryModel::RotationRole).isValid())
        return false;
    const QRect item = m_view.visualRect(index);
    return LibraryDelegate::turnRect(item).contains(position) ||
           (keys.testFlag(Qt::ShiftModifier) &&
            LibraryDelegate::pictureRect(item).contains(position) &&
            !LibraryDelegate::starRect(item).contains(position));
}

bool LibraryGestures::press(const QMouseEvent& event) {
    m_turnsByKey = false;
    m_rest.stop();
    if (m_turning)
        return true; // a second button changes nothing
    if (event.button() != Qt::LeftButton ||
        !canTurnAt(event.position().toPoint(), event.modifiers()))
        return false;
    m_view.setFocus(Qt::MouseFocusReason);
    m_turning = true;
    m_lastX = event.position().x();
    m_turn.begin();
    m_view.viewport()->setCursor(Qt::SizeHorCursor);
    return true;
}

bool LibraryGestures::move(const QMouseEvent& event) {
    if (m_turning) {
        // The picture follows the pointer.
        const double pixels = event.position().x() - std::exchange(m_lastX, event.position().x());
        const int width = LibraryDelegate::pictureRect(QRect()).width();
        if (pixels != 0.0)
            m_turn.turnBy(-pixels * 360.0 / width);
        return true;
    }
    if (event.buttons() == Qt::NoButton)
        hover(event.position().toPoint());
    else
        endHover({}); // something is dragged
    if (event.buttons() == Qt::NoButton && canTurnAt(event.position().toPoint(), event.modifiers()))
        m_view.viewport()->setCursor(Qt::SizeHorCursor);
    else
        m_view.viewport()->unsetCursor();
    return false;
}

bool LibraryGestures::release(const QMouseEvent& event) {
    if (!m_turning)
        return false;
    if (event.button() == Qt::LeftButton)
        m_turning = false;
    return true;
}

bool LibraryGestures::leave() {
    if (!std::exchange(m_turning, false))
        return false;
    m_turn.cancel();
    return true;
}

bool LibraryGestures::pressKey(const QKeyEvent& event) {
    const bool sideways = event.key() == Qt::Key_Left || event.key() == Qt::Key_Right;
    if (!sideways || event.modifiers() != Qt::ShiftModifier ||
        !m_view.currentIndex().data(LibraryModel::RotationRole).isValid()) {
        m_turnsByKey = m_turnsByKey && event.key() == Qt::Key_Shift;
        return false;
    }
    if (!std::exchange(m_turnsByKey, true))
        m_turn.begin();
    m_turn.turnBy(event.key() == Qt::Key_Left ? kKeyDegrees : -kKeyDegrees);
    return true;
}

} // namespace patina::editor
