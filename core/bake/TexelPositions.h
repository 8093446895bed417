// Where on the surface the texels of a bake lie, for light that differs from point to point.
#pragma once

#include "core/document/Document.h"

#include <glm/vec4.hpp>
#include <vector>

namespace patina {

// World positions (w = 1) of side × side texels of a material's texture, rows from the top, gutters
// filled; a texel that several triangles share takes their mean, as its bake does. (0, 0, 0, 1)
// everywhere where no mesh with texture coordinates shows the material.
[[nodiscard]] std::vector<glm::vec4> texelPositions(const Document& document, Id material,
                                                    int side);

} // namespace patina
