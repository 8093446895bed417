#include "core/image/Rgbd.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

using namespace patina;
using Code = std::array<std::uint8_t, 4>;

TEST(Rgbd, KnownCodes) {
    EXPECT_EQ(rgbdFromColor({1, 1, 1}), (Code{255, 255, 255, 255}));
    EXPECT_EQ(rgbdFromColor({0, 0, 0}), (Code{0, 0, 0, 255}));
    EXPECT_EQ(rgbdFromColor({255, 0, 0}), (Code{255, 0, 0, 1}));
    EXPECT_EQ(rgbdFromColor({2, 0.5f, 0}), (Code{255, 136, 0, 127})); // (0.5 · 127 / 255)^(1 / 2.2)
    // 0.5^(1/2.2) = 0.7297
    EXPECT_EQ(rgbdFromColor({0.5f, 0.5f, 0.5f}), (Code{186, 186, 186, 255}));
}

TEST(Rgbd, ClampsWhatItCannotHold) {
    EXPECT_EQ(rgbdFromColor({1e9f, -1, NAN}), (Code{255, 0, 0, 1}));
    EXPECT_EQ(rgbdFromColor({INFINITY, 255, 0}), (Code{255, 255, 0, 1}));
    EXPECT_EQ(colorFromRgbd({255, 0, 0, 0}), colorFromRgbd({255, 0, 0, 1})); // no division by 0
}

// Rounding is off by at most half a code: 2.2 / 510 · x^(-1/2.2) of the value x below 1.
TEST(Rgbd, TheBrightestComponentComesBack) {
    for (float value = 0.2f; value < 255.0f; value *= 1.013f) {
        const glm::vec3 back = colorFromRgbd(rgbdFromColor({0.3f * value, value, 0.0f}));
        EXPECT_NEAR(back.y, value, 0.009f * value) << value;
        EXPECT_NEAR(back.x, 0.3f * value, 0.016f * 0.3f * value) << value;
    }
    for (const float value : {0.001f, 0.01f, 0.1f})
        EXPECT_NEAR(colorFromRgbd(rgbdFromColor({value, 0, 0})).x, value,
                    2.2f / 510.0f * std::pow(value, 1.0f - 1.0f / 2.2f) * 1.01f);
}
