#include "core/bake/bounce/HiddenElements.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

namespace patina {

std::vector<std::uint32_t> moveHiddenPoints(const BounceElements& elements,
                                            std::span<const std::uint8_t> hidden,
                                            std::vector<BakePoint>& points) {
    std::vector<std::uint32_t> moved;
    if (std::find(hidden.begin(), hidden.end(), std::uint8_t{1}) == hidden.end())
        return moved;

    struct StandIn {
        std::uint32_t element = 0;
        float distance = std::numeric_limits<float>::max();
    };
    std::vector<StandIn> standIns(elements.count());
    const auto consider = [&](std::uint32_t element, std::uint32_t other) {
        if (hidden[element] == 0 || hidden[other] != 0)
            return;
        const float distance = glm::distance(points[element].origin, points[other].origin);
        StandIn& best = standIns[element];
        if (distance < best.distance || (distance == best.distance && other < best.element))
            best = {other, distance};
    };
    for (const BounceElements::Triangle& triangle : elements.triangles()) {
        const std::uint32_t toBack = elements.meshes()[triangle.mesh].toBack;
        for (std::size_t i = 0; i < 3; ++i)
            for (const std::size_t j : {(i + 1) % 3, (i + 2) % 3}) {
                consider(triangle.corners[i], triangle.corners[j]);
                if (toBack != 0)
                    consider(triangle.corners[i] + toBack, triangle.corners[j] + toBack);
            }
    }
    // Those that stand in do not move themselves.
    for (std::uint32_t e = 0; e < standIns.size(); ++e)
        if (standIns[e].distance < std::numeric_limits<float>::max()) {
            points[e] = points[standIns[e].element];
            moved.push_back(e);
        }
    return moved;
}

} // namespace patina
