// Harmonics of what is round about an axis: lights in closed form, turned to any direction.
#pragma once

#include "core/math/SphericalHarmonics.h"

#include <array>
#include <glm/vec3.hpp>
#include <span>

namespace patina {

// c_l0 of a function of the angle from +z alone; its coefficients of m != 0 vanish.
using ZonalHarmonics = std::array<double, kMaxShOrder>;

// Radiance 1 within `halfAngleRad` of the axis, 0 beyond. 0 … pi.
[[nodiscard]] ZonalHarmonics zonalCap(double halfAngleRad);
// Radiance 1 from a disc that faces the receiver, as seen from `distance` in front of its centre.
// radius >= 0, distance >= 0; at distance 0 it covers half of all directions.
[[nodiscard]] ZonalHarmonics zonalDisc(double radius, double distance);
// Radiance 1 from a sphere, as seen from `distance` to its centre; from inside it is everywhere.
[[nodiscard]] ZonalHarmonics zonalSphere(double radius, double distance);
// A point of light infinitely far away, of irradiance 1 on a surface that faces it.
[[nodiscard]] ZonalHarmonics zonalDirectional();
// max(0, z): the kernel that turns radiance into irradiance.
[[nodiscard]] ZonalHarmonics zonalCosine();

// What zonalDirectional() has to be multiplied by at `order` bands, so that a facing surface gets
// irradiance 1 of it in spite of what the bands leave out: 1 / Σ A_l (2l + 1) / 4pi. With a factor
// pi the same as DirectXMath's XMSHEvalDirectionalLight. order >= 1.
[[nodiscard]] double directionalScale(int order);

// coefficients += color · zonal turned to `direction` (unit): c_lm = sqrt(4pi / (2l + 1)) c_l Y_lm.
// Sloan 2008, "Stupid Spherical Harmonics (SH) Tricks", "Zonal Harmonics". The number of
// coefficients, order², says how many bands.
void addZonal(const ZonalHarmonics& zonal, const glm::dvec3& direction, const glm::dvec3& color,
              std::span<glm::vec3> coefficients);
// The same for one channel in double precision.
void addZonal(const ZonalHarmonics& zonal, const glm::dvec3& direction, double value,
              std::span<double> coefficients);

// Convolution of coefficients with a kernel round about its axis, in place: band l is multiplied by
// sqrt(4pi / (2l + 1)) k_l. With zonalCosine() this is convolveWithCosine().
void convolveWithZonal(const ZonalHarmonics& kernel, std::span<glm::vec3> coefficients);

} // namespace patina
