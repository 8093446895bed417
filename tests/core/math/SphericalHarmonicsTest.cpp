// The basis, its convolution and projection against independently computed values.
#include "core/math/SphericalHarmonics.h"

#include "core/math/Quadrature.h"
#include "core/math/Sampling.h"
#include "tests/core/light/LatLongPicture.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <numbers>

namespace patina {
namespace {

using std::numbers::pi;

// First 25 basis values with Condon-Shortley phase. Source: Green 2003 and DirectXMath's constants;
// agree with scipy.special.sph_harm made real to 4e-16.
const glm::dvec3 kD2 = glm::normalize(glm::dvec3(1, 2, 3));
constexpr std::array<double, 25> kY2 = {
    0.282094791774,  -0.261169028265,  0.391753542398,  -0.130584514133, 0.156078347227,
    -0.468235041682, 0.292863596306,   -0.234117520841, -0.117058760421, 0.0225279689466,
    0.331092173163,  -0.540952781035,  0.0641157236359, -0.270476390518, -0.248319129872,
    0.123903829206,  -0.0766329471979, 0.0541876766259, 0.473087347879,  -0.43010134943,
    -0.192680817596, -0.215050674715,  -0.354815510909, 0.298032221443,  -0.022351276266};
const glm::dvec3 kD3 = glm::dvec3(-2, 1, -2) / 3.0;
constexpr std::array<double, 25> kY3 = {
    0.282094791774,  -0.162867503968,  -0.325735007935, 0.325735007935,   -0.242788540132,
    0.242788540132,  0.105130521751,   -0.485577080263, 0.182091405099,   -0.240388129229,
    0.428238732243,  -0.186203844226,  0.193498839121,  0.372407688453,   -0.321179049182,
    0.0437069325872, -0.185432810503,  0.480776258459,  -0.44388442517,   0.0165196677422,
    -0.361760450562, -0.0330393354843, 0.332913318878,  -0.0874138651743, -0.0540845697302};

// Legendre polynomial by Bonnet's recursion.
double legendre(int l, double x) {
    double p = 1.0, previous = 0.0;
    for (int k = 1; k <= l; ++k) {
        const double next = ((2.0 * k - 1.0) * x * p - (k - 1.0) * previous) / k;
        previous = p;
        p = next;
    }
    return p;
}

TEST(ShBasis, MatchesTheTablesWithTheirSigns) {
    std::array<double, 25> y{};
    evaluateSh(5, kD2, y);
    for (int i = 0; i < 25; ++i)
        EXPECT_NEAR(y[i], kY2[i], 1e-11) << i;
    evaluateSh(5, kD3, y);
    for (int i = 0; i < 25; ++i)
        EXPECT_NEAR(y[i], kY3[i], 1e-11) << i;
}

TEST(ShBasis, AlongAxesAndWithoutThePhase) {
    // Green 2003 along +z and +x; Ramamoorthi & Hanrahan 2001 have all odd m of the other sign.
    constexpr std::array<double, 16> kZ = {
        0.282094791774, 0, 0.488602511903, 0, 0, 0, 0.630783130505, 0, 0, 0, 0, 0, 0.74635266518};
    constexpr std::array<double, 16> kX = {0.282094791774,
                                           0,
                                           0,
                                           -0.488602511903,
                                           0,
                                           0,
                                           -0.315391565253,
                                           0,
                                           0.546274215296,
                                           0,
                                           0,
                                           0,
                                           0.0,
                                           0.457045799464,
                                           0,
                                           -0.590043589927};
    constexpr std::array<double, 16> kWithoutPhase = {
        0.282094791774,  0.261169028265,   0.391753542398,  0.130584514133,
        0.156078347227,  0.468235041682,   0.292863596306,  0.234117520841,
        -0.117058760421, -0.0225279689466, 0.331092173163,  0.540952781035,
        0.0641157236359, 0.270476390518,   -0.248319129872, -0.123903829206};
    std::array<double, 64> z{}, x{}, y{};
    evaluateSh(8, {0, 0, 1}, z);
    evaluateSh(8, {1, 0, 0}, x);
    evaluateSh(8, kD2, y);
    for (int l = 0; l < 4; ++l)
        for (int m = -l; m <= l; ++m) {
            const int i = shIndex(l, m);
            EXPECT_NEAR(z[i], kZ[i], 1e-10) << i;
            EXPECT_NEAR(x[i], kX[i], 1e-10) << i;
            EXPECT_NEAR(m % 2 == 0 ? y[i] : -y[i], kWithoutPhase[i], 1e-10) << i;
        }
    // Unsöld: Σ_m Y_lm² = (2l + 1) / 4pi everywhere.
    constexpr std::array<double, 5> kUnsoeld = {0.0795774715459, 0.238732414638, 0.39788735773,
                                                0.557042300822, 0.716197243914};
    for (int l = 0; l < 5; ++l) {
        double sum = 0.0;
        for (int m = -l; m <= l; ++m)
            sum += y[shIndex(l, m)] * y[shIndex(l, m)];
        EXPECT_NEAR(sum, kUnsoeld[l], 1e-10) << l;
    }
}

TEST(ShBasis, SharedShaderTermsAreTheSameFunctions) {
    for (std::uint32_t i = 0; i < 500; ++i) {
        const glm::vec3 d = uniformSphere(sobolOwen2D(i, 9));
        std::array<double, 25> exact{};
        evaluateSh(5, glm::dvec3(d), exact);
        std::array<float, 25> single{};
        evaluateSh(5, d, single);
        float y9[9], y25[25];
        shading::shBasis9(d, y9);
        shading::shBasis25(d, y25);
        for (int k = 0; k < 25; ++k) {
            ASSERT_NEAR(y25[k], exact[k], 3e-6) << k;
            ASSERT_NEAR(single[k], exact[k], 3e-6) << k;
            if (k < 9) {
                ASSERT_NEAR(y9[k], exact[k], 2e-6) << k;
            }
        }
        std::array<double, 64> all{};
        evaluateSh(8, glm::dvec3(d), all);
        float y64[64];
        shading::shBasis64(d, y64);
        for (int k = 0; k < 64; ++k)
            ASSERT_NEAR(y64[k], all[k], 5e-6) << k;
    }
}

TEST(ShBasis, SumsOverDirectionsLeaveNoneOut) {
    for (const std::size_t count : {0u, 1u, 3u, 4u, 5u, 102u})
        for (int order = 1; order <= 8; ++order) {
            std::vector<glm::vec3> directions(count);
            std::array<double, 64> expected{}, y{};
            for (std::size_t k = 0; k < count; ++k) {
                directions[k] = uniformSphere(sobolOwen2D(static_cast<std::uint32_t>(k), 3));
                evaluateSh(order, glm::dvec3(directions[k]), y);
                for (int i = 0; i < 64; ++i)
                    expected[i] += y[i];
            }
            std::vector<float> sums(shCount(order) + 1, -7.0f); // what is there is added to
            sumSh(order, directions, sums);
            for (int i = 0; i < shCount(order); ++i)
                ASSERT_NEAR(sums[i], expected[i] - 7.0, 5e-5) << order << " " << i;
            EXPECT_EQ(sums.back(), -7.0f);
        }
}

TEST(ShBasis, AdditionTheorem) {
    // Σ_m Y_lm(a) Y_lm(b) = (2l + 1) / 4pi P_l(a·b); literature values for l = 0 … 4.
    constexpr std::array<double, 5> kKnown = {0.0795774715459, -0.127607843242, -0.0284205255521,
                                              0.23394771261, -0.242995493471};
    std::array<double, 64> a{}, b{};
    evaluateSh(8, kD2, a);
    evaluateSh(8, kD3, b);
    for (int l = 0; l < 8; ++l) {
        double sum = 0.0;
        for (int m = -l; m <= l; ++m)
            sum += a[shIndex(l, m)] * b[shIndex(l, m)];
        EXPECT_NEAR(sum, (2 * l + 1) / (4.0 * pi) * legendre(l, glm::dot(kD2, kD3)), 1e-12);
        if (l < 5) {
            EXPECT_NEAR(sum, kKnown[l], 1e-11);
        }
    }
}

TEST(ShBasis, IsOrthonormalUpToEightBands) {
    std::array<double, 64 * 64> gram{};
    const GaussLegendre rule(8);
    for (int i = 0; i < 8; ++i)
        for (int k = 0; k < 16; ++k) {
            const double z = 2.0 * rule.node01(i) - 1.0, phi = 2.0 * pi * k / 16.0;
            const double r = std::sqrt(1.0 - z * z);
            std::array<double, 64> y{};
            evaluateSh(8, glm::dvec3(r * std::cos(phi), r * std::sin(phi), z), y);
            for (int a = 0; a < 64; ++a)
                for (int b = 0; b < 64; ++b)
                    gram[a * 64 + b] += 2.0 * rule.weight01(i) * 2.0 * pi / 16.0 * y[a] * y[b];
        }
    for (int a = 0; a < 64; ++a)
        for (int b = 0; b < 64; ++b)
            ASSERT_NEAR(gram[a * 64 + b], a == b ? 1.0 : 0.0, 1e-12) << a << " " << b;
}

TEST(GaussLegendre, IsExactToDegree2nMinus1) {
    for (const int n : {1, 2, 5, 16, 64}) {
        const GaussLegendre rule(n);
        for (int degree = 0; degree < 2 * n; ++degree) {
            double sum = 0.0;
            for (int i = 0; i < n; ++i)
                sum += rule.weight01(i) * std::pow(rule.node01(i), degree);
            ASSERT_NEAR(sum, 1.0 / (degree + 1), 1e-13) << n << " " << degree;
        }
    }
}

TEST(CosineConvolution, ClosedFormValues) {
    constexpr std::array<double, 11> kA = {3.14159265359,    2.09439510239, 0.785398163397,  0.0,
                                           -0.1308996939,    0.0,           0.0490873852123, 0.0,
                                           -0.0245436926062, 0.0,           0.0143171540203};
    for (int l = 0; l <= 10; ++l)
        EXPECT_NEAR(cosineConvolution(l), kA[l], 1e-11) << l;
    for (int l = 0; l <= 7; ++l)
        EXPECT_NEAR(shading::shCosineFactor(l), kA[l], 1e-6) << l;

    std::vector<glm::vec3> c(25, glm::vec3(1.0f, 2.0f, 3.0f));
    convolveWithCosine(c);
    for (int l = 0; l < 5; ++l)
        for (int m = -l; m <= l; ++m)
            EXPECT_NEAR(c[shIndex(l, m)].y, 2.0 * kA[l], 1e-5) << l << " " << m;
}

TEST(CosineConvolution, EnergyOfTheClampedCosine) {
    // max(0, z) in harmonics: a_l = A_l sqrt((2l + 1) / 4pi); and the share of its square's
    // integral, 2pi / 3, in the bands up to l (Ramamoorthi & Hanrahan 2001: 99.22 % up to 2).
    constexpr std::array<double, 11> kZonal = {
        0.886226925453,  1.02332670795, 0.495415912201,   0.0, -0.110778365682, 0.0,
        0.0499271347096, 0.0,           -0.0285469314212, 0.0, 0.018508081889};
    constexpr std::array<double, 11> kShare = {
        0.375,          0.875,          0.9921875,      0.9921875,      0.998046875,   0.998046875,
        0.999237060547, 0.999237060547, 0.999626159668, 0.999626159668, 0.999789714813};
    const GaussLegendre rule(24);
    std::array<double, 64> y{};
    std::array<double, 8> projected{};
    for (int i = 0; i < rule.size(); ++i) {
        const double z = rule.node01(i);
        evaluateSh(8, glm::dvec3(std::sqrt(1.0 - z * z), 0.0, z), y);
        for (int l = 0; l < 8; ++l)
            projected[l] += rule.weight01(i) * 2.0 * std::numbers::pi * z * y[shIndex(l, 0)];
    }
    double energy = 0.0;
    for (int l = 0; l <= 10; ++l) {
        if (l < 8) {
            EXPECT_NEAR(projected[l], kZonal[l], 1e-10) << l;
        }
        const double zonal =
            cosineConvolution(l) * std::sqrt((2 * l + 1) / (4.0 * std::numbers::pi));
        EXPECT_NEAR(zonal, kZonal[l], 1e-10) << l;
        energy += zonal * zonal;
        EXPECT_NEAR(energy / (2.0 * std::numbers::pi / 3.0), kShare[l], 1e-10) << l;
    }
}

TEST(Projection, ConstantIsExactAtAnySize) {
    // c_00 = sqrt(4pi) c and nothing else: a sin(theta) weight would be off by 2.6 % at 4 rows.
    for (const int height : {1, 3, 4, 64}) {
        const Image image = test::latLongImage(
            2 * height, height, [](const glm::dvec3&) { return glm::vec3(1, 2, 0.5); });
        const auto c = projectLatLong(image, 5);
        EXPECT_NEAR(c[0].x, 3.54490770181, 1e-5) << height;
        EXPECT_NEAR(c[0].y, 2 * 3.54490770181, 2e-5) << height;
        for (int i = 1; i < 25; ++i)
            EXPECT_LT(glm::length(c[i]), 2e-6f) << height << " " << i;
    }
}

TEST(Projection, RecoversEveryBasisFunctionInPlace) {
    // Catches mirrored axes, swapped signs and wrong zonal axes, coefficient by coefficient.
    for (int i = 0; i < 64; ++i) {
        const Image image = test::latLongImage(256, 128, [&](const glm::dvec3& d) {
            std::array<double, 64> y{};
            evaluateSh(8, d, y);
            return glm::vec3(static_cast<float>(y[i]));
        });
        const auto c = projectLatLong(image, 8);
        for (int k = 0; k < 64; ++k)
            ASSERT_NEAR(c[k].x, i == k ? 1.0 : 0.0, 2.5e-3) << i << " " << k;
    }
}

TEST(Projection, HemisphereIsExact) {
    // L = 1 above the horizon. About z the coefficients are 1.77245385, 1.53499006, 0,
    // -0.58618401, 0; here the axis is +Y, so band l is c_l sqrt(4pi / (2l+1)) Y_lm(+Y).
    constexpr std::array<double, 5> kZonal = {1.77245385091, 1.53499006192, 0.0, -0.586184012479,
                                              0.0};
    const Image image = test::latLongImage(
        64, 32, [](const glm::dvec3& d) { return glm::vec3(d.y > 0.0 ? 1.0f : 0.0f); });
    const auto c = projectLatLong(image, 5);
    std::array<double, 25> y{};
    evaluateSh(5, glm::dvec3(0, 1, 0), y);
    for (int l = 0; l < 5; ++l)
        for (int m = -l; m <= l; ++m)
            EXPECT_NEAR(c[shIndex(l, m)].x,
                        kZonal[l] * std::sqrt(4.0 * pi / (2 * l + 1)) * y[shIndex(l, m)], 2e-6)
                << l << " " << m;
}

TEST(Projection, OneTexelSunKeepsItsEnergyAndPlace) {
    // Solid angles (2pi / W)(cos theta_j - cos theta_j+1), W = 128, H = 64: first row
    // 5.91279052618e-5, middle row 2.40860383118e-3.
    const struct {
        int row;
        double solidAngle;
    } cases[] = {{0, 5.91279052618e-05}, {32, 0.00240860383118}};
    for (const auto& [row, solidAngle] : cases)
        for (const int column : {0, 17, 100}) {
            Image image(128, 64, 3, PixelType::F32, ColorEncoding::Linear);
            for (int c = 0; c < 3; ++c)
                image.f32()[(row * 128 + column) * 3 + c] = 1e5f;
            const auto c = projectLatLong(image, 5);
            EXPECT_NEAR(c[0].x / (1e5 * solidAngle * 0.282094791774), 1.0, 1e-6);
            // The mean of the basis over the patch, equal steps in height and azimuth.
            std::array<double, 25> mean{};
            constexpr int kSteps = 64;
            for (int i = 0; i < kSteps * kSteps; ++i) {
                const double top = std::cos(pi * row / 64.0);
                const double bottom = std::cos(pi * (row + 1) / 64.0);
                const double y = top + (bottom - top) * (i / kSteps + 0.5) / kSteps;
                const double r = std::sqrt(1.0 - y * y);
                const double u = (column + (i % kSteps + 0.5) / kSteps) / 128.0;
                const double phi = 2.0 * pi * (u - 0.5);
                std::array<double, 25> basis{};
                evaluateSh(5, glm::dvec3(r * std::sin(phi), y, -r * std::cos(phi)), basis);
                for (int k = 0; k < 25; ++k)
                    mean[k] += basis[k] / (kSteps * kSteps);
            }
            for (int i = 0; i < 25; ++i)
                EXPECT_NEAR(c[i].x / (1e5 * solidAngle), mean[i], 2e-5) << row << " " << i;
        }
}

} // namespace
} // namespace patina
