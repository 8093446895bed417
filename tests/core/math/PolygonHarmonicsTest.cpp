// The closed form of a polygon's harmonics against numerical quadrature, and where it degenerates.
#include "core/math/PolygonHarmonics.h"

#include "core/math/Quadrature.h"
#include "core/math/Shading.h"
#include "core/math/ZonalHarmonics.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <numbers>
#include <random>
#include <vector>

namespace patina {
namespace {

using std::numbers::pi;
using Quad = std::array<glm::dvec3, 4>;

std::vector<double> project(std::span<const glm::dvec3> corners, int order) {
    std::vector<double> out(static_cast<std::size_t>(shCount(order)), -1.0);
    projectPolygon(corners, out);
    return out;
}

// ∫ Y dA cos / r² over a parallelogram by Gauss points on `cells`² pieces, radiance 1 on both
// sides.
std::vector<double> quadrature(const Quad& q, int order, int cells) {
    static constexpr std::array<double, 3> kAt{-0.7745966692414834, 0.0, 0.7745966692414834};
    static constexpr std::array<double, 3> kWeight{5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
    const glm::dvec3 x = q[1] - q[0], y = q[3] - q[0], normal = glm::cross(x, y);
    std::vector<double> sum(static_cast<std::size_t>(shCount(order))), basis(sum.size());
    for (int i = 0; i < 3 * cells; ++i)
        for (int j = 0; j < 3 * cells; ++j) {
            const double u = (i / 3 + 0.5 + 0.5 * kAt[i % 3]) / cells;
            const double v = (j / 3 + 0.5 + 0.5 * kAt[j % 3]) / cells;
            const glm::dvec3 p = q[0] + u * x + v * y;
            const double r = glm::length(p);
            const double weight = kWeight[i % 3] * kWeight[j % 3] / (4.0 * cells * cells) *
                                  std::abs(glm::dot(normal, p)) / (r * r * r);
            evaluateSh(order, p / r, basis);
            for (std::size_t k = 0; k < sum.size(); ++k)
                sum[k] += weight * basis[k];
        }
    return sum;
}

Quad rectangle(const glm::dvec3& center, const glm::dvec3& x, const glm::dvec3& y) {
    return {center - x - y, center + x - y, center + x + y, center - x + y};
}

TEST(PolygonHarmonics, AgreesWithQuadratureInAllEightBands) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const auto vector = [&] {
        return glm::dvec3(uniform(random), uniform(random), uniform(random));
    };
    for (int i = 0; i < 30; ++i) {
        SCOPED_TRACE(i);
        const double size = std::pow(10.0, uniform(random) - 0.7);
        const glm::dvec3 x = size * glm::normalize(vector());
        const glm::dvec3 y = 0.6 * size * glm::normalize(glm::cross(x, vector()));
        // Anywhere around, also across the horizon and the poles; not closer than its size / 3.
        glm::dvec3 center = vector();
        const glm::dvec3 normal = glm::normalize(glm::cross(x, y));
        if (std::abs(glm::dot(center, normal)) < size / 3.0)
            center += normal * size;
        const Quad q = rectangle(center, x, y);
        const std::vector<double> expected = quadrature(q, 8, 60);
        const std::vector<double> actual = project(q, 8);
        const double side = actual[0] < 0.0 ? -1.0 : 1.0;
        for (std::size_t k = 0; k < expected.size(); ++k)
            EXPECT_NEAR(side * actual[k], expected[k], 1e-6) << k;
        for (const int order : {1, 2, 5}) { // fewer bands are the first of more
            const std::vector<double> low = project(q, order);
            for (std::size_t k = 0; k < low.size(); ++k)
                EXPECT_NEAR(low[k], actual[k], 1e-12) << order << ' ' << k;
        }
    }
}

// The six faces of a cube around the point are light from everywhere: sqrt(4pi) and nothing else.
TEST(PolygonHarmonics, FacesOfACubeAddUpToTheSphere) {
    std::vector<double> sum(64, 0.0);
    const std::array<glm::dvec3, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (std::size_t a = 0; a < 3; ++a)
        for (const double s : {-1.0, 1.0}) {
            const glm::dvec3 n = s * axes[a], x = axes[(a + 1) % 3], y = glm::cross(n, x);
            const std::vector<double> face = project(rectangle(n, x, y), 8);
            EXPECT_NEAR(face[0], 4.0 * pi / 6.0 * std::sqrt(0.25 / pi), 1e-14);
            for (std::size_t k = 0; k < 64; ++k)
                sum[k] += face[k];
        }
    EXPECT_NEAR(sum[0], std::sqrt(4.0 * pi), 1e-13);
    for (std::size_t k = 1; k < 64; ++k)
        EXPECT_NEAR(sum[k], 0.0, 1e-13) << k;
}

// Clockwise as seen from the point is the lit side of lights.glsl's quadrilaterals.
TEST(PolygonHarmonics, TheOtherSideCountsNegative) {
    const Quad q = rectangle({0.3, -0.2, 2.0}, {0.5, 0.0, 0.1}, {0.0, 0.4, 0.2});
    const Quad back{q[3], q[2], q[1], q[0]};
    const std::vector<double> lit = project(q, 5), dark = project(back, 5);
    EXPECT_GT(lit[0], 0.0);
    EXPECT_GT(shading::quadFormFactor(q[0], q[1], q[2], q[3]), 0.0f);
    for (std::size_t k = 0; k < lit.size(); ++k)
        EXPECT_NEAR(dark[k], -lit[k], 1e-15) << k;
    // Its irradiance where all of it is above the horizon is the form factor, and all even bands
    // below the horizon carry none.
    std::vector<double> many = project(q, 8);
    const ZonalHarmonics cosine = zonalCosine();
    double irradiance = 0.0;
    for (int l = 0; l < 8; ++l)
        irradiance +=
            cosine[static_cast<std::size_t>(l)] * many[static_cast<std::size_t>(shIndex(l, 0))];
    EXPECT_NEAR(irradiance, pi * shading::quadFormFactor(q[0], q[1], q[2], q[3]),
                0.02 * irradiance); // what is left out beyond band 7
}

TEST(PolygonHarmonics, DegenerateViewsAreDarkOrTheirLimit) {
    const auto largest = [](const std::vector<double>& values) {
        double most = 0.0;
        for (const double value : values)
            most = std::max(most, std::abs(value));
        return most;
    };
    // Edge-on, also with an edge that points at us.
    EXPECT_EQ(largest(project(rectangle({0, 0, 3}, {0, 0, 1}, {1, 0, 0}), 8)), 0.0);
    EXPECT_LT(largest(project(rectangle({2, 1, 0}, {2, 1, 0.0}, {-0.2, 0.4, 0}), 8)), 1e-13);
    // On a corner, on an edge, in the plane within it.
    EXPECT_EQ(largest(project(rectangle({1, 1, 0}, {1, 0, 0}, {0, 1, 0}), 8)), 0.0);
    for (const double value : project(rectangle({1, 0, 0}, {1, 0, 0}, {0, 1, 0}), 8))
        EXPECT_TRUE(std::isfinite(value));
    // Without extent.
    EXPECT_EQ(largest(project(rectangle({1, 2, 3}, {0, 0, 0}, {0, 1, 0}), 8)), 0.0);
    EXPECT_EQ(largest(project(rectangle({0, 0, 0}, {0, 0, 0}, {0, 0, 0}), 8)), 0.0);
    EXPECT_EQ(largest(project(rectangle({NAN, 0, 0}, {1, 0, 0}, {0, 1, 0}), 8)), 0.0);

    // Huge: half of all directions.
    const std::vector<double> wall = project(rectangle({0, 0, 1e-6}, {1e6, 0, 0}, {0, 1e6, 0}), 8);
    const ZonalHarmonics half = zonalCap(0.5 * pi);
    for (int l = 0; l < 8; ++l)
        for (int m = -l; m <= l; ++m)
            EXPECT_NEAR(wall[static_cast<std::size_t>(shIndex(l, m))],
                        m == 0 ? half[static_cast<std::size_t>(l)] : 0.0, 1e-9)
                << l << ' ' << m;

    // Tiny: a sample times the solid angle, on both sides of where the method changes.
    const glm::dvec3 d = glm::normalize(glm::dvec3(1, -2, 0.5));
    const glm::dvec3 x = glm::normalize(glm::cross(d, glm::dvec3(0, 0, 1)));
    const glm::dvec3 y = glm::cross(d, x);
    std::vector<double> basis(64);
    evaluateSh(8, d, basis);
    for (const double size : {1e-9, 3e-7, 5e-6, 1e-4}) {
        const std::vector<double> small =
            project(rectangle(10.0 * d, 5.0 * size * x, 5.0 * size * y), 8);
        for (std::size_t k = 0; k < 64; ++k)
            EXPECT_NEAR(small[k] / (size * size), basis[k], 1e-6) << size << ' ' << k;
    }
}

TEST(PolygonHarmonics, SolidAngles) {
    const Quad octant{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 1}}};
    EXPECT_NEAR(polygonSolidAngle(std::span(octant).first(3)), pi / 2, 1e-15);
    // A rectangle 2a × 2b at distance d: 4 asin(a b / sqrt((a² + d²) (b² + d²))).
    const double expected = 4.0 * std::asin(1.0 * 0.5 / std::sqrt((1.0 + 4.0) * (0.25 + 4.0)));
    EXPECT_NEAR(polygonSolidAngle(rectangle({0, 0, 2}, {1, 0, 0}, {0, 0.5, 0})), expected, 1e-15);
}

} // namespace
} // namespace patina
