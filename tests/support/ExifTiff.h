// A photo as a camera's program may write it: TIFF of 8 bits, not compressed, with its exposure in
// Exif. Byte by byte: what is written by the library that reads it would prove less, and the
// editor's tests do not link it.
#pragma once

#include "core/image/Image.h"

#include <cmath>
#include <cstdint>
#include <string>

namespace patina::test {

// `image`: U8 RGB. `seconds` of exposure at f/8; 0: the file says nothing. (Of a TIFF's ISO
// OpenImageIO 2.4 makes nothing.)
inline std::string tiffWithExposure(const Image& image, double seconds) {
    std::string file("II*\0", 4);
    const auto put16 = [&](std::uint32_t value) {
        file += static_cast<char>(value & 0xffu);
        file += static_cast<char>(value >> 8u & 0xffu);
    };
    const auto put32 = [&](std::uint32_t value) {
        put16(value & 0xffffu);
        put16(value >> 16u);
    };
    const auto entry = [&](std::uint32_t tag, std::uint32_t type, std::uint32_t count,
                           std::uint32_t value) {
        put16(tag);
        put16(type);
        put32(count);
        put32(value);
    };
    constexpr std::uint32_t kShort = 3, kLong = 4, kRational = 5;
    constexpr std::uint32_t kEntries = 10, kExifEntries = 2;
    // Where things lie: the directory, bits of the channels, Exif's directory, its numbers, pixels.
    constexpr std::uint32_t kFirst = 8, kBits = kFirst + 2 + 12 * kEntries + 4, kExif = kBits + 6,
                            kTime = kExif + 2 + 12 * kExifEntries + 4, kAperture = kTime + 8,
                            kPixels = kAperture + 8;
    const auto width = static_cast<std::uint32_t>(image.width());
    const auto height = static_cast<std::uint32_t>(image.height());
    const bool known = seconds > 0.0;
    put32(kFirst);
    put16(kEntries);
    entry(256, kLong, 1, width);
    entry(257, kLong, 1, height);
    entry(258, kShort, 3, kBits);
    entry(259, kShort, 1, 1); // not compressed
    entry(262, kShort, 1, 2); // RGB
    entry(273, kLong, 1, kPixels);
    entry(277, kShort, 1, 3);
    entry(278, kLong, 1, height);
    entry(279, kLong, 1, 3 * width * height);
    entry(34665, kLong, 1, kExif);
    put32(0);
    for (int channel = 0; channel < 3; ++channel)
        put16(8);
    put16(kExifEntries);
    entry(33434, kRational, 1, kTime);
    entry(33437, kRational, 1, kAperture);
    put32(0);
    put32(static_cast<std::uint32_t>(std::lround(1e6 * seconds)));
    put32(1'000'000);
    put32(known ? 80 : 0);
    put32(10);
    file.append(reinterpret_cast<const char*>(image.u8().data()), image.u8().size());
    return file;
}

} // namespace patina::test
