// Real spherical harmonics of any order up to 8 bands: basis, projection of environments, cosine
// convolution and rotation. Condon-Shortley phase, index l(l+1)+m, zonal axis z: the basis of
// shaders/shared/sh.glsl. "Order" counts bands: order 3 has 9 coefficients.
#pragma once

#include "core/image/Image.h"
#include "core/job/JobContext.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace patina {

inline constexpr int kMaxShOrder = 8;

[[nodiscard]] constexpr int shCount(int order) {
    return order * order;
}
[[nodiscard]] constexpr int shIndex(int l, int m) {
    return l * (l + 1) + m;
}

// Y_0 … of a unit direction into out[0 … order²). Exact polynomials: no poles, no trigonometry.
void evaluateSh(int order, const glm::dvec3& direction, std::span<double> out);
void evaluateSh(int order, const glm::vec3& direction, std::span<float> out);

// A_l, what convolution with the clamped cosine multiplies band l by. Ramamoorthi & Hanrahan 2001,
// "On the relationship between radiance and irradiance", equation 24; any l >= 0.
[[nodiscard]] double cosineConvolution(int l);

// Radiance coefficients to irradiance coefficients, in place: E_lm = A_l L_lm.
void convolveWithCosine(std::span<glm::vec3> coefficients);

// L_i = ∫ L(ω) Y_i(ω) dω of a lat-long image (F32, 3 channels or more, conventions of
// patina::Environment). Each texel is a patch of constant radiance, and its patch is integrated
// exactly: a sun of one texel keeps its energy wherever it stands. Rows are spread over the pool;
// the result does not depend on their number. After a cancel the result is meaningless.
[[nodiscard]] std::vector<glm::vec3> projectLatLong(const Image& environment, int order,
                                                    const JobContext& job = {});

// The rotation of coefficient vectors: coefficients c of f(ω) become those of f(R⁻¹ ω).
class ShRotation {
  public:
    // `rotation` must be orthonormal; a determinant of -1, a mirror image, is fine. Exact to double
    // precision.
    ShRotation(const glm::dmat3& rotation, int order);
    static ShRotation aboutAxis(const glm::dvec3& axis, double angleRad, int order);
    // Counter-clockwise as seen from above: what environment.rotationDeg does to the surroundings.
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
