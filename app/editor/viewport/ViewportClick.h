// A click in the viewport that is no drag of the camera: for overlays that choose what is there.
#pragma once

#include <QApplication>
#include <QEvent>
#include <QMouseEvent>
#include <QPointF>
#include <optional>
#include <utility>

namespace patina::editor {

class ViewportClick {
  public:
    // Of each event of the viewport; `picks`: a press now may become a click. Where it was clicked,
    // when the left button has come up again without a drag or a key.
    std::optional<QPointF> follow(const QEvent& event, bool picks) {
        if (event.type() != QEvent::MouseButtonPress && event.type() != QEvent::MouseMove &&
            event.type() != QEvent::MouseButtonRelease)
            return std::nullopt;
        const auto& mouse = static_cast<const QMouseEvent&>(event);
        if (event.type() == QEvent::MouseButtonPress) {
            const bool plain = mouse.button() == Qt::LeftButton && mouse.modifiers() == 0;
            m_press = plain && picks ? std::optional(mouse.position()) : std::nullopt;
        } else if (m_press && (mouse.position() - *m_press).manhattanLength() >=
                                  QApplication::startDragDistance()) {
            m_press.reset(); // the camera moves
        } else if (event.type() == QEvent::MouseButtonRelease) {
            return std::exchange(m_press, std::nullopt);
        }
        return std::nullopt;
    }

  private:
    std::optional<QPointF> m_press; // that is a click so far
};

} // namespace patina::editor
