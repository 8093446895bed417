// The view camera: it orbits a target. World: right-handed, +Y up, metres. At yaw 0 and pitch 0 it
// stands on the +Z side of the target and looks along -Z, so that it faces an asset's front.
#pragma once

#include "core/math/Bounds.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace patina {

// Height of the sensor behind the lens: full frame is 36 mm x 24 mm (ISO 1007, film of type 135).
inline constexpr float kSensorHeight = 0.024f; // metres

// A thin lens in place of the pinhole (Potmesil & Chakravarty 1981, "A Lens and Aperture Camera
// Model for Synthetic Image Generation"). The focal length f follows from the field of view and the
// sensor, f = kSensorHeight / 2 / tan(fov / 2), and the aperture's diameter from both, f / N. The
// field of view stays as it is wherever the lens is focused.
struct Lens {
    bool depthOfField = false;  // else a pinhole: everything is sharp
    float fStop = 1.4f;         // N, > 0
    float focusDistance = 4.0f; // metres along the view axis to the plane that is sharp, > 0

    friend bool operator==(const Lens&, const Lens&) = default;
};

struct Camera {
    glm::vec3 target{0.0f};
    float yawDeg = 30.0f;   // positive turns the camera towards +X
    float pitchDeg = 15.0f; // positive looks down from above, -89…89
    float distance = 4.0f;  // metres, > 0
    float fovDeg = 35.0f;   // vertical field of view
    Lens lens{};

    [[nodiscard]] glm::vec3 position() const;
    [[nodiscard]] glm::vec3 forward() const;
    [[nodiscard]] glm::vec3 right() const;
    [[nodiscard]] glm::vec3 up() const;
    [[nodiscard]] glm::mat4 viewMatrix() const;
    // OpenGL clip space, depth -1…1; near and far planes enclose `scene` with some room.
    [[nodiscard]] glm::mat4 projectionMatrix(float aspect, const Bounds& scene) const;

    // --- The lens. Points of it are metres right and up of its middle, which is position(). ---
    [[nodiscard]] float focalLength() const; // metres
    [[nodiscard]] float lensRadius() const;  // metres; 0: a pinhole
    [[nodiscard]] glm::vec3 position(const glm::vec2& onLens) const;
    // From the world to OpenGL clip space as seen from a point of the lens: what lies at the focus
    // distance stays where it is seen from the middle. In the middle projectionMatrix() *
    // viewMatrix().
    [[nodiscard]] glm::mat4 worldToClip(float aspect, const Bounds& scene,
                                        const glm::vec2& onLens = glm::vec2(0.0f)) const;

    friend bool operator==(const Camera&, const Camera&) = default;
};

// Moves target and distance so that the box `scene` fits both directions of the picture with a
// small margin; keeps yaw, pitch, field of view and lens. The editor, the command line and every
// renderer frame through this one function.
[[nodiscard]] Camera frameBounds(Camera camera, const Bounds& scene, float aspect);

} // namespace patina
