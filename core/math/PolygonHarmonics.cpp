#include "core/math/PolygonHarmonics.h"

#include "core/base/Check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <glm/geometric.hpp>
#include <numbers>

namespace patina {
namespace {

constexpr int kMaxCount = shCount(kMaxShOrder);

// Below this angular size the edges' sums would lose the digits that a sample in the middle keeps:
// its error is of the order of l² size², theirs of 1e-16 / size.
constexpr double kSmall = 1e-6;

using Harmonics = std::array<double, kMaxCount>;
using Complex = std::complex<double>;

// ∫ Y_i along the arc from unit vector a to b, all bands below `order`, at angle (radians) about
// `middle`, with `along` = the direction of travel there.
//
// On a great circle a harmonic of band l is a trigonometric polynomial of the frequencies l, l - 2,
// … of the arc's angle: as many samples on half of the circle as there are frequencies hold it, and
// the integral of each sample's interpolation kernel (Dirichlet's) is its weight.
void integrateArc(const glm::dvec3& middle, const glm::dvec3& along, double angle, int order,
                  Harmonics& sums) {
    const int nodes = order; // frequencies 0 … order - 1
    sums.fill(0.0);
    Harmonics y{};
    for (int j = 0; j < nodes; ++j) {
        const double t = std::numbers::pi * j / nodes;
        // Kernels of the even and of the odd frequencies, integrated over -angle/2 … angle/2.
        std::array<double, 2> weight{angle, 0.0};
        for (int k = 1; k < order; ++k)
            weight[k % 2] += 4.0 / k * std::sin(0.5 * k * angle) * std::cos(k * t);
        evaluateSh(order, glm::normalize(middle * std::cos(t) + along * std::sin(t)), y);
        for (int l = 0; l < order; ++l)
            for (int i = shIndex(l, -l); i <= shIndex(l, l); ++i)
                sums[i] += weight[l % 2] / nodes * y[i];
    }
}

// ∫ n·∇(r^l Y_lm) along the arc from `arc`, the integrals of Y_l-1: differentiating a solid
// harmonic of degree l gives those of degree l - 1. Complex harmonics, Y_l-m = (-1)^m conj(Y_lm).
Complex slope(const Harmonics& arc, const glm::dvec3& n, int l, int m) {
    const auto integral = [&](int order) -> Complex {
        const int size = std::abs(order);
        if (size > l - 1)
            return 0.0;
        if (size == 0)
            return arc[shIndex(l - 1, 0)];
        const Complex value =
            Complex(arc[shIndex(l - 1, size)], arc[shIndex(l - 1, -size)]) / std::numbers::sqrt2;
        return order > 0 ? value : (size % 2 == 0 ? 1.0 : -1.0) * std::conj(value);
    };
    const Complex plus(n.x, n.y);
    const auto root = [](int product) { return std::sqrt(static_cast<double>(product)); };
    return std::sqrt((2.0 * l + 1.0) / (2.0 * l - 1.0)) *
           (n.z * root((l - m) * (l + m)) * integral(m) +
            0.5 * std::conj(plus) * root((l - m) * (l - m - 1)) * integral(m + 1) -
            0.5 * plus * root((l + m) * (l + m - 1)) * integral(m - 1));
}

} // namespace

double polygonSolidAngle(std::span<const glm::dvec3> corners) {
    CHECK(corners.size() >= 3);
    double sum = 0.0;
    const glm::dvec3& a = corners[0];
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        const glm::dvec3 &b = corners[i], &c = corners[i + 1];
        const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
        // The determinant from differences: small polygons keep their digits.
        const double volume = glm::dot(a, glm::cross(b - a, c - a));
        sum += 2.0 * std::atan2(volume, la * lb * lc + glm::dot(a, b) * lc + glm::dot(a, c) * lb +
                                            glm::dot(b, c) * la);
    }
    return sum;
}

void projectPolygon(std::span<const glm::dvec3> corners, std::span<double> out) {
    const int order = static_cast<int>(std::lround(std::sqrt(static_cast<double>(out.size()))));
    CHECK(order >= 1 && order <= kMaxShOrder);
    CHECK_EQ(static_cast<std::size_t>(shCount(order)), out.size());
    std::fill(out.begin(), out.end(), 0.0);

    const double solidAngle = polygonSolidAngle(corners);
    glm::dvec3 middle(0.0);
    double size = 0.0, farthest = 0.0;
    for (const glm::dvec3& corner : corners) {
        middle += corner;
        size = std::max(size, glm::length(corner - corners[0]));
        farthest = std::max(farthest, glm::length(corner));
    }
    if (!std::isfinite(solidAngle) || !(farthest > 0.0))
        return;
    // Edge-on, or the point is on the border: nothing is seen.
    if (std::abs(solidAngle) < 1e-14 * (size / farthest) || glm::length(middle) == 0.0)
        return;
    if (size < kSmall * farthest) {
        Harmonics y{};
        evaluateSh(order, glm::normalize(middle), y);
        for (int i = 0; i < shCount(order); ++i)
            out[i] = solidAngle * y[i];
        return;
    }
    out[0] = solidAngle * std::sqrt(0.25 / std::numbers::pi);

    // Δ Y_lm = -l (l + 1) Y_lm: Gauss' theorem on the sphere leaves the slope across each edge.
    Harmonics arc{};
    for (std::size_t i = 0; i < corners.size() && order > 1; ++i) {
        const glm::dvec3 &p = corners[i], &q = corners[(i + 1) % corners.size()];
        const glm::dvec3 normal = glm::cross(p, q - p);
        const double length = glm::length(normal);
        if (!(length > 1e-14 * glm::length(p) * glm::length(q)))
            continue; // the edge points at us
        const glm::dvec3 n = normal / length;
        const double angle = std::atan2(length, glm::dot(p, q));
        const glm::dvec3 from = glm::normalize(p);
        const glm::dvec3 across = glm::cross(n, from);
        const double half = 0.5 * angle;
        integrateArc(from * std::cos(half) + across * std::sin(half),
                     across * std::cos(half) - from * std::sin(half), angle, order - 1, arc);
        for (int l = 1; l < order; ++l)
            for (int m = 0; m <= l; ++m) {
                const Complex value = slope(arc, n, l, m) / (l * (l + 1.0));
                if (m == 0) {
                    out[shIndex(l, 0)] += value.real();
                } else {
                    out[shIndex(l, m)] += std::numbers::sqrt2 * value.real();
                    out[shIndex(l, -m)] += std::numbers::sqrt2 * value.imag();
                }
            }
    }
}

} // namespace patina
