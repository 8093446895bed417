#include "render/scene/DrawList.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

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
