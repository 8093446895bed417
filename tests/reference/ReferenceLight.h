// What an environment sends from one direction: its picture itself, and the sums of its first
// bands of spherical harmonics. Projection and basis are written after the textbooks, apart from
// core/math/SphericalHarmonics.h: references must not share the mistakes they are to find.
#pragma once

#include "core/image/Image.h"

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace patina::reference {

inline constexpr int kOrders = 6;
// [0] of the picture, [n] of its first n bands.
inline constexpr int kLights = kOrders + 1;

// Real spherical harmonics of the first kOrders bands at a unit direction, index l(l+1)+m.
using Basis = std::array<double, kOrders * kOrders>;
[[nodiscard]] Basis basisAt(const glm::dvec3& direction);

class ReferenceLight {
  public:
    // Lat-long, F32, 3 channels or more; u = 0.5 + atan2(x, -z) / 2 pi, v = acos(y) / pi, row 0 on
    // top; every pixel is a patch of constant radiance.
    explicit ReferenceLight(ImagePtr environment);

    // Of the first 1 … kOrders bands, from out[1] on; `basis` that of the direction.
    void bands(const Basis& basis, std::array<glm::dvec3, kLights>& out) const;

    [[nodiscard]] const std::array<glm::dvec3, kOrders * kOrders>& coefficients() const {
        return m_coefficients;
    }

    // A direction of the picture, as likely as it is bright; `sample` even in [0, 1)².
    struct Ray {
        glm::dvec3 direction{0.0};
        glm::dvec3 radiance{0.0};
        double density = 0.0; // per steradian
    };
    [[nodiscard]] Ray sample(const glm::dvec2& sample) const;

  private:
    [[nodiscard]] glm::dvec3 pixel(int x, int y) const;

    ImagePtr m_picture;
    std::vector<double> m_rows;    // running sums of power, row after row
    std::vector<double> m_columns; // and within each row
    std::array<glm::dvec3, kOrders * kOrders> m_coefficients{};
};

} // namespace patina::reference
