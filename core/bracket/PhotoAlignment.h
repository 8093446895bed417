// How far photos of a bracket are shifted against each other: whole pixels, by median threshold
// bitmaps, which look alike at every exposure.
// G. Ward, "Fast, Robust Image Registration for Compositing High Dynamic Range Photographs from
// Hand-Held Exposures", Journal of Graphics Tools 8(2), 2003.
#pragma once

#include "core/bracket/PhotoRows.h"
#include "core/job/JobContext.h"

#include <span>
#include <vector>

namespace patina {

inline constexpr int kMaxPhotoShift = 64; // pixels, either way; less in pictures under 256 pixels

// Shifts against the photo in the middle, whose own is none. `photos` in the order of their
// exposures: neighbours are compared. A pair in which nothing can be compared (both black, or
// white) has no shift. Meaningless after a cancel.
[[nodiscard]] std::vector<PhotoShift> findShifts(std::span<const Photo> photos,
                                                 const JobContext& job = {});

// The photo that the others are shifted to.
[[nodiscard]] inline std::size_t referencePhoto(std::size_t count) {
    return count / 2;
}

} // namespace patina
