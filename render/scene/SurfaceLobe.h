// A lobe of reflection that stands on the surface at one point (the editor).
#pragma once

#include "core/light/LobeMesh.h"

#include <glm/vec3.hpp>
#include <memory>

namespace patina::render {

struct SurfaceLobe {
    std::shared_ptr<const LobeMesh> mesh; // in the frame below
    glm::vec3 position{0.0f};             // world, as are all of them
    glm::vec3 tangent{1.0f, 0.0f, 0.0f}, bitangent{0.0f, 1.0f, 0.0f}, normal{0.0f, 0.0f, 1.0f};
    LobeEnd end = LobeEnd::Light; // what `toFixed` points to
    glm::vec3 toFixed{0.0f, 0.0f, 1.0f};
    glm::vec3 color{1.0f}; // of the display, 0…1
};

inline constexpr float kSurfaceLobeReach = 80.0f; // of its peak, in units of the overlay

} // namespace patina::render
