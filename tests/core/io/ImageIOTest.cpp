// What is written comes back: types, channels, names, parts, attributes, colour policy.
#include "tests/core/image/TestImages.h"
#include "tests/support/TemporaryFolder.h"

#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <limits>

namespace patina {
namespace {

using test::noise;
using testing::ElementsAre;

class ImageIO : public test::ImageFiles {};

struct Lossless {
    ImageFileFormat format;
    const char* name;
    PixelType type;
    int minChannels, maxChannels;
};

TEST_F(ImageIO, IntegerFormatsAreLossless) {
    for (const Lossless& c : {Lossless{ImageFileFormat::Png, "png", PixelType::U8, 1, 4},
                              Lossless{ImageFileFormat::Png, "png", PixelType::U16, 1, 4},
                              Lossless{ImageFileFormat::Tiff, "tiff", PixelType::U8, 1, 4},
                              Lossless{ImageFileFormat::Tiff, "tiff", PixelType::U16, 1, 4},
                              Lossless{ImageFileFormat::Tga, "targa", PixelType::U8, 3, 4}})
        for (int channels = c.minChannels; channels <= c.maxChannels; ++channels) {
            const Image image = noise(37, 21, channels, c.type, ColorEncoding::Data);
            const LoadedImage loaded = decode(encode(image, c.format), "picture.tga");
            EXPECT_EQ(loaded.format, c.name);
            // Equality includes alpha: colour under transparent pixels must not be multiplied.
            EXPECT_EQ(loaded.image(), image) << c.name << " " << channels;
        }
}

TEST_F(ImageIO, GreyTargaComesBackGrey) {
    const Image image = noise(9, 5, 1, PixelType::U8, ColorEncoding::Data);
    EXPECT_EQ(decode(encode(image, ImageFileFormat::Tga), "picture.tga").image(), image);
}

TEST_F(ImageIO, FloatExrIsExactIncludingNegativeNumbers) {
    for (int channels = 1; channels <= 4; ++channels) {
        Image image = noise(19, 11, channels, PixelType::F32, ColorEncoding::Linear);
        image.f32()[0] = -123.456f;
        image.f32()[1] = 1e30f;
        ImageLoadOptions options;
        options.sanitize = false;
        LoadedImage loaded = decode(encode(image, ImageFileFormat::Exr), "x.exr", options);
        EXPECT_EQ(loaded.format, "openexr");
        EXPECT_EQ(loaded.image().encoding(), ColorEncoding::Linear);
        loaded.parts[0].image.setChannelNames({});
        EXPECT_EQ(loaded.image(), image) << channels;
    }
}

TEST_F(ImageIO, HalfExrRoundsAndClamps) {
    Image image(4, 1, 1, PixelType::F32, ColorEncoding::Linear);
    image.f32()[0] = 0.1f;
    image.f32()[1] = 1e6f;
    image.f32()[2] = -std::numeric_limits<float>::infinity();
    image.f32()[3] = 2.5f;
    ImageSaveOptions save;
    save.half = true;
    ImageLoadOptions load;
    load.sanitize = false;
    const Image back = decode(encode(image, ImageFileFormat::Exr, save), "x.exr", load).image();
    EXPECT_NE(back.f32()[0], 0.1f);
    EXPECT_NEAR(back.f32()[0], 0.1f, 0.1f / 2048);
    EXPECT_EQ(back.f32()[1], 65504.0f);
    EXPECT_EQ(back.f32()[2], -65504.0f);
    EXPECT_EQ(back.f32()[3], 2.5f);
}

TEST_F(ImageIO, RadianceKeepsEightBitsOfMantissa) {
    Image image(64, 8, 3, PixelType::F32, ColorEncoding::Linear);
    for (std::size_t i = 0; i < image.f32().size(); ++i)
        image.f32()[i] = std::exp2(static_cast<float>(i / 3 % 20) - 8.0f) *
                         (0.6f + 0.13f * static_cast<float>(i % 3));
    const LoadedImage loaded = decode(encode(image, ImageFileFormat::Hdr), "x.hdr");
    EXPECT_EQ(loaded.format, "hdr");
    ASSERT_EQ(loaded.image().channels(), 3);
    for (std::size_t i = 0; i < image.f32().size(); ++i) {
        const std::size_t pixel = i / 3 * 3;
        const float largest =
            std::max({image.f32()[pixel], image.f32()[pixel + 1], image.f32()[pixel + 2]});
        ASSERT_NEAR(loaded.image().f32()[i], image.f32()[i], largest / 120);
    }
}

TEST_F(ImageIO, JpegIsClose) {
    Image image(64, 64, 3, PixelType::U8, ColorEncoding::Srgb);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const auto i = static_cast<std::size_t>(y * 64 + x) * 3;
            image.u8()[i] = static_cast<std::uint8_t>(x * 4);
            image.u8()[i + 1] = static_cast<std::uint8_t>(y * 4);
            image.u8()[i + 2] = 100;
        }
    ImageLoadOptions options;
    options.integerEncoding = ColorEncoding::Srgb;
    const LoadedImage loaded = decode(encode(image, ImageFileFormat::Jpeg), "x.jpg", options);
    EXPECT_EQ(loaded.image().encoding(), ColorEncoding::Srgb);
    for (std::size_t i = 0; i < image.u8().size(); ++i)
        ASSERT_NEAR(loaded.image().u8()[i], image.u8()[i], 6) << i;

