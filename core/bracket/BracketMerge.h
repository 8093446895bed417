// One picture of radiance from aligned photos whose response is known: the weighted mean of what
// each says, and where none of them, or no two alike, say it. docs/maths/bracket.md.
#pragma once

#include "core/bracket/PhotoRows.h"
#include "core/bracket/ResponseCurve.h"
#include "core/job/JobContext.h"

#include <cstdint>
#include <span>
#include <vector>

namespace patina {

// What is wrong with a pixel of the result; any of its channels will do.
inline constexpr std::uint8_t kClippedAbove = 1; // white in every photo: at least so bright
inline constexpr std::uint8_t kClippedBelow = 2; // black in every photo: at most so bright
inline constexpr std::uint8_t kDisagrees = 4; // photos say different radiances beyond their noise

struct MergedPhotos {
    Image image;                     // F32 RGB, linear
    std::vector<std::uint8_t> marks; // for each pixel
};

// What a linear photo's response is: the code itself.
[[nodiscard]] LogResponse linearResponse();

// `photos` by rising exposure, all of one size and channel count, with their shifts.
// `responses`: one for each channel of theirs. A photo of exposure 1 (0 EV) whose code is kMidCode
// has the radiance of that code under the sRGB curve, so that the result looks at 0 EV as the photo
// in the middle does; a linear one has its own values. Meaningless after a cancel.
[[nodiscard]] MergedPhotos mergePhotos(std::span<const Photo> photos,
                                       std::span<const RecoveredResponse> responses,
                                       const JobContext& job = {});

// Pixels with the mark, of all, 0 … 1.
[[nodiscard]] double shareOf(std::span<const std::uint8_t> marks, std::uint8_t mark);

} // namespace patina
