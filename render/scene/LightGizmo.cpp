#include "render/scene/LightGizmo.h"

#include "core/light/Light.h"
#include "core/light/Lights.h"
#include "core/mix/LightMix.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <optional>

namespace patina::render {
namespace {

constexpr float kSunDistance = 1.6f; // of a directional light's mark, in scene radii
constexpr float kAimReach = 90.0f;   // of the aim handle, in units
constexpr int kCircleSteps = 32;

// Hue of a light at full brightness.
glm::vec3 markColor(const Light& light) {
    const glm::vec3 color = lightColor(light) * light.tint;
    const float most = std::max({color.r, color.g, color.b, 1e-6f});
    return glm::mix(glm::vec3(1.0f), color / most, 0.8f);
}

float sceneRadius(const Bounds& scene) {
    return std::max(scene.radius(), 1e-3f);
}

struct Drawing {
    const GizmoView& view;
    LightGizmo& gizmo;

    void line(const glm::vec3& a, const glm::vec3& b, const glm::vec3& color, bool dashed = false) {
        const auto from = project(view, a), to = project(view, b);
        if (from && to)
            gizmo.lines.push_back({*from, *to, color, dashed});
    }
    void circle(const glm::vec3& center, const glm::vec3& x, const glm::vec3& y,
                const glm::vec3& color) {
        glm::vec3 last = center + x;
        for (int i = 1; i <= kCircleSteps; ++i) {
            const float angle = glm::two_pi<float>() * static_cast<float>(i) / kCircleSteps;
            const glm::vec3 next = center + std::cos(angle) * x + std::sin(angle) * y;
            line(last, next, color);
            last = next;
        }
    }
};

// Cone, outline or sphere of the selected light, in its true size.
void drawShape(Drawing& drawing, const Light& light, const Bounds& scene) {
    const glm::vec3 color = drawing.gizmo.color, d = light.directionToLight();
    const RectangleAxes axes = rectangleAxes(light);
    switch (light.type) {
    case LightType::Spot: {
        const float length =
            light.range > 0.0f ? light.range : glm::distance(light.position, scene.center());
        for (const float halfAngle : {light.outerConeDeg, light.innerConeDeg}) {
            const float angle = glm::radians(std::min(halfAngle, 89.0f));
            const float radius = length * std::sin(angle);
            const glm::vec3 center = light.position - length * std::cos(angle) * d;
            drawing.circle(center, radius * axes.x, radius * axes.y, color);
            if (halfAngle == light.outerConeDeg)
                for (const glm::vec3& side : {axes.x, -axes.x, axes.y, -axes.y})
                    drawing.line(light.position, center + radius * side, color);
        }
        break;
    }
    case LightType::Sphere: {
        const float r = light.radius;
        drawing.circle(light.position, {r, 0, 0}, {0, r, 0}, color);
        drawing.circle(light.position, {0, r, 0}, {0, 0, r}, color);
        drawing.circle(light.position, {0, 0, r}, {r, 0, 0}, color);
        break;
    }
    case LightType::Rectangle: {
        const glm::vec3 x = 0.5f * light.width * axes.x, y = 0.5f * light.height * axes.y;
        const std::array corners{light.position - x - y, light.position + x - y,
                                 light.position + x + y, light.position - x + y};
        for (std::size_t i = 0; i < 4; ++i)
            drawing.line(corners[i], corners[(i + 1) % 4], color);
        break;
    }
    case LightType::Point:
        if (light.range > 0.0f)
            drawing.circle(light.position, {light.range, 0, 0}, {0, 0, light.range}, color);
        break;
    case LightType::Directional:
        break;
    }
}

} // namespace

glm::vec3 gizmoPlace(const Light& light, const Bounds& scene) {
    return hasPosition(light.type)
               ? light.position
               : scene.center() + kSunDistance * sceneRadius(scene) * light.directionToLight();
}

glm::vec3 aimPlace(const Light& light, const Bounds& scene, const GizmoView& view) {
    const glm::vec3 place = gizmoPlace(light, scene);
    const float pixels = pixelsPerMetre(view, place);
    return pixels > 0.0f ? place - kAimReach * view.scale / pixels * light.directionToLight()
                         : place;
}

LightGizmo lightGizmo(const Document& document, const Light& light, const Bounds& scene,
                      const GizmoView& view, bool selected) {
    LightGizmo gizmo;
    gizmo.light = light.id;
    gizmo.type = light.type;
    gizmo.selected = selected;
    gizmo.shining = isActive(document, light);
    gizmo.color = markColor(light);
    if (!gizmo.shining)
        gizmo.color *= 0.45f;
    const glm::vec3 place = gizmoPlace(light, scene);
    const auto mark = project(view, place);
    gizmo.visible = mark.has_value();
    if (!mark)
        return gizmo;
    gizmo.mark = *mark;
    Drawing drawing{view, gizmo};
    if (light.type == LightType::Directional)
        drawing.line(place, scene.center() + 1.05f * sceneRadius(scene) * light.directionToLight(),
                     gizmo.color, true);
    if (!selected)
        return gizmo;

    drawShape(drawing, light, scene);
    const auto addHandle = [&](GizmoHandle handle, const glm::vec3& at, const glm::vec3& color) {
        if (const auto end = project(view, at)) {
            gizmo.lines.push_back({*mark, *end, color});
            gizmo.handles.push_back({handle, *end, color});
        }
    };
    const float pixels = pixelsPerMetre(view, place);
    if (hasPosition(light.type) && pixels > 0.0f)
        for (const GizmoAxis& axis : kGizmoAxes)
            addHandle(axis.move, place + kGizmoReach * view.scale / pixels * axis.direction,
                      axis.color);
    if (hasPosition(light.type) && hasDirection(light.type))
        addHandle(GizmoHandle::Aim, aimPlace(light, scene, view), {1.0f, 0.85f, 0.35f});
    return gizmo;
}

GizmoHit pickGizmo(const Document& document, const Bounds& scene, const GizmoView& view,
                   Id selected, const glm::vec2& pixel) {
    GizmoHit hit;
    float nearest = kGizmoPickRadius * view.scale;
    const auto consider = [&](Id light, GizmoHandle handle, const glm::vec2& at, float reach) {
        const float distance = glm::distance(pixel, at);
        if (distance <= std::min(nearest, reach)) {
            nearest = distance;
            hit = {light, handle};
        }
    };
    if (const Light* light = document.light(selected))
        for (const GizmoPoint& point : lightGizmo(document, *light, scene, view, true).handles)
            consider(selected, point.handle, point.at, kGizmoPickRadius * view.scale);
    if (hit.light != 0)
        return hit;
    nearest = kGizmoMark * view.scale;
    for (const Light& light : document.lights)
        if (const LightGizmo gizmo = lightGizmo(document, light, scene, view, false); gizmo.visible)
            consider(light.id, GizmoHandle::Mark, gizmo.mark, kGizmoMark * view.scale);
    return hit;
}

Light draggedLight(const Light& light, GizmoHandle handle, const Bounds& scene,
                   const GizmoView& view, const glm::vec3& right, const glm::vec3& up,
                   const glm::vec2& pixels) {
    Light result = light;
    const glm::vec3 place = gizmoPlace(light, scene);
    const auto across = [&](const glm::vec3& at) {
        const float perMetre = pixelsPerMetre(view, at);
        return perMetre > 0.0f ? (pixels.x * right + pixels.y * up) / perMetre : glm::vec3(0.0f);
    };
    switch (handle) {
    case GizmoHandle::None:
    case GizmoHandle::RotateX: // of meshes, as below
    case GizmoHandle::RotateY:
    case GizmoHandle::RotateZ:
    case GizmoHandle::ScaleX:
    case GizmoHandle::ScaleY:
    case GizmoHandle::ScaleZ:
    case GizmoHandle::ScaleAll:
        break;
    case GizmoHandle::Mark:
        if (hasPosition(light.type))
            result.position += across(place);
        else
            setDirectionToLight(result, place + across(place) - scene.center());
        break;
    case GizmoHandle::Aim: {
        const glm::vec3 aim = aimPlace(light, scene, view);
        setDirectionToLight(result, place - (aim + across(aim)));
        break;
    }
    case GizmoHandle::AxisX:
    case GizmoHandle::AxisY:
    case GizmoHandle::AxisZ:
        for (const GizmoAxis& axis : kGizmoAxes) {
            if (axis.move != handle)
                continue;
            // Pixels that a small step along the axis covers; an axis seen end on moves nothing.
            const float perMetre = pixelsPerMetre(view, place);
            const float step = perMetre > 0.0f ? 1.0f / perMetre : 0.0f; // about a pixel
            const auto from = project(view, place);
            const auto to = project(view, place + step * axis.direction);
            if (!from || !to)
                break;
            const glm::vec2 alongPixels = *to - *from;
            const float length2 = glm::dot(alongPixels, alongPixels);
            if (length2 > 1e-3f)
                result.position +=
                    axis.direction * (step * glm::dot(pixels, alongPixels) / length2);
        }
        break;
    }
    return result;
}

} // namespace patina::render
