// What a light looks like in the viewport's overlay, and where it can be taken hold of. No OpenGL.
#pragma once

#include "core/document/Document.h"
#include "core/light/Light.h"
#include "render/scene/Gizmo.h"

#include <vector>

namespace patina::render {

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

[[nodiscard]] LightGizmo lightGizmo(const Document& document, const Light& light,
                                    const Bounds& scene, const GizmoView& view, bool selected);

// Where the light's mark stands: its position, or on the side a directional light comes from.
[[nodiscard]] glm::vec3 gizmoPlace(const Light& light, const Bounds& scene);
// Where the handle stands that turns it.
[[nodiscard]] glm::vec3 aimPlace(const Light& light, const Bounds& scene, const GizmoView& view);

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
