// Where to sample: a progressive low-discrepancy sequence, and warps of its points to directions.
#pragma once

#include "core/math/Shading.h"

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace patina {

// An avalanching integer hash (Wellons' hash prospector, "lowbias32").
[[nodiscard]] constexpr std::uint32_t hash32(std::uint32_t x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    x ^= x >> 16;
    return x;
}

// The seed of one element's (vertex', texel's, pixel's) sequence, or of one more pair of
// dimensions.
[[nodiscard]] constexpr std::uint32_t seedFor(std::uint32_t seed, std::uint32_t element) {
    return hash32(seed ^ hash32(element + 0x9e3779b9u));
}

[[nodiscard]] constexpr std::uint32_t reverseBits(std::uint32_t x) {
    x = (x >> 16) | (x << 16);
    x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
    x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
    x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
    x = ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
    return x;
}

namespace detail {

// Owen scrambling from the lowest bit upwards: each bit flips depending on the bits below it only.
// Laine & Karras 2011 with the constants of Vegdahl 2021 ("Building a Better LK Hash").
[[nodiscard]] constexpr std::uint32_t laineKarras(std::uint32_t x, std::uint32_t seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

// Bit-reversed second dimension of Sobol' (the first is the reversed index itself): the Pascal
// triangle modulo 2 as a butterfly, one step per block size (direction numbers v ^= v >> 1).
[[nodiscard]] constexpr std::uint32_t sobolDimension1Reversed(std::uint32_t index) {
    index ^= index >> 16;
    index ^= (index & 0xff00ff00u) >> 8;
    index ^= (index & 0xf0f0f0f0u) >> 4;
    index ^= (index & 0xccccccccu) >> 2;
    index ^= (index & 0xaaaaaaaau) >> 1;
    return index;
}

// 24 bits: all that a float below 1 can hold.
[[nodiscard]] constexpr float unitFloat(std::uint32_t x) {
    return static_cast<float>(x >> 8) * 0x1p-24f;
}

} // namespace detail

// Point `index` of an Owen-scrambled Sobol' sequence in [0, 1)². Any 2^k points that start at a
// multiple of 2^k form a (0, k, 2)-net: one point in every elementary interval of area 2^-k. The
// seed shuffles the order too, so that sequences of different seeds (see seedFor) may be paired to
// more dimensions. Burley 2020, "Practical Hash-based Owen Scrambling", JCGT 9(4), section 4.
[[nodiscard]] constexpr glm::vec2 sobolOwen2D(std::uint32_t index, std::uint32_t seed) {
    const std::uint32_t shuffled =
        reverseBits(detail::laineKarras(reverseBits(index), hash32(seed)));
    const std::uint32_t x = detail::laineKarras(shuffled, hash32(seed ^ 0x68bc21ebu));
    const std::uint32_t y =
        detail::laineKarras(detail::sobolDimension1Reversed(shuffled), hash32(seed ^ 0x02e5be93u));
    return {detail::unitFloat(reverseBits(x)), detail::unitFloat(reverseBits(y))};
}

// The same in four dimensions, which are well spread together: any 2^k points that start at a
// multiple of 2^k. For integrals that depend on all of them at once, as where a ray from a random
// point in a random direction ends, the error at 256 points is 2/3 of that of two pairs, at 4096
// less than half. Direction numbers: Joe & Kuo 2008, "Constructing Sobol Sequences with Better
// Two-Dimensional Projections".
[[nodiscard]] glm::vec4 sobolOwen4D(std::uint32_t index, std::uint32_t seed);

// The warps and densities of shaders/shared/sampling.glsl.
using shading::brdfPdf;
using shading::concentricDisc;
using shading::cosineHemisphere;
using shading::cosineHemispherePdf;
using shading::orthonormalBasis;
using shading::sampleBrdf;
using shading::sampleVndfGGX;
using shading::uniformSphere;
using shading::vndfReflectionPdf;

} // namespace patina
