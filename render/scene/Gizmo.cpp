#include "render/scene/Gizmo.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace patina::render {

float gridSpacing(float cameraDistance) {
    return std::pow(10.0f, std::round(std::log10(cameraDistance / 6.0f)));
}

std::optional<glm::vec2> project(const GizmoView& view, const glm::vec3& point) {
    const glm::vec4 clip = view.worldToClip * glm::vec4(point, 1.0f);
    if (!(clip.w > 1e-6f))
        return std::nullopt;
    return (glm::vec2(clip) / clip.w * 0.5f + 0.5f) * view.viewport;
}

float pixelsPerMetre(const GizmoView& view, const glm::vec3& point) {
    const glm::mat4& m = view.worldToClip;
    const float w = (m * glm::vec4(point, 1.0f)).w;
    if (!(w > 1e-6f))
        return 0.0f;
    return 0.5f * view.viewport.y * glm::length(glm::vec3(m[0][1], m[1][1], m[2][1])) / w;
}

std::optional<float> alongAxis(const GizmoView& view, const glm::vec3& point,
                               const glm::vec3& direction, const glm::vec2& pixel) {
    // The plane through the pixel's ray that is most across the axis: of the two that a pixel's
    // row and column are, the one whose crossing with the line moves most.
    const glm::vec2 ndc = pixel / view.viewport * 2.0f - 1.0f;
    const glm::vec4 start = view.worldToClip * glm::vec4(point, 1.0f);
    const glm::vec4 step = view.worldToClip * glm::vec4(direction, 0.0f);
    if (!(start.w > 1e-6f))
        return std::nullopt;
    // d(x/w)/dt and d(y/w)/dt at the point: where the axis goes in the picture.
    const glm::vec2 slope =
        (glm::vec2(step) * start.w - glm::vec2(start) * step.w) / (start.w * start.w);
    const glm::vec2 pixels = 0.5f * slope * view.viewport;
    // An axis that covers less than a fiftieth of what it would across the view is seen end on.
    if (!(glm::length(pixels) > 0.02f * pixelsPerMetre(view, point)))
        return std::nullopt;
    // Along the picture's direction of the axis: n · (x, y) / w = n · ndc, which is linear in t.
    const glm::vec2 n = slope * view.viewport * view.viewport;
    const float at = glm::dot(n, ndc);
    const float denominator = glm::dot(n, glm::vec2(step)) - at * step.w;
    const float t = (at * start.w - glm::dot(n, glm::vec2(start))) / denominator;
    // Beyond the vanishing point there is nothing of the axis.
    if (!std::isfinite(t) || !(start.w + t * step.w > 1e-6f))
        return std::nullopt;
    return t;
}

} // namespace patina::render
