// The temperature of the black body whose colour comes nearest to a light's: "about 5600 K".
#pragma once

#include <glm/vec3.hpp>
#include <optional>

namespace patina {

struct ColorTemperature {
    double kelvin = 0.0; // kMinTemperatureK … kMaxTemperatureK; the ends stand for what lies beyond
    double distance = 0.0; // Δuv from the Planckian locus: positive is greener, negative pinker
    friend bool operator==(const ColorTemperature&, const ColorTemperature&) = default;
};

// Farther from the locus a correlated colour temperature has no meaning (CIE 15:2004, section 9.5).
inline constexpr double kMaxLocusDistance = 0.05;

// The correlated colour temperature of a linear sRGB colour: of the black body nearest to it in
// CIE 1960 u, v (CIE 15:2004, section 9.5), found on the locus itself (blackbodyChromaticity(),
// whose colour matching functions err by .001) and not by a fit of it. Nothing for black, and where
// the colour is farther from the locus than kMaxLocusDistance.
[[nodiscard]] std::optional<ColorTemperature> colorTemperature(const glm::dvec3& color);

} // namespace patina
