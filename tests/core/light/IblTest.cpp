// The whole of an environment's image-based light.
#include "core/light/Ibl.h"

#include "core/job/Parallel.h"
#include "core/light/Cubemap.h"
#include "core/math/Shading.h"
#include "core/math/SphericalHarmonics.h"
#include "tests/core/light/LatLongPicture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace patina {
namespace {

glm::vec3 lookUp(const CubeLevel& level, const glm::vec3& d) {
    const CubePosition at = cubePosition(d);
    const auto index = [&](float s) {
        return std::min(static_cast<int>(s * static_cast<float>(level.size)), level.size - 1);
    };
    return level.texels[(at.face * level.size + index(at.t)) * level.size + index(at.s)];
}

TEST(Ibl, LevelsHalveAndGrowRougher) {
    const Image sky = test::latLongImage(
        128, 64, [](glm::vec3 d) { return glm::vec3(d.y > 0.0f ? 1.0f : 0.0f, d.x + 1.0f, 1.0f); });
    const auto maps =
        computeIbl(sky, {.cubeSize = 32, .levels = 4, .spacing = LevelSpacing::Even}, {});
    ASSERT_TRUE(maps.ok());
    ASSERT_EQ(maps.value().prefiltered.size(), 4u);
    for (int i = 0; i < 4; ++i) {
        const int side = 32 >> i;
        EXPECT_EQ(maps.value().prefiltered[i].size, side);
        EXPECT_EQ(maps.value().prefiltered[i].texels.size(), 6u * side * side);
    }
    // Level 0 is the environment: a sharp horizon; then +x looks ever less bright from +x.
    EXPECT_NEAR(lookUp(maps.value().prefiltered[0], {0.3f, 0.8f, 0.1f}).x, 1.0f, 1e-5f);
    EXPECT_NEAR(lookUp(maps.value().prefiltered[0], {0.3f, -0.8f, 0.1f}).x, 0.0f, 1e-5f);
    // Level i stands for perceptual roughness i / 3: 1 + lambda_1(r) x, lambda_1(1) = 2/3; r = 1/3:
    // closed form (a²/b³)[(1+a²)²/a² - 4a² - 4(1+a²)L] / W with a = r², b = 1 - a²,
    // L = ln((1+a²)/2a²), W = 1/b - 2a²L/b².
    for (int i = 1; i < 4; ++i) {
        const double r = i / 3.0, a2 = std::pow(r, 4.0), b = 1.0 - a2;
        const double L = std::log((1.0 + a2) / (2.0 * a2)), W = 1.0 / b - 2.0 * a2 * L / (b * b);
        const double lambda =
            i == 3 ? 2.0 / 3.0
                   : a2 / (b * b * b) *
                         ((1.0 + a2) * (1.0 + a2) / a2 - 4.0 * a2 - 4.0 * (1.0 + a2) * L) / W;
        const CubeLevel& level = maps.value().prefiltered[i];
        const CubePosition at = cubePosition({1.0f, 0.1f, 0.05f});
        const int x = static_cast<int>(at.s * static_cast<float>(level.size));
        const int y = static_cast<int>(at.t * static_cast<float>(level.size));
        const glm::vec3 n =
            glm::normalize(cubeDirection(0, (x + 0.5f) / static_cast<float>(level.size),
                                         (y + 0.5f) / static_cast<float>(level.size)));
        EXPECT_NEAR(level.texels[y * level.size + x].y, 1.0 + lambda * n.x, 4e-3) << i;
        EXPECT_NEAR(level.texels[y * level.size + x].z, 1.0, 1e-5);
    }
}

TEST(Ibl, IrradianceOfAnalyticSkies) {
    // Constant: pi. y: (2pi/3) n.y. y²: pi/3 + (pi/6) P2(n.y). Sky above the horizon: pi(1 +
    // n.y)/2.
    const Image image = test::latLongImage(256, 128, [](glm::vec3 d) {
        return glm::vec3(1.0f + d.y, d.y * d.y, d.y > 0.0f ? 1.0f : 0.0f);
    });
    const auto maps = computeIbl(image, {16, 2}, {});
    ASSERT_TRUE(maps.ok());
    for (const float y : {1.0f, 0.5f, 0.0f, -0.5f, -1.0f}) {
        const glm::vec3 n(0.6f * std::sqrt(1.0f - y * y), y, 0.8f * std::sqrt(1.0f - y * y));
        const glm::vec3 e = shading::irradianceFromSh9(maps.value().irradianceSh.data(), n);
        EXPECT_NEAR(e.x, M_PI + 2.0 * M_PI / 3.0 * y, 1e-3);
        EXPECT_NEAR(e.y, M_PI / 3.0 + M_PI / 6.0 * (1.5 * y * y - 0.5), 1e-3);
        EXPECT_NEAR(e.z, M_PI * (1.0 + y) / 2.0, 1e-5);
    }
    const auto radiance = projectLatLong(image, 8);
    for (std::size_t i = 0; i < 64; ++i)
        EXPECT_EQ(maps.value().radianceSh[i], radiance[i]);
}

TEST(Ibl, IrradianceCubeIsTheRoughestLevelTimesPi) {
    // The same skies, texel by texel, and without the nine coefficients' limits: a lamp of 1e4.
    const Image image = test::latLongImage(256, 128, [](glm::vec3 d) {
        return glm::vec3(1.0f + d.y, d.y * d.y, d.y > 0.0f ? 1.0f : 0.0f);
    });
    const auto maps = computeIbl(
        image, {.cubeSize = 64, .levels = 4, .irradianceSize = 8, .spacing = LevelSpacing::Even},
        {});
    ASSERT_TRUE(maps.ok());
    ASSERT_EQ(maps->irradiance.size, 8);
    ASSERT_EQ(maps->irradiance.texels.size(), 6u * 8 * 8);
    for (int i = 0; i < 6 * 8 * 8; ++i) {
        const auto at = [](int k) { return (static_cast<float>(k % 8) + 0.5f) / 8.0f; };
        const float y = glm::normalize(cubeDirection(i / 64, at(i), at(i / 8))).y;
        EXPECT_NEAR(maps->irradiance.texels[i].x, M_PI + 2.0 * M_PI / 3.0 * y, 2e-3);
        EXPECT_NEAR(maps->irradiance.texels[i].y, M_PI / 3.0 + M_PI / 6.0 * (1.5 * y * y - 0.5),
                    2e-3);
        EXPECT_NEAR(maps->irradiance.texels[i].z, M_PI * (1.0 + y) / 2.0, 6e-3);
        // Level 3 of 64² is 8² at perceptual roughness 1; its cells are half as wide.
        EXPECT_LT(glm::length(maps->prefiltered[3].texels[i] * static_cast<float>(M_PI) -
                              maps->irradiance.texels[i]),
                  1e-3f);
    }
    EXPECT_TRUE(computeIbl(image, {16, 2, 0}, {})->irradiance.texels.empty());
}

TEST(Ibl, ResultDoesNotDependOnThreads) {
    const Image sky = test::latLongImage(128, 64, [](glm::vec3 d) {
        return d.y > 0.98f ? glm::vec3(1e5f) : glm::vec3(1.0f + d.x, 0.5f, d.z * d.z);
    });
    const auto many = computeIbl(sky, {32, 4}, {});
    const ThreadLimit one(1);
    const auto single = computeIbl(sky, {32, 4}, {});
    ASSERT_TRUE(many.ok() && single.ok());
    for (int i = 0; i < 4; ++i)
        EXPECT_EQ(many.value().prefiltered[i].texels, single.value().prefiltered[i].texels);
    EXPECT_EQ(many.value().irradianceSh, single.value().irradianceSh);
    EXPECT_EQ(many.value().radianceSh, single.value().radianceSh);
}

TEST(Ibl, CancelledMeansNoMaps) {
    const Image sky = test::latLongImage(64, 32, [](glm::vec3) { return glm::vec3(1.0f); });
    JobControl control;
    control.cancel();
    const auto maps = computeIbl(sky, {32, 4}, control.context());
    ASSERT_FALSE(maps.ok());
    EXPECT_EQ(maps.error().kind, ErrorKind::Cancelled);
}

TEST(Ibl, ReportsProgressToTheEnd) {
    const Image sky = test::latLongImage(64, 32, [](glm::vec3) { return glm::vec3(1.0f); });
    JobControl control;
    ASSERT_TRUE(computeIbl(sky, {32, 4}, control.context()).ok());
    EXPECT_NEAR(control.progress().fraction, 1.0, 1e-9);
}

} // namespace
} // namespace patina
