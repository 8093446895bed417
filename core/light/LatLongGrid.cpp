#include "core/light/LatLongGrid.h"

#include "core/base/Check.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <numbers>

namespace patina {

LatLongGrid::LatLongGrid(int height)
    : LatLongGrid(2 * height, height) {}

LatLongGrid::LatLongGrid(int width, int height)
    : m_columns(static_cast<std::size_t>(width))
    , m_rows(static_cast<std::size_t>(height)) {
    CHECK(width >= 1 && height >= 1);
    for (int x = 0; x < width; ++x) {
        const double angle = 2.0 * std::numbers::pi * ((x + 0.5) / width - 0.5);
        m_columns[static_cast<std::size_t>(x)] = {std::sin(angle), std::cos(angle)};
    }
    for (int y = 0; y < height; ++y) {
        const double angle = std::numbers::pi * (y + 0.5) / height;
        m_rows[static_cast<std::size_t>(y)] = {std::sin(angle), std::cos(angle)};
    }
}

glm::dvec3 LatLongGrid::directionAt(double x, double y) const {
    const double phi = 2.0 * std::numbers::pi * (x / width() - 0.5),
                 theta = std::numbers::pi * y / height();
    const double rho = std::sin(theta);
    return {rho * std::sin(phi), std::cos(theta), -rho * std::cos(phi)};
}

double LatLongGrid::texelAngle() const {
    return std::numbers::pi / height();
}

double LatLongGrid::solidAngle(int y) const {
    return 2.0 * std::numbers::pi / width() *
           (std::cos(std::numbers::pi * y / height()) -
            std::cos(std::numbers::pi * (y + 1) / height()));
}

double LatLongGrid::projectedSolidAngle(int y) const {
    // ∫ cos θ sin θ dθ = sin² θ / 2.
    const double top = std::sin(std::numbers::pi * y / height()),
                 bottom = std::sin(std::numbers::pi * (y + 1) / height());
    return std::numbers::pi / width() * (bottom * bottom - top * top);
}

glm::ivec2 LatLongGrid::rowsBetween(double begin, double end) const {
    const double first = std::floor(begin / texelAngle()), last = std::ceil(end / texelAngle());
    return {static_cast<int>(std::clamp<double>(first, 0, height())),
            static_cast<int>(std::clamp<double>(last, 0, height()))};
}

glm::dvec3 directionFromAngles(double azimuthDeg, double elevationDeg) {
    const double a = glm::radians(azimuthDeg), e = glm::radians(elevationDeg);
    return {std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e)};
}

glm::dvec2 anglesFromDirection(const glm::dvec3& d) {
    return {glm::degrees(std::atan2(d.x, d.z)),
            glm::degrees(std::atan2(d.y, std::hypot(d.x, d.z)))};
}

} // namespace patina
