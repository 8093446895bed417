#include "core/math/ZonalHarmonics.h"

#include "core/base/Check.h"
#include "core/math/SphericalHarmonics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace patina {

namespace {

// sqrt((2l + 1) / 4pi): Y_l0 = this times P_l(z).
double normalisation(int l) {
    return std::sqrt((2.0 * l + 1.0) / (4.0 * std::numbers::pi));
}

// 2pi K_l ∫_cos a^1 P_l dz with ∫_x^1 P_l dz = (1 - x²) P_l'(x) / (l (l + 1)), from Legendre's
// equation: unlike the difference of P_l-1 and P_l+1 it keeps its digits for the smallest lights.
ZonalHarmonics cap(double cosine, double sineSquared) {
    ZonalHarmonics c{};
    // 1 - cos a
    const double height = cosine > 0.0 ? sineSquared / (1.0 + cosine) : 1.0 - cosine;
    c[0] = 2.0 * std::numbers::pi * normalisation(0) * height;
    double p = cosine, previousP = 1.0;      // P_l, P_l-1
    double slope = 1.0, previousSlope = 0.0; // their derivatives
    for (int l = 1; l < kMaxShOrder; ++l) {
        c[l] = 2.0 * std::numbers::pi * normalisation(l) * sineSquared * slope / (l * (l + 1.0));
        const double nextP = ((2.0 * l + 1.0) * cosine * p - l * previousP) / (l + 1.0);
        const double nextSlope = previousSlope + (2.0 * l + 1.0) * p;
        previousP = p;
        p = nextP;
        previousSlope = slope;
        slope = nextSlope;
    }
    return c;
}

// Calls visit(i, c_lm).
template <class Visit>
void forEachTurned(const ZonalHarmonics& zonal, const glm::dvec3& direction, int order,
                   Visit&& visit) {
    std::array<double, kMaxShOrder * kMaxShOrder> y{};
    evaluateSh(order, direction, y);
    for (int l = 0; l < order; ++l)
        for (int m = -l; m <= l; ++m)
            visit(shIndex(l, m), zonal[l] / normalisation(l) * y[shIndex(l, m)]);
}

} // namespace

ZonalHarmonics zonalCap(double halfAngleRad) {
    CHECK(halfAngleRad >= 0.0 && halfAngleRad <= std::numbers::pi);
    const double sine = std::sin(halfAngleRad);
    return cap(std::cos(halfAngleRad), sine * sine);
}

ZonalHarmonics zonalDisc(double radius, double distance) {
    CHECK(radius >= 0.0 && distance >= 0.0 && radius + distance > 0.0);
    const double sine = radius / std::hypot(radius, distance);
    return cap(distance / std::hypot(radius, distance), sine * sine);
}

ZonalHarmonics zonalSphere(double radius, double distance) {
    CHECK(radius >= 0.0 && distance >= 0.0 && radius + distance > 0.0);
    if (distance <= radius)
        return cap(-1.0, 0.0);
    const double sine = radius / distance;
    return cap(std::sqrt((1.0 - sine) * (1.0 + sine)), sine * sine);
}

ZonalHarmonics zonalDirectional() {
    ZonalHarmonics c{};
    for (int l = 0; l < kMaxShOrder; ++l)
        c[l] = normalisation(l); // Y_l0(+z)
    return c;
}

ZonalHarmonics zonalCosine() {
    ZonalHarmonics c{};
    for (int l = 0; l < kMaxShOrder; ++l)
        c[l] = cosineConvolution(l) * normalisation(l);
    return c;
}

double directionalScale(int order) {
    CHECK(order >= 1 && order <= kMaxShOrder);
    double kept = 0.0;
    for (int l = 0; l < order; ++l)
        kept += cosineConvolution(l) * normalisation(l) * normalisation(l);
    return 1.0 / kept;
}

void addZonal(const ZonalHarmonics& zonal, const glm::dvec3& direction, const glm::dvec3& color,
              std::span<glm::vec3> coefficients) {
    forEachTurned(zonal, direction, shOrderOf(coefficients.size()), [&](int i, double c) {
        coefficients[i] = glm::vec3(glm::dvec3(coefficients[i]) + color * c);
    });
}

void addZonal(const ZonalHarmonics& zonal, const glm::dvec3& direction, double value,
              std::span<double> coefficients) {
    forEachTurned(zonal, direction, shOrderOf(coefficients.size()),
                  [&](int i, double c) { coefficients[i] += value * c; });
}

void convolveWithZonal(const ZonalHarmonics& kernel, std::span<glm::vec3> coefficients) {
    const int order = shOrderOf(coefficients.size());
    for (int l = 0; l < order; ++l)
        for (int m = -l; m <= l; ++m)
            coefficients[shIndex(l, m)] *= static_cast<float>(kernel[l] / normalisation(l));
}

} // namespace patina
