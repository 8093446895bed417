// Readers of KTX2 and DDS for tests, written from the specifications and not from the writers:
// OpenImageIO reads neither KTX2 nor a DDS of floating-point numbers.
#pragma once

#include "core/base/AtomicFile.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <glm/vec3.hpp>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace patina::test {

inline std::uint32_t u32(const Bytes& file, std::size_t offset) {
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;)
        value = value << 8 | std::to_integer<std::uint32_t>(file.at(offset + i));
    return value;
}

inline std::uint64_t u64(const Bytes& file, std::size_t offset) {
    return u32(file, offset) | std::uint64_t{u32(file, offset + 4)} << 32;
}

// IEEE 754 binary16 by its definition.
inline double fromHalf(std::uint32_t bits) {
    const double sign = bits & 0x8000 ? -1.0 : 1.0;
    const int exponent = static_cast<int>(bits >> 10 & 31);
    const double mantissa = bits & 1023;
    if (exponent == 31)
        return mantissa != 0 ? std::numeric_limits<double>::quiet_NaN() : sign * INFINITY;
    return exponent == 0 ? sign * std::ldexp(mantissa, -24)
                         : sign * std::ldexp(1024 + mantissa, exponent - 25);
}

// OpenGL 4.6, section 8.25: red = mantissa * 2^(exponent - 15 - 9).
inline glm::dvec3 fromRgb9E5(std::uint32_t bits) {
    const double scale = std::ldexp(1.0, static_cast<int>(bits >> 27) - 24);
    return glm::dvec3(bits & 511, bits >> 9 & 511, bits >> 18 & 511) * scale;
}

// Bytes per texel tell the format: 4 shared exponent, 8 half, 16 float.
inline glm::dvec3 texelAt(const Bytes& file, std::size_t at, std::size_t bytes) {
    if (bytes == 4)
        return fromRgb9E5(u32(file, at));
    if (bytes == 8)
        return {fromHalf(u32(file, at) & 0xffff), fromHalf(u32(file, at) >> 16),
                fromHalf(u32(file, at + 4) & 0xffff)};
    return {std::bit_cast<float>(u32(file, at)), std::bit_cast<float>(u32(file, at + 4)),
            std::bit_cast<float>(u32(file, at + 8))};
}

struct TextureFile {
    int faces = 0, width = 0, height = 0;
    std::size_t texelBytes = 0;
    std::vector<std::vector<glm::dvec3>> levels; // face after face, row after row
};

inline std::vector<glm::dvec3> texelsAt(const Bytes& file, std::size_t at, std::size_t count,
                                        std::size_t bytes) {
    std::vector<glm::dvec3> texels;
    for (std::size_t i = 0; i < count; ++i)
        texels.push_back(texelAt(file, at + i * bytes, bytes));
    return texels;
}

inline TextureFile readKtx2(const Bytes& file) {
    if (file.size() < 80 || std::memcmp(file.data(), "\xabKTX 20\xbb\r\n\x1a\n", 12) != 0)
        throw std::runtime_error("no KTX2 file");
    const std::uint32_t format = u32(file, 12);
    TextureFile texture;
    texture.texelBytes = format == 123 ? 4 : format == 97 ? 8 : 16;
    texture.width = static_cast<int>(u32(file, 20));
    texture.height = static_cast<int>(u32(file, 24));
    texture.faces = static_cast<int>(u32(file, 36));
    for (std::uint32_t level = 0; level < u32(file, 40); ++level) {
        const std::size_t entry = 80 + 24 * std::size_t{level};
        texture.levels.push_back(texelsAt(
            file, u64(file, entry), u64(file, entry + 8) / texture.texelBytes, texture.texelBytes));
    }
    return texture;
}

inline TextureFile readDds(const Bytes& file) {
    if (file.size() < 148 || std::memcmp(file.data(), "DDS ", 4) != 0 ||
        std::memcmp(file.data() + 84, "DX10", 4) != 0)
        throw std::runtime_error("no DDS file with a DX10 header");
    const std::uint32_t format = u32(file, 128);
    TextureFile texture;
    texture.texelBytes = format == 67 ? 4 : format == 10 ? 8 : 16;
    texture.height = static_cast<int>(u32(file, 12));
    texture.width = static_cast<int>(u32(file, 16));
    texture.faces = (u32(file, 136) & 4) != 0 ? 6 : 1;
    texture.levels.resize(u32(file, 28));
    std::size_t at = 148;
    for (int face = 0; face < texture.faces; ++face)
        for (std::size_t level = 0; level < texture.levels.size(); ++level) {
            const auto count = static_cast<std::size_t>(std::max(1, texture.width >> level)) *
                               static_cast<std::size_t>(std::max(1, texture.height >> level));
            const auto texels = texelsAt(file, at, count, texture.texelBytes);
            texture.levels[level].insert(texture.levels[level].end(), texels.begin(), texels.end());
            at += count * texture.texelBytes;
        }
    if (at != file.size())
        throw std::runtime_error("the file has another size than its header says");
    return texture;
}

// The unit direction that texel (x, y) of a face looks along: OpenGL 4.6, table 8.19, solved for
// the direction; first row on top.
inline glm::dvec3 faceDirection(int face, int x, int y, int size) {
    const double s = 2 * (x + 0.5) / size - 1, t = 2 * (y + 0.5) / size - 1;
    const glm::dvec3 directions[6] = {{1, -t, -s}, {-1, -t, s}, {s, 1, t},
                                      {s, -1, -t}, {s, -t, 1},  {-s, -t, -1}};
    const glm::dvec3 d = directions[face];
    return d / std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
}

} // namespace patina::test
