// What is known of the light in the Cornell box: the irradiance of points on its surfaces, for
// checking whatever computes light. The box is builtin:cornell-reference, with its two blocks or
// without them, and its light of radiance 1.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>

namespace patina::library {

// Reflectances, linear sRGB.
struct CornellWalls {
    glm::vec3 white, red, green;
};
// As measured, under D65, and as renderers often have them.
inline constexpr std::array<CornellWalls, 2> kCornellWalls{{
    {{.738239f, .735992f, .738601f},
     {.493880f, .048870f, .051155f},
     {.068413f, .398461f, .086545f}},
    {{.725f, .71f, .68f}, {.63f, .065f, .05f}, {.14f, .45f, .091f}},
}};

// Red, green and blue for each of kCornellWalls, W/m².
inline constexpr std::size_t kCornellChannels = 3 * kCornellWalls.size();
using CornellValues = std::array<double, kCornellChannels>;

struct CornellPoint {
    std::string_view name;
    bool blocks;                 // of the box with its blocks
    glm::dvec3 position, normal; // mm and unit, axes of the data sheet: x left, y up, z inwards
    double direct, directError;  // straight from the light, and its standard error
    CornellValues indirect, indirectError; // by way of other surfaces

    [[nodiscard]] double irradiance(std::size_t channel) const {
        return direct + indirect[channel];
    }
    [[nodiscard]] double standardError(std::size_t channel) const {
        return std::hypot(directError, indirectError[channel]);
    }
};

// 8 of the empty box, then 14 of the one with blocks.
[[nodiscard]] std::span<const CornellPoint> cornellPoints();

// From the data sheet's axes to the world of the built-in model: metres, and directions. The sheet
// looks along +Z into the opening at z = 0; in the model the opening faces +Z.
[[nodiscard]] inline glm::dvec3 cornellPosition(const glm::dvec3& mm) {
    return {(278.0 - mm.x) / 1000.0, mm.y / 1000.0, (279.6 - mm.z) / 1000.0};
}
[[nodiscard]] inline glm::dvec3 cornellDirection(const glm::dvec3& direction) {
    return {-direction.x, direction.y, -direction.z};
}

} // namespace patina::library
