// The transfer of a point as a surface around it.
#pragma once

#include "core/bake/document/TransferPoint.h"
#include "core/light/LobeMesh.h"

#include <glm/vec3.hpp>

namespace patina {

// Linear, 0…1: of directions whose light it lets through, and of those where its bands make it
// negative.
struct TransferColors {
    glm::vec3 positive{1.0f}, negative{0.0f};
};

// In the frame of the world, as far out in each direction as it lets light through, or takes light
// away where it is negative. Of the bands whose bit is set; `peak` > 0: the value that lies 1 away.
[[nodiscard]] LobeMesh transferLobe(const PointTransfer& transfer, unsigned bands, float peak,
                                    const TransferColors& colors);

} // namespace patina
