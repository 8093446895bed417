// What a displayed picture loses of its surfaces, in numbers. docs/maths/light-sweep.md.
#pragma once

#include <cstddef>
#include <span>

namespace patina {

// Pictures here are the light of pixels that a display shows, planar: red of each, 0…1, then green,
// then blue.

// Between these the display's 8 bits tell light apart: what is encoded below 0.5 / 255 is sent as
// 0, from 254.5 / 255 on as 255.
struct DisplayEnds {
    float black = 0, white = 1;
};

// Shares of the pixels, 0…1.
struct ClippedShares {
    double highlights = 0; // some channel is sent as 255
    double shadows = 0;    // all channels are sent as 0
    [[nodiscard]] double sum() const { return highlights + shadows; }
};
[[nodiscard]] ClippedShares clippedShares(std::span<const float> shown, const DisplayEnds& ends);

// Light that the screen reflects of its room, as a share of its white: what makes its black finite.
// Stokes, Anderson, Chandrasekar & Motta 1996, "A Standard Default Color Space for the Internet -
// sRGB", viewing conditions: a flare of 1 %.
inline constexpr double kScreenFlare = 0.01;

// Stops from the 5th to the 95th percentile (nearest rank) of luminance Y + kScreenFlare:
// log2((Y_95 + f) / (Y_5 + f)), from 0 to 6.66 for half black, half white. The range without
// outliers as Reinhard et al. 2010, "High Dynamic Range Imaging" (2nd ed.), 7.1, measure it.
[[nodiscard]] double contrastStops(std::span<const float> shown);

// The share of the pixels that a difference is looked for in: the worst one in a thousand, at least
// one pixel. Fewer pixels could be one glint, more would hide a failure of a small part.
inline constexpr double kWorstShare = 0.001;

struct DifferenceScore {
    double mean = 0;       // over all
    double worst = 0;      // mean of the worst kWorstShare
    double max = 0;        // the largest …
    std::size_t maxAt = 0; // … and the first index that has it
};
// `values`: one per pixel, not empty.
[[nodiscard]] DifferenceScore differenceScore(std::span<const float> values);

} // namespace patina
