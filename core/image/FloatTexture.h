// A 2D texture or cubemap of linear colours with its mip levels, and the texels in which the
// containers for graphics programs (Ktx2.h, Dds.h) store it.
#pragma once

#include "core/base/AtomicFile.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace patina {

struct FloatTexture {
    int faces = 1;             // 1: 2D; 6: a cubemap, +X -X +Y -Y +Z -Z in OpenGL's orientation
    int width = 0, height = 0; // of level 0, in texels; level i is max(1, size >> i)
    // faces × height × width texels of each level, the top row first.
    std::vector<std::vector<glm::vec3>> levels;

    [[nodiscard]] int levelWidth(int level) const;
    [[nodiscard]] int levelHeight(int level) const;
};

enum class TexelFormat {
    Rgba16F, // half floats, alpha 1
    Rgba32F, // floats, alpha 1
    Rgb9E5   // three mantissas of 9 bits share an exponent; no negative numbers
};

[[nodiscard]] std::size_t texelBytes(TexelFormat format);
// The largest number a format holds: 65504, the largest float, 65408.
[[nodiscard]] float largestValue(TexelFormat format);

struct PackedTexels {
    std::vector<Bytes> levels; // little-endian, face after face
    std::size_t clamped = 0;   // texels with a component beyond largestValue(), which it became
};
// NaN becomes 0, for Rgb9E5 negative numbers too.
[[nodiscard]] PackedTexels packTexels(const FloatTexture& texture, TexelFormat format);

// What a writer of a container returns.
struct EncodedTexture {
    Bytes file;
    std::size_t clamped = 0; // as in PackedTexels
};

// IEEE 754 binary16, rounded to nearest even; beyond ±65504 and infinity become ±65504, NaN 0.
[[nodiscard]] std::uint16_t halfFromFloat(float value);
// EXT_texture_shared_exponent (OpenGL 4.6, section 8.5.2): red in the low bits, exponent on top.
[[nodiscard]] std::uint32_t rgb9e5FromFloat(const glm::vec3& color);

} // namespace patina
