// Which triangles share an edge, over welded positions.
#pragma once

#include "core/mesh/Mesh.h"

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace patina {

inline constexpr std::uint32_t kNoTriangle = std::numeric_limits<std::uint32_t>::max();

// For edge e (corner e to e + 1) of each triangle the neighbour across it, or kNoTriangle: at a
// border, where more than two triangles meet, and where the neighbour is wound the other way round.
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> triangleAdjacency(const Mesh& mesh);

} // namespace patina
