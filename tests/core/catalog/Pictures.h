// Environments whose measures can be worked out by hand.
#pragma once

#include "core/image/Image.h"
#include "core/light/LatLongGrid.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

namespace patina::test {

// The radiance of each direction, as the mean of 4 × 4 samples a texel.
template <class Radiance>
Image latLong(int width, int height, const Radiance& radiance) {
    Image image(width, height, 3, PixelType::F32, ColorEncoding::Linear);
    const LatLongGrid grid(width, height);
    std::size_t at = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            glm::dvec3 sum(0.0);
            for (int j = 0; j < 4; ++j)
                for (int i = 0; i < 4; ++i) {
                    const glm::dvec2 in = subTexel(i, j, 4, 4);
                    sum += glm::dvec3(radiance(grid.directionAt(x + in.x, y + in.y)));
                }
            for (int c = 0; c < 3; ++c)
                image.f32()[at++] = static_cast<float>(sum[c] / 16.0);
        }
    return image;
}
template <class Radiance>
Image latLong(int height, const Radiance& radiance) {
    return latLong(2 * height, height, radiance);
}

inline Image uniform(const glm::dvec3& color, int height = 32) {
    return latLong(height, [&](const glm::dvec3&) { return color; });
}

// A disc of even radiance on an even ground.
struct Disc {
    double azimuthDeg = 60.0, elevationDeg = 40.0, diameterDeg = 4.0;
    double radiance = 1000.0, around = 1.0;

    [[nodiscard]] glm::dvec3 direction() const {
        return directionFromAngles(azimuthDeg, elevationDeg);
    }
    [[nodiscard]] double radius() const { return glm::radians(0.5 * diameterDeg); }
    [[nodiscard]] double solidAngle() const {
        return 2.0 * std::numbers::pi * (1.0 - std::cos(radius()));
    }
    // ∫ cos over the disc, seen by a surface that faces it.
    [[nodiscard]] double projected() const {
        return std::numbers::pi * std::sin(radius()) * std::sin(radius());
    }
    [[nodiscard]] Image picture(int height = 256) const {
        const double least = std::cos(radius());
        return latLong(height, [&, towards = direction()](const glm::dvec3& d) {
            return glm::dvec3(glm::dot(d, towards) >= least ? radiance : around);
        });
    }
};

} // namespace patina::test
