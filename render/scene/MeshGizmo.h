// Handles that move, rotate and scale meshes: an arm along each axis of the world with a knob that
// moves, a ring about each that rotates, a square on each of the mesh's own axes that scales along
// it, and one for all of them. No OpenGL.
#pragma once

#include "render/scene/Gizmo.h"

#include <vector>

namespace patina::render {

// Of what is selected.
struct MeshHandles {
    glm::vec3 pivot{0.0f}; // the world's point about which it is rotated and scaled
    glm::mat3 axes{1.0f};  // of the mesh, in the world: columns
    bool several = false;  // several meshes scale alike along all axes
    GizmoHandle held = GizmoHandle::None;
    friend bool operator==(const MeshHandles&, const MeshHandles&) = default;
};

struct MeshGizmo {
    std::vector<GizmoLine> lines;
    std::vector<GizmoPoint> handles; // the centre is the first; none: behind the camera
};

[[nodiscard]] MeshGizmo meshGizmo(const MeshHandles& handles, const GizmoView& view);
// Knobs and squares first, then rings.
[[nodiscard]] GizmoHandle pickMeshGizmo(const MeshHandles& handles, const GizmoView& view,
                                        const glm::vec2& pixel);

// What a drag of `held` does, all of it from where it began.
struct MeshMotion {
    glm::vec3 move{0.0f}; // metres
    glm::vec3 axis{0.0f}; // of the rotation; zero: none
    float angleDeg = 0.0f;
    glm::vec3 factors{1.0f}; // along the mesh's own axes
};
// `snap`: moves go by steps of `step` metres, angles by 15°, factors by tenths. `right` and `up`:
// the camera's.
struct MeshDragging {
    glm::vec2 from{0.0f}, to{0.0f}; // pixels, y up
    glm::vec3 right{1, 0, 0}, up{0, 1, 0};
    bool snap = false;
    float step = 0.1f;
};
[[nodiscard]] MeshMotion meshMotion(const MeshHandles& handles, const GizmoView& view,
                                    const MeshDragging& drag);

} // namespace patina::render
