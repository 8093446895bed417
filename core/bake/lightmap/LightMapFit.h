// How light that differs with the direction of view is kept at a texel: as a sum of the first nine
// spherical harmonics of the mirror direction, fitted by least squares to what views from all sides
// show. Formulas: docs/maths/light-map.md.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace patina {

inline constexpr int kLightMapOrder = 3; // bands
inline constexpr std::size_t kLightMapTerms = 9;

using LightMapBasis = std::array<float, kLightMapTerms>;
// Of a unit direction of the world.
[[nodiscard]] LightMapBasis lightMapBasis(const glm::vec3& mirrored);

// Coefficients a of Σ a_j Y_j, whose mean squared distance over the hemisphere about `normal`
// (unit) to a value f of each mirror direction is least; `moments` are the means of f Y_j over it.
// What views tell hardly apart is kept small: each coefficient but the constant's is charged
// `ridge` times the mean square of Y_0.
[[nodiscard]] std::array<glm::vec4, kLightMapTerms>
fitHemisphere(const glm::vec3& normal, const std::array<glm::vec4, kLightMapTerms>& moments,
              double ridge);

} // namespace patina
