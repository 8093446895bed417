// Merged photos made small, to be looked at: radiance at any exposure, with clipped and disagreeing
// pixels in colours of their own.
#pragma once

#include "core/bracket/BracketMerge.h"

#include <array>
#include <cstdint>
#include <vector>

namespace patina {

// Of the pixels that a small one stands for.
struct MarkedShares {
    float above = 0.0f, below = 0.0f, disagrees = 0.0f; // 0 … 1, each pixel once: the first of them
    [[nodiscard]] float sum() const { return above + below + disagrees; }
};

struct BracketPreview {
    Image image; // F32 RGB, linear
    std::vector<MarkedShares> marks;
};

// Both sides at most `maxSide`; 0: as large as it is.
[[nodiscard]] BracketPreview shrinkMerged(const MergedPhotos& merged, int maxSide);

using MarkColor = std::array<std::uint8_t, 3>; // sRGB
struct MarkColors {
    MarkColor above{255, 64, 160}, below{64, 128, 255}, disagrees{255, 200, 0};
};
inline constexpr MarkColors kMarkColors;

// 8 bits sRGB, of the radiance brightened by `exposureEv`; with or without the marks.
[[nodiscard]] Image drawPreview(const BracketPreview& preview, float exposureEv, bool marks,
                                const MarkColors& colors = kMarkColors);

} // namespace patina
