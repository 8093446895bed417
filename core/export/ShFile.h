// Spherical harmonics of light as files for other programs: JSON, and plain text of the same.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <string>

namespace patina {

// The basis of all of our files of spherical harmonics, in words.
inline constexpr const char* kShBasisText =
    "real, orthonormal, Condon-Shortley phase: Y_00 = 0.282095, Y_1-1 = -0.488603 y, "
    "Y_10 = 0.488603 z, Y_11 = -0.488603 x";

enum class ShQuantity {
    Radiance,  // L(d) of the environment
    Irradiance // E(n) = ∫ L(d) max(n·d, 0) dd; a white Lambertian surface reflects E / pi
};

// order² coefficients in the basis of core/math/SphericalHarmonics.h. Both files state that basis,
// and JSON also what the sum gives along the axes, so that a reader can check itself.
[[nodiscard]] std::string shJson(std::span<const glm::vec3> coefficients, ShQuantity quantity);
[[nodiscard]] std::string shText(std::span<const glm::vec3> coefficients, ShQuantity quantity);

} // namespace patina
