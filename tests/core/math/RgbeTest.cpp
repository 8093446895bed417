// Shared exponents: Radiance's color.c and B. Walter's rgbe.c, byte by byte.
#include "core/math/Shading.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace patina {
namespace {

using glm::vec3;
using glm::vec4;
using shading::rgbeDecode;
using shading::rgbeEncode;

struct Example {
    vec3 color;
    vec4 bytes;
    vec3 decoded; // without the half step that Radiance's own colr_color() adds
};

const Example kExamples[] = {
    {{1, 1, 1}, {128, 128, 128, 129}, {1, 1, 1}},
    {{0.5f, 0.5f, 0.5f}, {128, 128, 128, 128}, {0.5f, 0.5f, 0.5f}},
    {{1, 0.5f, 0.25f}, {128, 64, 32, 129}, {1, 0.5f, 0.25f}},
    {{0.9999f, 0.9999f, 0.9999f}, {255, 255, 255, 128}, {0.99609375f, 0.99609375f, 0.99609375f}},
    {{0.99609375f, 0, 0}, {255, 0, 0, 128}, {0.99609375f, 0, 0}},
    {{100, 0.1f, 1e-5f}, {200, 0, 0, 135}, {100, 0, 0}},
    {{0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0}},
    {{-1, 2, 0.5f}, {0, 128, 32, 130}, {0, 2, 0.5f}},
    {{-1, -2, -3}, {0, 0, 0, 0}, {0, 0, 0}},
    {{1e-32f, 0, 0}, {0, 0, 0, 0}, {0, 0, 0}},
    {{1.1e-32f, 0, 0}, {228, 0, 0, 22}, {1.09778007e-32f, 0, 0}},
    {{1e-40f, 0, 0}, {0, 0, 0, 0}, {0, 0, 0}},
    {{1.6e38f, 1, 1}, {240, 0, 0, 255}, {1.59507359e38f, 0, 0}},
    {{65504, 65504, 65504}, {255, 255, 255, 144}, {65280, 65280, 65280}},
    {{0.18f, 0.18f, 0.18f}, {184, 184, 184, 126}, {0.1796875f, 0.1796875f, 0.1796875f}},
    {{3, 2, 1}, {192, 128, 64, 130}, {3, 2, 1}},
};

TEST(Rgbe, BytesAndNumbersAreThoseOfTheFormat) {
    for (const Example& e : kExamples) {
        EXPECT_EQ(rgbeEncode(e.color), e.bytes)
            << e.color.x << " " << e.color.y << " " << e.color.z;
        const vec3 back = rgbeDecode(e.bytes);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(back[c], e.decoded[c], 1e-6f * e.decoded[c]) << e.bytes[c];
    }
}

TEST(Rgbe, TheLargestExponentDoesNotWrap) {
    constexpr float kLargest = 1.69476569463e38f; // 255 · 2^119
    const float inf = std::numeric_limits<float>::infinity();
    for (const float huge : {1.7014118346e38f, 3.4e38f, inf}) { // 2^127 and beyond
        EXPECT_EQ(rgbeEncode({huge, 0, 0}), vec4(255, 0, 0, 255));
        EXPECT_EQ(rgbeEncode({1, huge, huge}), vec4(0, 255, 255, 255));
    }
    EXPECT_NEAR(rgbeDecode({255, 255, 255, 255}).y / kLargest, 1.0f, 1e-7f);
    EXPECT_NEAR(rgbeDecode({1, 0, 0, 1}).x, 2.2958874e-41f, 1e-45f);
    // An exponent of 0 is black, whatever the mantissas say.
    EXPECT_EQ(rgbeDecode({200, 100, 50, 0}), vec3(0));
}

TEST(Rgbe, NumbersThatAreNoneAreBlack) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(rgbeEncode({nan, nan, nan}), vec4(0));
    EXPECT_EQ(rgbeEncode({nan, 1, -std::numeric_limits<float>::infinity()}), vec4(0, 128, 0, 129));
}

// Truncation loses up to 1/128 of the largest component, never gains; what was decoded is exact.
TEST(Rgbe, ErrorIsOneStepAtMostAndSecondTimesLoseNothing) {
    for (int i = 0; i < 20000; ++i) {
        const float x = std::exp2(static_cast<float>(i) * 0.01f - 100.0f);
        const vec3 color(x, 0.3f * x, 0.77f * x);
        const vec3 once = rgbeDecode(rgbeEncode(color));
        ASSERT_LE(once.x, x);
        ASSERT_GT(once.x, x * (1.0f - 0.0078126f));
        ASSERT_LE(once.z, color.z);
        ASSERT_GT(once.z, color.z - x * 0.0078126f);
        ASSERT_EQ(rgbeDecode(rgbeEncode(once)), once);
    }
}

} // namespace
} // namespace patina
