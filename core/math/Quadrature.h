// Gauss-Legendre quadrature: n points that integrate polynomials up to degree 2n - 1 exactly.
#pragma once

#include <vector>

namespace patina {

class GaussLegendre {
  public:
    // n >= 1. Newton iteration on the Legendre polynomial (Press et al. 2007, "Numerical Recipes",
    // section 4.6), to double precision.
    explicit GaussLegendre(int n);

    [[nodiscard]] int size() const { return static_cast<int>(m_nodes.size()); }
    // On the interval 0…1: ∫ f ≈ Σ weight01(i) f(node01(i)).
    [[nodiscard]] double node01(int i) const { return m_nodes[i]; }
    [[nodiscard]] double weight01(int i) const { return m_weights[i]; }

  private:
    std::vector<double> m_nodes, m_weights;
};

} // namespace patina
