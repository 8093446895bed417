// Rotation of coefficients against independently computed matrices and against rotated directions.
#include "core/math/ShRotation.h"

#include "core/math/Sampling.h"
#include "tests/core/light/LatLongPicture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

namespace patina {
namespace {

using std::numbers::pi;

// Active rotation by 40° about (1, 2, 2) / 3.
ShRotation knownRotation(int order) {
    return ShRotation::aboutAxis({1, 2, 2}, glm::radians(40.0), order);
}

TEST(Rotation, MatchesIndependentBandMatrices) {
    // 24 × 48 product quadrature, M Mᵀ = I to 1e-12.
    constexpr double kL1[3][3] = {{0.870024690622, 0.11028228906, 0.480515196876},
                                  {-0.318242784065, 0.870024690622, 0.376534949373},
                                  {-0.376534949373, -0.480515196876, 0.792039504995}};
    constexpr double kL2[5][5] = {
        {0.508163159965, -0.459585221629, -0.0917853834445, -0.143546924792, 0.708181721512},
        {0.174674208797, 0.721846419588, 0.166187355476, 0.459585221629, 0.457809845077},
        {-0.207550835222, -0.479568633677, 0.635414443437, 0.567410669603, 0.0350741141481},
        {-0.393839425258, -0.174674208797, -0.724101308704, 0.508163159965, 0.178401024328},
        {-0.716290640415, 0.0849824509085, 0.189428049852, -0.433579334515, 0.505798058618}};
    constexpr double kL3[7][7] = {
        {0.115849195192, -0.395806057075, 0.222899624678, 0.059331891352, 0.0204884278829,
         -0.348454014721, 0.809241643201},
        {-0.0416811702123, 0.314747370865, -0.605554143709, -0.178562437811, -0.229016619284,
         0.415825468657, 0.524649383046},
        {-0.0773858239492, 0.21939218255, 0.529355513808, 0.188062467718, 0.424844180749,
         0.633307909132, 0.220731209935},
        {-0.0815305356189, -0.403776524282, -0.542693879635, 0.341360630532, 0.642098494374,
         0.0682343864712, -0.0482405965548},
        {-0.19855734751, -0.450735425963, 0.0704759011529, -0.819414200332, 0.157865452382,
         0.2300285668, -0.0563154382287},
        {-0.527467049384, -0.453208185443, 0.0618727822935, 0.368519835099, -0.531332973976,
         0.303844078469, -0.0459324412212},
        {-0.80904841734, 0.352906733884, 0.00953601227669, -0.0738519469131, 0.217053743878,
         -0.393318922009, 0.116363000323}};
    const ShRotation rotation = knownRotation(5);
    for (int row = -1; row <= 1; ++row)
        for (int column = -1; column <= 1; ++column)
            EXPECT_NEAR(rotation.element(1, row, column), kL1[row + 1][column + 1], 1e-11);
    for (int row = -2; row <= 2; ++row)
        for (int column = -2; column <= 2; ++column)
            EXPECT_NEAR(rotation.element(2, row, column), kL2[row + 2][column + 2], 1e-11);
    for (int row = -3; row <= 3; ++row)
        for (int column = -3; column <= 3; ++column)
            EXPECT_NEAR(rotation.element(3, row, column), kL3[row + 3][column + 3], 1e-11);
    // Without the phase rows and columns of odd m change their sign: the tables' other half.
    EXPECT_NEAR(-rotation.element(1, -1, 0), -0.11028228906, 1e-11);
    EXPECT_NEAR(-rotation.element(2, 2, -1), -0.0849824509085, 1e-11);
    EXPECT_NEAR(-rotation.element(3, 3, -2), -0.352906733884, 1e-11);
    EXPECT_NEAR(rotation.element(3, -3, -3), 0.115849195192, 1e-11);
}

TEST(Rotation, RotatesAKnownVector) {
    const std::array<float, 9> c = {0.7f, -0.3f, 0.9f, 0.2f, 0.5f, -0.4f, 0.1f, 0.3f, -0.6f};
    constexpr std::array<double, 9> kRotated = {0.7,
                                                -0.0656503076578,
                                                0.953802046654,
                                                -0.161095291377,
                                                -0.0392359800558,
                                                -0.321593068447,
                                                0.300772212596,
                                                -0.154051826588,
                                                -0.806748131111};
    std::array<float, 9> out{};
    knownRotation(3).apply(std::span<const float>(c), std::span<float>(out));
    for (int i = 0; i < 9; ++i)
        EXPECT_NEAR(out[i], kRotated[i], 1e-6) << i;
    // A band's energy stays.
    constexpr double kEnergy[3] = {0.49, 0.94, 0.87};
    for (int l = 0; l < 3; ++l) {
        double energy = 0.0;
        for (int m = -l; m <= l; ++m)
            energy += double{out[shIndex(l, m)]} * double{out[shIndex(l, m)]};
        EXPECT_NEAR(energy, kEnergy[l], 1e-6) << l;
    }
}

// max |M Y(d) - Y(R d)| over 50 directions.
double worstOf(const glm::dmat3& r, int order = 8) {
    const ShRotation rotation(r, order);
    double worst = 0.0;
    for (std::uint32_t i = 0; i < 50; ++i) {
        const glm::dvec3 d = glm::normalize(glm::dvec3(uniformSphere(sobolOwen2D(i, 1))));
        std::array<double, 64> y{}, turned{};
        evaluateSh(order, d, y);
        evaluateSh(order, r * d, turned);
        for (int l = 0; l < order; ++l)
            for (int row = -l; row <= l; ++row) {
                double sum = 0.0;
                for (int column = -l; column <= l; ++column)
                    sum += rotation.element(l, row, column) * y[shIndex(l, column)];
                worst = std::max(worst, std::abs(sum - turned[shIndex(l, row)]));
            }
    }
    return worst;
}

glm::dmat3 turn(const glm::dvec3& axis, double angleRad) {
    return glm::dmat3(glm::rotate(glm::dmat4(1.0), angleRad, glm::normalize(axis)));
}

TEST(Rotation, EqualsEvaluationInTheRotatedDirection) {
    EXPECT_LT(worstOf(turn({0.3, -0.8, 0.5}, 2.1)), 1e-12);
    for (int order = 1; order <= 8; ++order)
        EXPECT_LT(worstOf(turn({-0.7, 0.1, 0.2}, -1.3), order), 1e-12) << order;
    for (std::uint32_t i = 0; i < 100; ++i) {
        const glm::dvec3 axis(uniformSphere(sobolOwen2D(i, 5)));
        EXPECT_LT(worstOf(turn(axis, 0.0628 * i)), 1e-12) << i;
    }
}

TEST(Rotation, IsExactWhereTheZonalAxisStaysOrTurnsRound) {
    // Euler angles are not unique there, and nearly so just beside it.
    for (const double tilt : {0.0, 1e-300, 1e-17, 1e-12, 1e-8, 1e-4})
        for (const double around : {0.0, 0.7, pi / 2, pi, -2.5}) {
            const glm::dmat3 nearly = turn({0.6, 0.8, 0.0}, tilt) * turn({0, 0, 1}, around);
            EXPECT_LT(worstOf(nearly), 1e-12) << tilt << " " << around;
            EXPECT_LT(worstOf(turn({1, 0, 0}, pi) * nearly), 1e-12) << tilt << " " << around;
            EXPECT_LT(worstOf(nearly * turn({0, 1, 0}, pi)), 1e-12) << tilt << " " << around;
        }
    EXPECT_LT(worstOf(glm::dmat3(1.0)), 1e-14);
}

TEST(Rotation, MirrorsToo) {
    const glm::dmat3 mirrors[] = {
        glm::dmat3(-1.0), // the opposite direction
        glm::dmat3(glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, -1)),
        glm::dmat3(glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1), glm::dvec3(0, 1, 0)),
        turn({1, 2, 3}, 0.8) * glm::dmat3(glm::dvec3(-1, 0, 0), {0, 1, 0}, {0, 0, 1})};
    for (const glm::dmat3& mirror : mirrors)
        EXPECT_LT(worstOf(mirror), 1e-12);
}

