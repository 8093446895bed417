// Products against closed forms, against products of values, and each other.
#include "core/math/ShProduct.h"

#include "core/math/Quadrature.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

namespace patina {
namespace {

TEST(ShProduct, GauntsOfTheFirstBands) {
    // Closed forms; (1 1)² keeps its value whatever the phase. (lm) as in the names.
    const int y00 = shIndex(0, 0), y10 = shIndex(1, 0), y11 = shIndex(1, 1);
    const int y20 = shIndex(2, 0), y22 = shIndex(2, 2);
    EXPECT_NEAR(gaunt(y00, y00, y00), 0.282094791774, 1e-10);
    for (int i = 0; i < 64; ++i) {
        EXPECT_NEAR(gaunt(y00, i, i), 0.282094791774, 1e-10) << i;
        EXPECT_NEAR(gaunt(i, y00, (i + 1) % 64), 0.0, 1e-12) << i;
    }
    EXPECT_NEAR(gaunt(y10, y10, y20), 0.252313252202, 1e-10);
    EXPECT_NEAR(gaunt(y11, y11, y20), -0.126156626101, 1e-10);
    EXPECT_NEAR(gaunt(y11, y11, y22), 0.218509686118, 1e-10);
    EXPECT_NEAR(gaunt(y20, y20, y20), 0.180223751573, 1e-10);
}

TEST(ShProduct, LeavesNoCouplingOut) {
    // All of order 5 by quadrature without selection rules, in every order of the indices.
    const GaussLegendre rule(10);
    std::vector<double> all(25 * 25 * 25, 0.0);
    std::array<double, 25> y{};
    for (int h = 0; h < 10; ++h)
        for (int a = 0; a < 20; ++a) {
            const double z = 2.0 * rule.node01(h) - 1.0, r = std::sqrt(1.0 - z * z);
            const double phi = 2.0 * std::numbers::pi * a / 20.0;
            evaluateSh(5, {r * std::cos(phi), r * std::sin(phi), z}, y);
            const double weight = 2.0 * rule.weight01(h) * 2.0 * std::numbers::pi / 20.0;
            for (int i = 0; i < 25; ++i)
                for (int j = 0; j < 25; ++j)
                    for (int k = 0; k < 25; ++k)
                        all[(i * 25 + j) * 25 + k] += weight * y[i] * y[j] * y[k];
        }
    for (int i = 0; i < 25; ++i)
        for (int j = 0; j < 25; ++j)
            for (int k = 0; k < 25; ++k)
                ASSERT_NEAR(gaunt(i, j, k), all[(i * 25 + j) * 25 + k], 1e-12)
                    << i << " " << j << " " << k;
}

std::vector<glm::vec3> someLight(int coefficients) {
    std::vector<glm::vec3> c;
    for (int i = 0; i < coefficients; ++i)
        c.emplace_back(std::sin(1.0 + i), std::cos(2.0 * i), 0.3 - 0.01 * i);
    return c;
}

TEST(ShProduct, IsTheProductOfValues) {
    // Bands 0 … 2 times bands 0 … 2 fit into five: no value is lost.
    std::vector<glm::vec3> light = someLight(9), product(25);
    std::vector<float> scalar;
    for (int i = 0; i < 9; ++i)
        scalar.push_back(static_cast<float>(std::cos(5.0 * i)));
    light.resize(25, glm::vec3(0.0f));
    scalar.resize(25, 0.0f);
    ShProduct(5).multiply(light, scalar, product);
    std::array<double, 25> y{};
    for (int n = 0; n < 50; ++n) {
        evaluateSh(5, glm::normalize(glm::dvec3(std::sin(n), std::cos(3.0 * n), 0.04 * n - 1)), y);
        glm::dvec3 l(0.0), p(0.0);
        double s = 0.0;
        for (int i = 0; i < 25; ++i) {
            l += y[i] * glm::dvec3(light[i]);
            p += y[i] * glm::dvec3(product[i]);
            s += y[i] * double{scalar[i]};
        }
        EXPECT_LT(glm::length(p - s * l), 2e-6) << n;
    }
}

TEST(ShProduct, CutsOffLikeQuadrature) {
    for (int order = 1; order <= 8; ++order) {
        const int count = shCount(order);
        const std::vector<glm::vec3> light = someLight(count);
        std::vector<float> scalar;
        for (int i = 0; i < count; ++i)
            scalar.push_back(static_cast<float>(std::cos(5.0 * i)));
        std::vector<glm::vec3> product(count), expected(count);
        ShProduct(order).multiply(light, scalar, product);
        multiplyByFunction(
            light,
            [&](const glm::dvec3& d) {
                std::array<double, 64> y{};
                evaluateSh(order, d, y);
                double sum = 0.0;
                for (int i = 0; i < count; ++i)
                    sum += y[i] * double{scalar[i]};
                return sum;
            },
            12, expected);
        for (int i = 0; i < count; ++i)
            ASSERT_LT(glm::length(product[i] - expected[i]), 2e-5f) << order << " " << i;
    }
}

TEST(ShProduct, WithAFunction) {
    // A constant sky times z: 4pi/3 of band 1 / (2 sqrt(pi/3)), and nothing else.
    const std::vector<glm::vec3> sky = {{3.54490770181, 0.0, 2 * 3.54490770181}};
    std::vector<glm::vec3> out(9);
    multiplyByFunction(
        sky, [](const glm::dvec3& d) { return d.z; }, 2, out);
    for (int i = 0; i < 9; ++i) {
        EXPECT_NEAR(out[i].x, i == 2 ? 2.0466534158929770 : 0.0, 1e-6) << i;
        EXPECT_NEAR(out[i].z, i == 2 ? 2 * 2.0466534158929770 : 0.0, 2e-6) << i;
        EXPECT_EQ(out[i].y, 0.0f);
    }
}

} // namespace
} // namespace patina
