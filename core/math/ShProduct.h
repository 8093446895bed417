// Products of functions on the sphere in terms of their harmonics.
#pragma once

#include "core/math/SphericalHarmonics.h"

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace patina {

// ∫ Y_i Y_j Y_k dω (Gaunt 1929, for real harmonics), to double precision; i, j, k below 64.
[[nodiscard]] double gaunt(int i, int j, int k);

// Coefficients of a product of two functions of `order` bands, cut off at `order` bands again:
// c_k = Σ_ij Γ_ijk a_i b_j. Holds the nonzero factors Γ; make one and keep it.
class ShProduct {
  public:
    explicit ShProduct(int order); // 1 … kMaxShOrder

    [[nodiscard]] int order() const { return m_order; }
    // Light times a scalar function, e.g. visibility. All of shCount(order()) elements; `out` must
    // not overlap the others.
    void multiply(std::span<const glm::vec3> light, std::span<const float> scalar,
                  std::span<glm::vec3> out) const;

  private:
    struct Term {
        std::uint8_t i, j, k;
        double value;
    };
    int m_order;
    std::vector<Term> m_terms;
};

// The same with a function that is not known by harmonics, e.g. a clamped cosine or an occluder, by
// quadrature with `resolution` Gauss-Legendre heights times twice as many azimuths: exact where
// `scalar` is a polynomial of degree up to 2 (resolution - order). `out`: whole bands, any number.
void multiplyByFunction(std::span<const glm::vec3> light,
                        const std::function<double(const glm::dvec3& direction)>& scalar,
                        int resolution, std::span<glm::vec3> out);

} // namespace patina
