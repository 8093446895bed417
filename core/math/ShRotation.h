// The rotation of spherical harmonics: coefficients c of f(ω) become those of f(R⁻¹ ω).
#pragma once

#include "core/math/SphericalHarmonics.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace patina {

class ShRotation {
  public:
    // `rotation` must be orthonormal; a determinant of -1, a mirror image, is fine. Exact to double
    // precision; 2 µs at order 6, applying included.
    ShRotation(const glm::dmat3& rotation, int order);
    static ShRotation aboutAxis(const glm::dvec3& axis, double angleRad, int order);
    // Counter-clockwise as seen from above: what environment.rotationDeg does to the environment.
    static ShRotation aboutY(double angleRad, int order) {
        return aboutAxis({0.0, 1.0, 0.0}, angleRad, order);
    }

    [[nodiscard]] int order() const { return m_order; }
    // Element of the matrix of band l; rows and columns m = -l … l. Y(R d) = M Y(d).
    [[nodiscard]] double element(int l, int row, int column) const;

    // `in` and `out` have shCount(order()) elements and must not overlap.
    void apply(std::span<const glm::vec3> in, std::span<glm::vec3> out) const;
    void apply(std::span<const float> in, std::span<float> out) const;

  private:
    int m_order;
    std::vector<double> m_elements; // band matrices one after another, row-major
};

} // namespace patina
