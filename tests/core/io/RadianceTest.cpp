// Radiance files: headers, orientations and run lengths, against vectors made with Radiance's
// color.c.
#include "tests/core/image/TestImages.h"
#include "tests/support/TemporaryFolder.h"

#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <glm/vec3.hpp>
#include <gmock/gmock.h>

namespace patina {
namespace {

Bytes bytesOf(std::string_view text) {
    Bytes bytes;
    for (const char c : text)
        bytes.push_back(static_cast<std::byte>(c));
    return bytes;
}

std::string fromHex(std::string_view hex) {
    std::string bytes;
    for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
        bytes += static_cast<char>(std::stoi(std::string(hex.substr(i, 2)), nullptr, 16));
    return bytes;
}

std::string toHex(std::string_view bytes) {
    std::string hex;
    for (const char c : bytes)
        hex += fmt::format("{:02x}", static_cast<unsigned char>(c));
    return hex;
}

class Radiance : public test::ImageFiles {
  protected:
    static std::string file(const std::string& variables, const std::string& size,
                            const std::string& pixels) {
        return "#?RADIANCE\n" + variables + "\n" + size + "\n" + pixels;
    }
    static Image read(const std::string& content, const ImageLoadOptions& options = {}) {
        return decode(bytesOf(content), "x.hdr", options).image();
    }
    static std::string refusal(const std::string& content) {
        const auto loaded = loadImageFromMemory(worker(), bytesOf(content), "x.hdr");
        EXPECT_FALSE(loaded.ok());
        if (loaded.ok())
            return {};
        EXPECT_EQ(loaded.error().kind, ErrorKind::InputBroken);
        return loaded.error().text();
    }
    // The pixels of what encodeImage() writes, behind the size line.
    static std::string written(const Image& image) {
        const Bytes bytes = encode(image, ImageFileFormat::Hdr);
        const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        const std::string size = fmt::format("-Y {} +X {}\n", image.height(), image.width());
        const std::size_t at = text.find(size);
        EXPECT_NE(at, std::string::npos) << text.substr(0, 80);
        return text.substr(at + size.size());
    }
    // A row of pixels from bytes.
    static Image rowOf(const std::vector<std::array<int, 4>>& pixels) {
        Image image(static_cast<int>(pixels.size()), 1, 3, PixelType::F32, ColorEncoding::Linear);
        for (std::size_t i = 0; i < pixels.size(); ++i)
            for (std::size_t c = 0; c < 3; ++c)
                image.f32()[3 * i + c] =
                    std::ldexp(static_cast<float>(pixels[i][c]), pixels[i][3] - 136);
        return image;
    }
};

const std::string kFormat = "FORMAT=32-bit_rle_rgbe\n";
const std::string kGrey = "\x80\x80\x80\x81"; // 1 1 1

TEST_F(Radiance, NewRunsAreWrittenAsRadianceDoes) {
    EXPECT_EQ(toHex(written(rowOf(std::vector<std::array<int, 4>>(8, {128, 64, 32, 129})))),
              "020200088880884088208881");
    std::vector<std::array<int, 4>> varying;
    for (int i = 0; i < 10; ++i)
        varying.push_back({10 * i, 255 - i, 7, 128});
    EXPECT_EQ(toHex(written(rowOf(varying))),
              "0202000a0a000a141e28323c46505a0afffefdfcfbfaf9f8f7f68a078a80");
    // Below eight pixels there are no runs.
    EXPECT_EQ(toHex(written(rowOf(std::vector<std::array<int, 4>>(4, {128, 64, 32, 129})))),
              "80402081804020818040208180402081");
}

TEST_F(Radiance, RunsOfEveryLengthComeBack) {
    for (const int width : {8, 127, 128, 129, 130, 131, 255, 300, 1000}) {
        std::vector<std::array<int, 4>> pixels;
        unsigned state = 7;
        for (int x = 0; x < width; ++x) {
            state = state * 1664525u + 1013904223u;
            const int step = static_cast<int>(state >> 16) % 3 == 0 ? 1 : 0;
            const int last = pixels.empty() ? 130 : pixels.back()[0];
            pixels.push_back({128 + (last - 128 + step) % 100, x < width / 2 ? 255 : 128 + x % 100,
                              x % 130 < 5 ? 3 : 9, 129});
        }
        const Image image = rowOf(pixels);
        const Bytes bytes = encode(image, ImageFileFormat::Hdr);
        Image back = decode(bytes, "x.hdr").image();
        EXPECT_EQ(back, image) << width;
    }
}

TEST_F(Radiance, NewRunsAreRead) {
    const std::string vector =
        fromHex("02020087ff01080101010202020505ff01080101010303030505ff01080101010404040505ff80"
                "088080808181818282");
    const Image image = read(file(kFormat, "-Y 1 +X 135", vector));
    ASSERT_EQ(image.width(), 135);
    // 130 pixels (1, 1, 1, 128), three (2, 3, 4, 129), two (5, 5, 5, 130)
    EXPECT_EQ(image.f32()[0], 1.0f / 256);
    EXPECT_EQ(image.f32()[3 * 129 + 2], 1.0f / 256);
    EXPECT_EQ(image.f32()[3 * 130], 2.0f / 128);
    EXPECT_EQ(image.f32()[3 * 132 + 2], 4.0f / 128);
    EXPECT_EQ(image.f32()[3 * 134 + 1], 5.0f / 64);

    // A code of 128 announces 128 bytes and is no run.
    std::string literal = fromHex("02020080");
    for (int c = 0; c < 4; ++c) {
        literal += fromHex("80");
        for (int i = 0; i < 128; ++i)
            literal += static_cast<char>(c == 3 ? 136 : i);
    }
    const Image numbers = read(file(kFormat, "-Y 1 +X 128", literal));
    for (int i = 0; i < 128; ++i)
        ASSERT_EQ(numbers.f32()[static_cast<std::size_t>(3 * i)], static_cast<float>(i));
}

TEST_F(Radiance, OldRunsRepeatPixelsAndShiftWhenTheyFollowEachOther) {
    const Image few = read(file(kFormat, "-Y 1 +X 4", fromHex("1020308101010103")));
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(few.f32()[3 * i], 16.0f / 128);
        EXPECT_EQ(few.f32()[3 * i + 2], 48.0f / 128);
    }
    // 2 + (1 << 8) repeats
    const Image many = read(file(kFormat, "-Y 1 +X 259", fromHex("102030810101010201010101")));
    EXPECT_EQ(many.f32()[3 * 258 + 1], 32.0f / 128);
    EXPECT_NE(refusal(file(kFormat, "-Y 1 +X 258", fromHex("102030810101010201010101"))), "");
    EXPECT_NE(refusal(file(kFormat, "-Y 1 +X 4", fromHex("0101010410203081"))), "");
}

TEST_F(Radiance, DamagedRunsAreRefused) {
    for (const char* hex : {"02020009888088408820888",      // another length than the header's
                            "0202000889808840882088810000", // a run beyond the end
                            "02020008888088408820",         // cut short
                            "0202000800000000000000"})      // nothing but empty runs
        EXPECT_NE(refusal(file(kFormat, "-Y 1 +X 8", fromHex(hex))).find("damaged or cut short"),
                  std::string::npos)
            << hex;
    EXPECT_NE(refusal(file(kFormat, "-Y 2 +X 1", kGrey)).find("cut short"), std::string::npos);
}

TEST_F(Radiance, ExposuresAndCorrectionsMultiplyAndAreDividedOut) {
    const auto first = [&](const std::string& variables) {
        const Image image = read(file(variables, "-Y 1 +X 1", kGrey));
        return glm::vec3(image.linear(0, 0));
    };
    EXPECT_EQ(first(""), glm::vec3(1.0f)); // a FORMAT may be missing
    EXPECT_EQ(first(kFormat + "EXPOSURE=2\nrender -x EXPOSURE 9\nEXPOSURE= 4.0\n"),
              glm::vec3(1.0f / 8));
    EXPECT_EQ(first(kFormat + "COLORCORR= 2 4 8\n# EXPOSURE=100\nEXPOSURE=0.5\nCOLORCORR=1 1 .5\n"),
              glm::vec3(1.0f, 0.5f, 0.5f));
    EXPECT_NE(refusal(file("EXPOSURE=bright\n", "-Y 1 +X 1", kGrey)).find("EXPOSURE=bright"),
              std::string::npos);
    EXPECT_NE(refusal(file("EXPOSURE=0\n", "-Y 1 +X 1", kGrey)).find("makes no sense"),
              std::string::npos);
}

// Picture 0 1 2 / 3 4 5 in the eight ways to write it.
TEST_F(Radiance, AllEightOrientationsAreTurnedUpright) {
    const struct {
        const char *size, *order;
    } cases[] = {{"-Y 2 +X 3", "012345"}, {"+Y 2 +X 3", "345012"}, {"-Y 2 -X 3", "210543"},
                 {"+Y 2 -X 3", "543210"}, {"+X 3 -Y 2", "031425"}, {"-X 3 -Y 2", "251403"},
                 {"+X 3 +Y 2", "304152"}, {"-X 3 +Y 2", "524130"}};
    for (const auto& c : cases) {
        std::string pixels;
        for (const char* digit = c.order; *digit != 0; ++digit)
            pixels += std::string(1, static_cast<char>(128 + (*digit - '0'))) + "\x80\x80\x88";
        const Image image = read(file(kFormat, c.size, pixels));
        ASSERT_EQ(image.width(), 3) << c.size;
        ASSERT_EQ(image.height(), 2) << c.size;
        for (int i = 0; i < 6; ++i)
            EXPECT_EQ(image.linear(i % 3, i / 3).r, static_cast<float>(128 + i)) << c.size;
    }
    for (const char* size :
         {"-Y 2", "-Y 2 -Y 3", "Y 2 X 3", "-Y 0 +X 3", "-Y 2.5 +X 3", "-Y a +X b"})
        EXPECT_NE(refusal(file(kFormat, size, kGrey)).find(size), std::string::npos);
    EXPECT_NE(refusal(file(kFormat, "-Y 40000 +X 8", kGrey)).find("largest supported side"),
              std::string::npos);
}

// XYZ of Rec.709's white and red (IEC 61966-2-1): white is (0.9505, 1, 1.0890).
TEST_F(Radiance, XyzBecomesRgb) {
    const auto convert = [&](const glm::vec3& xyz) {
        Image image(1, 1, 3, PixelType::F32, ColorEncoding::Linear);
        for (int c = 0; c < 3; ++c)
            image.f32()[static_cast<std::size_t>(c)] = xyz[c];
        const std::string pixel = written(image);
        return glm::vec3(read(file("FORMAT=32-bit_rle_xyze\n", "-Y 1 +X 1", pixel)).linear(0, 0));
    };
    const glm::vec3 white = convert({0.9505f, 1.0f, 1.0890f});
    const glm::vec3 red = convert({0.4124f, 0.2126f, 0.0193f});
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(white[c], 1.0f, 0.03f) << c; // steps of 1/128
    EXPECT_NEAR(red.r, 1.0f, 0.02f);
    EXPECT_NEAR(red.g, 0.0f, 0.02f);
    EXPECT_NE(refusal(file("FORMAT=32-bit_rle_lab\n", "-Y 1 +X 1", kGrey)).find("32-bit_rle_lab"),
              std::string::npos);
}

TEST_F(Radiance, WindowsLineEndsAndPrimariesAreUnderstood) {
    const std::string content =
        "#?RGBE\r\nFORMAT=32-bit_rle_rgbe\r\nPRIMARIES=.64 .33 .29 .6 .15 .06 "
        ".3333 .3333\r\n\r\n-Y 1 +X 1\n" +
        kGrey;
    const LoadedImage loaded = decode(bytesOf(content), "x.hdr");
    EXPECT_EQ(loaded.image().linear(0, 0).g, 1.0f);
    EXPECT_EQ(loaded.parts[0].attributes.at("chromaticities"),
              "0.64 0.33 0.29 0.6 0.15 0.06 0.3333 0.3333");
}

TEST_F(Radiance, InspectTellsTheSizeAsSeen) {
    const test::TemporaryFolder folder;
    const auto info =
        inspectImage(worker(), folder.write("x.hdr", bytesOf(file(kFormat, "+X 3 -Y 2", kGrey))));
    ASSERT_TRUE(info.ok()) << info.error().text();
    EXPECT_EQ(info->width, 3);
    EXPECT_EQ(info->height, 2);
    EXPECT_EQ(info->channels, 3);
    EXPECT_EQ(info->format, "hdr");
}

TEST_F(Radiance, LargePicturesAreAveragedWhileTheyAreRead) {
    Image image(96, 24, 3, PixelType::F32, ColorEncoding::Linear);
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 96; ++x)
            image.f32()[static_cast<std::size_t>((y * 96 + x) * 3)] =
                static_cast<float>(1 + (x / 2 + y) % 2);
    ImageLoadOptions options;
    options.maxSide = 48;
    for (const ImageFileFormat format : {ImageFileFormat::Hdr, ImageFileFormat::Exr}) {
        const Image small = decode(encode(image, format), "x", options).image();
        ASSERT_EQ(small.width(), 48);
        ASSERT_EQ(small.height(), 12);
        for (int y = 0; y < 12; ++y)
            for (int x = 0; x < 48; ++x)
                ASSERT_NEAR(small.linear(x, y).r, 1.5f, 1e-6f);
    }
    // Columns as scanlines
    const std::string turned =
        file(kFormat, "+X 4 -Y 2", kGrey + kGrey + kGrey + kGrey + kGrey + kGrey + kGrey + kGrey);
    options.maxSide = 2;
    const Image tiny = read(turned, options);
    EXPECT_EQ(tiny.width(), 2);
    EXPECT_EQ(tiny.height(), 1);
    EXPECT_EQ(tiny.linear(1, 0).b, 1.0f);
}

