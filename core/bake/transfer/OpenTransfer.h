// The transfer of a surface that nothing shades.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>

namespace patina {

class OpenTransfer {
  public:
    explicit OpenTransfer(int order); // 0 … 8 bands

    // A_l Y_lm(n) / pi - values[i], for each coefficient: what remains when `values` is hidden.
    // Fewer directions to sum up where most are open, and exact where all are.
    void subtract(const glm::vec3& normal, std::span<float> values) const;

  private:
    int m_order;
    std::array<float, 8> m_cosine{}; // A_l / pi of each band
};

} // namespace patina
