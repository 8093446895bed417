#include "core/trace/path/GlassAlbedo.h"

#include "core/math/Sampling.h"
#include "core/trace/path/Glass.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>

namespace patina {

// So many points of a net give the albedo to .3 %, in 10 ms for all of the table.
static constexpr std::uint32_t kAlbedoSamples = 512;

GlassAlbedo::GlassAlbedo(float eta, bool thinWalled) {
    GlassTerms glass;
    glass.eta = eta;
    glass.thinWalled = thinWalled;
    glass.n = {0.0f, 0.0f, 1.0f};
    for (int row = 0; row < kSize; ++row)
        for (int column = 0; column < kSize; ++column) {
            const auto node = [](int i) { return static_cast<float>(i) / (kSize - 1); };
            glass.alpha = glassAlpha(node(row), eta, thinWalled);
            glass.NoV = std::max(node(column), 1e-3f);
            glass.v = {std::sqrt(1.0f - glass.NoV * glass.NoV), 0.0f, glass.NoV};
            float sum = 0.0f;
            for (std::uint32_t i = 0; i < kAlbedoSamples; ++i) {
                const glm::vec2 choice = sobolOwen2D(i, 2);
                const GlassSample sample =
                    sampleGlass(glass, glm::vec3(sobolOwen2D(i, 1), choice.x));
                // The light behind a denser body's face is eta² as bright.
                sum += sample.weight.x *
                       (sample.through && !thinWalled ? glass.eta * glass.eta : 1.0f);
            }
            m_values[static_cast<std::size_t>(row * kSize + column)] =
                std::max(sum / static_cast<float>(kAlbedoSamples), 0.1f);
        }
}

float GlassAlbedo::at(float NoV, float perceptualRoughness) const {
    const auto place = [](float value) {
        return std::clamp(value, 0.0f, 1.0f) * static_cast<float>(kSize - 1);
    };
    const float x = place(NoV), y = place(perceptualRoughness);
    const int i = std::min(static_cast<int>(x), kSize - 2),
              j = std::min(static_cast<int>(y), kSize - 2);
    const float* value = m_values.data() + j * kSize + i;
    const float fx = x - static_cast<float>(i), fy = y - static_cast<float>(j);
    return glm::mix(glm::mix(value[0], value[1], fx), glm::mix(value[kSize], value[kSize + 1], fx),
                    fy);
}

} // namespace patina
