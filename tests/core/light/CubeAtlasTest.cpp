#include "core/light/CubeAtlas.h"

#include "core/light/CubeSampling.h"
#include "core/light/Cubemap.h"
#include "core/math/Sampling.h"
#include "core/math/Shading.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

using namespace patina;

namespace {

// A different picture on every level.
std::vector<CubeLevel> levels(int side, int count) {
    std::vector<CubeLevel> result;
    for (int k = 0; k < count; ++k) {
        CubeLevel level;
        const int size = static_cast<int>(shading::cubeLevelSide(k, static_cast<float>(side)));
        level.size = size;
        for (int i = 0; i < 6 * size * size; ++i) {
            const auto centre = [&](int j) {
                return (static_cast<float>(j % size) + 0.5f) / static_cast<float>(size);
            };
            const glm::vec3 d =
                glm::normalize(cubeDirection(i / (size * size), centre(i), centre(i / size)));
            level.texels.emplace_back(d.x + static_cast<float>(k), d.y * d.z, std::sin(3.0f * d.z));
        }
        result.push_back(level);
    }
    return result;
}

// As a linear filter without mipmaps reads the atlas; a lookup outside it is an error.
glm::vec3 bilinear(const CubeAtlas& atlas, const glm::vec2& texel) {
    const float x = texel.x - 0.5f, y = texel.y - 0.5f;
    const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
    const float fx = x - std::floor(x), fy = y - std::floor(y);
    const auto at = [&](int dx, int dy) {
        return atlas.texels.at(static_cast<std::size_t>(row + dy) *
                                   static_cast<std::size_t>(atlas.width) +
                               static_cast<std::size_t>(column + dx));
    };
    return (at(0, 0) * (1 - fx) + at(1, 0) * fx) * (1 - fy) +
           (at(0, 1) * (1 - fx) + at(1, 1) * fx) * fy;
}

} // namespace

TEST(CubeAtlas, ReadsLikeTheSeamlessCubemapOnEveryLevel) {
    for (const auto& [side, count] : {std::pair{64, 1}, {64, 3}, {64, 22}, {128, 22}, {16, 9}}) {
        const std::vector<CubeLevel> cube = levels(side, count);
        const CubeAtlas atlas = makeCubeAtlas(cube);
        ASSERT_EQ(atlas.texels.size(), static_cast<std::size_t>(atlas.width * atlas.height));
        EXPECT_EQ(atlas.side, side);
        EXPECT_EQ(atlas.levels, count);
        for (std::uint32_t i = 0; i < 20'000; ++i) {
            const glm::vec3 d = 3.0f * uniformSphere(sobolOwen2D(i, 5));
            const CubePosition expected = cubePosition(d);
            const glm::vec3 at = shading::cubeFacePosition(d);
            ASSERT_EQ(static_cast<int>(at.x), expected.face);
            ASSERT_NEAR(at.y, expected.s, 1e-6f);
            ASSERT_NEAR(at.z, expected.t, 1e-6f);
            const int level = static_cast<int>(i) % count;
            const glm::vec3 seen =
                bilinear(atlas, shading::cubeAtlasTexel(at, level, static_cast<float>(side)));
            const glm::vec3 cubes = sampleCube(cube[static_cast<std::size_t>(level)], d);
            ASSERT_LT(glm::length(seen - cubes), 2e-4f) << "level " << level << " sample " << i;
        }
    }
}

TEST(CubeAtlas, EdgesAndCornersOfTheCubeReadFiniteNeighbours) {
    const CubeAtlas atlas = makeCubeAtlas(levels(8, 4));
    for (const float x : {-1.0f, 0.0f, 1.0f})
        for (const float y : {-1.0f, 0.0f, 1.0f})
            for (const float z : {-1.0f, 0.0f, 1.0f})
                for (int level = 0; level < 4; ++level) {
                    const glm::vec3 at = shading::cubeFacePosition({x, y, z});
                    const glm::vec3 seen =
                        bilinear(atlas, shading::cubeAtlasTexel(at, level, 8.0f));
                    // Red holds the level and the direction's x.
                    EXPECT_NEAR(seen.x, static_cast<float>(level), 1.0f) << x << y << z;
                }
}
