// The colour of a glowing black body: what "2700 K" on a lamp's box means.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace patina {

inline constexpr float kMinTemperatureK = 1000.0f, kMaxTemperatureK = 40000.0f;

// CIE 1931 2° colour matching functions at a wavelength in nanometres: Wyman, Sloan & Shirley 2013,
// "Simple Analytic Approximations to the CIE XYZ Color Matching Functions", JCGT 2(2), the
// multi-lobe fit (equation 4 with the table of listing 1).
[[nodiscard]] glm::dvec3 cieColorMatching(double wavelengthNm);

// CIE 1931 x, y of a black body: Planck's law integrated with cieColorMatching().
[[nodiscard]] glm::dvec2 blackbodyChromaticity(double temperatureK);

// Linear sRGB of luminance 1. Below about 1900 K the colour lies outside of sRGB: its negative blue
// is cut to zero and the rest scaled back to luminance 1. The temperature is clamped to its limits.
[[nodiscard]] glm::vec3 blackbodyColor(float temperatureK);

} // namespace patina
