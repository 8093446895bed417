#include "core/image/FloatTexture.h"

#include "core/base/Check.h"
#include "core/image/LittleEndian.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace patina {
namespace {

constexpr float kLargestHalf = 65504.0f;
constexpr float kLargestRgb9E5 = 65408.0f; // 511 / 512 · 2^16

void appendTexel(Bytes& out, const glm::vec3& color, TexelFormat format) {
    switch (format) {
    case TexelFormat::Rgba16F:
        for (int c = 0; c < 3; ++c)
            appendLittleEndian(out, halfFromFloat(color[c]));
        appendLittleEndian(out, halfFromFloat(1.0f));
        break;
    case TexelFormat::Rgba32F:
        for (int c = 0; c < 3; ++c)
            appendLittleEndian(
                out, std::bit_cast<std::uint32_t>(std::isnan(color[c]) ? 0.0f : color[c]));
        appendLittleEndian(out, std::bit_cast<std::uint32_t>(1.0f));
        break;
    case TexelFormat::Rgb9E5:
        appendLittleEndian(out, rgb9e5FromFloat(color));
        break;
    }
}

} // namespace

int FloatTexture::levelWidth(int level) const {
    return std::max(1, width >> level);
}

int FloatTexture::levelHeight(int level) const {
    return std::max(1, height >> level);
}

std::size_t texelBytes(TexelFormat format) {
    switch (format) {
    case TexelFormat::Rgba16F:
        return 8;
    case TexelFormat::Rgba32F:
        return 16;
    case TexelFormat::Rgb9E5:
        return 4;
    }
    return 0;
}

float largestValue(TexelFormat format) {
    switch (format) {
    case TexelFormat::Rgba16F:
        return kLargestHalf;
    case TexelFormat::Rgba32F:
        return std::numeric_limits<float>::max();
    case TexelFormat::Rgb9E5:
        return kLargestRgb9E5;
    }
    return 0.0f;
}

PackedTexels packTexels(const FloatTexture& texture, TexelFormat format) {
    CHECK(texture.faces == 1 || texture.faces == 6);
    PackedTexels packed;
    const float largest = largestValue(format);
    for (int i = 0; i < static_cast<int>(texture.levels.size()); ++i) {
        const std::vector<glm::vec3>& level = texture.levels[i];
        CHECK_EQ(level.size(), static_cast<std::size_t>(texture.faces) * texture.levelWidth(i) *
                                   texture.levelHeight(i));
        Bytes& bytes = packed.levels.emplace_back();
        bytes.reserve(level.size() * texelBytes(format));
        for (const glm::vec3& texel : level) {
            if (texel.x > largest || texel.y > largest || texel.z > largest)
                ++packed.clamped;
            appendTexel(bytes, texel, format);
        }
    }
    return packed;
}

std::uint16_t halfFromFloat(float value) {
    if (std::isnan(value))
        return 0;
    const std::uint16_t sign = std::signbit(value) ? 0x8000 : 0;
    const float magnitude = std::min(std::abs(value), kLargestHalf);
    if (magnitude < 0x1p-14f) // subnormal: multiples of 2^-24; nearbyint rounds to even
        return static_cast<std::uint16_t>(
            sign | static_cast<std::uint16_t>(std::nearbyint(magnitude * 0x1p24f)));
    // Rebias the exponent from 127 to 15, then drop 13 of 23 mantissa bits. A carry out of the
    // mantissa is the next exponent, as it should be.
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(magnitude) - ((127u - 15u) << 23);
    const std::uint32_t rounded = bits + 0xfffu + ((bits >> 13) & 1u);
    return static_cast<std::uint16_t>(sign | (rounded >> 13));
}

std::uint32_t rgb9e5FromFloat(const glm::vec3& color) {
    constexpr int kBias = 15, kMantissaBits = 9;
    glm::vec3 c;
    for (int i = 0; i < 3; ++i)
        c[i] = color[i] > 0.0f ? std::min(color[i], kLargestRgb9E5) : 0.0f; // NaN too
    const float brightest = std::max({c.x, c.y, c.z});
    if (brightest == 0.0f)
        return 0;
    int exponent = std::max(-kBias - 1, std::ilogb(brightest)) + 1 + kBias;
    const auto mantissa = [&](float v) {
        return static_cast<std::uint32_t>(
            std::floor(std::ldexp(v, kBias + kMantissaBits - exponent) + 0.5f));
    };
    if (mantissa(brightest) == 1u << kMantissaBits)
        ++exponent; // rounded up to the next power of two
    return mantissa(c.x) | mantissa(c.y) << 9 | mantissa(c.z) << 18 |
           static_cast<std::uint32_t>(exponent) << 27;
}

} // namespace patina
