#include "core/mix/MixLevels.h"

#include "core/light/Light.h"
#include "core/light/Lights.h"
#include "core/math/Shading.h"
#include "core/mix/LightMix.h"

#include <cmath>
#include <numbers>

namespace patina {

float lightLevel(const Document& document, const Light& light) {
    if (!isActive(document, light))
        return 0.0f;
    return shading::luminance(lightColor(light) * light.tint) *
           illuminanceAt(light, document.bounds().center());
}

float upwardIlluminance(const Image& picture) {
    // ∫ L cos dω row by row: a row from v0 to v1 holds (sin²(v1) - sin²(v0)) / 2 of each unit of
    // azimuth.
    const std::span<const float> texels = picture.f32();
    const int width = picture.width(), height = picture.height(), channels = picture.channels();
    double sum = 0.0;
    for (int y = 0; y < (height + 1) / 2; ++y) {
        const auto edge = [&](int row) {
            const double s =
                std::sin(std::min(0.5, static_cast<double>(row) / height) * std::numbers::pi);
            return s * s;
        };
        double row = 0.0;
        for (int x = 0; x < width; ++x) {
            const std::size_t at = static_cast<std::size_t>(channels) *
                                   (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                    static_cast<std::size_t>(x));
            row += shading::luminance(glm::vec3(texels[at], texels[at + 1], texels[at + 2]));
        }
        sum += row / width * std::numbers::pi * (edge(y + 1) - edge(y));
    }
    return static_cast<float>(sum);
}

} // namespace patina
