// A rectangle light as the places near it see it, in harmonics: the closed form of
// shaders/shared/nearlight.glsl is in frames of the light's own, about its sides, and is turned
// into the world by matrices that are the same for every place.
#pragma once

#include "core/math/SphericalHarmonics.h"

#include <array>
#include <glm/vec3.hpp>
#include <span>

namespace patina {

// Numbers of one matrix of all bands: (2l + 1) rows and 2l columns (m ≠ 0) for l = 1 … 7.
inline constexpr int kRectangleTurnSize = 616;
// Where band l's rows begin.
[[nodiscard]] constexpr int rectangleTurnBegin(int l) {
    return l <= 1 ? 0 : rectangleTurnBegin(l - 1) + (2 * l - 1) * (2 * l - 2);
}
static_assert(rectangleTurnBegin(kMaxShOrder) == kRectangleTurnSize);

struct NearRectangle {
    glm::vec3 center{0.0f};
    glm::vec3 x{1, 0, 0}, y{0, 1, 0}, normal{0, 0, 1}; // unit; light goes against the normal
    float halfX = 0.5f, halfY = 0.5f;                  // of its sides
    // Of harmonics about x and about y, see rectangleSh().
    std::array<float, kRectangleTurnSize> turnFirst{}, turnSecond{};
};

// `halfX` and `halfY` are half of its sides, perpendicular; the side that cross(halfY, halfX)
// points to emits.
[[nodiscard]] NearRectangle nearRectangle(const glm::vec3& center, const glm::vec3& halfX,
                                          const glm::vec3& halfY);

// Its light of radiance 1 at `place`: out[0 … order² - 1], bands times `window` and scaled so that
// a surface that faces it gets its irradiance in spite of the bands left out.
void projectRectangle(const NearRectangle& rectangle, const glm::vec3& place, int order,
                      const std::array<float, kMaxShOrder>& window, std::span<float> out);

} // namespace patina
