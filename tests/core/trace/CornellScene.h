// The Cornell box of the data sheet, as its truth was computed: two triangles a side, walls without
// gloss, a black lamp of radiance 1 in a hole of the ceiling, an open front.
#pragma once

#include "core/library/CornellPoints.h"
#include "core/trace/path/TraceInputs.h"

namespace patina::test {

using library::CornellWalls;
using library::kCornellWalls;

// World: the data sheet's millimetres as metres.
[[nodiscard]] TraceInputs cornellBox(const CornellWalls& walls, bool blocks);

} // namespace patina::test
