// Image-based light: what the split-sum approximation needs of one lat-long environment.
#pragma once

#include "core/base/Result.h"
#include "core/image/Image.h"
#include "core/job/JobContext.h"
#include "core/light/DfgTable.h"

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

namespace patina {

// One level of a cubemap: six faces +X -X +Y -Y +Z -Z in OpenGL's order and orientation, RGB
// floats, texel centres at (i + 0.5) / size.
struct CubeLevel {
    int size = 0;
    std::vector<glm::vec3> texels; // 6 * size * size
};

// Which roughness each prefiltered level holds, and how large its faces are.
enum class LevelSpacing {
    Lobes, // by the lobe's width, for lookups: prefilteredRoughness() and cubeLevelSide() of
           // shaders/shared/ibl.glsl
    Even   // perceptualRoughness = i / (levels - 1), sides halve: mip levels, for files
};

struct IblMaps {
    LevelSpacing spacing = LevelSpacing::Lobes;
    std::vector<CubeLevel> prefiltered; // level 0 is the environment
    CubeLevel irradiance;               // E(n) = ∫ L(l) max(n·l, 0) dl; empty: not asked for
    std::array<glm::vec3, 9>
        irradianceSh; // E(n) = Σ irradianceSh[i] Y_i(n), Y as in shaders/shared/sh.glsl
    std::array<glm::vec3, 64> radianceSh; // L_i of the environment, 8 bands, for transfer
};

[[nodiscard]] std::size_t memoryBytes(const IblMaps& maps); // of all texels

struct IblSettings {
    int cubeSize = 256; // of level 0, a power of two
    int levels = 22;    // at least 2
    // Of the irradiance cube, a power of two; 0: none. Opposite a window in a dark room irradiance
    // bends within a degree: with 64 texels a side it is 3.5 % off there, with 128 2 %, with 256
    // less than 1 %.
    int irradianceSize = 256;
    // Share of the kernel's scale that a cell of the sum may span; 0.09 errs by some hundredths of
    // a percent (docs/maths/ibl.md), and the time goes with its inverse square.
    float cellSize = 0.09f;
    LevelSpacing spacing = LevelSpacing::Lobes;

    // For a first picture while the full maps are computed: within some percent.
    static IblSettings quick() { return {64, 8, 64, 0.3f}; }
    friend bool operator==(const IblSettings&, const IblSettings&) = default;
};

// Of level `level` of so many.
[[nodiscard]] float levelRoughness(LevelSpacing spacing, int level, int levels, int cubeSize);
[[nodiscard]] int levelSide(LevelSpacing spacing, int level, int cubeSize);

// The two levels whose mix is the environment at a roughness, as the viewport's shader takes them.
struct LevelPair {
    std::size_t first = 0, second = 0;
    float share = 0.0f; // of the second
};
[[nodiscard]] LevelPair levelsOf(const IblMaps& maps, float perceptualRoughness);

// `environment`: lat-long, F32, 3 channels, conventions of patina::Environment; rotation and
// exposure are applied by the user of the maps. Deterministic. Cancelled when the job is.
Result<IblMaps> computeIbl(const Image& environment, const IblSettings& settings,
                           const JobContext& job);

} // namespace patina
