#include "core/image/Qoi.h"

#include "core/base/Check.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

namespace patina {
namespace {

constexpr std::string_view kMagic = "qoif";
constexpr std::size_t kHeaderBytes = 14;
constexpr std::array<std::uint8_t, 8> kEnd{0, 0, 0, 0, 0, 0, 0, 1};
// The first bytes of chunks: whole bytes, or the upper two bits.
constexpr std::uint8_t kRgb = 0xfe, kRgba = 0xff, kIndex = 0x00, kDiff = 0x40, kLuma = 0x80,
                       kRun = 0xc0, kTwoBits = 0xc0;
constexpr int kLongestRun = 62;

struct Pixel {
    std::uint8_t r = 0, g = 0, b = 0, a = 255;
    friend bool operator==(const Pixel&, const Pixel&) = default;
};

// Of the 64 pixels that were seen last. Its own start is transparent black.
struct SeenPixels {
    std::array<Pixel, 64> pixels;
    SeenPixels() { pixels.fill({0, 0, 0, 0}); }
    Pixel& at(const Pixel& p) {
        return pixels[static_cast<std::size_t>((p.r * 3 + p.g * 5 + p.b * 7 + p.a * 11) % 64)];
    }
};

std::uint8_t wrapped(int value) {
    return static_cast<std::uint8_t>(value & 0xff);
}
// The difference as a number from -128 to 127, as both wrap.
int stepFrom(std::uint8_t before, std::uint8_t after) {
    return static_cast<std::int8_t>(wrapped(after - before));
}
bool within(int value, int min, int max) {
    return value >= min && value <= max;
}

} // namespace

std::vector<std::byte> encodeQoi(const Image& image) {
    CHECK(image.type() == PixelType::U8 && image.channels() == 3);
    std::vector<std::byte> file;
    const auto put = [&](int value) { file.push_back(static_cast<std::byte>(wrapped(value))); };
    for (const char c : kMagic)
        put(c);
    for (const int side : {image.width(), image.height()})
        for (int shift = 24; shift >= 0; shift -= 8)
            put(side >> shift);
    put(3); // channels
    put(0); // sRGB
    SeenPixels seen;
    Pixel before;
    int run = 0;
    const auto endRun = [&] {
        if (run > 0)
            put(kRun | (run - 1));
        run = 0;
    };
    const std::span<const std::uint8_t> samples = image.u8();
    for (std::size_t i = 0; i + 2 < samples.size(); i += 3) {
        const Pixel pixel{samples[i], samples[i + 1], samples[i + 2], 255};
        if (pixel == before) {
            if (++run == kLongestRun)
                endRun();
            continue;
        }
        endRun();
        Pixel& known = seen.at(pixel);
        const int r = stepFrom(before.r, pixel.r), g = stepFrom(before.g, pixel.g),
                  b = stepFrom(before.b, pixel.b);
        if (known == pixel) {
            put(kIndex | static_cast<int>(&known - seen.pixels.data()));
        } else if (within(r, -2, 1) && within(g, -2, 1) && within(b, -2, 1)) {
            put(kDiff | (r + 2) << 4 | (g + 2) << 2 | (b + 2));
        } else if (within(g, -32, 31) && within(r - g, -8, 7) && within(b - g, -8, 7)) {
            put(kLuma | (g + 32));
            put((r - g + 8) << 4 | (b - g + 8));
        } else {
            put(kRgb);
            put(pixel.r);
            put(pixel.g);
            put(pixel.b);
        }
        known = pixel;
        before = pixel;
    }
    endRun();
    for (const std::uint8_t byte : kEnd)
        put(byte);
    return file;
}

std::optional<Image> decodeQoi(std::span<const std::byte> file, int maxSide) {
    if (file.size() < kHeaderBytes + kEnd.size())
        return std::nullopt;
    const auto byteAt = [&](std::size_t i) { return std::to_integer<std::uint8_t>(file[i]); };
    const auto sideAt = [&](std::size_t i) {
        return std::uint32_t{byteAt(i)} << 24 | std::uint32_t{byteAt(i + 1)} << 16 |
               std::uint32_t{byteAt(i + 2)} << 8 | byteAt(i + 3);
    };
    for (std::size_t i = 0; i < kMagic.size(); ++i)
        if (byteAt(i) != static_cast<std::uint8_t>(kMagic[i]))
            return std::nullopt;
    const std::uint32_t width = sideAt(4), height = sideAt(8);
    const auto most = static_cast<std::uint32_t>(maxSide);
    if (width == 0 || height == 0 || width > most || height > most)
        return std::nullopt;
    Image image(static_cast<int>(width), static_cast<int>(height), 3, PixelType::U8,
                ColorEncoding::Srgb);
    const std::span<std::uint8_t> samples = image.u8();
    // No chunk is longer than five bytes, so that none reads beyond the end marker.
    const std::size_t end = file.size() - kEnd.size();
    SeenPixels seen;
    Pixel pixel;
    int run = 0;
    std::size_t at = kHeaderBytes;
    for (std::size_t i = 0; i < samples.size(); i += 3) {
        if (run > 0) {
            --run;
        } else {
            if (at >= end)
                return std::nullopt;
            const std::uint8_t first = byteAt(at++);
            if (first == kRgb || first == kRgba) {
                pixel.r = byteAt(at);
                pixel.g = byteAt(at + 1);
                pixel.b = byteAt(at + 2);
                if (first == kRgba)
                    pixel.a = byteAt(at + 3);
                at += first == kRgba ? 4 : 3;
            } else if ((first & kTwoBits) == kIndex) {
                pixel = seen.pixels[first];
            } else if ((first & kTwoBits) == kDiff) {
                pixel.r = wrapped(pixel.r + (first >> 4 & 3) - 2);
                pixel.g = wrapped(pixel.g + (first >> 2 & 3) - 2);
                pixel.b = wrapped(pixel.b + (first & 3) - 2);
            } else if ((first & kTwoBits) == kLuma) {
                const std::uint8_t second = byteAt(at++);
                const int green = (first & 0x3f) - 32;
                pixel.r = wrapped(pixel.r + green - 8 + (second >> 4));
                pixel.g = wrapped(pixel.g + green);
                pixel.b = wrapped(pixel.b + green - 8 + (second & 0x0f));
            } else {
                run = first & 0x3f;
            }
            seen.at(pixel) = pixel;
        }
        samples[i] = pixel.r;
        samples[i + 1] = pixel.g;
        samples[i + 2] = pixel.b;
    }
    return image;
}

} // namespace patina
