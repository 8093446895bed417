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

// D(h) N·L but for a constant, textbook form, and its Laplacian on the sphere by differences.
double lobe(double c, double alpha2) {
    const double d = 0.5 * (1.0 + c) * (alpha2 - 1.0) + 1.0;
    return std::max(c, 0.0) / (d * d);
}
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
    // lambda_1 … lambda_4 of the filter with N = V = R and weight N·L: a constant stays, P_l of the
    // angle to an axis becomes lambda_l P_l. Without the weight, or with alpha for the slider,
    // every one of them is different. At r = 0.05 the texels are five times as wide as the lobe.
    constexpr struct {
        float perceptualRoughness;
        double lambda[4];
    } kRows[] = {
        {0.05f, {0.999883857004, 0.999660942803, 0.999344792271, 0.998947243679}},
        {0.1f, {0.998693503699, 0.996229938117, 0.992824773157, 0.988665743355}},
        {0.25f, {0.976092604298, 0.933738270618, 0.880606983182, 0.822958863625}},
        {0.5f, {0.867395662812, 0.662405687279, 0.460387585347, 0.305538297757}},
        {0.75f, {0.745131342455, 0.398824737791, 0.140121157544, 0.0289846076205}},
        {1.0f, {0.666666666667, 0.25, 0.0, -0.0416666666667}},
    };
    const auto legendre = [](double x, int l) {
        const double x2 = x * x;
        return l == 1   ? x
               : l == 2 ? 0.5 * (3.0 * x2 - 1.0)
               : l == 3 ? 0.5 * x * (5.0 * x2 - 3.0)
                        : 0.125 * ((35.0 * x2 - 30.0) * x2 + 3.0);
    };
    const glm::dvec3 axis = glm::normalize(glm::dvec3(0.3, -0.5, 0.8));
    const auto band = [&](glm::vec3 d, int l) {
        return legendre(glm::dot(glm::dvec3(d), axis), l);
    };
    const CubePyramid odd(
        cubeOf(128, [&](glm::vec3 d) { return glm::vec3(1.0, 2.0 + band(d, 1), band(d, 3)); }));
    const CubePyramid even(
        cubeOf(128, [&](glm::vec3 d) { return glm::vec3(0.0, band(d, 2), band(d, 4)); }));
    for (const auto& row : kRows) {
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
    // K(t) = D(t / 2) cos t / (4 W): response at angle t from R to unit integrated radiance.
    constexpr float kAngleDeg[8] = {0, 5, 10, 20, 30, 45, 60, 80};
    constexpr double kKernel[5][8] = {
        {797.053020629, 1.98017439223, 0.13255018851, 0.00818470273818, 0.00153399510852,
         0.0002624868001, 6.37260003148e-05, 8.10520679947e-06},
        {21.0957001062, 9.52757393885, 2.40843045642, 0.262555479877, 0.0558782922431,
         0.010145809629, 0.00251584801732, 0.000323823737212},
        {1.67025672741, 1.57284266925, 1.32559130272, 0.744137473127, 0.359888235795,
         0.115575213166, 0.0370139994995, 0.005598521862},
        {0.534055233168, 0.527675877133, 0.509094726092, 0.442336735447, 0.352950647382,
         0.217920161614, 0.11257581728, 0.0258886473299},
        {0.318309886184, 0.317098620966, 0.313474043774, 0.29911345117, 0.275664447711,
         0.225079079039, 0.159154943092, 0.0552739316692}};
    // A lamp of one texel next to the middle of +X.
    constexpr int kSize = 256, kOut = 128;
    CubeLevel base = cubeOf(kSize, [](glm::vec3) { return glm::vec3(0.0f); });
    const std::size_t lamp = kSize / 2 * kSize + kSize / 2;
    base.texels[lamp] = glm::vec3(1e5f);
    const double flux = 1e5 * cubeSolidAngles(kSize)[lamp];
    const glm::dvec3 lampDirection(texelDirection(kSize, lamp));
    const CubePyramid pyramid(base);
    for (int r = 0; r < 5; ++r) {
        const double alpha2 = std::pow(kRoughness[r], 4.0);
        const CubeLevel out = prefilterGGX(pyramid, kOut, kRoughness[r] * kRoughness[r], {}, {});
        for (int k = 0; k < 8; ++k) {
            // The texel whose angle is closest, and from there by the ratio of the lobe's values.
            const double wanted = glm::radians(static_cast<double>(kAngleDeg[k]));
            double angle = 1e9, value = 0.0;
            for (std::size_t i = 0; i < out.texels.size(); ++i) {
                const glm::dvec3 d = lampDirection - glm::dvec3(texelDirection(kOut, i));
                const double t = 2.0 * std::asin(std::min(0.5 * glm::length(d), 1.0));
                if (std::abs(t - wanted) < std::abs(angle - wanted)) {
                    angle = t;
                    value = out.texels[i].x;
                }
            }
            const double expected =
                kKernel[r][k] * lobe(std::cos(angle), alpha2) / lobe(std::cos(wanted), alpha2);
            EXPECT_NEAR(value / (flux * expected), 1.0, 1e-4)
                << "roughness " << kRoughness[r] << " at " << kAngleDeg[k] << " degrees";
        }
    }
}

