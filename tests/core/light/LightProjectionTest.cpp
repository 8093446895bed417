// Lights as spherical harmonics: what their projection and its irradiance are in closed form.
#include "core/math/ShRotation.h"
#include "core/math/Shading.h"
#include "core/math/SphericalHarmonics.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <vector>

namespace patina {
namespace {

constexpr int kOrder = 6;

// A cap of radiance 1 around +Y, whose edge lies between two rows: the image is exact.
Image capImage(int halfAngleDeg) {
    Image image(72, 36, 3, PixelType::F32, ColorEncoding::Linear);
    for (int i = 0; i < 72 * halfAngleDeg / 5 * 3; ++i)
        image.f32()[i] = 1.0f;
    return image;
}

// Its coefficients, turned so that the cap is around +Z.
std::vector<glm::vec3> capAroundZ(int halfAngleDeg) {
    const std::vector<glm::vec3> upright = projectLatLong(capImage(halfAngleDeg), kOrder);
    std::vector<glm::vec3> turned(upright.size());
    ShRotation::aboutAxis({1.0, 0.0, 0.0}, glm::radians(90.0), kOrder)
        .apply(std::span(upright), std::span(turned));
    return turned;
}

double irradiance(std::vector<glm::vec3> radiance, int order, const glm::dvec3& n) {
    convolveWithCosine(radiance);
    std::array<double, kOrder * kOrder> y{};
    evaluateSh(order, n, y);
    double sum = 0.0;
    for (int i = 0; i < shCount(order); ++i)
        sum += y[i] * radiance[i].x;
    return sum;
}

TEST(LightProjection, CapsHaveTheirZonalCoefficients) {
    // sqrt(pi / (2l + 1)) (P_l-1(cos a) - P_l+1(cos a)); l = 0: sqrt(pi) (1 - cos a).
    constexpr struct {
        int halfAngleDeg;
        double zonal[kOrder];
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
        const std::vector<glm::vec3> c = capAroundZ(cap.halfAngleDeg);
        for (int l = 0; l < kOrder; ++l)
            for (int m = -l; m <= l; ++m)
                EXPECT_NEAR(c[shIndex(l, m)].x, m == 0 ? cap.zonal[l] : 0.0, 1e-6)
                    << cap.halfAngleDeg << " " << l << " " << m;
    }
}

TEST(LightProjection, IrradianceOfCapsOnTheirAxis) {
    // Orders 3 and 5; exactly pi sin² a, which no finite order reaches but that of the hemisphere.
    constexpr struct {
        int halfAngleDeg;
        double order3, order5, exact;
    } kCaps[] = {{5, 0.0253384159925, 0.0231393133223, 0.0238639257642},
                 {10, 0.100382805303, 0.0920982540204, 0.0947306097481},
                 {30, 0.815700498314, 0.779831907371, 0.785398163397},
                 {45, 1.5925739852, 1.57955772659, 1.57079632679},
                 {60, 2.33165079759, 2.36616536531, 2.35619449019},
                 {90, M_PI, M_PI, M_PI}};
    for (const auto& cap : kCaps) {
        const std::vector<glm::vec3> c = capAroundZ(cap.halfAngleDeg);
        EXPECT_NEAR(irradiance(c, 3, {0, 0, 1}), cap.order3, 1e-6) << cap.halfAngleDeg;
        EXPECT_NEAR(irradiance(c, 4, {0, 0, 1}), cap.order3, 1e-6) << cap.halfAngleDeg; // A_3 = 0
        EXPECT_NEAR(irradiance(c, 5, {0, 0, 1}), cap.order5, 1e-6) << cap.halfAngleDeg;
        EXPECT_NEAR(irradiance(c, 6, {0, 0, 1}), cap.order5, 1e-6) << cap.halfAngleDeg; // A_5 = 0
        EXPECT_NEAR(M_PI * std::pow(std::sin(glm::radians(1.0 * cap.halfAngleDeg)), 2.0), cap.exact,
                    1e-9);
        EXPECT_NEAR(irradiance(c, 5, {0, 0, 1}), cap.exact, 0.012);
    }
}

TEST(LightProjection, IrradianceOfACapOffItsAxis) {
    // 30°, order 3, and exactly, pi sin² a cos t.
    constexpr double kExact[4] = {0.785398163397, 0.738032858523, 0.601649898706, 0.392699081699};
    constexpr double kExpected[4] = {0.815700498314, 0.754721596239, 0.592092697123,
                                     0.380227017844};
    const std::vector<glm::vec3> c = capAroundZ(30);
    for (int i = 0; i < 4; ++i) {
        const double t = glm::radians(20.0 * i);
        EXPECT_NEAR(irradiance(c, 3, {std::sin(t) * 0.6, std::sin(t) * 0.8, std::cos(t)}),
                    kExpected[i], 1e-6);
        EXPECT_NEAR(M_PI / 4.0 * std::cos(t), kExact[i], 1e-12);
        EXPECT_NEAR(kExpected[i], kExact[i], 0.035); // what nine coefficients are worth
    }
}

TEST(LightProjection, NineCoefficientsOfAPointOfLight) {
    // E9(z) = 0.09375 + z/2 + 0.46875 z² for irradiance 1: at most 9.4 % of the peak off, and below
    // zero opposite the light, which irradianceFromSh9 cuts.
    constexpr double kZ[8] = {-1.0, -0.5333333333333333, -0.5, 0.0, 0.25, 0.5, 0.75, 1.0};
    constexpr double kExpected[8] = {0.0625,      -0.0395833333333, -0.0390625,  0.09375,
                                     0.248046875, 0.4609375,        0.732421875, 1.0625};
    const glm::dvec3 d = glm::normalize(glm::dvec3(1.0, 2.0, 3.0));
    const glm::dvec3 side = glm::normalize(glm::cross(d, glm::dvec3(0.0, 1.0, 0.0)));
    std::array<double, 9> y{};
    evaluateSh(3, d, y);
    std::vector<glm::vec3> light(9);
    for (int i = 0; i < 9; ++i)
        light[i] = glm::vec3(static_cast<float>(y[i]));
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 n = kZ[i] * d + std::sqrt(1.0 - kZ[i] * kZ[i]) * side;
        EXPECT_NEAR(irradiance(light, 3, n), kExpected[i], 1e-6) << kZ[i];
        std::vector<glm::vec3> convolved = light;
        convolveWithCosine(convolved);
        EXPECT_NEAR(shading::irradianceFromSh9(convolved.data(), glm::vec3(n)).x,
                    std::max(kExpected[i], 0.0), 1e-6);
    }
    // L2 error over the sphere relative to the norm of max(0, z): 0.0883883476483.
    double squares = 0.0, norm = 0.0;
    constexpr int kSteps = 20'000;
    for (int i = 0; i < kSteps; ++i) {
        const double z = (2.0 * i + 1.0) / kSteps - 1.0;
        const double error = 0.09375 + 0.5 * z + 0.46875 * z * z - std::max(z, 0.0);
        squares += error * error;
        norm += std::max(z, 0.0) * std::max(z, 0.0);
    }
    EXPECT_NEAR(std::sqrt(squares / norm), 0.0883883476483, 1e-6);
}

TEST(LightProjection, ScaleThatGivesADirectionalLightItsIrradiance) {
    // pi over what the order keeps of the light: Σ A_l (2l + 1) / 4pi.
    constexpr double kScale[5] = {4.18879020479, 2.95679308573, 2.95679308573, 3.24293435209,
                                  3.24293435209};
    const glm::dvec3 d = glm::normalize(glm::dvec3(-2.0, 1.0, -2.0));
    for (int order = 2; order <= 6; ++order) {
        std::array<double, kOrder * kOrder> y{};
        evaluateSh(order, d, y);
        std::vector<glm::vec3> light(shCount(order));
        for (int i = 0; i < shCount(order); ++i)
            light[i] = glm::vec3(static_cast<float>(y[i]));
        EXPECT_NEAR(M_PI / irradiance(light, order, d), kScale[order - 2], 2e-6) << order;
    }
}

TEST(LightProjection, GraceCathedral) {
    // Coefficients published by Ramamoorthi & Hanrahan 2001 (without the Condon-Shortley phase) and
    // the irradiance their quadratic form gives, with c1 … c5 = 0.429043 0.511664 0.743125 0.886227
    // 0.247708.
    const std::array<glm::vec3, 9> published{{{0.78908f, 0.4371f, 0.54161f},
                                              {0.39499f, 0.34989f, 0.60488f},
                                              {-0.33974f, -0.18236f, -0.2694f},
                                              {-0.29213f, -0.05562f, 0.00944f},
                                              {-0.11141f, -0.0509f, -0.12231f},
                                              {-0.2624f, -0.22401f, -0.47479f},
                                              {-0.1557f, -0.09471f, -0.14733f},
                                              {0.56014f, 0.21444f, 0.13915f},
                                              {0.21205f, -0.05432f, -0.30374f}}};
    const struct {
        glm::vec3 n, expected;
    } cases[] = {
        {{1, 0, 0}, {0.529906158f, 0.330607175f, 0.395826933f}},
        {{0, 1, 0}, {1.051097369f, 0.792187594f, 1.265791487f}},
        {{0, 0, 1}, {0.274502669f, 0.153835090f, 0.131315524f}},
        {{-1, 0, 0}, {1.127795021f, 0.444442038f, 0.376506525f}},
        {{0, -1, 0}, {0.242689736f, 0.076084031f, 0.027811769f}},
        {{0, 0, -1}, {0.969832701f, 0.527062807f, 0.682683954f}},
        {{0.267261242f, 0.534522484f, 0.801783726f}, {0.494244014f, 0.347940980f, 0.422421766f}}};
    std::vector<glm::vec3> c(published.begin(), published.end());
    for (int l = 0; l < 3; ++l)
        for (int m = -l; m <= l; ++m)
            if (m % 2 != 0)
                c[shIndex(l, m)] = -c[shIndex(l, m)];
    convolveWithCosine(c);
    for (const auto& item : cases) {
        const glm::vec3 e = shading::irradianceFromSh9(c.data(), item.n);
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(e[k], item.expected[k], 1e-5);
        const glm::vec3 n = item.n;
        const auto& L = published;
        const glm::vec3 form =
            0.429042765f * L[8] * (n.x * n.x - n.y * n.y) + 0.743123868f * L[6] * n.z * n.z +
            0.886226925f * L[0] - 0.247707956f * L[6] +
            2.0f * 0.429042765f * (L[4] * n.x * n.y + L[7] * n.x * n.z + L[5] * n.y * n.z) +
            2.0f * 0.511663354f * (L[3] * n.x + L[1] * n.y + L[2] * n.z);
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(form[k], item.expected[k], 1e-5);
    }
}

} // namespace
} // namespace patina
