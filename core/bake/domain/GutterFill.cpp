#include "core/bake/domain/GutterFill.h"

#include "core/base/Check.h"

#include <algorithm>
#include <cstddef>

namespace patina {
namespace {

constexpr int kRings = 4;

void growRing(std::span<float> values, std::vector<std::uint8_t>& known, int side,
              std::size_t channels) {
    const std::vector<std::uint8_t> before = known;
    const auto at = [side](int x, int y) {
        return static_cast<std::size_t>((y + side) % side) * static_cast<std::size_t>(side) +
               static_cast<std::size_t>((x + side) % side);
    };
    std::vector<float> sum(channels);
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            if (before[at(x, y)] != 0)
                continue;
            std::fill(sum.begin(), sum.end(), 0.0f);
            float weight = 0.0f;
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx)
                    if (const std::size_t neighbour = at(x + dx, y + dy); before[neighbour] != 0) {
                        const float w = dx == 0 || dy == 0 ? 2.0f : 1.0f;
                        for (std::size_t c = 0; c < channels; ++c)
                            sum[c] += w * values[neighbour * channels + c];
                        weight += w;
                    }
            if (weight > 0.0f) {
                for (std::size_t c = 0; c < channels; ++c)
                    values[at(x, y) * channels + c] = sum[c] / weight;
                known[at(x, y)] = 1;
            }
        }
    }
}

} // namespace

void fillGutters(std::span<float> values, std::vector<std::uint8_t> known, int side,
                 std::span<const float> fallback) {
    const std::size_t channels = fallback.size();
    CHECK_EQ(values.size(), known.size() * channels);
    CHECK_EQ(known.size(), static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
    if (std::none_of(known.begin(), known.end(), [](std::uint8_t k) { return k != 0; })) {
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = fallback[i % channels];
        return;
    }
    for (int ring = 0; ring < kRings; ++ring)
        growRing(values, known, side, channels);
    if (std::all_of(known.begin(), known.end(), [](std::uint8_t k) { return k != 0; }))
        return;

    // Push: the mean of the known texels of each block of four. Pull: unknown ones take it.
    const int half = (side + 1) / 2;
    const auto halfSide = static_cast<std::size_t>(half), fullSide = static_cast<std::size_t>(side);
    std::vector<float> coarse(halfSide * halfSide * channels, 0.0f);
    std::vector<std::uint8_t> coarseKnown(halfSide * halfSide, 0);
    for (std::size_t y = 0; y < halfSide; ++y)
        for (std::size_t x = 0; x < halfSide; ++x) {
            float* mean = coarse.data() + (y * halfSide + x) * channels;
            float count = 0.0f;
            for (std::size_t v = 2 * y; v < std::min(2 * y + 2, fullSide); ++v)
                for (std::size_t u = 2 * x; u < std::min(2 * x + 2, fullSide); ++u)
                    if (const std::size_t texel = v * fullSide + u; known[texel] != 0) {
                        for (std::size_t c = 0; c < channels; ++c)
                            mean[c] += values[texel * channels + c];
                        count += 1.0f;
                    }
            if (count > 0.0f) {
                for (std::size_t c = 0; c < channels; ++c)
                    mean[c] /= count;
                coarseKnown[y * halfSide + x] = 1;
            }
        }
    fillGutters(coarse, std::move(coarseKnown), half, fallback);
    for (std::size_t y = 0; y < fullSide; ++y)
        for (std::size_t x = 0; x < fullSide; ++x)
            if (known[y * fullSide + x] == 0)
                std::copy_n(coarse.data() + ((y / 2) * halfSide + x / 2) * channels, channels,
                            values.data() + (y * fullSide + x) * channels);
}

} // namespace patina
