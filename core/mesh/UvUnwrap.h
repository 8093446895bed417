// A UV layout for meshes that have none: charts of similar normals, projected along their mean
// normal, packed into the unit square without overlap and with a margin for baking.
#pragma once

#include "core/mesh/Mesh.h"

namespace patina {

struct UnwrapSettings {
    float maxNormalDeviationDeg = 55.0f; // between a chart's axis and its triangles
    float marginTexels = 2.0f;           // around each chart at `resolution`
    int resolution = 1024;
};

// Replaces uvs; vertices on chart borders are split (positions, normals and tangents are copied).
// Deterministic. Needs positions, normals and indices that keep Mesh's promises. `origin`: an entry
// for each vertex, which copies repeat.
void unwrapUvs(Mesh& mesh, const UnwrapSettings& settings = {},
               std::vector<std::uint32_t>* origin = nullptr);

// True when two triangles cover the same texel of a `resolution`² image by more than its border:
// such UVs (tiled or mirrored) cannot carry a bake.
[[nodiscard]] bool hasOverlappingUvs(const Mesh& mesh, int resolution = 512);

} // namespace patina
