#include "render/scene/MeshGizmo.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>
#include <utility>

namespace patina::render {
namespace {

constexpr float kMoveReach = 90.0f;  // of the knobs that move, in units
constexpr float kRingReach = 64.0f;  // radius of the rings
constexpr float kScaleReach = 42.0f; // of the squares that scale
constexpr float kRingPick = 6.0f;    // from a ring's line, in units
constexpr int kRingSteps = 40;
constexpr float kAllPixels = 100.0f; // a drag this far doubles the size, in units
constexpr float kLeastFactor = 0.01f;
constexpr float kAngleStep = 15.0f, kFactorStep = 0.1f; // that snapping goes by
constexpr float kEdgeOn = 0.2f; // sine of the angle below which a ring is seen from its side
constexpr glm::vec3 kHeld{1.0f, 0.85f, 0.35f}, kCentre{0.95f};
constexpr glm::vec2 kAllPlace{30.0f, 30.0f}; // of the square that scales all, from the centre

float snapped(float value, float step) {
    return std::round(value / step) * step;
}

// Two axes that a ring about `axis` goes through.
std::pair<glm::vec3, glm::vec3> across(const glm::vec3& axis) {
    const glm::vec3 x = std::abs(axis.x) > 0.5f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    const glm::vec3 y = glm::normalize(glm::cross(axis, x));
    return {glm::cross(y, axis), y};
}

float distanceTo(const GizmoLine& line, const glm::vec2& pixel) {
    const glm::vec2 along = line.to - line.from;
    const float length2 = std::max(glm::dot(along, along), 1e-12f);
    const float t = std::clamp(glm::dot(pixel - line.from, along) / length2, 0.0f, 1.0f);
    return glm::distance(pixel, line.from + t * along);
}

const GizmoAxis* axisOf(GizmoHandle handle) {
    const auto found = std::ranges::find_if(kGizmoAxes, [&](const GizmoAxis& axis) {
        return handle == axis.move || handle == axis.rotate || handle == axis.scale;
    });
    return found != kGizmoAxes.end() ? &*found : nullptr;
}

// The unit vector from the point to the eye.
glm::vec3 towardsEye(const GizmoView& view, const glm::vec3& point) {
    const glm::mat4& m = view.worldToClip;
    const glm::vec3 x(m[0][0], m[1][0], m[2][0]), y(m[0][1], m[1][1], m[2][1]);
    const glm::vec3 w(m[0][3], m[1][3], m[2][3]);
    // Two planes of all points that are seen in its column and its row: both hold the line of
    // sight.
    const glm::vec4 clip = m * glm::vec4(point, 1.0f);
    const glm::vec3 direction = glm::cross(x - clip.x / clip.w * w, y - clip.y / clip.w * w);
    const glm::vec3 unit = glm::normalize(direction);
    return glm::dot(unit, w) > 0.0f ? -unit : unit; // w grows away from the eye
}

float rotationAngle(const MeshHandles& handles, const GizmoAxis& axis, const GizmoView& view,
                    const MeshDragging& drag) {
    const auto centre = project(view, handles.pivot);
    if (!centre)
        return 0.0f;
    const float facing = glm::dot(axis.direction, towardsEye(view, handles.pivot));
    if (std::abs(facing) > kEdgeOn) {
        // As the pointer goes round the centre.
        const glm::vec2 a = drag.from - *centre, b = drag.to - *centre;
        const float rotated = std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b));
        return glm::degrees(facing > 0.0f ? rotated : -rotated);
    }
    // From its side: along the ring where it was taken, towards the eye's side of it.
    const glm::vec3 tangent = glm::cross(axis.direction, towardsEye(view, handles.pivot));
    const auto end = project(
        view, handles.pivot + tangent / std::max(pixelsPerMetre(view, handles.pivot), 1e-6f));
    if (!end || glm::distance(*end, *centre) < 1e-3f)
        return 0.0f;
    const glm::vec2 direction = glm::normalize(*end - *centre);
    return glm::degrees(glm::dot(drag.to - drag.from, direction) / (kRingReach * view.scale));
}

} // namespace

