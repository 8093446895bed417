// What the first bands of harmonics hold of an environment, against closed forms.
#include "core/light/ShBands.h"

#include "core/math/Shading.h"
#include "tests/core/light/LatLongPicture.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace patina {
namespace {

TEST(ShBands, AConstantNeedsOneBandAtAnySize) {
    for (const glm::ivec2 size : {glm::ivec2(1, 1), {2, 1}, {3, 5}, {64, 32}}) {
        const ShBands bands = computeShBands(test::latLongImage(
            size.x, size.y, [](const glm::vec3&) { return glm::vec3(1.0f, 2.0f, 0.5f); }));
        EXPECT_NEAR(bands.rms, std::sqrt((1.0 + 4.0 + 0.25) / 3.0), 1e-6);
        for (const ShBandSum& sum : bands.sums) {
            EXPECT_LT(sum.rmse, 1e-5) << size.x;
            EXPECT_NEAR(sum.lowest, 0.5f, 1e-5f) << size.x;
        }
        EXPECT_LT(glm::distance(shSum(bands.coefficients, 8, {0.6f, 0.0f, 0.8f}),
                                glm::vec3(1.0f, 2.0f, 0.5f)),
                  1e-5f);
    }
}

TEST(ShBands, ACosineNeedsTwo) {
    // L_c = 2 + a_c · d: the first band leaves |a_c|² / 3 of each channel, the second nothing.
    const glm::vec3 a(0.5f, -1.0f, 0.25f);
    const Image image = test::latLongImage(
        256, 128,
        [&](const glm::vec3& d) {
            return glm::vec3(2.0f + glm::dot(a, d), 2.0f, 2.0f + 2.0f * glm::dot(a, d));
        },
        4);
    const ShBands bands = computeShBands(image);
    const double a2 = static_cast<double>(glm::dot(a, a));
    EXPECT_NEAR(bands.sums[0].rmse, std::sqrt(a2 * (1.0 + 4.0) / 9.0), 1e-4);
    EXPECT_NEAR(bands.sums[0].lowest, 2.0f, 1e-4f);
    for (std::size_t n = 2; n <= 8; ++n) {
        const ShBandSum& sum = bands.sums[n - 1];
        EXPECT_LT(sum.rmse, 2e-4) << n;
        // Blue is lowest, opposite to a.
        EXPECT_NEAR(sum.lowest, 2.0f - 2.0f * glm::length(a), 1e-3f) << n;
        EXPECT_GT(glm::dot(sum.lowestDirection, -glm::normalize(a)), 0.999f) << n;
    }
}

// Parseval: what a band holds is what its sum comes closer by.
TEST(ShBands, EnergiesOfTheBandsAddUpToTheEnvironment) {
    const ShBands bands = computeShBands(test::latLongImage(512, 256, [](const glm::vec3& d) {
        return glm::vec3(d.x > 0.2f ? 3.0f : 0.5f, 1.0f, 2.0f + d.y * d.z);
    }));
    double held = 0.0;
    for (int l = 0; l < kMaxShOrder; ++l) {
        held += bandEnergy(bands.coefficients, l);
        const double rmse = bands.sums[static_cast<std::size_t>(l)].rmse;
        EXPECT_NEAR(held + rmse * rmse, bands.rms * bands.rms, 1e-3 * bands.rms * bands.rms) << l;
    }
    // Means of 1.5, 1 and 2: a cap beyond x = 0.2 is 0.4 of the sphere.
    EXPECT_NEAR(bandEnergy(bands.coefficients, 0), (1.5 * 1.5 + 1.0 + 4.0) / 3.0, 1e-2);
}

TEST(ShBands, HalfASphereByItsClosedForm) {
    // L = 1 above the horizon: bands hold pi, 3pi/4, 0, 7pi/64, 0, 11pi/256 … of its energy 2pi,
    // because ∫_0^1 P_l = 1/2, 1/2, 0, -1/8, 0, 1/16, 0, -5/128 and c_l² = pi (2l+1) (∫ P_l)².
    const ShBands bands = computeShBands(test::latLongImage(
        512, 256, [](const glm::vec3& d) { return glm::vec3(d.y > 0.0f ? 1.0f : 0.0f); }));
    constexpr double kLegendre[8] = {1.0, 0.5, 0.0, -0.125, 0.0, 0.0625, 0.0, -5.0 / 128.0};
    double left = 2.0; // of ∫ L² / pi
    for (std::size_t l = 0; l < 8; ++l) {
        const double share =
            l == 0 ? 1.0 : (2.0 * static_cast<double>(l) + 1.0) * kLegendre[l] * kLegendre[l];
        left -= share;
        EXPECT_NEAR(bands.sums[l].rmse, std::sqrt(left / 4.0), 2e-4) << l;
    }
    // Two bands: 1/2 + 3/4 y. Four: 1/2 + 45/32 y - 35/32 y³, lowest at y² = 3/7.
    EXPECT_NEAR(bands.sums[1].lowest, -0.25f, 1e-3f);
    EXPECT_LT(bands.sums[1].lowestDirection.y, -0.999f);
    EXPECT_NEAR(bands.sums[3].lowest, -0.113737f, 1e-3f);
    EXPECT_NEAR(bands.sums[3].lowestDirection.y, -std::sqrt(3.0f / 7.0f), 0.015f);
}

TEST(ShBands, EveryBasisFunctionAppearsWithItsBand) {
    std::array<double, 64> basis{};
    for (int i = 0; i < 64; ++i) {
        const int l = static_cast<int>(std::sqrt(static_cast<double>(i)));
        const Image image = test::latLongImage(128, 64, [&](const glm::vec3& d) {
            evaluateSh(8, glm::dvec3(d), basis);
            return glm::vec3(static_cast<float>(basis[static_cast<std::size_t>(i)]));
        });
        const ShBands bands = computeShBands(image);
        const double whole = 0.282094791774; // sqrt(1 / 4pi), of any of them
        EXPECT_NEAR(bands.rms, whole, 1e-3) << i;
        for (int n = 1; n <= 8; ++n)
            EXPECT_NEAR(bands.sums[static_cast<std::size_t>(n - 1)].rmse, n > l ? 0.0 : whole, 2e-3)
                << i << " with " << n;
    }
}

TEST(ShBands, PicturesAreTheSumsAtTheirPixels) {
    std::vector<glm::vec3> coefficients;
    for (int i = 0; i < 64; ++i)
        coefficients.emplace_back(std::sin(1.0f + static_cast<float>(i)),
                                  std::cos(2.0f * static_cast<float>(i)), 0.1f);
    for (const int order : {1, 3, 8}) {
        const Image picture = shLatLong(coefficients, order, 9);
        ASSERT_EQ(picture.width(), 18);
        for (int y = 0; y < 9; ++y)
            for (int x = 0; x < 18; ++x) {
                const glm::vec3 sum =
                    shSum(coefficients, order,
                          shading::directionFromLatLong({(static_cast<float>(x) + 0.5f) / 18.0f,
                                                         (static_cast<float>(y) + 0.5f) / 9.0f}));
                for (int c = 0; c < 3; ++c)
                    ASSERT_NEAR(picture.sample(x, y, c), sum[c], 2e-5f) << x << " " << y;
            }
    }
}

TEST(ShBands, PicturesOfSingleBandsAddUp) {
    std::vector<glm::vec3> coefficients;
    for (int i = 0; i < 36; ++i)
        coefficients.emplace_back(std::sin(1.0f + static_cast<float>(i)), 0.5f, 0.1f);
    constexpr std::size_t kValues = 18 * 9 * 3;
    for (int l = 0; l < 6; ++l) {
        const Image band = shBandLatLong(coefficients, l, 9);
        const Image before = l == 0 ? band : shLatLong(coefficients, l, 9);
        const Image after = shLatLong(coefficients, l + 1, 9);
        for (std::size_t i = 0; i < kValues; ++i)
            ASSERT_NEAR(band.f32()[i], after.f32()[i] - (l == 0 ? 0.0f : before.f32()[i]), 2e-5f)
                << l;
    }
}

} // namespace
} // namespace patina
