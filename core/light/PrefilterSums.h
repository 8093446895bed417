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

// Where the radiance of some cells is found: index first + alongX x + alongY y.
struct CellPlaces {
    std::span<const int> x, y; // of as many cells; at most kChunk
    int first = 0, alongX = 1, alongY = 0;
};

struct LobeShape {
    float alpha2;
    // What a single texel is: a point (false), or a disc of its solid angle. A lobe narrower than a
    // texel passes between points.
    bool discs = false;
};

struct PrefilterSums {
    // Weights of `cells` (direction, solid angle; at most kChunk): the lobe's mean kernel times the
    // solid angle; adds them up in `total`. `spread`: half the second moment of a cell's light
    // along an axis over its solid angle: 1/24 for an even square, 0 for a single texel.
    void (*weigh)(const TileDirections& tile, std::span<const glm::vec4> cells, float spread,
                  const LobeShape& shape, CellWeights& weights, float* total);
    // Adds weight · radiance of each cell.
    void (*add)(const CellWeights& weights, const CellPlaces& places, const glm::vec4* radiance,
                TileSums& sums);
    // Adds kernel · flux of each bright texel.
    void (*addBrightTexels)(const TileDirections& tile,
                            std::span<const CubePyramid::BrightTexel> bright,
                            const LobeShape& shape, TileSums& sums);
};

// For the kinds of instructions this machine has, the widest first.
[[nodiscard]] std::span<const PrefilterSums> prefilterSums();

} // namespace patina::detail
