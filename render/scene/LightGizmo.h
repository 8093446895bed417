// What a light looks like in the viewport's overlay, and where it can be taken hold of: points and
// lines in pixels, from one place, so that what is drawn is what can be dragged. No OpenGL.
#pragma once

#include "core/document/Document.h"
#include "core/light/Light.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

namespace patina::render {

// How the scene is seen. Pixels are counted from the bottom left.
struct GizmoView {
    glm::mat4 worldToClip{1.0f};
    glm::vec2 viewport{1.0f}; // pixels
    float scale = 1.0f;       // pixels per unit of the drawing
};

enum class GizmoHandle {
    None,
    Mark,  // moves the light in the plane of the picture; turns a directional light
    AxisX, // moves along one axis of the world
    AxisY,
    AxisZ,
    Aim // turns the light about its place
};

struct GizmoLine {
    glm::vec2 from, to;
    glm::vec3 color;
    bool dashed = false;
};

struct GizmoPoint {
    GizmoHandle handle = GizmoHandle::None;
    glm::vec2 at;
    glm::vec3 color;
};

struct LightGizmo {
    Id light = 0;
    LightType type = LightType::Point;
    bool visible = false; // false: behind the camera
    glm::vec2 mark{0.0f};
    glm::vec3 color{1.0f};
    bool selected = false;
    bool shining = true;
    std::vector<GizmoLine> lines;
    std::vector<GizmoPoint> handles; // besides the mark; only of the selected light
};

inline constexpr float kGizmoMark = 14.0f;  // half the side of a light's mark, in units
inline constexpr float kGizmoKnob = 5.0f;   // radius of a handle, in units
inline constexpr float kGizmoReach = 64.0f; // of the axes, in units

[[nodiscard]] LightGizmo lightGizmo(const Document& document, const Light& light,
                                    const Bounds& scene, const GizmoView& view, bool selected);

// Where the light's mark stands: its position, or on the side a directional light comes from.
[[nodiscard]] glm::vec3 gizmoPlace(const Light& light, const Bounds& scene);
// Where the handle stands that turns it.
[[nodiscard]] glm::vec3 aimPlace(const Light& light, const Bounds& scene, const GizmoView& view);
// Pixel that a point of the world is seen at; nothing behind the camera.
[[nodiscard]] std::optional<glm::vec2> project(const GizmoView& view, const glm::vec3& point);
// Pixels that a metre across the view covers at `point`; 0 behind the camera.
[[nodiscard]] float pixelsPerMetre(const GizmoView& view, const glm::vec3& point);

struct GizmoHit {
    Id light = 0; // 0: nothing there
    GizmoHandle handle = GizmoHandle::None;
};
// Handles of the selected light first, then marks, the nearest to the pixel.
[[nodiscard]] GizmoHit pickGizmo(const Document& document, const Bounds& scene,
                                 const GizmoView& view, Id selected, const glm::vec2& pixel);

// The light after its handle was dragged by `pixels` (y up). `right` and `up`: the camera's.
[[nodiscard]] Light draggedLight(const Light& light, GizmoHandle handle, const Bounds& scene,
                                 const GizmoView& view, const glm::vec3& right, const glm::vec3& up,
                                 const glm::vec2& pixels);

} // namespace patina::render
