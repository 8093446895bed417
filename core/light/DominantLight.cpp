#include "core/light/DominantLight.h"

#include "core/math/Shading.h"
#include "core/math/SphericalHarmonics.h"

#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace patina {
namespace {

// The luminance of the linear band as a vector: Y_1-1, Y_10, Y_11 are -y, z, -x times a constant.
glm::vec3 linearBand(std::span<const glm::vec3, 9> irradianceSh) {
    return {-shading::luminance(irradianceSh[3]), -shading::luminance(irradianceSh[1]),
            shading::luminance(irradianceSh[2])};
}

} // namespace

DominantLight dominantLight(std::span<const glm::vec3, 9> irradianceSh) {
    DominantLight light;
    const glm::vec3 linear = linearBand(irradianceSh);
    const float length = glm::length(linear);
    if (length > 1e-6f * shading::luminance(irradianceSh[0]))
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

float directionality(std::span<const glm::vec3, 9> irradianceSh) {
    const float all = shading::luminance(irradianceSh[0]);
    return all > 0.0f ? 0.8660254f * glm::length(linearBand(irradianceSh)) / all : 0.0f;
}

} // namespace patina
