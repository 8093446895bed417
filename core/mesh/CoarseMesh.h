// Fewer triangles over the same vertices, for pictures too small to show them all.
#pragma once

#include "core/mesh/Mesh.h"

#include <cstdint>
#include <vector>

namespace patina {

// Clusters the vertices in cubes of this size (metres; nothing comes of one below a 500th of the
// mesh, or where the mesh's own size is no number): all of a cube move onto one of its vertices, so
// that none moves farther than the cube's diagonal. Triangles that lose their area are left out.
// What shares an edge still does, and seams of the texture and of the normals stay seams. Indices
// into the mesh's own vertices. Rossignac and Borrel, "Multi-resolution 3D approximations for
// rendering complex scenes", 1993.
[[nodiscard]] std::vector<std::uint32_t> coarseTriangles(const Mesh& mesh, float cellSize);

} // namespace patina
