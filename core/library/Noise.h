// Noises that tile: gradient noise and its sums, Voronoi cells, random strokes. Frequencies count
// lattice cells per tile; the same seed gives the same bytes on every machine.
#pragma once

#include "core/library/Field.h"

#include <cstdint>

namespace patina::library {

// A well-mixed 32-bit hash of lattice coordinates ("lowbias32" of Chris Wellons).
inline std::uint32_t hashInt(std::uint32_t x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    x ^= x >> 16;
    return x;
}
inline std::uint32_t hashInt(std::uint32_t x, std::uint32_t y, std::uint32_t seed) {
    return hashInt(x + hashInt(y + hashInt(seed)));
}
// 0 ≤ value < 1, exact in float.
inline float hashToFloat(std::uint32_t h) {
    return static_cast<float>(h >> 8) * (1.0f / 16777216.0f);
}

// Perlin's gradient noise with the quintic fade, about -1…1.
Field gradientNoise(int size, int cellsX, int cellsY, std::uint32_t seed);

struct FbmSettings {
    int cellsX = 4, cellsY = 4; // of the first octave; each further one doubles them
    int octaves = 5;
    float gain = 0.5f; // amplitude of an octave relative to the one before
    std::uint32_t seed = 0;
};
// Sum of octaves, divided by the sum of amplitudes: about -0.7…0.7.
Field fbm(int size, const FbmSettings& settings);
// Sum of (1 - |noise|)²: crests, 0…1.
Field ridged(int size, const FbmSettings& settings);

// Distances are in cells. `edge` is the distance to the nearest border between two cells.
struct VoronoiCells {
    Field nearest; // F1
    Field edge;
    Field random; // 0…1, one per cell
};
VoronoiCells voronoi(int size, int cellsX, int cellsY, float jitter, std::uint32_t seed);

// Strokes of random position: each pixel receives the strongest stroke over it, 0…1.
struct StrokeSettings {
    int count = 50;
    float minLength = 20.0f, maxLength = 120.0f; // pixels
    float halfWidth = 0.8f;                      // pixels
    float directionDeg = 0.0f, spreadDeg = 180.0f;
    std::uint32_t seed = 0;
};
Field strokes(int size, const StrokeSettings& settings);

} // namespace patina::library