// Portable float maps, which light probes were first handed on in; row 0 of the file is the last.
class PortableFloatMap : public test::ImageFiles {
  protected:
    static Bytes file(const std::string& header, std::initializer_list<float> values, bool little) {
        Bytes bytes = bytesOf(header);
        for (const float value : values) {
            const auto bits = std::bit_cast<std::uint32_t>(value);
            for (int b = 0; b < 4; ++b)
                bytes.push_back(static_cast<std::byte>(bits >> (8 * (little ? b : 3 - b))));
        }
        return bytes;
    }
    static std::string refusal(const Bytes& bytes) {
        const auto loaded = loadImageFromMemory(worker(), bytes, "x.pfm");
        EXPECT_FALSE(loaded.ok());
        return loaded.ok() ? std::string() : loaded.error().text();
    }
};

TEST_F(PortableFloatMap, IsReadInBothByteOrders) {
    for (const bool little : {true, false}) {
        const std::string scale = little ? "-1.0" : "1.0";
        const Image color = decode(file("PF\n2 2\n" + scale + "\n",
                                        {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 70000}, little),
                                   "x.pfm", {})
                                .image();
        EXPECT_EQ(color.encoding(), ColorEncoding::Linear);
        EXPECT_THAT(color.f32(), testing::ElementsAre(6, 7, 8, 9, 10, 70000, 0, 1, 2, 3, 4, 5));
        const Image grey =
            decode(file("Pf\n2 2\n" + scale + "\n", {.25f, .5f, 1, 2}, little), "x.pfm", {})
                .image();
        EXPECT_EQ(grey.channels(), 1);
        EXPECT_THAT(grey.f32(), testing::ElementsAre(1, 2, .25f, .5f));
        const Image small =
            decode(file("PF\n2 2\n" + scale + "\n", {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}, little),
                   "x.pfm", {.maxSide = 1})
                .image();
        EXPECT_THAT(small.f32(), testing::ElementsAre(4.5f, 5.5f, 6.5f));
    }
}

TEST_F(PortableFloatMap, IsRefusedWhereItIsDamaged) {
    const auto starts = [](const char* header) { return file(header, {1, 2, 3}, true); };
    EXPECT_THAT(refusal(starts("PF\n2 2\n-1\n")), testing::HasSubstr("pixels are missing"));
    EXPECT_THAT(refusal(starts("PF\n2 x\n-1\n")), testing::HasSubstr("no numbers"));
    EXPECT_THAT(refusal(starts("PF\n0 2\n-1\n")), testing::HasSubstr("no pixels"));
    EXPECT_THAT(refusal(starts("PF\n-2 -2\n-1\n")), testing::HasSubstr("no pixels"));
    EXPECT_THAT(refusal(starts("PF\n1 1\n0\n")), testing::HasSubstr("byte order"));
    EXPECT_THAT(refusal(starts("PF\n1 1\nnan\n")), testing::HasSubstr("byte order"));
    EXPECT_THAT(refusal(bytesOf("PF\n1 1")), testing::HasSubstr("header"));
    refusal(starts("PF\n2000000000 2000000000\n-1\n"));
}

} // namespace
} // namespace patina
