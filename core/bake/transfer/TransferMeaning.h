// What the coefficients of a direct transfer say about a surface besides its light: both are linear
// in them, so that nothing needs to be stored.
#pragma once

#include "core/math/SphericalHarmonics.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <span>

namespace patina {

// Share of the light of a uniform environment that arrives, 1 = open: T_00 / Y_00 (Y_00 =
// 1 / (2 sqrt(pi)), and T_00 = Y_00 ∫ V cos / pi).
[[nodiscard]] inline float ambientVisibility(std::span<const float> transfer) {
    return transfer[0] * 3.5449077018f;
}

// The mean direction that light of a uniform environment comes from, cosine-weighted; unit, or
// `normal` where nothing is open. Band 1 of the transfer is the mean of Y_1m = sqrt(3 / 4 pi) ·
// (-y, z, -x). Needs order 2.
[[nodiscard]] inline glm::vec3 bentNormal(std::span<const float> transfer,
                                          const glm::vec3& normal) {
    if (transfer.size() < 4)
        return normal;
    const glm::vec3 mean(-transfer[3], -transfer[1], transfer[2]);
    const float length = glm::length(mean);
    return length > 1e-6f ? mean / length : normal;
}

} // namespace patina
