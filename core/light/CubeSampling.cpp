#include "core/light/CubeSampling.h"

#include "core/job/Parallel.h"
#include "core/light/Cubemap.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

namespace patina {

glm::vec3 cubeTexel(const CubeLevel& level, int face, int x, int y) {
    const int size = level.size;
    if (x < 0 || y < 0 || x >= size || y >= size) {
        const auto scale = static_cast<float>(size);
        const CubePosition at = cubePosition(cubeDirection(
            face, (static_cast<float>(x) + 0.5f) / scale, (static_cast<float>(y) + 0.5f) / scale));
        face = at.face;
        x = std::clamp(static_cast<int>(at.s * scale), 0, size - 1);
        y = std::clamp(static_cast<int>(at.t * scale), 0, size - 1);
    }
    return level.texels[(static_cast<std::size_t>(face) * size + y) * size + x];
}

glm::vec3 sampleCube(const CubeLevel& level, const glm::vec3& direction) {
    const CubePosition at = cubePosition(direction);
    const auto scale = static_cast<float>(level.size);
    const float x = at.s * scale - 0.5f, y = at.t * scale - 0.5f;
    const float x0 = std::floor(x), y0 = std::floor(y);
    const float fx = x - x0, fy = y - y0;
    const int column = static_cast<int>(x0), row = static_cast<int>(y0);
    return (cubeTexel(level, at.face, column, row) * (1.0f - fx) +
            cubeTexel(level, at.face, column + 1, row) * fx) *
               (1.0f - fy) +
           (cubeTexel(level, at.face, column, row + 1) * (1.0f - fx) +
            cubeTexel(level, at.face, column + 1, row + 1) * fx) *
               fy;
}

glm::vec3 sampleCubes(const CubeLevel& first, const CubeLevel& second, float share,
                      const glm::vec3& direction) {
    const glm::vec3 value = sampleCube(first, direction);
    return share > 0.0f ? glm::mix(value, sampleCube(second, direction), share) : value;
}

glm::vec3 sampleIrradiance(const IblMaps& maps, const glm::vec3& normal) {
    if (maps.irradiance.size > 0)
        return sampleCube(maps.irradiance, normal);
    return std::numbers::pi_v<float> * sampleCube(maps.prefiltered.back(), normal);
}

Image latLongFromCube(const CubeLevel& level, const JobContext& job) {
    const int width = 4 * level.size, height = 2 * level.size;
    Image image(width, height, 3, PixelType::F32, ColorEncoding::Linear);
    const std::span<float> out = image.f32();
    parallelFor(job, static_cast<std::size_t>(height), 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t row = begin; row < end; ++row)
            for (int x = 0; x < width; ++x) {
                glm::vec3 sum(0.0f);
                for (int k = 0; k < 4; ++k) {
                    const double theta = std::numbers::pi *
                                         (static_cast<double>(row) + 0.25 + 0.5 * (k / 2)) / height;
                    const double phi =
                        2.0 * std::numbers::pi * ((x + 0.25 + 0.5 * (k % 2)) / width - 0.5);
                    sum += sampleCube(level,
                                      glm::vec3(std::sin(theta) * std::sin(phi), std::cos(theta),
                                                -std::sin(theta) * std::cos(phi)));
                }
                for (int c = 0; c < 3; ++c)
                    out[(row * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) * 3 +
                        static_cast<std::size_t>(c)] = 0.25f * sum[c];
            }
    });
    return image;
}

} // namespace patina
