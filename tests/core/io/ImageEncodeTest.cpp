// What each format stores of a picture it cannot hold as it is.
#include "tests/core/image/TestImages.h"

#include <ctime>
#include <gmock/gmock.h>
#include <string>
#include <vector>

namespace patina {
namespace {

using test::noise;
using testing::HasSubstr;

class Encode : public test::ImageFiles {
  protected:
    static Image grey(float value, ColorEncoding encoding) {
        Image image(8, 8, 1, PixelType::F32, encoding);
        for (float& sample : image.f32())
            sample = value;
        return image;
    }
    static std::string usageError(const std::vector<ImagePart>& parts, ImageFileFormat format) {
        const auto bytes = encodeImage(worker(), parts, format);
        EXPECT_FALSE(bytes.ok());
        if (bytes.ok())
            return {};
        EXPECT_EQ(bytes.error().kind, ErrorKind::Usage);
        return bytes.error().message;
    }
    // The names of a PNG file's chunks, those of pixels once.
    static std::vector<std::string> chunks(const Bytes& png) {
        std::vector<std::string> names;
        for (std::size_t at = 8; at + 8 <= png.size();) {
            std::size_t size = 0;
            for (std::size_t i = 0; i < 4; ++i)
                size = size << 8 | std::to_integer<std::size_t>(png[at + i]);
            const std::string name(reinterpret_cast<const char*>(png.data() + at + 4), 4);
            if (names.empty() || names.back() != name)
                names.push_back(name);
            at += size + 12; // with its size, name and checksum
        }
        return names;
    }
};

TEST_F(Encode, PngSaysWhichColoursAreSrgb) {
    const auto of = [](ColorEncoding encoding) {
        return chunks(encode(noise(300, 200, 3, PixelType::U8, encoding), ImageFileFormat::Png));
    };
    using testing::ElementsAre;
    EXPECT_THAT(of(ColorEncoding::Srgb),
                ElementsAre("IHDR", "gAMA", "sRGB", "cHRM", "oFFs", "tEXt", "IDAT", "IEND"));
    EXPECT_THAT(of(ColorEncoding::Data), ElementsAre("IHDR", "oFFs", "IDAT", "IEND"));
}

TEST_F(Encode, LinearFloatsGetTheCurveInIntegerFormats) {
    // linearToSrgb(0.5) * 255 = 187.5 → 188
    for (const auto format : {ImageFileFormat::Png, ImageFileFormat::Jpeg, ImageFileFormat::Tga}) {
        const Image back =
            decode(encode(grey(0.5f, ColorEncoding::Linear), format), "x.tga").image();
        EXPECT_EQ(back.type(), PixelType::U8);
        EXPECT_EQ(back.u8()[0], 188);
        EXPECT_EQ(
            decode(encode(grey(9.0f, ColorEncoding::Linear), format), "x.tga").image().u8()[0],
            255);
    }
}

TEST_F(Encode, DataFloatsAreStoredAsTheyAre) {
    const Image back =
        decode(encode(grey(0.5f, ColorEncoding::Data), ImageFileFormat::Png)).image();
    EXPECT_EQ(back.u8()[0], 128);
}

TEST_F(Encode, FloatFormatsHoldLinearLight) {
    Image srgb(2, 2, 3, PixelType::U8, ColorEncoding::Srgb);
    for (std::uint8_t& sample : srgb.u8())
        sample = 188;
    const float linear = 0.5028865f; // of 188 / 255
    EXPECT_NEAR(decode(encode(srgb, ImageFileFormat::Exr)).image().f32()[0], linear, 1e-6f);
    EXPECT_NEAR(decode(encode(srgb, ImageFileFormat::Hdr)).image().f32()[0], linear, 1.0f / 256);
    srgb.setEncoding(ColorEncoding::Data);
    EXPECT_FLOAT_EQ(decode(encode(srgb, ImageFileFormat::Exr)).image().f32()[0], 188.0f / 255.0f);
}

TEST_F(Encode, SixteenBitsAreNarrowedWhereTheFormatHasEight) {
    Image image(8, 8, 1, PixelType::U16, ColorEncoding::Data);
    for (std::uint16_t& sample : image.u16())
        sample = 200 * 257;
    EXPECT_EQ(decode(encode(image, ImageFileFormat::Jpeg)).image().u8()[0], 200);
    EXPECT_EQ(decode(encode(image, ImageFileFormat::Png)).image().u16()[0], 200 * 257);
}

TEST_F(Encode, ChannelsAreAdaptedToTheFormat) {
    const Image rgba = noise(8, 8, 4, PixelType::U8, ColorEncoding::Srgb);
    EXPECT_EQ(decode(encode(rgba, ImageFileFormat::Jpeg)).image().channels(), 3);
    const Image greyAlpha = noise(8, 8, 2, PixelType::U8, ColorEncoding::Srgb);
    EXPECT_EQ(decode(encode(greyAlpha, ImageFileFormat::Jpeg)).image().channels(), 1);
    const Image targa = decode(encode(greyAlpha, ImageFileFormat::Tga), "x.tga").image();
    ASSERT_EQ(targa.channels(), 4);
    EXPECT_EQ(targa.u8()[0], greyAlpha.u8()[0]);
    EXPECT_EQ(targa.u8()[2], greyAlpha.u8()[0]);
    EXPECT_EQ(targa.u8()[3], greyAlpha.u8()[1]);
    const Image hdr =
        decode(encode(grey(2.0f, ColorEncoding::Linear), ImageFileFormat::Hdr)).image();
    ASSERT_EQ(hdr.channels(), 3);
    EXPECT_NEAR(hdr.f32()[2], 2.0f, 0.02f);
}

TEST_F(Encode, TheTimeOfWritingIsNotStored) {
    for (const auto format : {ImageFileFormat::Exr, ImageFileFormat::Tiff}) {
        const Bytes bytes = encode(grey(0.5f, ColorEncoding::Linear), format);
        const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        const std::time_t now = std::time(nullptr);
        std::string year(8, ' ');
        year.resize(std::strftime(year.data(), year.size(), "%Y:", std::localtime(&now)));
        EXPECT_EQ(text.find(year), std::string::npos);
        EXPECT_EQ(decode(bytes).parts[0].attributes.count("DateTime"), 0u);
    }
}

TEST_F(Encode, MisuseIsExplained) {
    std::vector<ImagePart> parts(2);
    parts[0].image = parts[1].image = grey(1.0f, ColorEncoding::Linear);
    EXPECT_THAT(usageError(parts, ImageFileFormat::Png), HasSubstr("only OpenEXR"));
    parts[0].name = parts[1].name = "same";
    EXPECT_THAT(usageError(parts, ImageFileFormat::Exr), HasSubstr("names of their own"));
    EXPECT_THAT(usageError({}, ImageFileFormat::Png), HasSubstr("only OpenEXR"));
    EXPECT_THAT(usageError(std::vector<ImagePart>(1), ImageFileFormat::Png), HasSubstr("no image"));
    parts.resize(1);
    parts[0].image = noise(2, 2, 5, PixelType::F32, ColorEncoding::Linear);
    EXPECT_THAT(usageError(parts, ImageFileFormat::Png), HasSubstr("OpenEXR"));
    parts[0].image.setChannelNames({"a", "b", "c", "d", "a"});
    EXPECT_THAT(usageError(parts, ImageFileFormat::Exr), HasSubstr("names of their own"));
    parts[0].image.setChannelNames({});
    parts[0].attributes["key"] = "\xff\xfe";
    EXPECT_THAT(usageError(parts, ImageFileFormat::Exr), HasSubstr("UTF-8"));
}

TEST(ImageFormat, IsTheExtension) {
    EXPECT_EQ(*imageFormatForPath("a.b/picture.PNG"), ImageFileFormat::Png);
    EXPECT_EQ(*imageFormatForPath("x.jpeg"), ImageFileFormat::Jpeg);
    EXPECT_EQ(*imageFormatForPath("x.Exr"), ImageFileFormat::Exr);
    EXPECT_EQ(*imageFormatForPath("x.tiff"), ImageFileFormat::Tiff);
    for (const char* name : {"x", "x.gif", "png", "x.png.txt"}) {
        const auto format = imageFormatForPath(name);
        ASSERT_FALSE(format.ok()) << name;
        EXPECT_EQ(format.error().kind, ErrorKind::Usage);
        EXPECT_THAT(format.error().message, HasSubstr(".png"));
    }
}

} // namespace
} // namespace patina
