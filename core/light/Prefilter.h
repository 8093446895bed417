// Filtering a cubemap with the GGX lobe, without random numbers: for each tile of output texels the
// mip pyramid is walked once and gives a list of cells, small near the lobe's peak and larger far
// from it; the lobe's mean over each cell, in closed form, is the cell's weight. The list and the
// weights depend on geometry only, so 48 tiles share them that a symmetry of the cube carries into
// each other. Texels that stand out of their neighbourhood are summed one by one. No noise, no
// fireflies, the same result on any number of threads.
#pragma once

#include "core/job/JobContext.h"
#include "core/light/CubePyramid.h"
#include "core/light/Ibl.h"

namespace patina {

// How far a cell may be from a point: its width at most `relative` · (angle to the tile + 2 alpha)
// and at most `widest` radians.
struct PrefilterQuality {
    float relative = 0.09f;
    float widest = 0.0315f;
};

// Radiance seen through a GGX lobe with N = V = R (Karis 2013): the mean over l with weight
// D(h) N·L, where (N·H)² = (1 + N·L) / 2. alpha > 0; alpha = 1 gives irradiance / pi. `size`: a
// power of two. Meaningless after a cancel.
[[nodiscard]] CubeLevel prefilterGGX(const CubePyramid& pyramid, int size, float alpha,
                                     const PrefilterQuality& quality, const JobContext& job);

} // namespace patina
