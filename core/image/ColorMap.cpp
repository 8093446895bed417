#include "core/image/ColorMap.h"

#include "core/image/Srgb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>

namespace patina {
namespace {

// Ottosson 2020, "A perceptual color space for image processing": Oklab to linear sRGB.
glm::vec3 linearFromOklab(const glm::vec3& lab) {
    const auto cube = [](float x) { return x * x * x; };
    const float l = cube(lab.x + 0.3963377774f * lab.y + 0.2158037573f * lab.z);
    const float m = cube(lab.x - 0.1055613458f * lab.y - 0.0638541728f * lab.z);
    const float s = cube(lab.x - 0.0894841775f * lab.y - 1.2914855480f * lab.z);
    return {4.0767416621f * l - 3.3077115913f * m + 0.2309699292f * s,
            -1.2684380046f * l + 2.6097574011f * m - 0.3413193965f * s,
            -0.0041960863f * l - 0.7034186147f * m + 1.7076147010f * s};
}

glm::vec3 fromLch(float lightness, float chroma, float hueDeg) {
    const float hue = hueDeg * 0.017453292519943f;
    const glm::vec3 linear =
        linearFromOklab({lightness, chroma * std::cos(hue), chroma * std::sin(hue)});
    const glm::vec3 inside = glm::clamp(linear, 0.0f, 1.0f);
    return {linearToSrgb(inside.x), linearToSrgb(inside.y), linearToSrgb(inside.z)};
}

constexpr std::array<std::uint32_t, 256> kMagma{
#include "core/image/MagmaTable.inc"
};

// Between the two nearest colours of the table.
glm::vec3 magma(float t) {
    const float at = t * (kMagma.size() - 1);
    const auto below = std::min(static_cast<std::size_t>(at), kMagma.size() - 2);
    const auto color = [](std::uint32_t rgb) {
        return glm::vec3(rgb >> 16, rgb >> 8 & 0xff, rgb & 0xff) / 255.0f;
    };
    return glm::mix(color(kMagma[below]), color(kMagma[below + 1]), at - static_cast<float>(below));
}

} // namespace

// Lightness grows evenly, so equal steps look equal, also printed grey and to colour-blind eyes;
// hue runs from violet over blue and green to yellow as in viridis (Smith & van der Walt 2015).
glm::vec3 mapColor(ColorMap map, float t) {
    t = t >= 0.0f ? std::min(t, 1.0f) : 0.0f;
    switch (map) {
    case ColorMap::Grey:
        return glm::vec3(t);
    case ColorMap::Sequential:
        return fromLch(0.26f + 0.66f * t, 0.105f + 0.06f * t, 310.0f - 205.0f * t);
    case ColorMap::Diverging: {
        // Away from the middle lightness falls and chroma rises, alike on both sides.
        const float away = std::abs(2.0f * t - 1.0f);
        return fromLch(0.95f - 0.45f * away, 0.14f * away, t < 0.5f ? 255.0f : 50.0f);
    }
    case ColorMap::Magma:
        return magma(t);
    }
    return glm::vec3(t);
}

} // namespace patina
