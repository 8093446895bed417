#include "core/scene/SceneCameras.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace patina {

Camera cameraLike(const SceneCamera& camera, const Camera& view, const Bounds& scene,
                  std::string& notice) {
    constexpr float kSteepest = 89.0f, kVisible = 0.1f; // degrees
    Camera result = view;
    result.fovDeg = std::clamp(camera.fovDeg, 1.0f, 170.0f);
    const glm::vec3 back = -camera.forward;
    const float pitch = glm::degrees(std::asin(std::clamp(back.y, -1.0f, 1.0f)));
    result.pitchDeg = std::clamp(pitch, -kSteepest, kSteepest);
    // Of one that looks straight down, what is up in its picture tells where it is turned to.
    const glm::vec3 level = std::abs(pitch) < kSteepest ? back
                            : pitch > 0.0f              ? -camera.up
                                                        : camera.up;
    result.yawDeg = glm::degrees(std::atan2(level.x, level.z));
    const float away = scene.empty() ? 0.0f : glm::dot(scene.center() - camera.position, -back);
    result.distance = away > 0.0f ? away : std::max(scene.radius(), 1.0f);
    result.target = camera.position + result.forward() * result.distance;

    const float roll = glm::degrees(
        std::acos(std::clamp(glm::dot(glm::normalize(camera.up), result.up()), -1.0f, 1.0f)));
    if (std::abs(pitch) > kSteepest + kVisible)
        notice = fmt::format("the camera \"{}\" looks more steeply than view cameras can; it is "
                             "shown at {:g}°",
                             camera.name, kSteepest);
    else if (roll > kVisible)
        notice = fmt::format("the camera \"{}\" is tilted by {:.1f}° about its axis; it is shown "
                             "upright",
                             camera.name, roll);
    return result;
}

} // namespace patina
