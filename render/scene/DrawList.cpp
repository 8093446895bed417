#include "render/scene/DrawList.h"

#include "core/material/Material.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <limits>

namespace patina::render {

bool insideFrustum(const Bounds& bounds, const glm::mat4& worldToClip) {
    // Gribb & Hartmann 2001: the planes are sums and differences of the matrix' rows.
    const glm::mat4 rows = glm::transpose(worldToClip);
    const std::array<glm::vec4, 6> planes{rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1],
                                          rows[3] - rows[1], rows[3] + rows[2], rows[3] - rows[2]};
    return std::none_of(planes.begin(), planes.end(), [&](const glm::vec4& plane) {
        // The corner farthest along the plane's normal.
        const glm::vec3 corner(plane.x > 0 ? bounds.max.x : bounds.min.x,
                               plane.y > 0 ? bounds.max.y : bounds.min.y,
                               plane.z > 0 ? bounds.max.z : bounds.min.z);
        return glm::dot(plane, glm::vec4(corner, 1.0f)) < 0.0f;
    });
}

const GpuMesh::Coarse* coarseFor(const DrawItem& item, const CoarseView& view) {
    constexpr float kShare = 1.0f / 45.0f, kPixels = 4.0f;
    if (item.mesh->coarse.empty())
        return nullptr;
    // The world's size of a cell: the box of the instance has as many as the mesh's own, and
    // turning it makes it larger.
    const glm::vec3 own = item.mesh->bounds.size(), world = item.bounds.size();
    const float scale = std::max({world.x, world.y, world.z}) / std::max({own.x, own.y, own.z});
    // Where the box is nearest, w is the distance along the view (1 when it is orthographic).
    const glm::mat4& clip = view.worldToClip;
    float nearest = std::numeric_limits<float>::max();
    for (int corner = 0; corner < 8; ++corner) {
        const Bounds& b = item.bounds;
        const glm::vec4 at =
            clip * glm::vec4(corner & 1 ? b.max.x : b.min.x, corner & 2 ? b.max.y : b.min.y,
                             corner & 4 ? b.max.z : b.min.z, 1.0f);
        nearest = std::min(nearest, at.w);
    }
    if (!(nearest > 0.0f))
        return nullptr;
    const glm::vec3 up(clip[0][1], clip[1][1], clip[2][1]);
    const float share = 0.5f * glm::length(up) * scale / nearest; // of the height, per metre
    const GpuMesh::Coarse* chosen = nullptr;
    for (const GpuMesh::Coarse& coarse : item.mesh->coarse) {
        const float height = share * coarse.cell;
        if (height < kShare &&
            (chosen == nullptr || height * static_cast<float>(view.height) < kPixels))
            chosen = &coarse;
    }
    return chosen;
}

std::vector<TriangleRange> visibleTriangles(const DrawItem& item,
                                            const std::optional<glm::mat4>& worldToClip) {
    const auto all = static_cast<std::uint64_t>(item.mesh->indexCount) / 3;
    if (!worldToClip)
        return {{0, all}};
    const glm::mat4 clip = *worldToClip * item.transform;
    constexpr std::uint64_t kLot = GpuMesh::kLot;
    std::vector<TriangleRange> ranges;
    for (std::uint64_t first = 0; first < all; first += kLot) {
        if (!insideFrustum(item.mesh->lots[first / kLot], clip))
            continue;
        const std::uint64_t count = std::min(kLot, all - first);
        if (!ranges.empty() && ranges.back().end() == first)
            ranges.back().count += count;
        else
            ranges.push_back({first, count});
    }
    return ranges;
}

std::uint64_t triangleCount(const std::vector<const DrawItem*>& items,
                            const std::optional<glm::mat4>& worldToClip) {
    std::uint64_t count = 0;
    for (const DrawItem* item : items)
        for (const TriangleRange& range : visibleTriangles(*item, worldToClip))
            count += range.count;
    return count;
}

DrawList makeDrawList(const std::vector<DrawItem>& items, const glm::mat4& worldToClip,
                      const glm::vec3& eye) {
    DrawList list;
    for (const DrawItem& item : items)
        if (insideFrustum(item.bounds, worldToClip))
            (item.material->alphaMode == AlphaMode::Blend ? list.blended : list.opaque)
                .push_back(&item);
    const auto distance = [&](const DrawItem* item) {
        return glm::distance(item->bounds.center(), eye);
    };
    // Stable, so that equal distances do not flicker.
    std::stable_sort(list.opaque.begin(), list.opaque.end(),
                     [&](auto a, auto b) { return distance(a) < distance(b); });
    std::stable_sort(list.blended.begin(), list.blended.end(),
                     [&](auto a, auto b) { return distance(a) > distance(b); });
    return list;
}

} // namespace patina::render
