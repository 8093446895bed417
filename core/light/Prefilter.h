// Filtering a cubemap with the GGX lobe, without random numbers: for each tile of output texels the
// mip pyramid is walked once and gives a list of cells, small near the lobe's peak and larger far
// from it; the lobe's closed form is then summed over that list. No noise, no fireflies, the same
// result on any number of threads.
#pragma once

#include "core/job/JobContext.h"
#include "core/light/Ibl.h"

#include <glm/vec4.hpp>
#include <vector>

namespace patina {

// How far a cell may be from a point: its width at most `relative` · (angle to the tile + 2 alpha)
// and at most `widest` radians.
struct PrefilterQuality {
    float relative = 0.2f;
    float widest = 0.1f;
};

// The pyramid a prefilter reads: radiance, direction and solid angle of every cell.
class CubePyramid {
  public:
    // Levels of size n, n/2 … 1; n a power of two.
    explicit CubePyramid(CubeLevel base);

    struct Level {
        CubeLevel radiance;
        std::vector<glm::vec4> cells; // unit direction its light comes from, solid angle
    };
    [[nodiscard]] const std::vector<Level>& levels() const { return m_levels; }

  private:
    std::vector<Level> m_levels; // finest first
};

// Radiance seen through a GGX lobe with N = V = R (Karis 2013): the mean over l with weight
// D(h) N·L, where (N·H)² = (1 + N·L) / 2. alpha > 0. Meaningless after a cancel.
[[nodiscard]] CubeLevel prefilterGGX(const CubePyramid& pyramid, int size, float alpha,
                                     const PrefilterQuality& quality, const JobContext& job);

} // namespace patina
