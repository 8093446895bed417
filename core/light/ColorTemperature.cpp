#include "core/light/ColorTemperature.h"

#include "core/light/Blackbody.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace patina {
namespace {

// CIE 1960 uniform chromaticities, which the nearest black body is defined by.
glm::dvec2 uv1960(double x, double y, double z) {
    const double sum = x + 15.0 * y + 3.0 * z;
    return {4.0 * x / sum, 6.0 * y / sum};
}

// Of a black body of so many mired (10⁶ / K), in which the locus is run through almost evenly.
glm::dvec2 locus(double mired) {
    const glm::dvec2 xy = blackbodyChromaticity(1e6 / mired);
    return uv1960(xy.x, xy.y, 1.0 - xy.x - xy.y);
}

constexpr int kLocusSteps = 39;
constexpr double kLeastMired = 1e6 / kMaxTemperatureK, kMostMired = 1e6 / kMinTemperatureK;

double miredAt(int step) {
    return kLeastMired + (kMostMired - kLeastMired) * step / kLocusSteps;
}

// Integrated once: a search begins at the nearest of them.
const std::array<glm::dvec2, kLocusSteps + 1>& locusTable() {
    static const auto table = [] {
        std::array<glm::dvec2, kLocusSteps + 1> points;
        for (int i = 0; i <= kLocusSteps; ++i)
            points[static_cast<std::size_t>(i)] = locus(miredAt(i));
        return points;
    }();
    return table;
}

} // namespace

std::optional<ColorTemperature> colorTemperature(const glm::dvec3& color) {
    // Linear sRGB to XYZ, IEC 61966-2-1.
    const glm::dvec3 xyz(glm::dot(glm::dvec3(0.4124564, 0.3575761, 0.1804375), color),
                         glm::dot(glm::dvec3(0.2126729, 0.7151522, 0.0721750), color),
                         glm::dot(glm::dvec3(0.0193339, 0.1191920, 0.9503041), color));
    if (!(xyz.y > 0.0) || !std::isfinite(xyz.x + xyz.y + xyz.z))
        return std::nullopt;
    const glm::dvec2 own = uv1960(xyz.x, xyz.y, xyz.z);

    // Nearest of the table, then golden section between its neighbours.
    const auto& table = locusTable();
    int nearest = 0;
    for (int i = 1; i <= kLocusSteps; ++i)
        if (glm::distance(table[static_cast<std::size_t>(i)], own) <
            glm::distance(table[static_cast<std::size_t>(nearest)], own))
            nearest = i;
    double low = miredAt(nearest > 0 ? nearest - 1 : 0);
    double high = miredAt(nearest < kLocusSteps ? nearest + 1 : kLocusSteps);
    const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
    double m1 = high - golden * (high - low), m2 = low + golden * (high - low);
    double d1 = glm::distance(locus(m1), own), d2 = glm::distance(locus(m2), own);
    while (high - low > 0.01) { // 0.4 K at 6500 K
        if (d1 < d2) {
            high = m2;
            m2 = m1;
            d2 = d1;
            m1 = high - golden * (high - low);
            d1 = glm::distance(locus(m1), own);
        } else {
            low = m1;
            m1 = m2;
            d1 = d2;
            m2 = low + golden * (high - low);
            d2 = glm::distance(locus(m2), own);
        }
    }
    const double mired = 0.5 * (low + high);
    const glm::dvec2 on = locus(mired);
    const double distance = glm::distance(on, own);
    if (distance > kMaxLocusDistance)
        return std::nullopt;
    // Green lies above the locus, where v is larger.
    return ColorTemperature{1e6 / mired, own.y >= on.y ? distance : -distance};
}

} // namespace patina
