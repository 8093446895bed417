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

struct IblMaps {
    std::vector<CubeLevel> prefiltered; // level i: perceptualRoughness = i / (levels - 1)
    CubeLevel irradiance;               // E(n) = ∫ L(l) max(n·l, 0) dl; empty unless asked for
    std::array<glm::vec3, 9>
        irradianceSh; // E(n) = Σ irradianceSh[i] Y_i(n), Y as in shaders/shared/sh.glsl
    std::array<glm::vec3, 64> radianceSh; // L_i of the environment, 8 bands, for transfer
};

[[nodiscard]] std::size_t memoryBytes(const IblMaps& maps); // of all texels

struct IblSettings {
    int cubeSize = 256;     // of level 0, a power of two
    int levels = 7;         // at least 2: 256 128 64 32 16 16 16
    int irradianceSize = 0; // of the irradiance cube, a power of two; 0: none
    // Share of the kernel's scale that a cell of the sum may span; 0.09 errs by some hundredths of
    // a percent (docs/maths/ibl.md), and the time goes with its inverse square.
    float cellSize = 0.09f;
    // The sides halve down to this power of two and stay: lookups in fewer texels show seams. The
    // viewport needs 16 (shaders/shared/ibl.glsl), a mip chain 1.
    int smallestLevel = 16;

    // For a first picture while the full maps are computed: within about one percent.
    static IblSettings quick() { return {64, 5, 0, 0.3f}; }
    friend bool operator==(const IblSettings&, const IblSettings&) = default;
};

// `environment`: lat-long, F32, 3 channels, conventions of patina::Environment; rotation and
// exposure are applied by the user of the maps. Deterministic. Cancelled when the job is.
Result<IblMaps> computeIbl(const Image& environment, const IblSettings& settings,
                           const JobContext& job);

} // namespace patina