TEST(Prefilter, DiscLightsLookedAtDirectly) {
    // Fraction of the kernel inside a disc of half-angle 0.2666° (the Sun), 2.5° and 10°; r = 0.1,
    // 0.25, 0.5, 0.75, 1. Texels of width w, each a point of light at its centre, make the peak of
    // a lobe w² / (12 alpha²) too high: at r = 0.1 by 5 % where 256 texels are a right angle, by
    // 0.08 % where 1024 are and the disc lies near a corner of the cube.
    constexpr struct {
        double halfAngleDeg;
        double fraction[5];
    } kDiscs[] = {
        {0.2666,
         {0.0514302096453, 0.00143290266601, 0.000113597751254, 3.63247689137e-05,
          2.16506974444e-05}},
        {2.5,
         {0.827566121667, 0.112452461214, 0.0099129653364, 0.00318895909711, 0.00190265095413}},
        {10.0, {0.988017070715, 0.68222336265, 0.142079213488, 0.0497765768298, 0.030153689607}}};
    // Each disc stands on a texel of the output; a texel it covers in part has that share.
    constexpr int kSize = 1024, kOut = 64, kParts = 16;
    const std::size_t texel = (4u * kOut + 61) * kOut + 61;
    const glm::vec3 towards = texelDirection(kOut, texel);
    const std::vector<float> omega = cubeSolidAngles(kSize);
    for (const auto& disc : kDiscs) {
        const auto edge = static_cast<float>(2.0 * std::sin(glm::radians(disc.halfAngleDeg) / 2.0));
        CubeLevel base{kSize, std::vector<glm::vec3>(6u * kSize * kSize, glm::vec3(0.0f))};
        double flux = 0.0;
        for (std::size_t i = 0; i < base.texels.size(); ++i) {
            if (i % 64 == 0 && glm::length(texelDirection(kSize, i) - towards) > edge + 0.15f) {
                i += 63; // none of a row of 64 is near
                continue;
            }
            const float distance = glm::length(texelDirection(kSize, i) - towards);
            if (distance > edge + 0.002f)
                continue;
            int inside = 0;
            for (int k = 0; k < kParts * kParts && distance > edge - 0.002f; ++k) {
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
            const float share =
                distance > edge - 0.002f ? static_cast<float>(inside) / (kParts * kParts) : 1.0f;
            base.texels[i] = glm::vec3(share);
            flux += static_cast<double>(share) * omega[i % omega.size()];
        }
        // Its flux exactly: the parts of a texel count too coarsely for the Sun.
        const double half = std::sin(glm::radians(disc.halfAngleDeg) / 2.0);
        for (glm::vec3& value : base.texels)
            value *= static_cast<float>(4.0 * M_PI * half * half / flux);
        const CubePyramid pyramid(base);
        for (int r = 0; r < 5; ++r) {
            const CubeLevel out =
                prefilterGGX(pyramid, kOut, kRoughness[r] * kRoughness[r], {}, {});
            EXPECT_NEAR(out.texels[texel].x / disc.fraction[r], 1.0, 1e-3)
                << disc.halfAngleDeg << " degrees, " << kRoughness[r];
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
    std::vector<int> column, row;
    std::vector<CubePyramid::Lamp> lamps;
    for (std::uint32_t i = 0; i < 50; ++i) {
        cells.emplace_back(uniformSphere(sobolOwen2D(i, 4)), 1e-3f * static_cast<float>(i + 1));
        radiance.emplace_back(static_cast<float>(i), 1.0f, 0.1f * static_cast<float>(50 - i), 0.0f);
        column.push_back(static_cast<int>((i * 7) % 10));
        row.push_back(static_cast<int>(i % 5));
        lamps.push_back({uniformSphere(sobolOwen2D(i, 5)), glm::vec3(radiance[i])});
    }
    constexpr float kSpread = 1.0f / 32.0f;
    const auto compute = [&](const detail::PrefilterSums& arithmetic) {
        auto weights = std::make_unique<detail::CellWeights>();
        detail::TileSums sums;
        std::vector<float> result(detail::kTileTexels, 0.0f);
        arithmetic.weigh(tile, cells, kSpread, 0.04f, *weights, result.data());
        arithmetic.add(*weights, {column, row, 40, 1, -10}, radiance.data(), sums);
        arithmetic.addLamps(tile, lamps, 0.04f, sums);
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
            light +=
                lobe(glm::dot(n, glm::dvec3(lamps[k].direction)), 0.04) * glm::dvec3(lamps[k].flux);
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
