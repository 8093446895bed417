// Looking the DFG table up, as the shader does.
#pragma once

#include "core/image/Image.h"

#include <glm/vec3.hpp>

namespace patina {

// The channels of computeDfgTable() with DfgTexels::Inside, bilinear between its texels; both
// coordinates are clamped to 0…1.
[[nodiscard]] glm::vec3 lookUpDfg(const Image& table, float NoV, float perceptualRoughness);

} // namespace patina
