#include "core/compare/Metrics.h"

#include "Pictures.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

using namespace patina;
using patina::test::codes;
using patina::test::floats;

TEST(Compare, EqualImagesHaveNoDistance) {
    const Image image = codes(2, 1, 3, {0, 10, 255, 7, 8, 9});
    const Result<ImageMetrics> metrics = compareImages(image, image);
    ASSERT_TRUE(metrics.ok());
    EXPECT_EQ(metrics->rmse, 0.0);
    EXPECT_EQ(metrics->relMse, 0.0);
    EXPECT_EQ(metrics->max, 0.0);
    EXPECT_EQ(metrics->samples, 6u);
    EXPECT_EQ(metrics->different, 0u);
    EXPECT_TRUE(std::isinf(metrics->psnr) && metrics->psnr > 0);
}

// Two pixels, four samples differ by 0.5, 0, 0.25 … so every number can be computed by hand.
TEST(Compare, GivesTheNumbersOfItsDefinitions) {
    const Image image = floats(2, 1, 3, {0.5f, 0.0f, 1.0f, 0.0f, 0.75f, 2.0f});
    const Image reference = floats(2, 1, 3, {0.0f, 0.0f, 1.0f, 0.0f, 0.5f, 1.0f});
    const Result<ImageMetrics> metrics = compareImages(image, reference);
    ASSERT_TRUE(metrics.ok());
    const double squares = 0.25 + 0.0625 + 1.0;
    EXPECT_DOUBLE_EQ(metrics->rmse, std::sqrt(squares / 6));
    EXPECT_DOUBLE_EQ(metrics->psnr, 10 * std::log10(6 / squares));
    EXPECT_DOUBLE_EQ(metrics->relMse, (0.25 / 0.01 + 0.0625 / 0.26 + 1.0 / 1.01) / 6);
    EXPECT_EQ(metrics->max, 1.0);
    EXPECT_EQ(metrics->maxPosition, (PixelPosition{1, 0}));
    EXPECT_EQ(metrics->different, 3u);
    // The reference weighs relative errors: exchanged, the number is another one.
    EXPECT_NE(compareImages(reference, image)->relMse, metrics->relMse);
    EXPECT_EQ(compareImages(reference, image)->rmse, metrics->rmse);
}

TEST(Compare, CodeValuesAreComparedAsStored) {
    const Result<ImageMetrics> metrics =
        compareImages(codes(1, 1, 3, {255, 100, 0}), codes(1, 1, 3, {0, 100, 0}));
    EXPECT_NEAR(metrics->rmse, std::sqrt(1.0 / 3), 1e-12);
    EXPECT_NEAR(compareImages(codes(1, 1, 1, {51}), codes(1, 1, 1, {0}))->max, 0.2, 1e-7);
}

TEST(Compare, DifferentEncodingsMeetInLinearLight) {
    // sRGB 188 is 0.502886 in linear light (IEC 61966-2-1).
    const Result<ImageMetrics> metrics = compareImages(
        codes(1, 1, 3, {188, 188, 188}), floats(1, 1, 3, {0.502886f, 0.502886f, 0.502886f}));
    EXPECT_LT(metrics->max, 1e-5);
}

TEST(Compare, GreyStandsForEqualChannelsAndMissingAlphaForOne) {
    const Image rgb = codes(1, 1, 3, {9, 9, 9});
    EXPECT_EQ(compareImages(codes(1, 1, 1, {9}), rgb)->max, 0.0);
    const Result<ImageMetrics> opaque = compareImages(rgb, codes(1, 1, 4, {9, 9, 9, 255}));
    EXPECT_EQ(opaque->max, 0.0);
    EXPECT_EQ(opaque->samples, 4u);
    EXPECT_EQ(compareImages(rgb, codes(1, 1, 4, {9, 9, 9, 0}))->max, 1.0);
    EXPECT_EQ(compareImages(codes(1, 1, 2, {9, 0}), codes(1, 1, 4, {9, 9, 9, 0}))->max, 0.0);
}

TEST(Compare, ImagesOfManyChannelsAreComparedChannelByChannel) {
    const Image a = floats(1, 1, 6, {1, 2, 3, 4, 5, 6}), b = floats(1, 1, 6, {1, 2, 3, 4, 5, 4});
    EXPECT_EQ(compareImages(a, b)->max, 2.0);
    EXPECT_EQ(compareImages(a, b)->samples, 6u);
    EXPECT_EQ(compareImages(a, floats(1, 1, 3, {1, 2, 3})).error().kind, ErrorKind::Usage);
}

TEST(Compare, RefusesOtherSizesAndInvalidNumbers) {
    const Image a = floats(2, 1, 1, {0, 0});
    EXPECT_EQ(compareImages(a, floats(1, 2, 1, {0, 0})).error().kind, ErrorKind::Usage);
    EXPECT_EQ(compareImages(Image(), Image()).error().kind, ErrorKind::Usage);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(compareImages(a, floats(2, 1, 1, {0, nan})).error().kind, ErrorKind::InputBroken);
    EXPECT_EQ(
        compareImages(floats(2, 1, 1, {std::numeric_limits<float>::infinity(), 0}), a).error().kind,
        ErrorKind::InputBroken);
}

TEST(Compare, DifferenceImageShowsWhere) {
    const Result<Image> difference =
        differenceImage(codes(2, 1, 3, {255, 0, 0, 1, 2, 3}), codes(2, 1, 3, {0, 51, 0, 1, 2, 3}));
    ASSERT_TRUE(difference.ok());
    const std::span<const float> d = std::as_const(*difference).f32();
    const float expected[] = {1.0f, 0.2f, 0, 0, 0, 0};
    for (int i = 0; i < 6; ++i)
        EXPECT_NEAR(d[i], expected[i], 1e-6f);
    EXPECT_EQ(differenceImage(codes(1, 1, 1, {9}), codes(1, 1, 3, {9, 9, 60}))->f32()[2], 0.2f);
}
