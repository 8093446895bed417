// Where points and lines of the scene lie in a widget over the viewport.
#pragma once

#include "core/math/Camera.h"

#include <QLineF>
#include <QPointF>
#include <QSize>
#include <optional>

namespace patina::editor {

class ViewLines {
  public:
    ViewLines(const Camera& camera, const QSize& size);

    // Nothing: behind the viewer.
    [[nodiscard]] std::optional<QPointF> point(const glm::vec3& world) const;
    // What of a line is in front of the viewer.
    [[nodiscard]] std::optional<QLineF> line(const glm::vec3& from, const glm::vec3& to) const;
    // Of the ray through a point of the widget, in the world; unit.
    [[nodiscard]] glm::vec3 direction(const QPointF& at) const;

  private:
    [[nodiscard]] glm::vec3 inView(const glm::vec3& world) const; // right, up, forward; metres
    [[nodiscard]] QPointF project(const glm::vec3& view) const;

    glm::vec3 m_position, m_right, m_up, m_forward;
    float m_nearest; // metres: what is nearer is cut off
    float m_scale;   // pixels of a slope of 1
    QPointF m_middle;
};

} // namespace patina::editor
