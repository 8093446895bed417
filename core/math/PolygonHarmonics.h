// Harmonics of light from a polygon, in closed form: what a surface point sees of a rectangle
// light.
#pragma once

#include "core/math/SphericalHarmonics.h"

#include <glm/vec3.hpp>
#include <span>

namespace patina {

// ∫ Y_i(ω) dω over the directions to a polygon, radiance 1: out[i], as many whole bands as `out`
// has room for. `corners`: three or more, relative to the point that sees them, of a planar convex
// polygon; clockwise as seen from the point counts positive, as in quadFormFactor() of
// shaders/shared/lights.glsl, counter-clockwise negative. Nothing is cut off at any horizon. A
// polygon that is seen edge-on, or that the point lies on the border of, gives zeros.
//
// Wang & Ramamoorthi 2018, "Analytic Spherical Harmonic Coefficients for Polygonal Area Lights",
// reduce the integral to ones along the edges by Stokes' theorem, band by band. This does so for
// the harmonics themselves: docs/maths/spherical-harmonics.md.
void projectPolygon(std::span<const glm::dvec3> corners, std::span<double> out);

// The solid angle alone, with the same sign. Van Oosterom & Strackee 1983.
[[nodiscard]] double polygonSolidAngle(std::span<const glm::dvec3> corners);

} // namespace patina
