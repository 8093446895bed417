#include "core/mesh/Weld.h"

#include "core/base/Check.h"

#include <bit>
#include <limits>

namespace patina {
namespace {

constexpr std::uint32_t kFree = std::numeric_limits<std::uint32_t>::max();

std::uint32_t keyBits(float value) {
    return value == 0.0f ? 0u : std::bit_cast<std::uint32_t>(value); // -0 is 0
}

std::uint64_t hashRow(const float* row, std::size_t stride) {
    std::uint64_t h = 0x9e3779b97f4a7c15ull;
    for (std::size_t i = 0; i < stride; ++i) {
        h = (h ^ keyBits(row[i])) * 0xff51afd7ed558ccdull;
        h ^= h >> 32;
    }
    return h;
}

bool sameRow(const float* a, const float* b, std::size_t stride) {
    for (std::size_t i = 0; i < stride; ++i)
        if (keyBits(a[i]) != keyBits(b[i]))
            return false;
    return true;
}

} // namespace

std::vector<std::uint32_t> firstEqualRow(std::span<const float> rows, std::size_t stride) {
    CHECK(stride > 0);
    CHECK_EQ(rows.size() % stride, std::size_t{0});
    const std::size_t count = rows.size() / stride;
    CHECK_LT(count, std::size_t{kFree});

    // Open addressing with linear probing, at most half full.
    std::vector<std::uint32_t> table(std::bit_ceil(2 * count + 1), kFree);
    const std::size_t mask = table.size() - 1;
    std::vector<std::uint32_t> first(count);
    for (std::size_t i = 0; i < count; ++i) {
        const float* row = rows.data() + i * stride;
        std::size_t slot = hashRow(row, stride) & mask;
        while (table[slot] != kFree && !sameRow(rows.data() + table[slot] * stride, row, stride))
            slot = (slot + 1) & mask;
        if (table[slot] == kFree)
            table[slot] = static_cast<std::uint32_t>(i);
        first[i] = table[slot];
    }
    return first;
}

std::vector<std::uint32_t> weldPositions(std::span<const glm::vec3> positions) {
    static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
    if (positions.empty())
        return {};
    return firstEqualRow({&positions.front().x, 3 * positions.size()}, 3);
}

} // namespace patina
