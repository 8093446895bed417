// QOI files and Base64 texts: nothing is lost, nothing is believed.

#include "core/image/Qoi.h"
#include "core/base/Base64.h"

#include <gtest/gtest.h>
#include <random>
#include <string>

namespace patina {
namespace {

std::vector<std::byte> bytesOf(std::initializer_list<int> values) {
    std::vector<std::byte> bytes;
    for (const int value : values)
        bytes.push_back(static_cast<std::byte>(value));
    return bytes;
}

// Areas, gradients and noise: every kind of chunk.
Image picture(std::mt19937& random, int width, int height) {
    Image image(width, height, 3, PixelType::U8, ColorEncoding::Srgb);
    std::uint8_t value[3]{};
    for (std::size_t i = 0; i < image.u8().size(); i += 3) {
        const unsigned kind = random() % 5;
        for (std::size_t c = 0; c < 3; ++c) {
            if (kind == 1)
                value[c] = static_cast<std::uint8_t>(value[c] + random() % 4 - 2);
            if (kind == 2)
                value[c] = static_cast<std::uint8_t>(value[c] + random() % 16);
            if (kind == 3)
                value[c] = static_cast<std::uint8_t>(random());
            if (kind == 4)
                value[c] = static_cast<std::uint8_t>(random() % 2 * 50);
            image.u8()[i + c] = value[c];
        }
    }
    return image;
}

TEST(Qoi, GivesBackWhatItWasGiven) {
    std::mt19937 random(5);
    for (const auto& [width, height] : {std::pair{1, 1}, {160, 90}, {256, 256}, {3, 200}}) {
        const Image image = picture(random, width, height);
        const std::optional<Image> back = decodeQoi(encodeQoi(image), 256);
        ASSERT_TRUE(back.has_value());
        EXPECT_EQ(*back, image);
    }
    const Image black(200, 200, 3, PixelType::U8, ColorEncoding::Srgb);
    EXPECT_LT(encodeQoi(black).size(), 700u) << "runs of 62";
    EXPECT_EQ(*decodeQoi(encodeQoi(black), 256), black);
    EXPECT_FALSE(decodeQoi(encodeQoi(black), 199).has_value());
}

// By hand after the specification: one red pixel, one of +1, -2, 0, a run of three.
TEST(Qoi, WritesWhatTheSpecificationSays) {
    Image image(5, 1, 3, PixelType::U8, ColorEncoding::Srgb);
    const std::uint8_t values[] = {200, 10, 10, 201, 8, 10, 201, 8, 10, 201, 8, 10, 201, 8, 10};
    std::ranges::copy(values, image.u8().begin());
    EXPECT_EQ(encodeQoi(image), bytesOf({'q',
                                         'o',
                                         'i',
                                         'f',
                                         0,
                                         0,
                                         0,
                                         5,
                                         0,
                                         0,
                                         0,
                                         1,
                                         3,
                                         0,
                                         0xfe,
                                         200,
                                         10,
                                         10,
                                         0x40 | 3 << 4 | 0 << 2 | 2,
                                         0xc0 | 2,
                                         0,
                                         0,
                                         0,
                                         0,
                                         0,
                                         0,
                                         0,
                                         1}));
}

TEST(Qoi, DamagedFilesAreRefusedOrDecodeToSomePicture) {
    std::mt19937 random(9);
    const std::vector<std::byte> whole = encodeQoi(picture(random, 40, 30));
    for (int round = 0; round < 3000; ++round) {
        std::vector<std::byte> file = whole;
        if (round % 2 == 0)
            file.resize(random() % file.size());
        for (int i = 0; i < 4 && !file.empty(); ++i)
            file[random() % file.size()] = static_cast<std::byte>(random());
        const std::optional<Image> image = decodeQoi(file, 256);
        if (image) {
            EXPECT_LE(image->width(), 256);
            EXPECT_LE(image->height(), 256);
        }
    }
}

TEST(Base64, IsThatOfTheStandard) {
    // RFC 4648, section 10
    const std::pair<std::string, std::string> cases[] = {{"", ""},
                                                         {"f", "Zg=="},
                                                         {"fo", "Zm8="},
                                                         {"foo", "Zm9v"},
                                                         {"foob", "Zm9vYg=="},
                                                         {"fooba", "Zm9vYmE="},
                                                         {"foobar", "Zm9vYmFy"}};
    for (const auto& [plain, text] : cases) {
        const auto bytes = std::as_bytes(std::span(plain.data(), plain.size()));
        EXPECT_EQ(toBase64(bytes), text);
        EXPECT_EQ(fromBase64(text), std::vector<std::byte>(bytes.begin(), bytes.end()));
    }
    for (const char* wrong : {"Zg=", "Zg", "Zh==", "Zm9=", "Z===", "====", "Zm9v Zm9v", "Zm\n9"})
        EXPECT_FALSE(fromBase64(wrong).has_value()) << wrong;
}

} // namespace
} // namespace patina
