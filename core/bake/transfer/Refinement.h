// Where more rays do the most good: which points of a bake to refine so that its error comes down
// to a tolerance.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace patina {

// What is known of one point.
struct PointError {
    float error = 0.0f; // estimated standard error
    int rays = 0;       // that it rests on
};

// 1 for each point that should double its rays; all 0 when the RMS of the errors is `tolerance` or
// less, or when no point that matters may have more than `maxRays`.
//
// An error falls as c N^-a with N rays; a = 0.83 for scrambled nets on transfer (measured). The
// fewest rays for a given sum of squares go where c²N^-2a falls fastest: N* = s c^(2 / (2a + 1)),
// s from the tolerance. A point is refined while it has less than N* / sqrt(2), so that doubling
// brings it closer. Edges of shadows then get many rays, open and dark places few.
[[nodiscard]] std::vector<std::uint8_t> pointsToRefine(std::span<const PointError> points,
                                                       float tolerance, int maxRays);

} // namespace patina
