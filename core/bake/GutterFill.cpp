#include "core/bake/GutterFill.h"

#include "core/base/Check.h"

#include <algorithm>
#include <cstddef>

namespace patina {
namespace {

constexpr int kRings = 4;

void growRing(std::span<float> values, std::vector<std::uint8_t>& known, int side) {
    const std::vector<std::uint8_t> before = known;
    const auto at = [side](int x, int y) {
        return static_cast<std::size_t>((y + side) % side) * static_cast<std::size_t>(side) +
               static_cast<std::size_t>((x + side) % side);
    };
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            if (before[at(x, y)] != 0)
                continue;
            float sum = 0.0f, weight = 0.0f;
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx)
                    if (before[at(x + dx, y + dy)] != 0) {
                        const float w = dx == 0 || dy == 0 ? 2.0f : 1.0f;
                        sum += w * values[at(x + dx, y + dy)];
                        weight += w;
                    }
            if (weight > 0.0f) {
                values[at(x, y)] = sum / weight;
                known[at(x, y)] = 1;
            }
        }
    }
}

} // namespace

void fillGutters(std::span<float> values, std::vector<std::uint8_t> known, int side,
                 float fallback) {
    CHECK_EQ(values.size(), known.size());
    CHECK_EQ(values.size(), static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
    if (std::none_of(known.begin(), known.end(), [](std::uint8_t k) { return k != 0; })) {
        std::fill(values.begin(), values.end(), fallback);
        return;
    }
    for (int ring = 0; ring < kRings; ++ring)
        growRing(values, known, side);
    if (std::all_of(known.begin(), known.end(), [](std::uint8_t k) { return k != 0; }))
        return;

    // Push: the mean of the known texels of each block of four. Pull: unknown ones take it.
    const int half = (side + 1) / 2;
    const auto halfSide = static_cast<std::size_t>(half), fullSide = static_cast<std::size_t>(side);
    std::vector<float> coarse(halfSide * halfSide, 0.0f);
    std::vector<std::uint8_t> coarseKnown(coarse.size(), 0);
    for (std::size_t y = 0; y < halfSide; ++y)
        for (std::size_t x = 0; x < halfSide; ++x) {
            float sum = 0.0f, count = 0.0f;
            for (std::size_t v = 2 * y; v < std::min(2 * y + 2, fullSide); ++v)
                for (std::size_t u = 2 * x; u < std::min(2 * x + 2, fullSide); ++u)
                    if (known[v * fullSide + u] != 0) {
                        sum += values[v * fullSide + u];
                        count += 1.0f;
                    }
            if (count > 0.0f) {
                coarse[y * halfSide + x] = sum / count;
                coarseKnown[y * halfSide + x] = 1;
            }
        }
    fillGutters(coarse, std::move(coarseKnown), half, fallback);
    for (std::size_t y = 0; y < fullSide; ++y)
        for (std::size_t x = 0; x < fullSide; ++x)
            if (known[y * fullSide + x] == 0)
                values[y * fullSide + x] = coarse[(y / 2) * halfSide + x / 2];
}

} // namespace patina
