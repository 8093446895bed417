// Rays of the camera.
#pragma once

#include "core/trace/path/PathTracer.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace patina {

// In scene units.
class Eye {
  public:
    Eye(const TraceScene& scene, const TraceView& view)
        : m_width(view.width)
        , m_height(view.height)
        , m_origin(scene.toScene(glm::dvec3(view.camera.position())))
        , m_forward(view.camera.forward()) {
        const float tangent = std::tan(0.5f * glm::radians(view.camera.fovDeg));
        const float aspect = static_cast<float>(m_width) / static_cast<float>(m_height);
        m_right = tangent * aspect * view.camera.right();
        m_up = tangent * view.camera.up();
    }

    [[nodiscard]] const glm::vec3& origin() const { return m_origin; }
    // Through a point of a pixel; `at` in [0, 1)² from its upper left corner.
    [[nodiscard]] glm::vec3 direction(int x, int y, const glm::vec2& at) const {
        const float right =
            2.0f * (static_cast<float>(x) + at.x) / static_cast<float>(m_width) - 1.0f;
        const float down =
            2.0f * (static_cast<float>(y) + at.y) / static_cast<float>(m_height) - 1.0f;
        return glm::normalize(m_forward + right * m_right - down * m_up);
    }

  private:
    int m_width, m_height;
    glm::vec3 m_origin, m_forward, m_right{0.0f}, m_up{0.0f};
};

} // namespace patina
