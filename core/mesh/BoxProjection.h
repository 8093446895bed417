// UVs by projection along the nearest of the six axes, each axis in a square cell of its own (three
// by two). Linear in time and memory; parts that lie behind each other overlap.
#pragma once

#include "core/mesh/Mesh.h"

namespace patina {

// Replaces uvs; vertices between two axes are split. For meshes too large for charts. `origin`: an
// entry for each vertex, which copies repeat.
void boxProjectUvs(Mesh& mesh, std::vector<std::uint32_t>* origin = nullptr);

} // namespace patina
