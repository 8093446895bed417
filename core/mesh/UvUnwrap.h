// A UV layout for meshes that have none: charts of similar normals, projected along their mean
// normal, packed into the unit square without overlap and with a margin for baking.
#pragma once

#include "core/mesh/Mesh.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace patina {

// Above this, charts of a texture's size would hold less than a texel per triangle, and the user
// would wait for them.
inline constexpr std::size_t kMaxChartedTriangles = 2'000'000;

struct UnwrapSettings {
    float maxNormalDeviationDeg = 55.0f; // between a chart's axis and its triangles
    float marginTexels = 2.0f;           // around each chart at `resolution`
    int resolution = 1024;
};

// Replaces uvs; vertices on chart borders are split (positions, normals and tangents are copied).
// Deterministic. Needs positions, normals and indices that keep Mesh's promises. `origin`: an entry
// for each vertex, which copies repeat. More than kMaxChartedTriangles get a box projection.
void unwrapUvs(Mesh& mesh, const UnwrapSettings& settings = {},
               std::vector<std::uint32_t>* origin = nullptr);
// The same for several meshes that share one square, all at one scale; at most
// kMaxChartedTriangles together. No chart spans two of them. `origins`: as `origin`, of each mesh.
// Returns the side in texels that the margins are as wide as wanted for: settings.resolution, or
// more where that has no room for all charts.
int unwrapUvsTogether(std::span<Mesh> meshes, const UnwrapSettings& settings,
                      std::span<std::vector<std::uint32_t>> origins);

// True when two triangles cover the same texel of a `resolution`² image by more than its border:
// such UVs (tiled or mirrored) cannot carry a bake.
[[nodiscard]] bool hasOverlappingUvs(const Mesh& mesh, int resolution = 512);

} // namespace patina
