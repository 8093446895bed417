#include "app/editor/trace/ViewLines.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace patina::editor {
namespace {

constexpr float kNearestShare = 1e-3f; // of the camera's distance from its target

} // namespace

ViewLines::ViewLines(const Camera& camera, const QSize& size)
    : m_position(camera.position())
    , m_right(camera.right())
    , m_up(camera.up())
    , m_forward(camera.forward())
    , m_nearest(kNearestShare * camera.distance)
    , m_scale(0.5f * static_cast<float>(size.height()) /
              std::tan(0.5f * glm::radians(camera.fovDeg)))
    , m_middle(0.5 * size.width(), 0.5 * size.height()) {}

glm::vec3 ViewLines::inView(const glm::vec3& world) const {
    const glm::vec3 from = world - m_position;
    return {glm::dot(from, m_right), glm::dot(from, m_up), glm::dot(from, m_forward)};
}

QPointF ViewLines::project(const glm::vec3& view) const {
    const float scale = m_scale / view.z;
    return m_middle +
           QPointF(static_cast<double>(scale * view.x), -static_cast<double>(scale * view.y));
}

glm::vec3 ViewLines::direction(const QPointF& at) const {
    const QPointF from = at - m_middle;
    return glm::normalize(m_scale * m_forward + static_cast<float>(from.x()) * m_right -
                          static_cast<float>(from.y()) * m_up);
}

std::optional<QPointF> ViewLines::point(const glm::vec3& world) const {
    const glm::vec3 view = inView(world);
    return view.z < m_nearest ? std::nullopt : std::optional(project(view));
}

std::optional<QLineF> ViewLines::line(const glm::vec3& from, const glm::vec3& to) const {
    glm::vec3 a = inView(from), b = inView(to);
    if (a.z < m_nearest && b.z < m_nearest)
        return std::nullopt;
    const auto cut = [this](const glm::vec3& outside, const glm::vec3& inside) {
        return inside + (outside - inside) * ((inside.z - m_nearest) / (inside.z - outside.z));
    };
    if (a.z < m_nearest)
        a = cut(a, b);
    else if (b.z < m_nearest)
        b = cut(b, a);
    return QLineF(project(a), project(b));
}

} // namespace patina::editor
