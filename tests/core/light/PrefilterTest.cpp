// The GGX prefilter against its closed forms: band multipliers, kernel, sun discs, irradiance.
#include "core/light/Prefilter.h"

#include "core/job/Parallel.h"
#include "core/light/Cubemap.h"
#include "core/light/PrefilterSums.h"
#include "core/math/Sampling.h"
#include "core/math/SphericalHarmonics.h"
#include "tests/core/light/PrefilterReference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>
#include <memory>

namespace patina {
namespace {

using namespace reference;

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

// The lobe's Laplacian on the sphere, by differences.
double laplacian(double c, double alpha2) {
    const auto f = [&](double x) { // without the clamp
        const double d = 0.5 * (1.0 + x) * (alpha2 - 1.0) + 1.0;
        return x / (d * d);
    };
    constexpr double h = 1e-4;
    const double slope = (f(c + h) - f(c - h)) / (2.0 * h);
    const double curvature = (f(c + h) - 2.0 * f(c) + f(c - h)) / (h * h);
    return (1.0 - c * c) * curvature - 2.0 * c * slope;
}

TEST(Prefilter, MultipliesBandsByTheirFactors) {
    // A constant stays, P_l becomes lambda_l P_l. Without the weight, or with alpha for the slider,
    // every lambda is different. At r = 0.05 the texels are five times as wide as the lobe.
    const CubePyramid odd(
        cubeOf(128, [](glm::vec3 d) { return glm::vec3(1.0, 2.0 + band(d, 1), band(d, 3)); }));
    const CubePyramid even(
        cubeOf(128, [](glm::vec3 d) { return glm::vec3(0.0, band(d, 2), band(d, 4)); }));
    for (const BandFactors& row : kBandFactors) {
        const float alpha = row.perceptualRoughness * row.perceptualRoughness;
        const CubeLevel a = prefilterGGX(odd, 16, alpha, {}, {});
        const CubeLevel b = prefilterGGX(even, 16, alpha, {}, {});
        for (std::size_t i = 0; i < a.texels.size(); ++i) {
            const glm::vec3 n = texelDirection(16, i);
            ASSERT_NEAR(a.texels[i].x, 1.0, 1e-6);
            ASSERT_NEAR(a.texels[i].y, 2.0 + row.lambda[0] * band(n, 1), 3e-4) << alpha;
            ASSERT_NEAR(b.texels[i].y, row.lambda[1] * band(n, 2), 4e-4) << alpha;
            ASSERT_NEAR(a.texels[i].z, row.lambda[2] * band(n, 3), 8e-4) << alpha;
            ASSERT_NEAR(b.texels[i].z, row.lambda[3] * band(n, 4), 8e-4) << alpha;
        }
    }
}

TEST(Prefilter, RespondsToAPointOfLightWithItsKernel) {
    // A light of one texel next to the middle of +X.
    constexpr int kSize = 256, kOut = 128;
    CubeLevel base = cubeOf(kSize, [](glm::vec3) { return glm::vec3(0.0f); });
    const std::size_t light = kSize / 2 * kSize + kSize / 2;
    base.texels[light] = glm::vec3(1e5f);
    const double flux = 1e5 * cubeSolidAngles(kSize)[light];
    const CubePyramid pyramid(base);
    for (int r = 0; r < 5; ++r) {
        const float alpha = kFilterRoughness[r] * kFilterRoughness[r];
        const CubeLevel out = prefilterGGX(pyramid, kOut, alpha, {}, {});
        for (int k = 0; k < 8; ++k) {
            const KernelSample at = kernelSample(kOut, texelDirection(kSize, light), r, k);
            EXPECT_NEAR(out.texels[at.texel].x / (flux * at.exact), 1.0, 1e-4)
                << "roughness " << kFilterRoughness[r] << " at " << kKernelAngleDeg[k]
                << " degrees";
        }
    }
}

TEST(Prefilter, DiscLightsLookedAtDirectly) {
    for (const Disc& disc : kDiscs) {
        const CubePyramid pyramid(discCube(disc.halfAngleDeg));
        for (int r = 0; r < 5; ++r) {
            const float alpha = kFilterRoughness[r] * kFilterRoughness[r];
            const CubeLevel out = prefilterGGX(pyramid, 16, alpha, {}, {});
            EXPECT_NEAR(out.texels[kDiscTexel].x / disc.fraction[r], 1.0, 1e-3)
                << disc.halfAngleDeg << " degrees, " << kFilterRoughness[r];
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

// A dark room with three hard-edged softboxes: what is not turned to one is lit by its lobe's tail.
glm::vec3 studio(glm::vec3 d) {
    static const glm::mat3 turned(glm::normalize(glm::vec3(1.0f, 0.3f, -0.2f)),
                                  glm::normalize(glm::vec3(-0.3f, 1.0f, 0.0f)),
                                  glm::normalize(glm::vec3(0.2f, 0.06f, 1.09f)));
    const glm::vec3 p = d * turned;
    if (p.z > 0.5f && std::abs(p.x) < 0.4f * p.z && std::abs(p.y) < 0.2f * p.z)
        return {60.0f, 58.0f, 55.0f};
    if (p.x > 0.5f && std::abs(p.y) < 0.3f * p.x && std::abs(p.z - 0.1f) < 0.15f * p.x)
        return {30.0f, 34.0f, 40.0f};
    if (p.y > 0.5f && std::abs(p.x) < 0.5f * p.y && std::abs(p.z) < 0.5f * p.y)
        return {12.0f, 12.0f, 12.0f};
    return glm::vec3(0.02f + 0.01f * p.y);
}

class PrefilterOf : public testing::TestWithParam<glm::vec3 (*)(glm::vec3)> {};

TEST_P(PrefilterOf, IsTheTexelSumAtEveryLevel) {
    // Relative error below 0.25 %, 0.06 % root mean square, at every roughness: in a scene with a
    // sun of 1e5, also where half the sun is below the horizon, and in one of edges. No speckle.
    const CubeLevel base = cubeOf(128, GetParam());
    const CubePyramid pyramid(base);
    for (int level = 1; level <= 6; ++level) {
        const float r = static_cast<float>(level) / 6.0f;
        const int size = 128 >> level;
        const float widest = level == 1 ? 0.063f : 0.0315f;
        const CubeLevel out = prefilterGGX(pyramid, size, r * r, {0.09f, widest}, {});
        const std::size_t step = std::max<std::size_t>(out.texels.size() / 80, 1) | 1u;
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
        EXPECT_LT(std::sqrt(squares / count), 6e-4) << r;
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, PrefilterOf, testing::Values(sunnySky, studio));

TEST(Prefilter, EveryFaceIsFilteredTheSameWay) {
    // The same sky turned by the cube's symmetries gives the same maps, turned: a light and its
    // environment in each of 48 places. 32² texels have tiles off the diagonal, too.
    constexpr int kOut = 32;
    const auto sky = [](const glm::vec3& d) {
        return glm::vec3(2.0f + d.x + 0.5f * d.y * d.z,
                         glm::dot(d, {0.6f, 0.48f, 0.64f}) > 0.95f ? 50.0f : 1.0f, std::abs(d.z));
    };
    const CubeLevel straight = prefilterGGX(CubePyramid(cubeOf(64, sky)), kOut, 0.1f, {}, {});
    for (const CubeSymmetry& symmetry : cubeSymmetries()) {
        const glm::mat3 back = glm::transpose(symmetry.matrix);
        const CubeLevel turned =
            prefilterGGX(CubePyramid(cubeOf(64, [&](glm::vec3 d) { return sky(back * d); })), kOut,
                         0.1f, {}, {});
        for (std::size_t i = 0; i < turned.texels.size(); i += 17) {
            const CubePosition at = cubePosition(back * texelDirection(kOut, i));
            const auto column = static_cast<std::size_t>(at.s * kOut);
            const auto row = static_cast<std::size_t>(at.t * kOut);
            const glm::vec3& expected =
                straight.texels[(static_cast<std::size_t>(at.face) * kOut + row) * kOut + column];
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
    std::vector<int> column, row;
    std::vector<CubePyramid::BrightTexel> bright;
    for (std::uint32_t i = 0; i < 50; ++i) {
        cells.emplace_back(uniformSphere(sobolOwen2D(i, 4)), 1e-3f * static_cast<float>(i + 1));
        radiance.emplace_back(static_cast<float>(i), 1.0f, 0.1f * static_cast<float>(50 - i), 0.0f);
        column.push_back(static_cast<int>((i * 7) % 10));
        row.push_back(static_cast<int>(i % 5));
        bright.push_back({uniformSphere(sobolOwen2D(i, 5)), glm::vec3(radiance[i]), 1e-3f});
    }
    constexpr float kSpread = 1.0f / 32.0f;
    const auto compute = [&](const detail::PrefilterSums& arithmetic) {
        auto weights = std::make_unique<detail::CellWeights>();
        detail::TileSums sums;
        std::vector<float> result(detail::kTileTexels, 0.0f);
        arithmetic.weigh(tile, cells, kSpread, {0.04f}, *weights, result.data());
        arithmetic.add(*weights, {column, row, 40, 1, -10}, radiance.data(), sums);
        arithmetic.addBrightTexels(tile, bright, {0.04f}, sums);
        for (const float* colour : {sums.red, sums.green, sums.blue})
            result.insert(result.end(), colour, colour + detail::kTileTexels);
        return result;
    };
    const auto all = detail::prefilterSums();
    const std::vector<float> expected = compute(all.back());
    for (int i = 0; i < detail::kTileTexels; ++i) {
        // The plain definition; the mean over a cell by differences of the lobe.
        glm::dvec3 light(0.0);
        double total = 0.0;
        for (std::size_t k = 0; k < cells.size(); ++k) {
            const glm::dvec3 n(tile.x[i], tile.y[i], tile.z[i]), l(cells[k]);
            const double c = glm::dot(n, l);
            const double moment = kSpread * static_cast<double>(cells[k].w);
            const double width = std::sqrt(6.0 * moment);
            double weight = c > 0.0 ? lobe(c, 0.04) + moment * laplacian(c, 0.04) : 0.0;
            if (std::abs(c) < width) {
                const double s = 0.5 * (1.0 + c) * (0.04 - 1.0) + 1.0;
                weight += (std::pow(c + width, 2.0) / (4.0 * width) - std::max(c, 0.0)) / (s * s);
            }
            total += weight * cells[k].w;
            const int at = 40 + column[k] - 10 * row[k];
            light += weight * cells[k].w * glm::dvec3(radiance[static_cast<std::size_t>(at)]);
            light += lobe(glm::dot(n, glm::dvec3(bright[k].direction)), 0.04) *
                     glm::dvec3(bright[k].flux);
        }
        EXPECT_NEAR(expected[i] / total, 1.0, 1e-5);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(expected[(c + 1) * detail::kTileTexels + i] / light[c], 1.0, 1e-5);
    }
    for (const detail::PrefilterSums& arithmetic : all) {
        const std::vector<float> result = compute(arithmetic);
        for (std::size_t i = 0; i < result.size(); ++i)
            EXPECT_NEAR(result[i], expected[i], 2e-6f * std::abs(expected[i])) << i;
    }
}

// Through a lobe narrower than a texel, a texel is a disc of its solid angle: the weight of a cell
// is the lobe's mean over it.
TEST(Prefilter, NarrowLobesSeeTexelsAsDiscs) {
    const double alpha = 0.003, alpha2 = alpha * alpha, radius = 0.0044;
    const double solidAngle = M_PI * radius * radius;
    detail::TileDirections tile;
    for (int i = 0; i < detail::kTileTexels; ++i) {
        const float angle = 0.0005f * static_cast<float>(i); // up to seven radii from its middle
        tile.x[i] = std::sin(angle);
        tile.y[i] = 0.0f;
        tile.z[i] = std::cos(angle);
    }
    const glm::vec4 cell(0.0f, 0.0f, 1.0f, solidAngle);
    const CubePyramid::BrightTexel bright{glm::vec3(cell), glm::vec3(2.0f),
                                          static_cast<float>(solidAngle)};
    for (const detail::PrefilterSums& arithmetic : detail::prefilterSums()) {
        auto weights = std::make_unique<detail::CellWeights>();
        detail::TileSums sums;
        std::vector<float> total(detail::kTileTexels, 0.0f);
        const detail::LobeShape shape{static_cast<float>(alpha2), true};
        arithmetic.weigh(tile, {&cell, 1}, 0.0f, shape, *weights, total.data());
        arithmetic.addBrightTexels(tile, {&bright, 1}, shape, sums);
        for (int i = 0; i < detail::kTileTexels; ++i) {
            // By points of the disc that stand for equal areas
            double mean = 0.0;
            constexpr int kRings = 60, kAround = 60;
            for (int k = 0; k < kRings * kAround; ++k) {
                const double r = radius * std::sqrt((k / kAround + 0.5) / kRings);
                const double phi = 2.0 * M_PI * (k % kAround + 0.5) / kAround;
                const glm::dvec3 l =
                    glm::normalize(glm::dvec3(r * std::cos(phi), r * std::sin(phi), 1.0));
                mean +=
                    lobe(glm::dot(glm::normalize(glm::dvec3(tile.x[i], tile.y[i], tile.z[i])), l),
                         alpha2) /
                    (kRings * kAround);
            }
            EXPECT_NEAR(static_cast<double>(total[i]) / (mean * solidAngle), 1.0, 2e-3) << i;
            EXPECT_NEAR(static_cast<double>(sums.green[i]) / (mean * 2.0), 1.0, 2e-3) << i;
        }
    }
}

TEST(Prefilter, ManyBrightTexelsAreLeftInThePyramid) {
    // More bright texels than can be summed one by one: a white half of a face, half of it
    // brighter.
    const CubeLevel base = cubeOf(64, [](glm::vec3 d) {
        return d.x > 0.9f ? glm::vec3(d.y > 0.0f ? 900.0f : 800.0f) : glm::vec3(0.1f);
    });
    const CubePyramid pyramid(base);
    EXPECT_LE(pyramid.brightTexels().size(), 1024u);
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
