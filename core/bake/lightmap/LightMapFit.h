// How light that differs with the direction of view is kept at a texel: as a sum of the first nine
// spherical harmonics of the mirror direction, fitted by least squares to what views from all sides
// show. Formulas: docs/maths/light-map.md.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>

namespace patina {

inline constexpr int kLightMapOrder = 3; // bands
inline constexpr std::size_t kLightMapTerms = 9;

using LightMapBasis = std::array<float, kLightMapTerms>;
// Of a unit direction of the world.
[[nodiscard]] LightMapBasis lightMapBasis(const glm::vec3& mirrored);

// Four sums at once: of each direction a value of four numbers.
class LightMapFit {
  public:
    void add(const LightMapBasis& basis, double weight = 1.0); // a direction that was looked from
    // Coefficients a of Σ a_j Y_j, so that its squared distance to the values f is least, where
    // `moments` are Σ weight f Y_j over the same directions. Directions that few views tell apart
    // are kept small (a share `ridge` of the mean square is charged for each). Nothing where no
    // direction was added.
    [[nodiscard]] std::optional<std::array<glm::dvec4, kLightMapTerms>>
    solve(const std::array<glm::dvec4, kLightMapTerms>& moments, double ridge) const;

  private:
    std::array<std::array<double, kLightMapTerms>, kLightMapTerms> m_gram{}; // lower half
    double m_weight = 0.0;
};

} // namespace patina
