#include "core/math/Sampling.h"

#include <array>
#include <cstddef>

namespace patina {
namespace {

// What the bytes of an index contribute to a dimension of Sobol's sequence, bit-reversed as
// laineKarras() wants it.
using ByteTable = std::array<std::array<std::uint32_t, 256>, 4>;

// Of a primitive polynomial of degree `degree` over GF(2), whose inner coefficients are the bits of
// `coefficients`, and its first direction numbers.
constexpr ByteTable reversedSobol(int degree, std::uint32_t coefficients,
                                  const std::array<std::uint32_t, 3>& first) {
    std::array<std::uint32_t, 32> m{};
    for (int i = 0; i < 32; ++i) {
        if (i < degree) {
            m[i] = first[i];
            continue;
        }
        m[i] = m[i - degree] ^ (m[i - degree] << degree);
        for (int k = 1; k < degree; ++k)
            if ((coefficients >> (degree - 1 - k) & 1u) != 0)
                m[i] ^= m[i - k] << k;
    }
    ByteTable table{};
    for (std::size_t byte = 0; byte < 4; ++byte)
        for (std::size_t value = 0; value < 256; ++value)
            for (std::size_t bit = 0; bit < 8; ++bit)
                if ((value >> bit & 1u) != 0) {
                    const std::size_t i = 8 * byte + bit;
                    table[byte][value] ^= reverseBits(m[i] << (31 - i));
                }
    return table;
}

constexpr ByteTable kThird = reversedSobol(2, 1, {1, 3, 0});
constexpr ByteTable kFourth = reversedSobol(3, 1, {1, 3, 1});

std::uint32_t reversedPoint(const ByteTable& table, std::uint32_t index) {
    return table[0][index & 0xffu] ^ table[1][index >> 8 & 0xffu] ^ table[2][index >> 16 & 0xffu] ^
           table[3][index >> 24];
}

} // namespace

glm::vec4 sobolOwen4D(std::uint32_t index, std::uint32_t seed) {
    const auto scrambled = [seed](std::uint32_t reversed, std::uint32_t salt) {
        return detail::unitFloat(reverseBits(detail::laineKarras(reversed, hash32(seed ^ salt))));
    };
    return {scrambled(index, 0x68bc21ebu),
            scrambled(detail::sobolDimension1Reversed(index), 0x02e5be93u),
            scrambled(reversedPoint(kThird, index), 0x967a889bu),
            scrambled(reversedPoint(kFourth, index), 0x368cc8b7u)};
}

} // namespace patina
