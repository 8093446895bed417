#include "app/editor/viewport/Navigator.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

namespace patina::editor {
namespace {

constexpr float kDegreesPerPixel = 0.4f;
constexpr float kMaxPitchDeg = 89.0f; // at the pole "up" is undefined

void turn(Camera& camera, glm::vec2 pixels, float degreesPerPixel) {
    camera.yawDeg = std::remainder(camera.yawDeg - pixels.x * degreesPerPixel, 360.0f);
    camera.pitchDeg =
        std::clamp(camera.pitchDeg + pixels.y * degreesPerPixel, -kMaxPitchDeg, kMaxPitchDeg);
}

} // namespace

Camera orbit(Camera camera, glm::vec2 pixels) {
    turn(camera, pixels, kDegreesPerPixel);
    return camera;
}

Camera pan(Camera camera, glm::vec2 pixels, float height) {
    const float metresPerPixel = 2.0f * camera.distance *
                                 std::tan(0.5f * glm::radians(camera.fovDeg)) /
                                 std::max(height, 1.0f);
    camera.target += metresPerPixel * (pixels.y * camera.up() - pixels.x * camera.right());
    return camera;
}

Camera dolly(Camera camera, float steps, float sceneRadius) {
    const float radius = std::max(sceneRadius, 1e-4f);
    camera.distance =
        std::clamp(camera.distance * std::pow(0.9f, steps), 1e-3f * radius, 100.0f * radius);
    return camera;
}

Camera look(Camera camera, glm::vec2 pixels) {
    const glm::vec3 position = camera.position();
    // Finer than orbiting: the whole picture moves. The yaw is the side the camera stands on, so
    // looking right is the same turn as orbiting left.
    turn(camera, pixels, 0.5f * kDegreesPerPixel);
    camera.target = position + camera.distance * camera.forward();
    return camera;
}

Camera fly(Camera camera, const glm::vec3& metres) {
    camera.target +=
        metres.x * camera.right() + metres.y * camera.up() + metres.z * camera.forward();
    return camera;
}

} // namespace patina::editor
