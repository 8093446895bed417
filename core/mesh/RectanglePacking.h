// Packing rectangles into a square of texels, all at one scale.
#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace patina {

struct RectanglePacking {
    double scale = 1.0;                // texels per unit of the rectangles' sizes
    int side = 0;                      // of the square, texels
    std::vector<glm::ivec2> positions; // of each rectangle's cell; the margin lies inside it
};

// Finds (nearly) the largest scale at which all rectangles, each with `margin` texels on every
// side, fit into side² texels. When the margins alone need more room, the side is doubled until
// they fit. Skyline, tallest first; deterministic.
[[nodiscard]] RectanglePacking packRectangles(std::span<const glm::dvec2> sizes, int side,
                                              int margin);

} // namespace patina