TEST(Rotation, MatricesAreOrthogonalAndComposeLikeRotations) {
    const glm::dmat3 a = turn({1, -2, 0.5}, 1.1), b = turn({0.2, 0.3, -1}, -2.7);
    const ShRotation ra(a, 8), rb(b, 8), rab(a * b, 8);
    for (int l = 0; l < 8; ++l)
        for (int i = -l; i <= l; ++i)
            for (int j = -l; j <= l; ++j) {
                double product = 0.0, gram = 0.0;
                for (int k = -l; k <= l; ++k) {
                    product += ra.element(l, i, k) * rb.element(l, k, j);
                    gram += ra.element(l, i, k) * ra.element(l, j, k);
                }
                ASSERT_NEAR(product, rab.element(l, i, j), 1e-13);
                ASSERT_NEAR(gram, i == j ? 1.0 : 0.0, 1e-13);
            }
}

TEST(Rotation, AboutYTurnsAnEnvironmentLikeItsImage) {
    // Counter-clockwise as seen from above: what was at +Z is then at +X.
    const auto scene = [](const glm::dvec3& d) {
        return glm::vec3(static_cast<float>(1.0 + d.x + 2.0 * d.z * d.x + d.y * d.z),
                         static_cast<float>(d.z * d.z * d.z), static_cast<float>(d.y));
    };
    const glm::dmat3 quarter = turn({0, 1, 0}, pi / 2);
    EXPECT_NEAR((quarter * glm::dvec3(0, 0, 1)).x, 1.0, 1e-12);
    const auto original = projectLatLong(test::latLongImage(128, 64, scene), 5);
    const auto expected = projectLatLong(
        test::latLongImage(128, 64,
                           [&](const glm::dvec3& d) { return scene(glm::transpose(quarter) * d); }),
        5);
    std::vector<glm::vec3> rotated(25);
    ShRotation::aboutY(pi / 2, 5).apply(std::span<const glm::vec3>(original), rotated);
    for (int i = 0; i < 25; ++i)
        EXPECT_LT(glm::length(rotated[i] - expected[i]), 2e-6f) << i;

    // The shared rotateY turns directions the same way.
    const glm::vec3 turned = shading::rotateY({0, 0, 1}, shading::kPi / 2);
    EXPECT_NEAR(turned.x, 1.0f, 1e-6f);
}

} // namespace
} // namespace patina