    ImageSaveOptions poor;
    poor.jpegQuality = 10;
    const Image noisy = noise(64, 64, 3, PixelType::U8, ColorEncoding::Srgb);
    EXPECT_LT(encode(noisy, ImageFileFormat::Jpeg, poor).size(),
              encode(noisy, ImageFileFormat::Jpeg).size() / 2);
}

TEST_F(ImageIO, TheCallerDecidesTheEncodingOfIntegersOnly) {
    const Bytes png =
        encode(noise(4, 4, 3, PixelType::U8, ColorEncoding::Srgb), ImageFileFormat::Png);
    ImageLoadOptions options;
    EXPECT_EQ(decode(png).image().encoding(), ColorEncoding::Data);
    options.integerEncoding = ColorEncoding::Srgb;
    EXPECT_EQ(decode(png, "x", options).image().encoding(), ColorEncoding::Srgb);
    const Bytes exr =
        encode(noise(4, 4, 3, PixelType::F32, ColorEncoding::Linear), ImageFileFormat::Exr);
    EXPECT_EQ(decode(exr, "x", options).image().encoding(), ColorEncoding::Linear);
}

TEST_F(ImageIO, ManyNamedChannelsSurvive) {
    // As in a bake of order 6: three colours of 36 coefficients.
    std::vector<std::string> names;
    for (int l = 0; l < 6; ++l)
        for (int m = -l; m <= l; ++m)
            for (const char* color : {"R", "G", "B"})
                names.push_back(fmt::format("sh.l{}m{}.{}", l, m, color));
    Image image =
        noise(7, 5, static_cast<int>(names.size()), PixelType::F32, ColorEncoding::Linear);
    for (std::size_t i = 0; i < image.f32().size(); ++i)
        image.f32()[i] -= 8.0f;
    image.setChannelNames(names);
    ImageLoadOptions options;
    options.sanitize = false;
    const Image back = decode(encode(image, ImageFileFormat::Exr), "bake.exr", options).image();
    ASSERT_EQ(back.channels(), 108);
    // The order is the file's; channels are found by their names.
    for (int c = 0; c < image.channels(); ++c) {
        const auto& found = back.channelNames();
        const auto it = std::find(found.begin(), found.end(), names[static_cast<std::size_t>(c)]);
        ASSERT_NE(it, found.end()) << names[static_cast<std::size_t>(c)];
        const int at = static_cast<int>(it - found.begin());
        for (int y = 0; y < 5; ++y)
            for (int x = 0; x < 7; ++x)
                ASSERT_EQ(back.sample(x, y, at), image.sample(x, y, c));
    }
}

std::vector<ImagePart> threeParts() {
    std::vector<ImagePart> parts(3);
    parts[0].name = "diffuse";
    parts[0].image = noise(8, 4, 3, PixelType::F32, ColorEncoding::Linear);
    parts[0].attributes = {{"patina:basis", "real-sh-cs"}, {"patina:inputs", "0123456789abcdef"}};
    parts[1].name = "mesh Ünïcode";
    parts[1].image = noise(5, 9, 1, PixelType::F32, ColorEncoding::Linear);
    parts[1].image.setChannelNames({"ao"});
    parts[1].attributes = {{"patina:target", "vertex"}};
    parts[2].name = "third";
    parts[2].image = noise(1, 1, 4, PixelType::F32, ColorEncoding::Linear);
    return parts;
}

TEST_F(ImageIO, ExrPartsKeepNamesSizesAndAttributes) {
    const auto parts = threeParts();
    const auto bytes = encodeImage(worker(), parts, ImageFileFormat::Exr);
    ASSERT_TRUE(bytes.ok()) << bytes.error().text();
    ImageLoadOptions options;
    options.allParts = true;
    const LoadedImage loaded = decode(*bytes, "x.exr", options);
    ASSERT_EQ(loaded.parts.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(loaded.parts[i].name, parts[i].name);
        EXPECT_EQ(loaded.parts[i].attributes, parts[i].attributes) << i;
        Image image = loaded.parts[i].image;
        EXPECT_EQ(image.channelNames().size(), static_cast<std::size_t>(image.channels()));
        image.setChannelNames(parts[i].image.channelNames());
        EXPECT_EQ(image, parts[i].image) << i;
    }
    EXPECT_THAT(loaded.parts[1].image.channelNames(), ElementsAre("ao"));
    options.allParts = false;
    EXPECT_EQ(decode(*bytes, "x.exr", options).parts.size(), 1u);
}

TEST_F(ImageIO, InspectTellsWithoutPixels) {
    const test::TemporaryFolder folder;
    const auto bytes = encodeImage(worker(), threeParts(), ImageFileFormat::Exr);
    ASSERT_TRUE(bytes.ok());
    const auto info = inspectImage(worker(), folder.write("bake.exr", *bytes));
    ASSERT_TRUE(info.ok()) << info.error().text();
    EXPECT_EQ(info->width, 8);
    EXPECT_EQ(info->height, 4);
    EXPECT_EQ(info->channels, 3);
    EXPECT_EQ(info->pixelType, "float");
    EXPECT_EQ(info->format, "openexr");
    EXPECT_THAT(info->channelNames, ElementsAre("R", "G", "B"));
    EXPECT_THAT(info->partNames, ElementsAre("diffuse", "mesh Ünïcode", "third"));
    EXPECT_EQ(info->attributes.at("patina:basis"), "real-sh-cs");

    const Bytes png =
        encode(noise(3, 2, 2, PixelType::U16, ColorEncoding::Data), ImageFileFormat::Png);
    const auto small = inspectImage(worker(), folder.write("a.png", png));
    ASSERT_TRUE(small.ok());
    EXPECT_EQ(small->pixelType, "uint16");
    EXPECT_EQ(small->channels, 2);
}

TEST_F(ImageIO, SanitizingIsCountedAndOptional) {
    Image image(4, 1, 3, PixelType::F32, ColorEncoding::Linear);
    for (float& sample : image.f32())
        sample = 1.0f;
    image.f32()[2] = std::numeric_limits<float>::quiet_NaN();
    image.f32()[5] = -4.0f;
    image.f32()[7] = std::numeric_limits<float>::infinity();
    const Bytes exr = encode(image, ImageFileFormat::Exr);
    const LoadedImage clean = decode(exr);
    EXPECT_EQ(clean.sanitizedSamples, 3u);
    EXPECT_EQ(clean.image().f32()[2], 0.0f);
    EXPECT_EQ(clean.image().f32()[5], 0.0f);
    EXPECT_EQ(clean.image().f32()[7], 65504.0f);
    ImageLoadOptions raw;
    raw.sanitize = false;
    const LoadedImage as = decode(exr, "x", raw);
    EXPECT_EQ(as.sanitizedSamples, 0u);
    EXPECT_TRUE(std::isnan(as.image().f32()[2]));
    EXPECT_EQ(as.image().f32()[5], -4.0f);
}

TEST_F(ImageIO, SaveWritesTheFormatOfTheName) {
    const test::TemporaryFolder folder;
    const Image image = noise(6, 6, 3, PixelType::U8, ColorEncoding::Data);
    for (const char* name : {"a.png", "b.TIF", "c.tga"}) {
        const auto file = folder.path() / name;
        ASSERT_TRUE(saveImage(worker(), image, file).ok());
        const auto loaded = loadImage(worker(), file);
        ASSERT_TRUE(loaded.ok()) << loaded.error().text();
        EXPECT_EQ(loaded->image(), image);
    }
}

} // namespace
} // namespace patina
