#include "core/mesh/Weld.h"

#include "core/base/Check.h"

#include <array>
#include <bit>
#include <limits>

namespace patina {
namespace {

constexpr std::uint32_t kFree = std::numeric_limits<std::uint32_t>::max();

std::uint32_t keyBits(float value) {
    return value == 0.0f ? 0u : std::bit_cast<std::uint32_t>(value); // -0 is 0
}

// The number of rows and the floats that each of several arrays adds to one.
struct Rows {
    std::size_t count;
    struct Part {
        const float* first;
        std::size_t stride;
    };
    std::span<const Part> parts;
};

std::uint64_t hashRow(const Rows& rows, std::size_t row) {
    std::uint64_t h = 0x9e3779b97f4a7c15ull;
    for (const auto& [first, stride] : rows.parts)
        for (std::size_t i = 0; i < stride; ++i) {
            h = (h ^ keyBits(first[row * stride + i])) * 0xff51afd7ed558ccdull;
            h ^= h >> 32;
        }
    return h;
}

bool sameRow(const Rows& rows, std::size_t a, std::size_t b) {
    for (const auto& [first, stride] : rows.parts)
        for (std::size_t i = 0; i < stride; ++i)
            if (keyBits(first[a * stride + i]) != keyBits(first[b * stride + i]))
                return false;
    return true;
}

std::vector<std::uint32_t> firstEqual(const Rows& rows) {
    const std::size_t count = rows.count;
    CHECK_LT(count, std::size_t{kFree});

    // Open addressing with linear probing, at most half full.
    std::vector<std::uint32_t> table(std::bit_ceil(2 * count + 1), kFree);
    const std::size_t mask = table.size() - 1;
    std::vector<std::uint32_t> first(count);
    for (std::size_t i = 0; i < count; ++i) {
        std::size_t slot = hashRow(rows, i) & mask;
        while (table[slot] != kFree && !sameRow(rows, table[slot], i))
            slot = (slot + 1) & mask;
        if (table[slot] == kFree)
            table[slot] = static_cast<std::uint32_t>(i);
        first[i] = table[slot];
    }
    return first;
}

template <class T>
Rows::Part part(std::span<const T> values) {
    static_assert(sizeof(T) == T::length() * sizeof(float));
    return {&values.front().x, static_cast<std::size_t>(T::length())};
}

} // namespace

std::vector<std::uint32_t> firstEqualRow(std::span<const float> rows, std::size_t stride) {
    CHECK(stride > 0);
    CHECK_EQ(rows.size() % stride, std::size_t{0});
    const Rows::Part whole{rows.data(), stride};
    return firstEqual({rows.size() / stride, {&whole, 1}});
}

std::vector<std::uint32_t> weldPositions(std::span<const glm::vec3> positions) {
    if (positions.empty())
        return {};
    const Rows::Part only = part(positions);
    return firstEqual({positions.size(), {&only, 1}});
}

std::vector<std::uint32_t> weldVertices(std::span<const glm::vec3> positions,
                                        std::span<const glm::vec3> normals,
                                        std::span<const glm::vec2> uvs) {
    CHECK_EQ(normals.size(), positions.size());
    CHECK_EQ(uvs.size(), positions.size());
    if (positions.empty())
        return {};
    const std::array parts{part(positions), part(normals), part(uvs)};
    return firstEqual({positions.size(), parts});
}

} // namespace patina
