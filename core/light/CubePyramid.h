// What a prefilter reads of an environment: a pyramid of cells whose geometry is the same for every
// face, and the brightest texels apart, so that each of them can be treated exactly.
#pragma once

#include "core/light/Ibl.h"

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace patina {

// A map of the cube onto itself that carries face +Z, perhaps mirrored, to `face`: what is computed
// for a tile of face +Z holds for its 48 images, with the radiance found where the map leads.
struct CubeSymmetry {
    // Where the texels of a face go: x' = originX + xx x + xy y and so on, in units of texels, with
    // origins 0 or n - 1.
    struct FaceMap {
        int face = 0;
        int xx = 0, xy = 0, yx = 0, yy = 0; // -1, 0 or 1
    };

    int face = 0;            // that +Z goes to
    bool transposed = false; // first: column and row change places
    bool mirrorX = false, mirrorY = false;
    glm::mat3 matrix{1.0f}; // of directions; a signed permutation
    std::array<FaceMap, 6> faces;
};

// The six maps that take the texel (x, y) of +Z to the texel (x, y) of a face, in the faces' order;
// then the same behind a mirroring in x, in y, and in both; then all of these behind the exchange
// of x and y.
[[nodiscard]] const std::array<CubeSymmetry, 48>& cubeSymmetries();

class CubePyramid {
  public:
    // Levels of size n, n/2 … 1; n a power of two.
    explicit CubePyramid(const CubeLevel& base);

    struct Level {
        int size = 0;
        std::size_t first = 0; // of its texels in radiance()
        const glm::vec4* cells =
            nullptr; // of face +Z, size²: unit vector to the centroid, solid angle
    };
    [[nodiscard]] const std::vector<Level>& levels() const { return m_levels; } // finest first
    // Mean radiance of every cell but for the bright texels, all levels one after another; w is
    // unused.
    [[nodiscard]] const std::vector<glm::vec4>& radiance() const { return m_radiance; }

    // How much a texel of the base differs from the median of its 8 × 8 neighbours, times its solid
    // angle, where that is more than the mean brightness; at most 1024 of them. Negative where it
    // is darker.
    struct BrightTexel {
        glm::vec3 direction;
        glm::vec3 flux;
        float solidAngle; // of the texel
    };
    [[nodiscard]] const std::vector<BrightTexel>& brightTexels() const { return m_brightTexels; }
    // The bright texels of a cell of the second level, as one: their flux, from their centroid.
    struct BrightGroup {
        BrightTexel all;
        std::size_t first = 0, count = 0; // in brightTexels()
    };
    [[nodiscard]] const std::vector<BrightGroup>& brightGroups() const { return m_brightGroups; }

  private:
    struct Outlier {
        std::size_t texel;
        glm::vec4 neighbourhood;
        float contrast;
    };
    void separateBrightTexels(const std::vector<float>& solidAngles);
    [[nodiscard]] std::vector<Outlier> findOutliers(float limit) const;
    void groupBrightTexels(const std::vector<Outlier>& outliers, std::vector<BrightTexel> bright);

    std::vector<Level> m_levels;
    std::vector<glm::vec4> m_radiance, m_cells;
    std::vector<BrightTexel> m_brightTexels; // by group
    std::vector<BrightGroup> m_brightGroups;
};

} // namespace patina
