#include "core/compare/FitImage.h"

#include "Pictures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <utility>

using namespace patina;
using patina::test::codes;
using patina::test::floats;
using testing::ElementsAre;
using testing::FloatNear;

namespace {

std::span<const float> samples(const Image& image) {
    return image.f32();
}

} // namespace

TEST(FitImage, OfItsOwnSizeIsTheImage) {
    const Image image = codes(2, 2, 3, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
    EXPECT_EQ(fitImage(image, 2, 2), image);
}

TEST(FitImage, AveragesWhatEachPixelCovers) {
    const Image image = floats(3, 2, 1, {1, 2, 6, 3, 4, 8});
    EXPECT_THAT(samples(fitImage(image, 1, 1)), ElementsAre(FloatNear(4.0f, 1e-6f)));
    // 1.5 pixels each.
    EXPECT_THAT(samples(fitImage(floats(3, 1, 1, {1, 4, 7}), 2, 1)),
                ElementsAre(FloatNear(2.0f, 1e-6f), FloatNear(6.0f, 1e-6f)));
}

TEST(FitImage, InterpolatesBetweenCentres) {
    EXPECT_THAT(samples(fitImage(floats(2, 1, 1, {0, 4}), 4, 1)), ElementsAre(0, 1, 3, 4));
    // One side becomes shorter, the other longer.
    EXPECT_THAT(samples(fitImage(floats(2, 2, 1, {0, 2, 4, 6}), 1, 4)), ElementsAre(1, 2, 4, 5));
    EXPECT_THAT(samples(fitImage(floats(1, 1, 2, {5, 0.5f}), 2, 1)), ElementsAre(5, 0.5f, 5, 0.5f));
}

TEST(FitImage, WorksInLinearLightAndKeepsTheEncoding) {
    const Image fitted = fitImage(codes(2, 1, 1, {0, 255}), 1, 1);
    EXPECT_EQ(fitted.encoding(), ColorEncoding::Srgb);
    EXPECT_NEAR(fitted.linear(0, 0).x, 0.5f, 1e-6f);
    EXPECT_NEAR(samples(fitted)[0], 0.735357f, 1e-5f); // sRGB of a half
}
