#include "app/editor/EscapeKey.h"

#include <QAbstractItemView>
#include <QApplication>
#include <QKeyEvent>
#include <QMainWindow>
#include <algorithm>
#include <utility>

namespace patina::editor {

EscapeKey::EscapeKey(QMainWindow& window, std::vector<Way> ways)
    : QObject(&window)
    , m_window(window)
    , m_ways(std::move(ways)) {
    QCoreApplication::instance()->installEventFilter(this);
}

bool EscapeKey::leave() const {
    if (QGuiApplication::mouseButtons() != Qt::NoButton) // a drag is what would be ended
        return false;
    return std::any_of(m_ways.begin(), m_ways.end(), [](const Way& way) { return way(); });
}

bool EscapeKey::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() != QEvent::KeyPress)
        return false;
    const auto* key = static_cast<QKeyEvent*>(event);
    const auto* widget = qobject_cast<QWidget*>(watched);
    if (!widget || key->key() != Qt::Key_Escape || key->modifiers() != Qt::NoModifier)
        return false;
    // Lists and trees take every key, to search with; while one of their items is edited, the
    // editor has the focus.
    if (qobject_cast<const QAbstractItemView*>(widget)) {
        event->ignore();
        return true;
    }
    // A key that nobody took arrives at the window of the widget with the focus.
    const bool ours =
        widget == &m_window || (widget->isWindow() && widget->windowType() == Qt::Tool &&
                                widget->parentWidget() == &m_window);
    return ours && leave();
}

} // namespace patina::editor
