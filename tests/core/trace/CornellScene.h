// The Cornell box of the data sheet, as its truth was computed: two triangles a side, walls without
// gloss, a black lamp of radiance 1 in a hole of the ceiling, an open front.
#pragma once

#include "core/trace/path/TraceInputs.h"

#include <array>
#include <glm/vec3.hpp>

namespace patina::test {

struct CornellWalls {
    glm::vec3 white, red, green; // linear sRGB
};
// Under D65, and as renderers often have it.
inline const std::array<CornellWalls, 2> kCornellWalls{{
    {{.738239f, .735992f, .738601f},
     {.493880f, .048870f, .051155f},
     {.068413f, .398461f, .086545f}},
    {{.725f, .71f, .68f}, {.63f, .065f, .05f}, {.14f, .45f, .091f}},
}};

// World: the data sheet's millimetres as metres.
[[nodiscard]] TraceInputs cornellBox(const CornellWalls& walls, bool blocks);

} // namespace patina::test
