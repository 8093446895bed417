// Splitting triangles where something on them changes faster than they can show. The surface stays
// what it was: new vertices lie on the middles of edges.
#pragma once

#include "core/mesh/Mesh.h"

#include <cstdint>
#include <span>

namespace patina {

// Splits every triangle with `split` set (one per triangle) into four, and its neighbours so that
// no vertex comes to lie on an edge. Where a triangle is split at all its longest edge is (Rivara
// 1984, "Mesh refinement processes based on the generalized bisection of simplices"): angles stay
// bounded however often it is repeated. Edges shorter than `minEdge` (metres) are not split.
// Vertices keep their numbers; new ones come after them with interpolated normals, tangents and
// UVs. Where positions are shared, across UV seams and creases too, both sides are split alike.
[[nodiscard]] Mesh refineMesh(const Mesh& mesh, std::span<const std::uint8_t> split,
                              float minEdge = 0.0f);

} // namespace patina
