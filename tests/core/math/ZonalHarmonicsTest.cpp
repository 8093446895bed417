// Lights in closed form against literature values, quadrature and each other.
#include "core/math/ZonalHarmonics.h"

#include "core/math/Quadrature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <vector>

namespace patina {
namespace {

using std::numbers::pi;

// 2pi ∫ Y_l0 dz from cos(a) to 1, the definition.
ZonalHarmonics capByQuadrature(double halfAngleRad) {
    const GaussLegendre rule(16);
    const double from = std::cos(halfAngleRad), length = 1.0 - from;
    ZonalHarmonics c{};
    std::array<double, 64> y{};
    for (int i = 0; i < rule.size(); ++i) {
        const double z = from + length * rule.node01(i);
        evaluateSh(8, glm::dvec3(std::sqrt(1.0 - z * z), 0.0, z), y);
        for (int l = 0; l < 8; ++l)
            c[l] += 2.0 * pi * length * rule.weight01(i) * y[shIndex(l, 0)];
    }
    return c;
}

double irradiance(const std::vector<double>& radiance, const glm::dvec3& n) {
    std::array<double, 64> y{};
    const int order = static_cast<int>(std::lround(std::sqrt(double(radiance.size()))));
    evaluateSh(order, n, y);
    double sum = 0.0;
    for (int l = 0; l < order; ++l)
        for (int m = -l; m <= l; ++m)
            sum += cosineConvolution(l) * radiance[shIndex(l, m)] * y[shIndex(l, m)];
    return sum;
}

TEST(ZonalHarmonics, Caps) {
    // sqrt(pi / (2l + 1)) (P_l-1(cos a) - P_l+1(cos a)); l = 0: sqrt(pi) (1 - cos a).
    constexpr struct {
        double halfAngleDeg;
        double zonal[6];
    } kCaps[] = {{5,
                  {0.00674472202114, 0.0116599740722, 0.0149956807354, 0.0176417873072,
                   0.019851373115, 0.0217369330213}},
                 {10,
                  {0.0269275566774, 0.046285613877, 0.058846665896, 0.0680375186566,
                   0.0747849206093, 0.0794878958995}},
                 {30,
                  {0.237463788986, 0.38374751548, 0.429042765405, 0.40300150858, 0.323786966186,
                   0.212409064572}},
                 {45,
                  {0.51913971359, 0.76749503096, 0.70062390205, 0.43963800936, 0.117498200373,
                   -0.137778852695}},
                 {60,
                  {0.886226925453, 1.15124254644, 0.743123868301, 0.10990950234, -0.311564153479,
                   -0.327224775152}},
                 {90, {1.77245385091, 1.53499006192, 0.0, -0.586184012479, 0.0, 0.367410273855}},
                 {120,
                  {2.65868077636, 1.15124254644, -0.743123868301, 0.10990950234, 0.311564153479,
                   -0.327224775152}},
                 {180, {3.54490770181, 0.0, 0.0, 0.0, 0.0, 0.0}}};
    for (const auto& cap : kCaps) {
        const ZonalHarmonics c = zonalCap(glm::radians(cap.halfAngleDeg));
        const ZonalHarmonics expected = capByQuadrature(glm::radians(cap.halfAngleDeg));
        for (int l = 0; l < 6; ++l)
            EXPECT_NEAR(c[l], cap.zonal[l], 1e-10) << cap.halfAngleDeg << " " << l;
        for (int l = 0; l < 8; ++l)
            EXPECT_NEAR(c[l], expected[l], 1e-12) << cap.halfAngleDeg << " " << l;
    }
    // Half of all directions: 1.77245385091, 1.53499006192, 0, -0.586184012479, 0, 0.367410273855
    // and irradiance pi (1 + n.z) / 2, to which two bands suffice.
    std::vector<double> half(4, 0.0);
    addZonal(zonalCap(pi / 2), {0, 0, 1}, 1.0, half);
    for (const double z : {1.0, 0.5, 0.0, -0.5, -1.0})
        EXPECT_NEAR(irradiance(half, {std::sqrt(1 - z * z), 0, z}), pi * (1 + z) / 2, 1e-12);
}

TEST(ZonalHarmonics, SmallLightsKeepTheirDigits) {
    // A cap of solid angle 2pi (1 - cos a) tends to that times Y_l0(+z); the quotient is
    // 1 - (l (l + 1) / 8) a² to first order.
    for (const double a : {1e-3, 1e-5, 1e-8}) {
        const ZonalHarmonics c = zonalCap(a), point = zonalDirectional();
        const double half = std::sin(a / 2);
        const double solidAngle = 4.0 * pi * half * half;
        for (int l = 0; l < 8; ++l)
            EXPECT_NEAR(c[l] / (solidAngle * point[l]), 1.0 - l * (l + 1) / 8.0 * a * a, 1e-10)
                << a << " " << l;
    }
}

TEST(ZonalHarmonics, DiscsAndSpheresAreCapsOfTheirSize) {
    const auto expectSame = [](const ZonalHarmonics& a, const ZonalHarmonics& b) {
        for (int l = 0; l < 8; ++l)
            EXPECT_NEAR(a[l], b[l], 1e-12) << l;
    };
    expectSame(zonalDisc(3.0, 4.0), zonalCap(std::atan2(3.0, 4.0)));
    expectSame(zonalDisc(2.0, 0.0), zonalCap(pi / 2));
    expectSame(zonalDisc(0.0, 1.0), zonalCap(0.0));
    expectSame(zonalSphere(3.0, 5.0), zonalCap(std::asin(0.6)));
    expectSame(zonalSphere(0.0, 1.0), ZonalHarmonics{});
    const ZonalHarmonics everywhere = {3.54490770181103}; // sqrt(4pi)
    expectSame(zonalSphere(2.0, 1.0), everywhere);
    expectSame(zonalSphere(2.0, 0.0), everywhere);
    // Touching, as the sine's root is steep: half of all directions from outside.
    EXPECT_NEAR(zonalSphere(1.0, 1.0 + 1e-12)[0], zonalCap(pi / 2)[0], 1e-5);
}

TEST(ZonalHarmonics, IrradianceOfCaps) {
    // On the axis at orders 3, 4, 5 and 6; exactly pi sin² a.
    constexpr struct {
        double halfAngleDeg, order3, order5, exact;
    } kCaps[] = {{5, 0.0253384159925, 0.0231393133223, 0.0238639257642},
                 {10, 0.100382805303, 0.0920982540204, 0.0947306097481},
                 {30, 0.815700498314, 0.779831907371, 0.785398163397},
                 {45, 1.5925739852, 1.57955772659, 1.57079632679},
                 {60, 2.33165079759, 2.36616536531, 2.35619449019},
                 {90, 3.14159265359, 3.14159265359, 3.14159265359}};
    const glm::dvec3 d = glm::normalize(glm::dvec3(1, -2, 0.7));
    for (const auto& cap : kCaps)
        for (int order = 3; order <= 6; ++order) {
            std::vector<double> c(shCount(order), 0.0);
            addZonal(zonalCap(glm::radians(cap.halfAngleDeg)), d, 1.0, c);
            EXPECT_NEAR(irradiance(c, d), order < 5 ? cap.order3 : cap.order5, 1e-10)
                << cap.halfAngleDeg << " " << order;
            const double sine = std::sin(glm::radians(cap.halfAngleDeg));
            EXPECT_NEAR(pi * sine * sine, cap.exact, 1e-10);
        }
    // Off the axis by 0, 20, 40 and 60 degrees, 30 degrees wide, nine coefficients.
    constexpr double kOff[4] = {0.815700498314, 0.754721596239, 0.592092697123, 0.380227017844};
    constexpr double kExact[4] = {0.785398163397, 0.738032858523, 0.601649898706, 0.392699081699};
    std::vector<double> c(9, 0.0);
    addZonal(zonalCap(glm::radians(30.0)), {0, 0, 1}, 1.0, c);
    for (int i = 0; i < 4; ++i) {
        const double t = glm::radians(20.0 * i);
        EXPECT_NEAR(irradiance(c, {0.6 * std::sin(t), 0.8 * std::sin(t), std::cos(t)}), kOff[i],
                    1e-10);
        EXPECT_NEAR(pi / 4.0 * std::cos(t), kExact[i], 1e-10);
    }
}

TEST(ZonalHarmonics, DirectionalLights) {
    const glm::dvec3 d = glm::normalize(glm::dvec3(-2, 1, -2));
    // pi / Σ A_l (2l + 1) / 4pi (DirectXMath, XMSHEvalDirectionalLight).
    constexpr double kScale[5] = {4.18879020479, 2.95679308573, 2.95679308573, 3.24293435209,
                                  3.24293435209};
    for (int order = 1; order <= 8; ++order) {
        std::vector<double> c(shCount(order), 0.0);
        addZonal(zonalDirectional(), d, 5.0 * directionalScale(order), c);
        EXPECT_NEAR(irradiance(c, d), 5.0, 1e-12) << order;
        if (order >= 2 && order <= 6) {
            EXPECT_NEAR(pi * directionalScale(order), kScale[order - 2], 1e-10) << order;
        }
    }
    // Nine coefficients of irradiance 1: 0.09375 + z / 2 + 0.46875 z².
    constexpr double kZ[8] = {-1.0, -0.5333333333333333, -0.5, 0.0, 0.25, 0.5, 0.75, 1.0};
    constexpr double kE9[8] = {0.0625,      -0.0395833333333, -0.0390625,  0.09375,
                               0.248046875, 0.4609375,        0.732421875, 1.0625};
    std::vector<double> c(9, 0.0);
    addZonal(zonalDirectional(), {0, 0, 1}, 1.0, c);
    for (int i = 0; i < 8; ++i)
        EXPECT_NEAR(irradiance(c, {0, std::sqrt(1 - kZ[i] * kZ[i]), kZ[i]}), kE9[i], 1e-10);
}

TEST(ZonalHarmonics, TurnedIsTheBasisThere) {
    // Σ c_lm Y_lm(w) must depend on the angle to the axis only: the zonal sum at that angle.
    const ZonalHarmonics zonal = {0.3, -0.5, 0.7, 0.2, -0.9, 0.4, 0.1, -0.6};
    const glm::dvec3 axis = glm::normalize(glm::dvec3(0.2, -0.9, 0.4));
    std::vector<double> c(64, 0.25);
    addZonal(zonal, axis, 2.0, c);
    std::vector<glm::vec3> coloured(64, glm::vec3(0.25f));
    addZonal(zonal, axis, {2.0, -1.0, 0.0}, coloured);
    std::array<double, 64> y{}, atAngle{};
    for (int i = 0; i < 40; ++i) {
        const glm::dvec3 w =
            glm::normalize(glm::dvec3(std::sin(3.0 * i), std::cos(i), 0.05 * i - 1));
        const double z = glm::dot(w, axis);
        evaluateSh(8, w, y);
        evaluateSh(8, {std::sqrt(1 - z * z), 0, z}, atAngle);
        double sum = 0.0, expected = 0.0, before = 0.0;
        glm::dvec3 colour(0.0);
        for (int k = 0; k < 64; ++k) {
            sum += c[k] * y[k];
            before += 0.25 * y[k];
            colour += y[k] * glm::dvec3(coloured[k]);
        }
        for (int l = 0; l < 8; ++l)
            expected += zonal[l] * atAngle[shIndex(l, 0)];
        EXPECT_NEAR(sum - before, 2.0 * expected, 1e-12);
        EXPECT_NEAR(colour.x - before, 2.0 * expected, 5e-6);
        EXPECT_NEAR(colour.y - before, -expected, 5e-6);
        EXPECT_NEAR(colour.z - before, 0.0, 5e-6);
    }
}

TEST(ZonalHarmonics, ConvolutionWithTheCosineGivesIrradiance) {
    // sqrt(pi) / 2, sqrt(pi / 3), sqrt(5pi) / 8, 0, -sqrt(pi) / 16: Sloan 2008.
    const ZonalHarmonics cosine = zonalCosine();
    constexpr double kKnown[8] = {0.886226925453,  1.02332670795, 0.495415912201,  0.0,
                                  -0.110778365682, 0.0,           0.0499271347096, 0.0};
    for (int l = 0; l < 8; ++l)
        EXPECT_NEAR(cosine[l], kKnown[l], 1e-10) << l;
    std::vector<glm::vec3> a, b;
    for (int i = 0; i < 49; ++i)
        a.emplace_back(std::sin(i), std::cos(2.0 * i), 0.1f * static_cast<float>(i));
    b = a;
    convolveWithCosine(a);
    convolveWithZonal(cosine, b);
    for (int i = 0; i < 49; ++i)
        EXPECT_LT(glm::length(a[i] - b[i]), 2e-6f * (1.0f + glm::length(a[i]))) << i;
}

} // namespace
} // namespace patina
