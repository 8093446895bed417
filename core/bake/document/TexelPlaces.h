// Where on the surface the texels of a bake lie, for light that differs from point to point.
#pragma once

#include "core/document/Document.h"

#include <glm/vec4.hpp>
#include <vector>

namespace patina {

struct TexelPlace {                             // as it lies in a buffer of the GPU
    glm::vec4 position{0.0f, 0.0f, 0.0f, 1.0f}; // world
    glm::vec4 normal{0.0f};                     // unit, world; zero where nothing is known of it
};

// Of side × side texels of a material's texture, rows from the top, gutters filled; a texel that
// several triangles share takes the mean of their places, as its bake does. TexelPlace() everywhere
// where no mesh with texture coordinates shows the material.
[[nodiscard]] std::vector<TexelPlace> texelPlaces(const Document& document, Id material, int side);

} // namespace patina
