#include "core/image/Srgb.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace patina {
namespace {

// Values of IEC 61966-2-1 computed in double precision: ((e + 0.055) / 1.055)^2.4 and e / 12.92.
TEST(Srgb, KnownValues) {
    EXPECT_FLOAT_EQ(srgbToLinear(0.5f), 0.21404114f);
    EXPECT_FLOAT_EQ(srgbToLinear(0.04f), 0.04f / 12.92f);
    EXPECT_FLOAT_EQ(linearToSrgb(0.18f), 0.46135613f);
    EXPECT_FLOAT_EQ(linearToSrgb(0.002f), 0.02584f);
    EXPECT_EQ(srgbToLinear(0.0f), 0.0f);
    EXPECT_FLOAT_EQ(srgbToLinear(1.0f), 1.0f);
    EXPECT_FLOAT_EQ(linearToSrgb(1.0f), 1.0f);
}

TEST(Srgb, CurvesAreInverseAndOdd) {
    for (float x = 0.0f; x < 4.0f; x += 0.013f) {
        EXPECT_NEAR(srgbToLinear(linearToSrgb(x)), x, 1e-6f * std::max(1.0f, x)) << x;
        EXPECT_EQ(linearToSrgb(-x), -linearToSrgb(x));
        EXPECT_EQ(srgbToLinear(-x), -srgbToLinear(x));
    }
}

TEST(Srgb, TablesHoldTheCurve) {
    EXPECT_FLOAT_EQ(srgbTable8()[188], srgbToLinear(188.0f / 255.0f));
    EXPECT_FLOAT_EQ(srgbTable16()[32768], srgbToLinear(32768.0f / 65535.0f));
    EXPECT_EQ(srgbTable8()[255], 1.0f);
    EXPECT_EQ(srgbTable16()[65535], 1.0f);
}

TEST(Srgb, EightBitCodesRoundTrip) {
    for (int k = 0; k < 256; ++k)
        EXPECT_EQ(linearToSrgb8(srgbTable8()[static_cast<std::size_t>(k)]), k);
}

TEST(Srgb, QuickEncodingRoundsLikeThePower) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> exponent(-6.0, 0.1);
    for (int i = 0; i < 200000; ++i) {
        const double linear = std::pow(10.0, exponent(random));
        const double encoded =
            linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
        const double code = std::min(encoded, 1.0) * 255.0;
        const int quick = linearToSrgb8(static_cast<float>(linear));
        // Nearest code, give or take the rounding of the threshold to float.
        ASSERT_LE(std::abs(quick - code), 0.5 + 1e-4) << linear;
    }
}

TEST(Srgb, QuickEncodingTakesEverything) {
    EXPECT_EQ(linearToSrgb8(-1.0f), 0);
    EXPECT_EQ(linearToSrgb8(std::numeric_limits<float>::quiet_NaN()), 0);
    EXPECT_EQ(linearToSrgb8(std::numeric_limits<float>::infinity()), 255);
    EXPECT_EQ(linearToSrgb8(std::nextafter(1.0f, 0.0f)), 255);
    EXPECT_EQ(linearToSrgb8(std::numeric_limits<float>::denorm_min()), 0);
}

} // namespace
} // namespace patina