MeshGizmo meshGizmo(const MeshHandles& handles, const GizmoView& view) {
    MeshGizmo gizmo;
    const auto centre = project(view, handles.pivot);
    const float pixels = pixelsPerMetre(view, handles.pivot);
    if (!centre || !(pixels > 0.0f))
        return gizmo;
    const float unit = view.scale / pixels; // metres that a unit covers
    const auto colorOf = [&](GizmoHandle handle, const glm::vec3& color) {
        return handle == handles.held ? kHeld : color;
    };
    gizmo.handles.push_back({GizmoHandle::Mark, *centre, colorOf(GizmoHandle::Mark, kCentre)});
    const glm::vec3 eye = towardsEye(view, handles.pivot);
    for (int i = 0; i < 3; ++i) {
        const GizmoAxis& axis = kGizmoAxes[static_cast<std::size_t>(i)];
        if (const auto end = project(view, handles.pivot + kMoveReach * unit * axis.direction)) {
            gizmo.lines.push_back({*centre, *end, colorOf(axis.move, axis.color)});
            gizmo.handles.push_back({axis.move, *end, colorOf(axis.move, axis.color)});
        }
        // The half of the ring that faces the eye; all of it where it is seen from the front.
        const auto [x, y] = across(axis.direction);
        const bool whole = std::abs(glm::dot(axis.direction, eye)) > 0.95f;
        const glm::vec3 color = 0.8f * colorOf(axis.rotate, axis.color);
        std::optional<glm::vec2> last;
        for (int step = 0; step <= kRingSteps; ++step) {
            const float angle =
                glm::two_pi<float>() * static_cast<float>(step) / static_cast<float>(kRingSteps);
            const glm::vec3 out = std::cos(angle) * x + std::sin(angle) * y;
            const bool seen = whole || glm::dot(out, eye) > -0.05f;
            const auto next = seen ? project(view, handles.pivot + kRingReach * unit * out)
                                   : std::optional<glm::vec2>();
            if (last && next)
                gizmo.lines.push_back({*last, *next, color, false, axis.rotate});
            last = next;
        }
        if (handles.several)
            continue;
        if (const auto end = project(view, handles.pivot + kScaleReach * unit * handles.axes[i]))
            gizmo.handles.push_back({axis.scale, *end, colorOf(axis.scale, axis.color), true});
    }
    gizmo.handles.push_back({GizmoHandle::ScaleAll, *centre + kAllPlace * view.scale,
                             colorOf(GizmoHandle::ScaleAll, kCentre), true});
    return gizmo;
}

GizmoHandle pickMeshGizmo(const MeshHandles& handles, const GizmoView& view,
                          const glm::vec2& pixel) {
    const MeshGizmo gizmo = meshGizmo(handles, view);
    GizmoHandle found = GizmoHandle::None;
    float nearest = kGizmoPickRadius * view.scale;
    for (const GizmoPoint& point : gizmo.handles)
        if (const float distance = glm::distance(point.at, pixel); distance < nearest) {
            nearest = distance;
            found = point.handle;
        }
    if (found != GizmoHandle::None)
        return found;
    nearest = kRingPick * view.scale;
    for (const GizmoLine& line : gizmo.lines)
        if (line.handle != GizmoHandle::None)
            if (const float distance = distanceTo(line, pixel); distance < nearest) {
                nearest = distance;
                found = line.handle;
            }
    return found;
}

MeshMotion meshMotion(const MeshHandles& handles, const GizmoView& view, const MeshDragging& drag) {
    MeshMotion motion;
    const float pixels = pixelsPerMetre(view, handles.pivot);
    if (!(pixels > 0.0f))
        return motion;
    const glm::vec2 moved = drag.to - drag.from;
    if (handles.held == GizmoHandle::Mark) {
        motion.move = (moved.x * drag.right + moved.y * drag.up) / pixels;
        if (drag.snap)
            for (int i = 0; i < 3; ++i)
                motion.move[i] = snapped(motion.move[i], drag.step);
        return motion;
    }
    if (handles.held == GizmoHandle::ScaleAll) {
        float factor = 1.0f + (moved.x + moved.y) / (kAllPixels * view.scale);
        if (drag.snap)
            factor = snapped(factor, kFactorStep);
        motion.factors = glm::vec3(std::max(factor, kLeastFactor));
        return motion;
    }
    const GizmoAxis* axis = axisOf(handles.held);
    if (axis == nullptr)
        return motion;
    if (handles.held == axis->rotate) {
        const float angle = rotationAngle(handles, *axis, view, drag);
        motion.axis = axis->direction;
        motion.angleDeg = drag.snap ? snapped(angle, kAngleStep) : angle;
        return motion;
    }
    const bool scales = handles.held == axis->scale;
    const auto index = static_cast<int>(axis - kGizmoAxes.data());
    const glm::vec3 direction = scales ? handles.axes[index] : axis->direction;
    const auto from = alongAxis(view, handles.pivot, direction, drag.from);
    const auto to = alongAxis(view, handles.pivot, direction, drag.to);
    if (!from || !to)
        return motion;
    if (scales) {
        float factor = std::abs(*from) > 1e-9f ? *to / *from : 1.0f;
        if (drag.snap)
            factor = snapped(factor, kFactorStep);
        motion.factors[index] = std::max(factor, kLeastFactor);
    } else {
        const float distance = drag.snap ? snapped(*to - *from, drag.step) : *to - *from;
        motion.move = distance * direction;
    }
    return motion;
}

} // namespace patina::render
