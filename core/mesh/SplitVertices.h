// Splitting vertices by a label of their triangles: a chart, a projection axis.
#pragma once

#include "core/mesh/Mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace patina {

// Gives every vertex exactly one label: vertices used by triangles of several labels are repeated
// once per further label (positions, normals and tangents are copied, UVs are dropped). `labels`
// has one entry per triangle. Returns the label of each vertex; vertices without triangles get 0.
// `origin`: an entry for each vertex, which copies repeat.
std::vector<std::uint32_t> splitVertices(Mesh& mesh, std::span<const std::uint32_t> labels,
                                         std::vector<std::uint32_t>* origin = nullptr);

} // namespace patina
