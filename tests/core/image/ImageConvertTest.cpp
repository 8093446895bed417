#include "core/image/Image.h"

#include "core/image/Srgb.h"

#include <gtest/gtest.h>
#include <limits>
#include <numeric>

namespace patina {
namespace {

TEST(ConvertImage, EightBitsSurviveEveryDetour) {
    Image image(256, 1, 1, PixelType::U8, ColorEncoding::Srgb);
    std::iota(image.u8().begin(), image.u8().end(), std::uint8_t{0});
    for (const PixelType type : {PixelType::U16, PixelType::F32}) {
        const Image same = convertImage(image, type, ColorEncoding::Srgb);
        EXPECT_EQ(convertImage(same, PixelType::U8, ColorEncoding::Srgb), image);
    }
    const Image linear = convertImage(image, PixelType::F32, ColorEncoding::Linear);
    EXPECT_EQ(linear.f32()[188], srgbTable8()[188]);
    EXPECT_EQ(convertImage(linear, PixelType::U8, ColorEncoding::Srgb), image);
}

TEST(ConvertImage, SixteenBitsSurviveLinearFloat) {
    Image image(256, 256, 1, PixelType::U16, ColorEncoding::Srgb);
    std::iota(image.u16().begin(), image.u16().end(), std::uint16_t{0});
    const Image linear = convertImage(image, PixelType::F32, ColorEncoding::Linear);
    EXPECT_EQ(convertImage(linear, PixelType::U16, ColorEncoding::Srgb), image);
}

TEST(ConvertImage, WideningAndNarrowingRound) {
    Image image(3, 1, 1, PixelType::U8, ColorEncoding::Data);
    image.u8()[1] = 1;
    image.u8()[2] = 255;
    const Image wide = convertImage(image, PixelType::U16, ColorEncoding::Data);
    EXPECT_EQ(wide.u16()[1], 257);
    EXPECT_EQ(wide.u16()[2], 65535);
    Image narrow(2, 1, 1, PixelType::U16, ColorEncoding::Data);
    narrow.u16()[0] = 128; // 0.498 of a step
    narrow.u16()[1] = 129; // 0.502 of a step
    const Image rounded = convertImage(narrow, PixelType::U8, ColorEncoding::Data);
    EXPECT_EQ(rounded.u8()[0], 0);
    EXPECT_EQ(rounded.u8()[1], 1);
}

TEST(ConvertImage, FloatsAreClampedForIntegersOnly) {
    Image image(4, 1, 1, PixelType::F32, ColorEncoding::Data);
    image.f32()[0] = -3.0f;
    image.f32()[1] = 7.0f;
    image.f32()[2] = std::numeric_limits<float>::quiet_NaN();
    image.f32()[3] = 0.5f;
    const Image bytes = convertImage(image, PixelType::U8, ColorEncoding::Data);
    EXPECT_EQ(bytes.u8()[0], 0);
    EXPECT_EQ(bytes.u8()[1], 255);
    EXPECT_EQ(bytes.u8()[2], 0);
    EXPECT_EQ(bytes.u8()[3], 128);
    const Image floats = convertImage(image, PixelType::F32, ColorEncoding::Linear);
    EXPECT_EQ(floats.f32()[1], 7.0f);
}

TEST(ConvertImage, TheCurveSparesAlphaAndData) {
    Image image(1, 1, 4, PixelType::F32, ColorEncoding::Linear);
    for (float& sample : image.f32())
        sample = 0.5f;
    const Image srgb = convertImage(image, PixelType::U8, ColorEncoding::Srgb);
    EXPECT_EQ(srgb.u8()[0], 188);
    EXPECT_EQ(srgb.u8()[3], 128);
    image.setEncoding(ColorEncoding::Data);
    const Image data = convertImage(image, PixelType::U8, ColorEncoding::Srgb);
    EXPECT_EQ(data.u8()[0], 128); // Data carries no curve to undo
    EXPECT_EQ(data.encoding(), ColorEncoding::Srgb);
    Image greyAlpha(1, 1, 2, PixelType::U8, ColorEncoding::Srgb);
    greyAlpha.u8()[0] = greyAlpha.u8()[1] = 128;
    const Image linear = convertImage(greyAlpha, PixelType::F32, ColorEncoding::Linear);
    EXPECT_EQ(linear.f32()[0], srgbTable8()[128]);
    EXPECT_FLOAT_EQ(linear.f32()[1], 128.0f / 255.0f);
}

TEST(ConvertImage, KeepsChannelNames) {
    Image image(1, 1, 2, PixelType::F32, ColorEncoding::Linear);
    image.setChannelNames({"sh.l0m0.R", "sh.l0m0.G"});
    const Image converted = convertImage(image, PixelType::U16, ColorEncoding::Linear);
    EXPECT_EQ(converted.channelNames(), image.channelNames());
}

TEST(ShrinkImage, AveragesAreasExactly) {
    Image image(4, 2, 1, PixelType::F32, ColorEncoding::Linear);
    std::iota(image.f32().begin(), image.f32().end(), 0.0f); // 0 1 2 3 / 4 5 6 7
    const Image small = shrinkImage(image, 2);
    ASSERT_EQ(small.width(), 2);
    ASSERT_EQ(small.height(), 1);
    EXPECT_FLOAT_EQ(small.f32()[0], 2.5f);
    EXPECT_FLOAT_EQ(small.f32()[1], 4.5f);
}

TEST(ShrinkImage, FractionalFootprintsKeepTheMean) {
    Image image(7, 5, 1, PixelType::F32, ColorEncoding::Linear);
    double sum = 0;
    for (std::size_t i = 0; i < image.f32().size(); ++i) {
        image.f32()[i] = static_cast<float>((i * 37) % 11);
        sum += image.f32()[i];
    }
    const Image one = shrinkImage(image, 1);
    ASSERT_EQ(one.width(), 1);
    EXPECT_NEAR(one.f32()[0], sum / 35.0, 1e-5);

    // 3 texels into 2: the middle one is shared half and half.
    Image row(3, 1, 1, PixelType::F32, ColorEncoding::Linear);
    row.f32()[0] = 3;
    row.f32()[1] = 6;
    row.f32()[2] = 12;
    const Image two = shrinkImage(row, 2);
    EXPECT_FLOAT_EQ(two.f32()[0], (3.0f + 0.5f * 6.0f) / 1.5f);
    EXPECT_FLOAT_EQ(two.f32()[1], (12.0f + 0.5f * 6.0f) / 1.5f);
}

TEST(ShrinkImage, AveragesInLinearLightAndKeepsTheType) {
    Image image(2, 1, 4, PixelType::U8, ColorEncoding::Srgb);
    for (std::size_t c = 0; c < 4; ++c)
        image.u8()[4 + c] = 255;
    const Image small = shrinkImage(image, 1);
    EXPECT_EQ(small.type(), PixelType::U8);
    EXPECT_EQ(small.encoding(), ColorEncoding::Srgb);
    EXPECT_EQ(small.u8()[0], 188);
    EXPECT_EQ(small.u8()[3], 128); // alpha is linear
}

TEST(ShrinkImage, NeverEnlarges) {
    Image image(3, 2, 1, PixelType::U8, ColorEncoding::Data);
    image.u8()[0] = 9;
    EXPECT_EQ(shrinkImage(image, 3), image);
    EXPECT_EQ(shrinkImage(image, 100), image);
    Image strip(100, 1, 1, PixelType::U8, ColorEncoding::Data);
    EXPECT_EQ(shrinkImage(strip, 10).height(), 1);
    EXPECT_TRUE(shrinkImage(Image(), 10).empty());
}

} // namespace
} // namespace patina
