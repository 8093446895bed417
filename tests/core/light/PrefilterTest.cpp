// The GGX prefilter against its closed forms: band multipliers, kernel, sun discs, irradiance.
#include "core/light/Prefilter.h"

#include "core/job/Parallel.h"
#include "core/light/Cubemap.h"
#include "core/light/PrefilterSums.h"
#include "core/math/Sampling.h"
#include "core/math/SphericalHarmonics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>
#include <memory>

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
            ASSERT_NEAR(out.texels[i].y, 2.0 + kLambda[r][0] * n.z, 2e-4) << kRoughness[r];
            ASSERT_NEAR(out.texels[i].z,
                        1.0 / 3.0 + 2.0 / 3.0 * kLambda[r][1] * (1.5 * n.y * n.y - 0.5), 2e-4)
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
            EXPECT_NEAR(value / (flux * expected), 1.0, 1e-3)
                << "roughness " << kR[r] << " at " << kAngleDeg[k] << " degrees";
        }
    }
}

TEST(Prefilter, DiscLightsLookedAtDirectly) {
    // Fraction of the kernel inside a disc of half-angle 0.2666° (the Sun), 2.5° and 10°; r = 0.25,
    // 0.5, 0.75, 1. The discs' edges and the Sun are the cube's texels, 0.35° wide: narrower lobes
    // see them, r = 0.25 still a little.
    constexpr struct {
        double halfAngleDeg;
        double fraction[4], tolerance;
    } kDiscs[] = {
        {0.2666, {0.00143290266601, 0.000113597751254, 3.63247689137e-05, 2.16506974444e-05}, 3e-3},
        {2.5, {0.112452461214, 0.0099129653364, 0.00318895909711, 0.00190265095413}, 1.5e-3},
        {10.0, {0.68222336265, 0.142079213488, 0.0497765768298, 0.030153689607}, 1e-3}};
    constexpr float kR[4] = {0.25f, 0.5f, 0.75f, 1.0f};
    // Each disc stands on a texel of the 16² output; a texel it covers in part has that share.
    constexpr int kSize = 256, kParts = 16;
    const std::size_t texel = (4u * 16 + 7) * 16 + 8;
    const glm::vec3 towards = texelDirection(16, texel);
    for (const auto& disc : kDiscs) {
        const auto edge = static_cast<float>(2.0 * std::sin(glm::radians(disc.halfAngleDeg) / 2.0));
        CubeLevel base{kSize, std::vector<glm::vec3>(6u * kSize * kSize, glm::vec3(0.0f))};
        for (std::size_t i = 0; i < base.texels.size(); ++i) {
            const glm::vec3 d = texelDirection(kSize, i);
            if (glm::length(d - towards) > edge + 0.01f)
                continue;
            int inside = 0;
            for (int k = 0; k < kParts * kParts; ++k) {
                const auto at = [&](std::size_t whole, int part) {
                    return (static_cast<float>(whole) +
                            (static_cast<float>(part) + 0.5f) / kParts) /
                           kSize;
                };
                const glm::vec3 part = glm::normalize(
                    cubeDirection(static_cast<int>(i / (kSize * kSize)), at(i % kSize, k % kParts),
                                  at(i / kSize % kSize, k / kParts)));
                inside += glm::length(part - towards) < edge ? 1 : 0;
            }
            base.texels[i] = glm::vec3(static_cast<float>(inside) / (kParts * kParts));
        }
        // Its flux exactly: the parts of a texel count too coarsely for the Sun.
        const std::vector<float> omega = cubeSolidAngles(kSize);
        double flux = 0.0;
        for (std::size_t i = 0; i < base.texels.size(); ++i)
            flux += static_cast<double>(base.texels[i].x) * omega[i % omega.size()];
        const double half = std::sin(glm::radians(disc.halfAngleDeg) / 2.0);
        for (glm::vec3& value : base.texels)
            value *= static_cast<float>(4.0 * M_PI * half * half / flux);
        const CubePyramid pyramid(base);
        for (int r = 0; r < 4; ++r) {
            const CubeLevel out = prefilterGGX(pyramid, 16, kR[r] * kR[r], {0.05f, 0.02f}, {});
            EXPECT_NEAR(out.texels[texel].x / disc.fraction[r], 1.0, disc.tolerance)
                << disc.halfAngleDeg << " degrees, " << kR[r];
        }
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

TEST(Prefilter, IsTheTexelSumAtEveryLevel) {
    // Relative error below 0.25 %, 0.08 % root mean square, at every roughness and in a scene with
    // a sun of 1e5: also where half the sun is below the horizon. No speckle.
    const CubeLevel base = cubeOf(128, sunnySky);
    const CubePyramid pyramid(base);
    for (int level = 1; level <= 6; ++level) {
        const float r = static_cast<float>(level) / 6.0f;
        const int size = 128 >> level;
        const float widest = level == 1 ? 0.07f : 0.035f;
        const CubeLevel out = prefilterGGX(pyramid, size, r * r, {0.1f, widest}, {});
        const std::size_t step = std::max<std::size_t>(out.texels.size() / 150, 1) | 1u;
        double squares = 0.0;
        int count = 0;
        for (std::size_t i = 0; i < out.texels.size(); i += step) {
            const glm::dvec3 exact =
                exactSum(base, glm::dvec3(texelDirection(size, i)), static_cast<double>(r * r));
            for (int c = 0; c < 3; ++c) {
                const double error = out.texels[i][c] / exact[c] - 1.0;
                ASSERT_NEAR(error, 0.0, 2.5e-3) << r << " " << i;
                squares += error * error;
                ++count;
            }
        }
        EXPECT_LT(std::sqrt(squares / count), 8e-4) << r;
    }
}

TEST(Prefilter, EveryFaceIsFilteredTheSameWay) {
    // The same sky turned by the cube's symmetries gives the same maps, turned: a lamp and its
    // surroundings in each of 24 places.
    const auto sky = [](const glm::vec3& d) {
        return glm::vec3(2.0f + d.x + 0.5f * d.y * d.z,
                         glm::dot(d, {0.6f, 0.48f, 0.64f}) > 0.95f ? 50.0f : 1.0f, std::abs(d.z));
    };
    const CubeLevel straight = prefilterGGX(CubePyramid(cubeOf(64, sky)), 16, 0.1f, {}, {});
    for (const CubeSymmetry& symmetry : cubeSymmetries()) {
        const glm::mat3 back = glm::transpose(symmetry.matrix);
        const CubeLevel turned = prefilterGGX(
            CubePyramid(cubeOf(64, [&](glm::vec3 d) { return sky(back * d); })), 16, 0.1f, {}, {});
        for (std::size_t i = 0; i < turned.texels.size(); i += 7) {
            const CubePosition at = cubePosition(back * texelDirection(16, i));
            const auto column = static_cast<std::size_t>(at.s * 16.0f);
            const auto row = static_cast<std::size_t>(at.t * 16.0f);
            const glm::vec3& expected =
                straight.texels[(static_cast<std::size_t>(at.face) * 16 + row) * 16 + column];
            ASSERT_LT(glm::length(turned.texels[i] - expected), 2e-4f * glm::length(expected))
                << symmetry.face << symmetry.mirrorX << symmetry.mirrorY << " " << i;
        }
    }
}

TEST(Prefilter, EveryInstructionSetComputesTheSame) {
    detail::TileDirections tile;
    for (std::uint32_t i = 0; i < detail::kTileTexels; ++i) {
        const glm::vec3 d = uniformSphere(sobolOwen2D(i, 3));
        tile.x[i] = d.x;
        tile.y[i] = d.y;
        tile.z[i] = d.z;
    }
    std::vector<glm::vec4> cells, radiance;
    std::vector<int> index;
    std::vector<CubePyramid::Lamp> lamps;
    for (std::uint32_t i = 0; i < 50; ++i) {
        cells.emplace_back(uniformSphere(sobolOwen2D(i, 4)), 1e-3f * static_cast<float>(i + 1));
        radiance.emplace_back(static_cast<float>(i), 1.0f, 0.1f * static_cast<float>(50 - i), 0.0f);
        index.push_back(static_cast<int>((i * 7) % 50));
        lamps.push_back({uniformSphere(sobolOwen2D(i, 5)), glm::vec3(radiance[i])});
    }
    const auto compute = [&](const detail::PrefilterSums& arithmetic) {
        auto weights = std::make_unique<detail::CellWeights>();
        detail::TileSums sums;
        std::vector<float> result(detail::kTileTexels, 0.0f);
        arithmetic.weigh(tile, cells, 0.04f, *weights, result.data());
        arithmetic.add(*weights, index, radiance.data(), sums);
        arithmetic.addLamps(tile, lamps, 0.04f, sums);
        for (const float* colour : {sums.red, sums.green, sums.blue})
            result.insert(result.end(), colour, colour + detail::kTileTexels);
        return result;
    };
    const auto all = detail::prefilterSums();
    const std::vector<float> expected = compute(all.back());
    for (int i = 0; i < detail::kTileTexels; ++i) { // the plain definition
        double total = 0.0;
        for (const glm::vec4& cell : cells) {
            const double c = static_cast<double>(tile.x[i]) * cell.x +
                             static_cast<double>(tile.y[i]) * cell.y +
                             static_cast<double>(tile.z[i]) * cell.z;
            const double d = 0.5 * (1.0 + c) * (0.04 - 1.0) + 1.0;
            total += std::max(c, 0.0) * cell.w / (d * d);
        }
        EXPECT_NEAR(expected[i] / total, 1.0, 1e-5);
    }
    for (const detail::PrefilterSums& arithmetic : all) {
        const std::vector<float> result = compute(arithmetic);
        for (std::size_t i = 0; i < result.size(); ++i)
            EXPECT_NEAR(result[i], expected[i], 2e-6f * std::abs(expected[i])) << i;
    }
}

TEST(Prefilter, ManyLampsAreLeftInThePyramid) {
    // More bright texels than can be summed one by one: a white half of a face, half of it
    // brighter.
    const CubeLevel base = cubeOf(64, [](glm::vec3 d) {
        return d.x > 0.9f ? glm::vec3(d.y > 0.0f ? 900.0f : 800.0f) : glm::vec3(0.1f);
    });
    const CubePyramid pyramid(base);
    EXPECT_LE(pyramid.lamps().size(), 1024u);
    const CubeLevel out = prefilterGGX(pyramid, 8, 0.3f, {}, {});
    for (std::size_t i = 0; i < out.texels.size(); i += 11) {
        const double exact = exactSum(base, glm::dvec3(texelDirection(8, i)), 0.3).x;
        EXPECT_NEAR(out.texels[i].x / exact, 1.0, 1e-2) << i;
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
        EXPECT_NEAR(out.texels[i].x / (irradiance / M_PI), 1.0, 1.5e-3) << i;
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
