#include "core/light/Blackbody.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

namespace patina {
namespace {

// A Gaussian whose width differs on its two sides; `left` and `right` are reciprocal widths.
double lobe(double x, double center, double left, double right) {
    const double t = (x - center) * (x < center ? left : right);
    return std::exp(-0.5 * t * t);
}

// Planck's law, without the constant that the normalisation takes away.
double spectralRadiance(double wavelengthNm, double temperatureK) {
    constexpr double kSecondRadiation = 1.438776877e7; // h c / k in nm K (CODATA 2018)
    return std::pow(wavelengthNm, -5.0) /
           std::expm1(kSecondRadiation / (wavelengthNm * temperatureK));
}

glm::dvec3 blackbodyXyz(double temperatureK) {
    glm::dvec3 sum(0.0);
    for (int nm = 360; nm <= 830; nm += 5)
        sum += spectralRadiance(nm, temperatureK) * cieColorMatching(nm);
    return sum / sum.y;
}

} // namespace

glm::dvec3 cieColorMatching(double nm) {
    return {1.056 * lobe(nm, 599.8, 0.0264, 0.0323) + 0.362 * lobe(nm, 442.0, 0.0624, 0.0374) -
                0.065 * lobe(nm, 501.1, 0.0490, 0.0382),
            0.821 * lobe(nm, 568.8, 0.0213, 0.0247) + 0.286 * lobe(nm, 530.9, 0.0613, 0.0322),
            1.217 * lobe(nm, 437.0, 0.0845, 0.0278) + 0.681 * lobe(nm, 459.0, 0.0385, 0.0725)};
}

glm::dvec2 blackbodyChromaticity(double temperatureK) {
    const glm::dvec3 xyz = blackbodyXyz(temperatureK);
    return {xyz.x / (xyz.x + xyz.y + xyz.z), xyz.y / (xyz.x + xyz.y + xyz.z)};
}

glm::vec3 blackbodyColor(float temperatureK) {
    const glm::dvec3 xyz =
        blackbodyXyz(std::clamp(temperatureK, kMinTemperatureK, kMaxTemperatureK));
    // XYZ to linear sRGB, IEC 61966-2-1.
    const glm::dvec3 rgb(glm::dot(glm::dvec3(3.2404542, -1.5371385, -0.4985314), xyz),
                         glm::dot(glm::dvec3(-0.9692660, 1.8760108, 0.0415560), xyz),
                         glm::dot(glm::dvec3(0.0556434, -0.2040259, 1.0572252), xyz));
    const glm::dvec3 inside = glm::max(rgb, glm::dvec3(0.0));
    return glm::vec3(inside / glm::dot(inside, glm::dvec3(0.2126729, 0.7151522, 0.0721750)));
}

} // namespace patina
