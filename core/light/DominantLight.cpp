#include "core/light/DominantLight.h"

#include "core/math/Shading.h"
#include "core/math/SphericalHarmonics.h"

#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace patina {

DominantLight dominantLight(std::span<const glm::vec3, 9> irradianceSh) {
    DominantLight light;
    const auto brightness = [&](std::size_t i) { return shading::luminance(irradianceSh[i]); };
    // Y_1-1, Y_10, Y_11 are -y, z, -x times a constant.
    const glm::vec3 linear(-brightness(3), -brightness(1), brightness(2));
    const float length = glm::length(linear);
    if (length > 1e-6f * brightness(0))
        light.toLight = linear / length;
    std::array<float, 9> y{};
    shading::shBasis9(light.toLight, y.data());
    glm::vec3 sum(0.0f);
    for (int l = 0; l < 3; ++l)
        for (int i = l * l; i < (l + 1) * (l + 1); ++i)
            sum += shading::shCosineFactor(l) * y[static_cast<std::size_t>(i)] *
                   irradianceSh[static_cast<std::size_t>(i)];
    light.irradiance = glm::max(sum * (3.0f / (2.0f * shading::kPi)), glm::vec3(0.0f));
    return light;
}

} // namespace patina
