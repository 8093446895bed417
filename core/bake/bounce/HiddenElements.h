// Vertices that lie within another object, where bounces have nothing to tell, although their
// triangles reach out of it.
#pragma once

#include "core/bake/bounce/HitCache.h"

#include <cstdint>
#include <span>
#include <vector>

namespace patina {

// `hidden`, one per element: many of its rays meet backs, so that it stands within something,
// or close behind it. Moves the points of these to that of the nearest element that is
// not hidden, over one edge of the mesh: their light is then that of the surface beside the object,
// and does not run out from below it as darkness. Where there is none they stay. Returns the
// elements that moved, ascending.
std::vector<std::uint32_t> moveHiddenPoints(const BounceElements& elements,
                                            std::span<const std::uint8_t> hidden,
                                            std::vector<BakePoint>& points);

} // namespace patina
