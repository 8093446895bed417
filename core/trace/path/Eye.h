// Rays of the camera.
#pragma once

#include "core/math/Sampling.h"
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
        const Camera& camera = view.camera;
        if (const float radius = scene.sceneUnits(camera.lensRadius()); radius > 0.0f) {
            m_hasLens = true;
            m_lensRight = radius * camera.right();
            m_lensUp = radius * camera.up();
            m_focus = scene.sceneUnits(camera.lens.focusDistance);
        }
    }

    struct Ray {
        glm::vec3 origin, direction;
    };
    [[nodiscard]] bool hasLens() const { return m_hasLens; }
    // Through the same point of the plane in focus from anywhere on the lens, `onLens` in [0, 1)².
    // Pharr, Jakob & Humphreys, "Physically Based Rendering", section "The Thin Lens Model".
    [[nodiscard]] Ray throughLens(int x, int y, const glm::vec2& at,
                                  const glm::vec2& onLens) const {
        const glm::vec3 seen = direction(x, y, at);
        const glm::vec2 disc = concentricDisc(onLens);
        const glm::vec3 offset = disc.x * m_lensRight + disc.y * m_lensUp;
        const glm::vec3 inFocus = m_focus / glm::dot(seen, m_forward) * seen;
        return {m_origin + offset, glm::normalize(inFocus - offset)};
    }

    // From the middle of the lens.
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
    bool m_hasLens = false;
    glm::vec3 m_lensRight{0.0f}, m_lensUp{0.0f};
    float m_focus = 0.0f; // distance of the plane in focus along the view axis
};

} // namespace patina
