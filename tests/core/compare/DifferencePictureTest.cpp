#include "core/compare/DifferencePicture.h"

#include "Pictures.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <utility>

using namespace patina;
using patina::test::floats;
using testing::ElementsAre;

TEST(DifferencePicture, SpansTheColourScale) {
    const Image values = floats(5, 1, 1, {-9.0f, -2.0f, 0.0f, 2.0f, 9.0f});
    const Image picture = colorErrors(values, ColorMap::Diverging, -2.0f, 2.0f);
    EXPECT_EQ(picture.encoding(), ColorEncoding::Srgb);
    for (int x = 0; x < 5; ++x) {
        const glm::vec3 expected =
            mapColor(ColorMap::Diverging, (values.sample(x, 0, 0) + 2.0f) / 4.0f);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(picture.sample(x, 0, c), expected[c], 0.5f / 255.0f + 1e-6f);
    }
    EXPECT_EQ(picture.sample(0, 0, 0), picture.sample(1, 0, 0)); // what lies beyond
}

TEST(DifferencePicture, ShowsFlipInMagma) {
    const Image picture =
        colorErrors(floats(3, 1, 1, {0.0f, 128.0f / 255.0f, 1.0f}), ColorMap::Magma, 0.0f, 1.0f);
    EXPECT_THAT(picture.u8(), ElementsAre(0, 0, 4, 183, 55, 121, 252, 253, 191));
}

TEST(DifferencePicture, LeavesOutWhatNobodyNotices) {
    Image values = floats(3, 1, 1, {-5.0f, 3.0f, 2.0f});
    hideInvisible(values, floats(3, 1, 1, {0.1f, 0.2f, 0.05f}), 0.1f);
    EXPECT_THAT(std::as_const(values).f32(), ElementsAre(-5.0f, 3.0f, 0.0f));
}
