#include "core/image/ColorMap.h"

#include "core/image/Srgb.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

using namespace patina;

namespace {

// CIE lightness of a displayed colour, 0…100.
float lightness(const glm::vec3& shown) {
    const float y = 0.2126f * srgbToLinear(shown.x) + 0.7152f * srgbToLinear(shown.y) +
                    0.0722f * srgbToLinear(shown.z);
    return y > 0.008856f ? 116.0f * std::cbrt(y) - 16.0f : 903.3f * y;
}

TEST(ColorMap, SequentialGrowsEvenlyInLightness) {
    constexpr int kSteps = 32;
    const float first = lightness(mapColor(ColorMap::Sequential, 0.0f));
    const float last = lightness(mapColor(ColorMap::Sequential, 1.0f));
    EXPECT_LT(first, 25.0f);
    EXPECT_GT(last, 85.0f);
    const float even = (last - first) / kSteps;
    for (int i = 0; i < kSteps; ++i) {
        const float step =
            lightness(mapColor(ColorMap::Sequential, static_cast<float>(i + 1) / kSteps)) -
            lightness(mapColor(ColorMap::Sequential, static_cast<float>(i) / kSteps));
        EXPECT_GT(step, 0.4f * even) << i;
        EXPECT_LT(step, 1.8f * even) << i;
    }
}

TEST(ColorMap, DivergingIsLightestInTheMiddleAndAlikeOnBothSides) {
    EXPECT_GT(lightness(mapColor(ColorMap::Diverging, 0.5f)), 90.0f);
    for (const float away : {0.1f, 0.25f, 0.5f}) {
        const glm::vec3 below = mapColor(ColorMap::Diverging, 0.5f - away);
        const glm::vec3 above = mapColor(ColorMap::Diverging, 0.5f + away);
        EXPECT_NEAR(lightness(below), lightness(above), 4.0f);
        EXPECT_GT(below.z, below.x); // blue
        EXPECT_GT(above.x, above.z); // orange
    }
}

// Entries 0, 128 and 255 of the table that matplotlib has published as magma.
TEST(ColorMap, MagmaIsTheOneThatFlipIsShownIn) {
    const auto codes = [](float t) { return mapColor(ColorMap::Magma, t) * 255.0f; };
    const auto expectNear = [](const glm::vec3& color, const glm::vec3& expected) {
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(color[c], expected[c], 1e-3f) << c;
    };
    expectNear(codes(0.0f), {0, 0, 4});
    expectNear(codes(128.0f / 255.0f), {183, 55, 121});
    expectNear(codes(1.0f), {252, 253, 191});
    for (int i = 0; i < 255; ++i)
        EXPECT_LT(lightness(mapColor(ColorMap::Magma, static_cast<float>(i) / 255.0f)),
                  lightness(mapColor(ColorMap::Magma, static_cast<float>(i + 1) / 255.0f)))
            << i;
}

TEST(ColorMap, WhatIsOutsideTakesTheEnds) {
    for (const ColorMap map :
         {ColorMap::Grey, ColorMap::Sequential, ColorMap::Diverging, ColorMap::Magma}) {
        EXPECT_EQ(mapColor(map, -3.0f), mapColor(map, 0.0f));
        EXPECT_EQ(mapColor(map, 7.0f), mapColor(map, 1.0f));
        EXPECT_EQ(mapColor(map, std::numeric_limits<float>::quiet_NaN()), mapColor(map, 0.0f));
    }
}

} // namespace
