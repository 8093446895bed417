// The view camera: it orbits a target. World: right-handed, +Y up, metres. At yaw 0 and pitch 0 it
// stands on the +Z side of the target and looks along -Z, so that it faces an asset's front.
#pragma once

#include "core/math/Bounds.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace patina {

struct Camera {
    glm::vec3 target{0.0f};
    float yawDeg = 30.0f;   // positive turns the camera towards +X
    float pitchDeg = 15.0f; // positive looks down from above, -89…89
    float distance = 4.0f;  // metres, > 0
    float fovDeg = 35.0f;   // vertical field of view

    [[nodiscard]] glm::vec3 position() const;
    [[nodiscard]] glm::vec3 forward() const;
    [[nodiscard]] glm::vec3 right() const;
    [[nodiscard]] glm::vec3 up() const;
    [[nodiscard]] glm::mat4 viewMatrix() const;
    // OpenGL clip space, depth -1…1; near and far planes enclose `scene` with some room.
    [[nodiscard]] glm::mat4 projectionMatrix(float aspect, const Bounds& scene) const;

    friend bool operator==(const Camera&, const Camera&) = default;
};

// Moves target and distance so that the box `scene` fits both directions of the picture with a
// small margin; keeps yaw, pitch and field of view. The editor, the command line and every renderer
// frame through this one function.
[[nodiscard]] Camera frameBounds(Camera camera, const Bounds& scene, float aspect);

} // namespace patina
