// The arithmetic of the prefilter for a tile of 8 × 8 output texels, in SIMD as wide as the machine
// has. Used by Prefilter.cpp only.
#pragma once

#include "core/light/CubePyramid.h"

#include <span>

namespace patina::detail {

constexpr int kTileTexels = 64;
constexpr int kChunk =
    64; // cells that are weighed at a time: their weights stay in the first cache

struct alignas(64) TileDirections {
    float x[kTileTexels], y[kTileTexels], z[kTileTexels]; // unit vectors
};

struct alignas(64) TileSums {
    float red[kTileTexels] = {}, green[kTileTexels] = {}, blue[kTileTexels] = {};
};

struct alignas(64) CellWeights {
    float of[kChunk][kTileTexels];
};

struct PrefilterSums {
    // Weights of `cells` (direction, solid angle; at most kChunk): the lobe's kernel times the
    // solid angle; adds them up in `total`.
    void (*weigh)(const TileDirections& tile, std::span<const glm::vec4> cells, float alpha2,
                  CellWeights& weights, float* total);
    // Adds weight · radiance[index] of each cell.
    void (*add)(const CellWeights& weights, std::span<const int> index, const glm::vec4* radiance,
                TileSums& sums);
    // Adds kernel · flux of each lamp.
    void (*addLamps)(const TileDirections& tile, std::span<const CubePyramid::Lamp> lamps,
                     float alpha2, TileSums& sums);
};

// For the kinds of instructions this machine has, the widest first.
[[nodiscard]] std::span<const PrefilterSums> prefilterSums();

} // namespace patina::detail
