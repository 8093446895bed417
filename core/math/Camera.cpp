#include "core/math/Camera.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

namespace patina {

glm::vec3 Camera::forward() const {
    const float yaw = glm::radians(yawDeg), pitch = glm::radians(pitchDeg);
    return -glm::vec3(std::sin(yaw) * std::cos(pitch), std::sin(pitch),
                      std::cos(yaw) * std::cos(pitch));
}

glm::vec3 Camera::right() const {
    const float yaw = glm::radians(yawDeg);
    return {std::cos(yaw), 0.0f, -std::sin(yaw)};
}

glm::vec3 Camera::up() const {
    return glm::cross(right(), forward());
}

glm::vec3 Camera::position() const {
    return target - distance * forward();
}

glm::mat4 Camera::viewMatrix() const {
    return glm::lookAt(position(), position() + forward(), up());
}

glm::mat4 Camera::projectionMatrix(float aspect, const Bounds& scene) const {
    const float radius = std::max(scene.radius(), 1e-4f);
    const float toCenter = glm::dot(scene.center() - position(), forward());
    const float farPlane = std::max(toCenter + 1.05f * radius, 1e-3f * radius);
    // A ratio of 1e5 keeps 24 bits of depth usable when the camera is inside the scene.
    const float nearPlane =
        std::clamp(toCenter - 1.05f * radius, farPlane * 1e-5f, farPlane * 0.5f);
    return glm::perspective(glm::radians(fovDeg), std::max(aspect, 1e-3f),
                            std::max(nearPlane, 1e-3f * distance), farPlane);
}

float Camera::focalLength() const {
    return 0.5f * kSensorHeight / std::tan(0.5f * glm::radians(fovDeg));
}

float Camera::lensRadius() const {
    return lens.depthOfField ? 0.5f * focalLength() / lens.fStop : 0.0f;
}

glm::vec3 Camera::position(const glm::vec2& onLens) const {
    return position() + onLens.x * right() + onLens.y * up();
}

glm::mat4 Camera::worldToClip(float aspect, const Bounds& scene, const glm::vec2& onLens) const {
    glm::mat4 projection = projectionMatrix(aspect, scene);
    if (onLens == glm::vec2(0.0f))
        return projection * viewMatrix();
    // A point x at depth d, seen from o on the lens, is seen through o + (x - o) F / d of the plane
    // in focus, at F: at (x - o) / d + o / F of a picture at distance 1. The second term shears.
    const glm::vec2 shear = onLens / lens.focusDistance;
    projection[2][0] -= projection[0][0] * shear.x;
    projection[2][1] -= projection[1][1] * shear.y;
    const glm::vec3 from = position(onLens);
    return projection * glm::lookAt(from, from + forward(), up());
}

Camera frameBounds(Camera camera, const Bounds& scene, float aspect) {
    const float margin = 1.12f; // a little air around the object
    const float tanVertical = std::tan(0.5f * glm::radians(camera.fovDeg)) / margin;
    const float tanHorizontal = tanVertical * aspect;
    const float radius = std::max(scene.radius(), 1e-4f);
    const glm::vec3 half = 0.5f * scene.size();

    // A corner at (x, y, z) from the centre, along right, up and forward, appears within the frame
    // when |x| <= tanHorizontal (distance + z), and alike for y.
    float distance = 1.05f * radius; // in front of the whole object in any case
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 offset(corner & 1 ? half.x : -half.x, corner & 2 ? half.y : -half.y,
                               corner & 4 ? half.z : -half.z);
        const float x = std::abs(glm::dot(offset, camera.right()));
        const float y = std::abs(glm::dot(offset, camera.up()));
        const float z = glm::dot(offset, camera.forward());
        distance = std::max({distance, x / tanHorizontal - z, y / tanVertical - z});
    }
    camera.target = scene.center();
    camera.distance = distance;
    return camera;
}

} // namespace patina
