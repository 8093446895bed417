// The GGX prefilter against its closed forms: band multipliers, kernel, sun discs, irradiance.
#include "core/light/Prefilter.h"

#include "core/job/Parallel.h"
#include "core/light/Cubemap.h"
#include "core/math/SphericalHarmonics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/trigonometric.hpp>

namespace patina {
namespace {

constexpr float kRoughness[5] = {0.1f, 0.25f, 0.5f, 0.75f, 1.0f};

glm::vec3 texelDirection(int size, std::size_t index) {
    const int face = static_cast<int>(index) / (size * size);
    const int x = static_cast<int>(index) % size, y = static_cast<int>(index) / size % size;
    return glm::normalize(cubeDirection(face, (x + 0.5f) / static_cast<float>(size),
                                        (y + 0.5f) / static_cast<float>(size)));
}

CubeLevel cubeOf(int size, const std::function<glm::vec3(glm::vec3)>& radiance) {
    CubeLevel level;
    level.size = size;
    for (std::size_t i = 0; i < 6u * size * size; ++i)
        level.texels.push_back(radiance(texelDirection(size, i)));
    return level;
}

// The definition, in double: every texel of the base level, textbook form of D.
glm::dvec3 exactSum(const CubeLevel& base, glm::dvec3 n, double alpha) {
    const std::vector<float> omega = cubeSolidAngles(base.size);
    glm::dvec3 sum(0.0);
    double weights = 0.0;
    for (std::size_t i = 0; i < base.texels.size(); ++i) {
        const double c = glm::dot(n, glm::dvec3(texelDirection(base.size, i)));
        if (c <= 0.0)
            continue;
        const double d = 0.5 * (1.0 + c) * (alpha * alpha - 1.0) + 1.0;
        const double w = c * omega[i % omega.size()] / (d * d);
        sum += w * glm::dvec3(base.texels[i]);
        weights += w;
    }
    return sum / weights;
}

TEST(Prefilter, MultipliesBandsByTheirFactors) {
    // lambda_1 and lambda_2 of the filter with N = V = R and weight N·L: a constant stays, z
    // becomes lambda_1 R.z, z² becomes 1/3 + 2/3 lambda_2 P2(R.z). Without the weight, or with
    // alpha for the slider, every one of them is different.
    constexpr double kLambda[5][2] = {{0.998693503699, 0.996229938117},
                                      {0.976092604298, 0.933738270618},
                                      {0.867395662812, 0.662405687279},
                                      {0.745131342455, 0.398824737791},
                                      {0.666666666667, 0.25}};
    const CubePyramid pyramid(
        cubeOf(128, [](glm::vec3 d) { return glm::vec3(1.0f, 2.0f + d.z, d.y * d.y); }));
    for (int r = 0; r < 5; ++r) {
        const float alpha = kRoughness[r] * kRoughness[r];
        const CubeLevel out = prefilterGGX(pyramid, 16, alpha, {}, {});
        for (std::size_t i = 0; i < out.texels.size(); ++i) {
            const glm::dvec3 n(texelDirection(16, i));
            ASSERT_NEAR(out.texels[i].x, 1.0, 1e-6);
            ASSERT_NEAR(out.texels[i].y, 2.0 + kLambda[r][0] * n.z, 1e-3) << kRoughness[r];
            ASSERT_NEAR(out.texels[i].z,
                        1.0 / 3.0 + 2.0 / 3.0 * kLambda[r][1] * (1.5 * n.y * n.y - 0.5), 2e-3)
                << kRoughness[r];
        }
    }
}

TEST(Prefilter, RespondsToAPointOfLightWithItsKernel) {
    // K(t) = D(t / 2) cos t / (4 W): response at angle t from R to unit integrated radiance.
    constexpr float kAngleDeg[5] = {10, 20, 30, 45, 60};
    constexpr double kKernel[3][5] = {
        {2.40843045642, 0.262555479877, 0.0558782922431, 0.010145809629, 0.00251584801732},
        {1.32559130272, 0.744137473127, 0.359888235795, 0.115575213166, 0.0370139994995},
        {0.313474043774, 0.29911345117, 0.275664447711, 0.225079079039, 0.159154943092}};
    constexpr float kR[3] = {0.25f, 0.5f, 1.0f};
    // A lamp of one texel at the middle of +X (four texels meet there: take the next one).
    CubeLevel base = cubeOf(128, [](glm::vec3) { return glm::vec3(0.0f); });
    const std::size_t lamp = 64u * 128 + 64;
    base.texels[lamp] = glm::vec3(1e5f);
    const double flux = 1e5 * cubeSolidAngles(128)[lamp];
    const glm::dvec3 lampDirection(texelDirection(128, lamp));
    const CubePyramid pyramid(std::move(base));
    for (int r = 0; r < 3; ++r) {
        const CubeLevel out = prefilterGGX(pyramid, 64, kR[r] * kR[r], {}, {});
        for (int k = 0; k < 5; ++k) {
            // The texel whose angle is closest, and the kernel there by log-linear interpolation of
            // K / cos from the closed form ratio D(t) / D(t_k).
            double best = 1e9, angle = 0.0, value = 0.0;
            for (std::size_t i = 0; i < out.texels.size(); ++i) {
                const double t = std::acos(std::clamp(
                    glm::dot(lampDirection, glm::dvec3(texelDirection(64, i))), -1.0, 1.0));
                if (std::abs(t - glm::radians(static_cast<double>(kAngleDeg[k]))) < best) {
                    best = std::abs(t - glm::radians(static_cast<double>(kAngleDeg[k])));
                    angle = t;
                    value = out.texels[i].x;
                }
            }
            const auto shape = [&](double t) {
                const double a2 = std::pow(kR[r], 4.0), c = std::cos(t);
                const double d = 0.5 * (1.0 + c) * (a2 - 1.0) + 1.0;
                return c / (d * d);
            };
            const double expected = kKernel[r][k] * shape(angle) /
                                    shape(glm::radians(static_cast<double>(kAngleDeg[k])));
            EXPECT_NEAR(value / (flux * expected), 1.0, 5e-3)
                << "roughness " << kR[r] << " at " << kAngleDeg[k] << " degrees";
        }
    }
}

TEST(Prefilter, DiscLightsLookedAtDirectly) {
    // Fraction of the kernel inside a disc of half-angle 10°.
    constexpr double kFraction[4] = {0.68222336265, 0.142079213488, 0.0497565768298,
                                     0.030153689607};
    constexpr float kR[4] = {0.25f, 0.5f, 0.75f, 1.0f};
    // The disc stands on a texel of the 16² output.
    const std::size_t texel = (4u * 16 + 7) * 16 + 8;
    const glm::vec3 towards = texelDirection(16, texel);
    const float edge = std::cos(glm::radians(10.0f));
    const CubePyramid pyramid(cubeOf(
        256, [&](glm::vec3 d) { return glm::vec3(glm::dot(d, towards) > edge ? 1.0f : 0.0f); }));
    for (int r = 0; r < 4; ++r) {
        const CubeLevel out = prefilterGGX(pyramid, 16, kR[r] * kR[r], {}, {});
        EXPECT_NEAR(out.texels[texel].x / kFraction[r], 1.0, 0.01) << kR[r];
    }
}

// A sky with a window and a sun of radiance 1e5.
glm::vec3 sunnySky(glm::vec3 d) {
    static const glm::vec3 sun = glm::normalize(glm::vec3(0.4f, 0.5f, -0.3f));
    static const glm::vec3 window = glm::normalize(glm::vec3(-0.8f, 0.2f, 0.3f));
    if (glm::dot(d, sun) > 0.9999f)
        return {1e5f, 9e4f, 7e4f};
    if (glm::dot(d, window) > 0.978f)
        return {10.0f, 9.0f, 8.0f};
    return glm::vec3(0.4f + 0.3f * d.y);
}

TEST(Prefilter, ASunOf100000LeavesNoSpeckle) {
    const CubeLevel base = cubeOf(64, sunnySky);
    const CubePyramid pyramid(base);
    for (const float r : {0.2f, 0.4f, 0.7f, 1.0f}) {
        const CubeLevel out = prefilterGGX(pyramid, 32, r * r, {}, {});
        // 1 % of the value; 0.4 % of the brightest where half a sun is above the horizon and its
        // cell counts as a point.
        float brightest = 0.0f;
        for (const glm::vec3& texel : out.texels)
            brightest = std::max(brightest, texel.x);
        for (std::size_t i = 0; i < out.texels.size(); i += 17) {
            const glm::dvec3 exact =
                exactSum(base, glm::dvec3(texelDirection(32, i)), static_cast<double>(r * r));
            ASSERT_NEAR(out.texels[i].x, exact.x, 0.01 * exact.x + 0.004 * brightest)
                << r << " " << i;
        }
    }
}

TEST(Prefilter, RoughestLevelIsIrradianceOverPi) {
    const CubeLevel base = cubeOf(64, sunnySky);
    const std::vector<float> omega = cubeSolidAngles(64);
    const CubeLevel out = prefilterGGX(CubePyramid(base), 8, 1.0f, {}, {});
    for (std::size_t i = 0; i < out.texels.size(); i += 5) {
        const glm::dvec3 n(texelDirection(8, i));
        double irradiance = 0.0;
        for (std::size_t k = 0; k < base.texels.size(); ++k)
            irradiance += base.texels[k].x *
                          std::max(glm::dot(n, glm::dvec3(texelDirection(64, k))), 0.0) *
                          omega[k % omega.size()];
        EXPECT_NEAR(out.texels[i].x / (irradiance / M_PI), 1.0, 0.01) << i;
    }
}

TEST(Prefilter, ResultDoesNotDependOnThreads) {
    const CubePyramid pyramid(cubeOf(64, sunnySky));
    const CubeLevel many = prefilterGGX(pyramid, 32, 0.1f, {}, {});
    const ThreadLimit one(1);
    const CubeLevel single = prefilterGGX(pyramid, 32, 0.1f, {}, {});
    EXPECT_EQ(many.texels, single.texels);
}

} // namespace
} // namespace patina
