#include "core/image/Image.h"

#include "core/image/Srgb.h"
#include "core/image/TexelRange.h"

#include <cmath>
#include <glm/common.hpp>
#include <gtest/gtest.h>
#include <limits>

namespace patina {
namespace {

Image grey(int width, int height, std::initializer_list<float> values) {
    Image image(width, height, 1, PixelType::F32, ColorEncoding::Linear);
    std::copy(values.begin(), values.end(), image.f32().begin());
    return image;
}

TEST(Image, StartsAsZeros) {
    const Image image(3, 2, 4, PixelType::U16, ColorEncoding::Data);
    EXPECT_EQ(image.bytesPerPixel(), 8u);
    EXPECT_EQ(image.bytes().size(), 48u);
    for (const std::uint16_t sample : image.u16())
        EXPECT_EQ(sample, 0);
    EXPECT_FALSE(image.empty());
    EXPECT_TRUE(Image().empty());
}

TEST(Image, SampleScalesIntegers) {
    Image image(2, 2, 2, PixelType::U8, ColorEncoding::Srgb);
    image.u8()[6] = 51; // x = 1, y = 1, channel 0
    image.u8()[7] = 255;
    EXPECT_FLOAT_EQ(image.sample(1, 1, 0), 0.2f);
    EXPECT_FLOAT_EQ(image.sample(1, 1, 1), 1.0f);
    EXPECT_FLOAT_EQ(image.sample(0, 1, 0), 0.0f);
}

TEST(Image, LinearExpandsChannelsAndKeepsAlphaLinear) {
    const float half = srgbTable8()[128];
    for (int channels = 1; channels <= 4; ++channels) {
        Image image(1, 1, channels, PixelType::U8, ColorEncoding::Srgb);
        for (std::uint8_t& sample : image.u8())
            sample = 128;
        const bool alpha = channels == 2 || channels == 4;
        const glm::vec4 expected(half, half, half, alpha ? 128.0f / 255.0f : 1.0f);
        EXPECT_EQ(image.linear(0, 0), expected) << channels;
    }
}

TEST(Image, DataAndLinearAreNotDecoded) {
    Image image(1, 1, 3, PixelType::U16, ColorEncoding::Data);
    image.u16()[1] = 65535 / 5;
    EXPECT_FLOAT_EQ(image.linear(0, 0).y, 0.2f);
    const Image hdr = grey(1, 1, {-7.5f});
    EXPECT_EQ(hdr.linear(0, 0), glm::vec4(-7.5f, -7.5f, -7.5f, 1.0f));
}

TEST(Image, ExtraChannelsAreIgnoredByLinear) {
    Image image(1, 1, 6, PixelType::F32, ColorEncoding::Linear);
    for (std::size_t i = 0; i < 6; ++i)
        image.f32()[i] = static_cast<float>(i);
    EXPECT_EQ(image.linear(0, 0), glm::vec4(0, 1, 2, 3));
    EXPECT_EQ(image.sample(0, 0, 5), 5.0f);
}

TEST(Image, HashSeesEveryPart) {
    Image image(2, 2, 1, PixelType::U8, ColorEncoding::Data);
    const Hash base = hashImage(image);
    EXPECT_EQ(hashImage(image), base);

    Image pixel = image;
    pixel.u8()[3] = 1;
    EXPECT_NE(hashImage(pixel), base);
    Image encoding = image;
    encoding.setEncoding(ColorEncoding::Srgb);
    EXPECT_NE(hashImage(encoding), base);
    Image named = image;
    named.setChannelNames({"ao"});
    EXPECT_NE(hashImage(named), base);
    EXPECT_NE(hashImage(Image(4, 1, 1, PixelType::U8, ColorEncoding::Data)), base);
    EXPECT_NE(hashImage(Image(1, 2, 1, PixelType::U16, ColorEncoding::Data)), base);
}

TEST(ImageDeathTest, WrongUseIsCaught) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    Image image(2, 2, 1, PixelType::U8, ColorEncoding::Data);
    EXPECT_DEATH((void)image.f32(), "CHECK|F32|type");
    EXPECT_DEATH((void)image.sample(2, 0, 0), "m_width");
    EXPECT_DEATH((Image(0, 1, 1, PixelType::U8, ColorEncoding::Data)), "width");
    EXPECT_DEATH((Image(1 << 20, 1, 1, PixelType::U8, ColorEncoding::Data)), "width");
    EXPECT_DEATH(image.setChannelNames({"a", "b"}), "names");
}

TEST(SampleBilinear, TexelCentresAreExactAndTheMiddleIsTheMean) {
    const Image image = grey(2, 2, {1, 2, 3, 4});
    EXPECT_FLOAT_EQ(sampleBilinear(image, 0.25f, 0.25f).x, 1.0f);
    EXPECT_FLOAT_EQ(sampleBilinear(image, 0.75f, 0.25f).x, 2.0f);
    EXPECT_FLOAT_EQ(sampleBilinear(image, 0.25f, 0.75f).x, 3.0f); // v grows downwards
    EXPECT_FLOAT_EQ(sampleBilinear(image, 0.5f, 0.5f).x, 2.5f);
    EXPECT_FLOAT_EQ(sampleBilinear(image, 0.375f, 0.25f).x, 1.25f);
}

TEST(SampleBilinear, Repeats) {
    const Image image = grey(4, 1, {0, 1, 2, 3});
    EXPECT_FLOAT_EQ(sampleBilinear(image, 0.0f, 0.5f).x, 1.5f); // between texel 3 and 0
    EXPECT_FLOAT_EQ(sampleBilinear(image, 1.0f, 0.5f).x, 1.5f);
    EXPECT_FLOAT_EQ(sampleBilinear(image, -0.125f, -7.5f).x, 3.0f);
    EXPECT_FLOAT_EQ(sampleBilinear(image, 5.375f, 2.0f).x, 1.0f);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(std::isfinite(sampleBilinear(image, nan, 1e30f).x));
    EXPECT_TRUE(std::isfinite(sampleBilinear(image, -1e-9f, 0.9999999f).x));
}

TEST(SampleBilinear, InterpolatesInLinearLight) {
    Image image(2, 1, 1, PixelType::U8, ColorEncoding::Srgb);
    image.u8()[1] = 255;
    EXPECT_FLOAT_EQ(sampleBilinear(image, 0.5f, 0.5f).x, 0.5f);
}

TEST(SanitizeHdr, ReplacesAndCounts) {
    const float inf = std::numeric_limits<float>::infinity();
    Image image = grey(7, 1, {std::nanf(""), -1, inf, -inf, 0, 70000, 0.5f});
    EXPECT_EQ(sanitizeHdr(image), 4u);
    EXPECT_EQ(image, grey(7, 1, {0, 0, 65504, 0, 0, 70000, 0.5f}));
    EXPECT_EQ(sanitizeHdr(image), 0u);
    Image integers(2, 2, 1, PixelType::U8, ColorEncoding::Data);
    EXPECT_EQ(sanitizeHdr(integers), 0u);
}

// Integers are counted by value, floats one by one: both are what linear() says of every texel.
TEST(TexelRange, IsThatOfLinearTexels) {
    for (const PixelType type : {PixelType::U8, PixelType::U16, PixelType::F32})
        for (const ColorEncoding encoding : {ColorEncoding::Srgb, ColorEncoding::Data})
            for (int channels = 1; channels <= 4; ++channels) {
                Image floats(5, 3, channels, PixelType::F32, encoding);
                for (std::size_t i = 0; i < floats.f32().size(); ++i)
                    floats.f32()[i] = static_cast<float>((i * 37 + 11) % 100) / 100.0f;
                const Image image = convertImage(floats, type, encoding);
                glm::vec4 low(2.0f), high(-1.0f);
                glm::dvec4 sum(0.0);
                for (int y = 0; y < 3; ++y)
                    for (int x = 0; x < 5; ++x) {
                        const glm::vec4 texel = image.linear(x, y);
                        low = glm::min(low, texel);
                        high = glm::max(high, texel);
                        sum += glm::dvec4(texel);
                    }
                const TexelRange range = texelRange(image, JobContext());
                EXPECT_EQ(range.low, low) << channels;
                EXPECT_EQ(range.high, high) << channels;
                for (int c = 0; c < 4; ++c)
                    EXPECT_NEAR(range.mean[c], sum[c] / 15.0, 1e-6) << channels << " " << c;
            }
}

TEST(TexelRange, LeavesOutWhatIsNoNumber) {
    const float inf = std::numeric_limits<float>::infinity();
    const TexelRange range =
        texelRange(grey(4, 1, {std::nanf(""), 3.0f, inf, -1.0f}), JobContext());
    EXPECT_EQ(range.low, glm::vec4(-1, -1, -1, 1));
    EXPECT_EQ(range.mean, glm::vec4(1));
    EXPECT_EQ(range.high, glm::vec4(3, 3, 3, 1));
}

} // namespace
} // namespace patina
