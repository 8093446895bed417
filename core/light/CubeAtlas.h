// A prefiltered cubemap as one flat picture, which is how the viewport looks it up: software OpenGL
// samples a flat texture without mipmaps about twice as fast as a cubemap with them, and no GPU
// minds. Each face has a border of one texel of its neighbours, so that bilinear lookups are
// seamless. The layout is that of cubeAtlasTexel() in shaders/shared/ibl.glsl.
#pragma once

#include "core/light/Ibl.h"

namespace patina {

// Rows of levels, the largest first; a level is +X -X +Y -Y +Z -Z side by side. Below all lies the
// irradiance over pi, alike.
struct CubeAtlas {
    int side = 0; // of a face of level 0, without its border
    int levels = 0;
    int irradianceSide = 0; // of a face, without its border
    int irradianceTop = 0;  // row of texels of its border
    int width = 0, height = 0;
    std::vector<glm::vec3> texels; // what no face covers is black
};

// `levels`: the first a power of two; their sides are cubeLevelSide() of shaders/shared/ibl.glsl,
// as computeIbl() makes them for LevelSpacing::Lobes. `irradiance`: IblMaps::irradiance; empty: the
// last level stands in, which is the same in fewer texels.
[[nodiscard]] CubeAtlas makeCubeAtlas(const std::vector<CubeLevel>& levels,
                                      const CubeLevel& irradiance = {});

} // namespace patina
