// Which items a camera sees, and in which order they are drawn.
#pragma once

#include "render/scene/GpuScene.h"
#include "render/scene/SceneSlice.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace patina::render {

// False only when the box lies wholly outside one of the six clip planes.
[[nodiscard]] bool insideFrustum(const Bounds& bounds, const glm::mat4& worldToClip);

// The view of a frame drawn for speed.
struct CoarseView {
    glm::mat4 worldToClip;
    int height = 1; // of the picture, pixels
};
// The fewest of the mesh's coarse triangles that suffice; null: none do. The cells to which they
// are rounded stay below a 45th of the picture's height (16 pixels of 720, 4 when a frame is drawn
// at a quarter), and all but the finest below four pixels.
[[nodiscard]] const GpuMesh::Coarse* coarseFor(const DrawItem& item, const CoarseView& view);

// The triangles of an item that lie in clip space, by lots; without a matrix all of them.
[[nodiscard]] std::vector<TriangleRange>
visibleTriangles(const DrawItem& item, const std::optional<glm::mat4>& worldToClip);
[[nodiscard]] std::uint64_t triangleCount(const std::vector<const DrawItem*>& items,
                                          const std::optional<glm::mat4>& worldToClip);

struct DrawList {
    std::vector<const DrawItem*> opaque;  // front to back: hidden fragments are not shaded
    std::vector<const DrawItem*> blended; // back to front
};
[[nodiscard]] DrawList makeDrawList(const std::vector<DrawItem>& items,
                                    const glm::mat4& worldToClip, const glm::vec3& eye);

} // namespace patina::render
