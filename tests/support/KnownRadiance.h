// Lat-long images of radiance known in closed form, and what prefiltering makes of it.
#pragma once

#include "core/image/Image.h"

#include <array>
#include <cmath>
#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <numbers>

namespace patina::test {

// Radiance 2 + d, red along x, green along y, blue along z: no two directions are alike, so that a
// face turned, mirrored or exchanged, a wrong sign of a harmonic or a wrong scale shows.
inline glm::dvec3 linearRadiance(const glm::dvec3& d) {
    return 2.0 + d;
}

// What GGX prefiltering multiplies the linear part by, at perceptual roughness 0, 1/4, 1/2, 3/4, 1:
// closed form of lambda_1 of the filter N = V = R with weight N·L (docs/maths/ibl.md).
inline constexpr std::array kLambda1 = {1.0, 0.976093, 0.867396, 0.745131, 2.0 / 3.0};

// Of the middle of pixel (x, y): u = 0.5 + atan2(x, -z) / 2pi, v = acos(y) / pi.
inline glm::dvec3 latLongDirection(int x, int y, int width, int height) {
    const double theta = std::numbers::pi * (y + 0.5) / height;
    const double phi = 2 * std::numbers::pi * ((x + 0.5) / width - 0.5);
    return {std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)};
}

inline Image latLongImage(const std::function<glm::dvec3(const glm::dvec3&)>& radiance) {
    constexpr int kWidth = 256, kHeight = 128;
    Image image(kWidth, kHeight, 3, PixelType::F32, ColorEncoding::Linear);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const glm::dvec3 value = radiance(latLongDirection(x, y, kWidth, kHeight));
            for (int c = 0; c < 3; ++c)
                image.f32()[static_cast<std::size_t>((y * kWidth + x) * 3 + c)] =
                    static_cast<float>(value[c]);
        }
    return image;
}

} // namespace patina::test
