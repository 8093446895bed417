// Whether triangles in the plane overlap, told by their common border alone.
//
// The triangles run counter-clockwise, so that each point is covered by as many of them as their
// border winds around it. The border is the sum of their sides: sides of two that run against each
// other cancel out. It is followed from left to right (M. I. Shamos and D. Hoey, "Geometric
// intersection problems", 1976): where none of its segments meet but at their ends, the number of
// windings changes at segments only, by one at each.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <vector>

namespace patina {

// With the triangles on its left.
using BorderSegment = std::array<glm::dvec2, 2>;

// True where the border surely winds around no point more than once. False where it does, and where
// segments touch or nearly so. Coordinates of a size near 1. O(n log n).
[[nodiscard]] bool windsAtMostOnce(const std::vector<BorderSegment>& border);

} // namespace patina
