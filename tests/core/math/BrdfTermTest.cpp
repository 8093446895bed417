// Every term of the shading models against closed forms and independently computed values.
#include "core/math/Quadrature.h"
#include "tests/core/math/LobeQuadrature.h"
#include "tests/core/math/RelativeError.h"

#include <gtest/gtest.h>

#include <array>
#include <complex>

namespace patina::shading {
namespace {

BrdfModel withVisibility(int distribution, int visibility = kVisibilitySmithCorrelated) {
    BrdfModel m = defaultBrdfModel();
    m.distribution = distribution;
    m.visibility = visibility;
    return m;
}

// ∫ f cos dω over the hemisphere of lights, by Gauss-Legendre in N·L and the midpoint rule in the
// azimuth; for smooth lobes.
template <class Brdf>
double diffuseIntegral(float NoV, const Brdf& brdf) {
    const GaussLegendre nodes(64);
    constexpr int kAzimuths = 64;
    double sum = 0.0;
    const double sinV = std::sqrt(1.0 - double(NoV) * NoV);
    // The lobes of Oren and Nayar have a kink at N·L = N·V: each side for itself.
    for (const auto& [from, to] : {std::pair(0.0, double(NoV)), std::pair(double(NoV), 1.0)})
        for (int i = 0; i < nodes.size(); ++i)
            for (int j = 0; j < kAzimuths; ++j) {
                const double x = from + (to - from) * nodes.node01(i);
                const double phi = M_PI * (j + 0.5) / kAzimuths;
                const double VoL = NoV * x + sinV * std::sqrt(1.0 - x * x) * std::cos(phi);
                const float VoH = static_cast<float>(std::sqrt(std::max(0.5 + 0.5 * VoL, 0.0)));
                sum += brdf(static_cast<float>(x), VoH) * x * nodes.weight01(i) * (to - from) *
                       2.0 * M_PI / kAzimuths;
            }
    return sum;
}

// ---- D ---------------------------------------------------------------------------------------

TEST(Distributions, ClosedForms) {
    // Beckmann: exp(-tan²/a²) / (pi a² cos⁴); Blinn-Phong: (p + 2) / 2pi cos^p, p = 2/a² - 2.
    for (const float alpha : {0.002025f, 0.01f, 0.0625f, 0.25f, 0.5625f, 1.0f}) {
        const double a2 = double(alpha) * alpha;
        for (const double tanOverAlpha : {0.0, 0.01, 0.3, 1.0, 2.0, 3.0}) {
            const double tan2 = a2 * tanOverAlpha * tanOverAlpha, cos2 = 1.0 / (1.0 + tan2);
            const float NoH = static_cast<float>(std::sqrt(cos2));
            const float sin2 = static_cast<float>(tan2 * cos2);
            expectRelative(D_Beckmann_Sin2(NoH, sin2, alpha),
                           std::exp(-tan2 / a2) / (M_PI * a2 * cos2 * cos2), 1e-5, "Beckmann");
            const double p = 2.0 / a2 - 2.0;
            expectRelative(D_BlinnPhong_Sin2(sin2, alpha),
                           (p + 2.0) / (2.0 * M_PI) * std::exp(0.5 * p * std::log1p(-tan2 * cos2)),
                           2e-5, "Blinn-Phong");
        }
        // At the horizon and beyond what floats hold: finite, and nothing.
        EXPECT_LT(D_Beckmann_Sin2(0.0f, 1.0f, alpha), 1e-30f);
        if (alpha < 1.0f)
            EXPECT_LT(D_BlinnPhong_Sin2(1.0f, alpha), 1e-9f);
        else // exponent zero: constant
            EXPECT_FLOAT_EQ(D_BlinnPhong_Sin2(1.0f, alpha), kInvPi);
    }
}

TEST(Distributions, ProjectedAreaIsOne) {
    // ∫ D (n·h) dω = 1 for each, in sin² of the angle: pi ∫ D d(sin²), the peak spread by s^k.
    for (int d : {kDistributionGGX, kDistributionBeckmann, kDistributionBlinnPhong})
        for (const float r : {0.045f, 0.05f, 0.1f, 0.25f, 0.5f, 0.75f, 1.0f}) {
            const float alpha = r * r;
            double sum = 0.0;
            constexpr int kSteps = 4000;
            for (int i = 0; i < kSteps; ++i) {
                // tan² = a² s / (1 - s)
                const double s = (i + 0.5) / kSteps, a2 = double(alpha) * alpha;
                const double q = 1.0 + (a2 - 1.0) * s, sin2 = a2 * s / q;
                sum += M_PI * a2 / (q * q) / kSteps *
                       distribution(withVisibility(d), static_cast<float>(std::sqrt((1.0 - s) / q)),
                                    static_cast<float>(sin2), alpha);
            }
            EXPECT_NEAR(sum, 1.0, 2e-5) << "D " << d << ", r " << r;
        }
}

TEST(Distributions, LogOneMinusKeepsItsDigits) {
    for (const float x : {0.0f, 1e-7f, 1e-4f, 0.01f, 0.0999f, 0.1001f, 0.5f, 0.99f})
        EXPECT_NEAR(logOneMinus(x), std::log1p(-double(x)), 1e-6 * std::abs(std::log1p(-x))) << x;
    EXPECT_TRUE(std::isfinite(logOneMinus(1.0f)));
}

// ---- G ---------------------------------------------------------------------------------------

TEST(Visibilities, ClosedFormValues) {
    // G2 at four pairs (N·V, N·L) per roughness: separable Smith, Schlick with k = (r + 1)² / 8 and
    // with k = alpha / 2. G1(x) = 2x / (x + sqrt(a² + (1 - a²) x²)) and x / (x (1 - k) + k).
    constexpr float kPairs[4][2] = {{0.1f, 0.1f}, {0.25f, 0.75f}, {0.5f, 0.5f}, {1.0f, 0.25f}};
    constexpr double kG2[5][3][4] = {
        {{0.995080417436, 0.999605844584, 0.999850028119, 0.999625280987},
         {0.179356061296, 0.654860308405, 0.75450255293, 0.687876182287},
         {0.915729951237, 0.983582370925, 0.990074503106, 0.985221674877}},
        {{0.843543867701, 0.985018015739, 0.99418319137, 0.985765617396},
         {0.131483279699, 0.592000192708, 0.699901747191, 0.630541871921},
         {0.609161213563, 0.904860088365, 0.940312213039, 0.914285714286}},
        {{0.295215966644, 0.826219279819, 0.915971211908, 0.836140993509},
         {0.0801942203775, 0.49588377724, 0.609161213563, 0.542372881356},
         {0.221453287197, 0.698181818182, 0.79012345679, 0.727272727273}},
        {{0.0894952748148, 0.556387316934, 0.696681173465, 0.588737259497},
         {0.0506052304014, 0.412781860172, 0.522965942098, 0.465454545455},
         {0.0801942203775, 0.49588377724, 0.609161213563, 0.542372881356}},
        {{0.0330578512397, 0.342857142857, 0.444444444444, 0.4},
         {0.0330578512397, 0.342857142857, 0.444444444444, 0.4},
         {0.0330578512397, 0.342857142857, 0.444444444444, 0.4}}};
    constexpr int kVisibility[3] = {kVisibilitySmithSeparable, kVisibilitySchlickDirect,
                                    kVisibilitySchlickIbl};
    for (int r = 0; r < 5; ++r) {
        const float alpha = kRoughness[r] * kRoughness[r];
        for (int k = 0; k < 3; ++k)
            for (int i = 0; i < 4; ++i) {
                const float NoV = kPairs[i][0], NoL = kPairs[i][1];
                const BrdfModel m = withVisibility(kDistributionGGX, kVisibility[k]);
                expectRelative(visibility(m, NoV, NoL, 0.5f, alpha) * 4.0f * NoV * NoL,
                               kG2[r][k][i], 1e-5, "G2");
            }
    }
    // G = N·V N·L / (V·H)² and G = N·V N·L
    EXPECT_FLOAT_EQ(V_Kelemen(0.5f), 1.0f);
    EXPECT_FLOAT_EQ(V_Implicit() * 4.0f, 1.0f);
}

TEST(Visibilities, CorrelatedMasksLessThanSeparable) {
    for (int d : {kDistributionGGX, kDistributionBeckmann, kDistributionBlinnPhong})
        for (const float alpha : {0.01f, 0.25f, 1.0f})
            for (const float NoV : {0.05f, 0.3f, 1.0f})
                for (const float NoL : {0.05f, 0.4f, 1.0f}) {
                    const float correlated =
                        visibility(withVisibility(d), NoV, NoL, 0.5f, alpha) * 4.0f * NoV * NoL;
                    const float separable = visibility(withVisibility(d, kVisibilitySmithSeparable),
                                                       NoV, NoL, 0.5f, alpha) *
                                            4.0f * NoV * NoL;
                    EXPECT_GE(correlated, separable * (1.0f - 1e-6f));
                    EXPECT_LE(correlated, 1.0f + 1e-6f);
                    if (NoL == 1.0f) { // no shadow: what remains is the masking of v
                        EXPECT_NEAR(correlated,
                                    d == kDistributionGGX ? G1_SmithGGX(NoV, alpha)
                                                          : G1_SmithBeckmann(NoV, alpha),
                                    1e-5f);
                    }
                }
}

TEST(Visibilities, BeckmannMaskingIsTheExactOneWithin4PerMille) {
    // Lambda = (erf(a) - 1) / 2 + exp(-a²) / (2 a sqrt(pi)), a = 1 / (alpha tan): Heitz 2014,
    // eq. 69.
    for (const float alpha : {0.05f, 0.25f, 0.6f, 1.0f})
        for (const float x : {0.02f, 0.1f, 0.3f, 0.5f, 0.7f, 0.9f, 0.99f}) {
            const double a = x / (alpha * std::sqrt(1.0 - double(x) * x));
            const double lambda =
                0.5 * (std::erf(a) - 1.0) + std::exp(-a * a) / (2.0 * a * std::sqrt(M_PI));
            expectRelative(G1_SmithBeckmann(x, alpha), 1.0 / (1.0 + lambda), 4e-3, "G1");
        }
    EXPECT_EQ(G1_SmithBeckmann(1.0f, 0.5f), 1.0f);
}

TEST(Visibilities, WeakWhiteFurnace) {
    // ∫ G1(v) max(v·h, 0) D(h) / (n·v) dω = 1: the visible facets cover what the viewer sees. Exact
    // for GGX; Beckmann's G1 is a fit; Schlick's k fails it.
    for (const float r : {0.25f, 0.5f, 1.0f})
        for (const float NoV : {0.1f, 0.5f, 1.0f}) {
            const float alpha = r * r, sinV = std::sqrt(1.0f - NoV * NoV);
            const auto sum = [&](int d, auto g1) {
                double visible = 0.0;
                constexpr int kHeights = 1000, kAzimuths = 64;
                for (int i = 0; i < kHeights; ++i)
                    for (int j = 0; j < kAzimuths; ++j) {
                        const float t = (static_cast<float>(i) + 0.5f) / kHeights;
                        const vec2 u(t * (2.0f - t), (static_cast<float>(j) + 0.5f) / kAzimuths);
                        const vec3 h = d == kDistributionGGX ? sampleHalfVectorGGX(u, alpha)
                                                             : sampleHalfVectorBeckmann(u, alpha);
                        visible += std::max(sinV * h.x + NoV * h.z, 0.0f) / (NoV * h.z) * 2.0 *
                                   (1.0 - t) / (kHeights * kAzimuths);
                    }
                return visible * g1;
            };
            EXPECT_NEAR(sum(kDistributionGGX, G1_SmithGGX(NoV, alpha)), 1.0, 5e-4);
            EXPECT_NEAR(sum(kDistributionBeckmann, G1_SmithBeckmann(NoV, alpha)), 1.0, 4e-3);
            if (NoV < 1.0f && r < 1.0f) {
                const float k = 0.5f * alpha;
                EXPECT_LT(sum(kDistributionGGX, NoV / (NoV * (1.0f - k) + k)), 0.98);
            }
        }
}

// ---- F ---------------------------------------------------------------------------------------

TEST(Fresnels, AverageOfSchlick) {
    // 2 ∫ F mu dmu = F0 + (1 - F0) / 21
    const GaussLegendre nodes(16);
    for (const float f0 : {0.0f, 0.04f, 0.5f, 0.9f, 1.0f}) {
        double sum = 0.0;
        for (int i = 0; i < nodes.size(); ++i)
            sum += 2.0 * nodes.node01(i) * nodes.weight01(i) *
                   F_Schlick(vec3(f0), 1.0f, static_cast<float>(nodes.node01(i))).x;
        EXPECT_NEAR(sum, f0 + (1.0 - f0) / 21.0, 1e-6) << f0;
    }
}

TEST(Fresnels, ExactDielectric) {
    // ½ ((g - c) / (g + c))² (1 + ((c (g + c) - 1) / (c (g - c) + 1))²), g² = n² - 1 + c²
    constexpr float kCosine[6] = {0.05f, 0.1f, 0.25f, 0.5f, 0.75f, 1.0f};
    constexpr double kF[6] = {0.752130477785,  0.571592520342,  0.264190373434,
                              0.0891867128022, 0.0467807474253, 0.04};
    for (int i = 0; i < 6; ++i)
        EXPECT_NEAR(F_Dielectric(kCosine[i], 1.5f), kF[i], 1e-6) << kCosine[i];
    EXPECT_FLOAT_EQ(F_Dielectric(0.0f, 1.5f), 1.0f);
    EXPECT_NEAR(f0FromIor(1.33f), 0.0200593121995, 1e-7);
    EXPECT_NEAR(f0FromIor(1.5f), 0.04, 1e-7);
    EXPECT_NEAR(f0FromIor(2.0f), 0.111111111111, 1e-7);
    EXPECT_NEAR(f0FromIor(2.417f), 0.171968832523, 1e-7);
    // Nothing is reflected where nothing changes.
    for (const float c : {0.0f, 0.3f, 1.0f})
        EXPECT_NEAR(F_Dielectric(c, 1.0f), 0.0f, 1e-6f);
    const GaussLegendre nodes(64);
    double average = 0.0; // by substitution mu = s², which tames the slope at the horizon
    for (int i = 0; i < nodes.size(); ++i) {
        const double s = nodes.node01(i);
        average +=
            4.0 * s * s * s * nodes.weight01(i) * F_Dielectric(static_cast<float>(s * s), 1.5f);
    }
    EXPECT_NEAR(average, 0.0917779593424, 1e-6);
}

TEST(Fresnels, ExactConductorIsFresnelWithAComplexIndex) {
    using Complex = std::complex<double>;
    const auto reference = [](double c, double n, double k) {
        const Complex eta(n, k);
        const Complex t = std::sqrt(1.0 - (1.0 - c * c) / (eta * eta));
        return 0.5 * (std::norm((c - eta * t) / (c + eta * t)) +
                      std::norm((eta * c - t) / (eta * c + t)));
    };
    const vec3 n(0.18f, 0.42f, 1.37f), k(3.42f, 2.35f, 1.77f); // gold
    for (const float c : {0.001f, 0.1f, 0.25f, 0.5f, 0.75f, 1.0f}) {
        const vec3 F = F_Conductor(c, n, k);
        for (int i = 0; i < 3; ++i)
            EXPECT_NEAR(F[i], reference(c, n[i], k[i]), 2e-5) << c << " " << i;
        // Without absorption it is a dielectric.
        EXPECT_NEAR(F_Conductor(c, vec3(1.5f), vec3(0.0f)).y, F_Dielectric(c, 1.5f), 1e-5f) << c;
    }
    EXPECT_EQ(F_Conductor(0.0f, n, k), vec3(1.0f));
    EXPECT_TRUE(std::isfinite(F_Conductor(1.0f, vec3(0.01f), vec3(0.0f)).x));
}

TEST(Fresnels, DispatchMixesMetalsAndNonMetals) {
    BrdfModel m = defaultBrdfModel();
    const vec3 gold(1.0f, 0.78f, 0.34f);
    for (const float metallic : {0.0f, 0.3f, 1.0f})
        for (const float c : {0.0f, 0.2f, 0.7f, 1.0f}) {
            const auto at = [&](int fresnelModel) {
                m.fresnel = fresnelModel;
                return fresnel(m, normalReflectance(m, gold, metallic), metallic, c);
            };
            m.ior = 1.33f;
            m.f90 = 0.5f;
            m.conductorN = vec3(0.2f, 0.9f, 1.4f);
            m.conductorK = vec3(3.0f, 2.5f, 1.8f);
            const vec3 plastic = F_Schlick(vec3(0.04f), 1.0f, c), metal = F_Schlick(gold, 1.0f, c);
            const auto mixed = [&](const vec3& a, const vec3& b) { return mix(a, b, metallic); };
            for (int i = 0; i < 3; ++i) {
                EXPECT_NEAR(at(kFresnelSchlick)[i], mixed(plastic, metal)[i], 1e-6f);
                EXPECT_NEAR(at(kFresnelSchlickF90)[i],
                            mixed(F_Schlick(vec3(0.04f), 0.5f, c), F_Schlick(gold, 0.5f, c))[i],
                            1e-6f);
                EXPECT_NEAR(at(kFresnelDielectric)[i],
                            mixed(vec3(F_Dielectric(c, 1.33f)), metal)[i], 1e-6f);
                EXPECT_NEAR(at(kFresnelConductor)[i],
                            mixed(plastic, F_Conductor(c, m.conductorN, m.conductorK))[i], 1e-6f);
                // F0 is what it is at normal incidence
                EXPECT_NEAR(fresnel(m, normalReflectance(m, gold, metallic), metallic, 1.0f)[i],
                            normalReflectance(m, gold, metallic)[i], 1e-6f);
            }
        }
}

// ---- Diffuse ---------------------------------------------------------------------------------

TEST(DiffuseTerms, AlbedosAreTheIntegralsOfTheirLobes) {
    for (const float NoV : {0.05f, 0.2f, 0.5f, 0.8f, 1.0f})
        for (const float r : {0.0f, 0.3f, 0.7f, 1.0f}) {
            const auto VoL = [](float VoH) { return 2.0f * VoH * VoH - 1.0f; };
            EXPECT_NEAR(E_Burley(NoV, r),
                        diffuseIntegral(
                            NoV, [&](float NoL, float VoH) { return Fd_Burley(NoV, NoL, VoH, r); }),
                        2e-5)
                << "Burley " << NoV << " " << r;
            EXPECT_NEAR(
                E_OrenNayar(NoV, r),
                diffuseIntegral(
                    NoV, [&](float NoL, float VoH) { return Fd_OrenNayar(NoV, NoL, VoL(VoH), r); }),
                3e-4)
                << "Oren-Nayar " << NoV << " " << r;
            for (const float rho : {0.18f, 0.8f, 1.0f})
                EXPECT_NEAR(E_Eon(vec3(rho), NoV, r).x,
                            diffuseIntegral(NoV,
                                            [&](float NoL, float VoH) {
                                                return Fd_Eon(vec3(rho), NoV, NoL, VoL(VoH), r).x;
                                            }),
                            1e-3)
                    << "EON " << NoV << " " << r << " " << rho;
        }
}

TEST(DiffuseTerms, AllAreLambertWhenSmooth) {
    for (const float NoV : {0.1f, 0.6f, 1.0f})
        for (const float NoL : {0.1f, 0.6f, 1.0f}) {
            EXPECT_FLOAT_EQ(Fd_OrenNayar(NoV, NoL, 0.3f, 0.0f), kInvPi);
            EXPECT_NEAR(Fd_Eon(vec3(0.5f), NoV, NoL, 0.3f, 0.0f).y, 0.5f * kInvPi, 1e-6f);
        }
}

TEST(DiffuseTerms, PublishedConstants) {
    EXPECT_NEAR(kFonA, 0.5 - 2.0 / (3.0 * M_PI), 1e-7);
    EXPECT_NEAR(kFonAvg, 2.0 / 3.0 - 28.0 / (15.0 * M_PI), 1e-7);
    // Oren-Nayar at sigma = 0.5: A = 1 - 0.125 / 0.58, B = 0.1125 / 0.34.
    EXPECT_NEAR(orenNayarCoefficients(0.5f).x, 0.784482758621, 1e-6);
    EXPECT_NEAR(orenNayarCoefficients(0.5f).y, 0.330882352941, 1e-6);
    // Burley, both at grazing, V·H = 1: FD90² / pi = 6.25 / pi for roughness 1.
    EXPECT_NEAR(Fd_Burley(0.0f, 0.0f, 1.0f, 1.0f), 6.25 / M_PI, 1e-5);
    // Backscattering at 60° for sigma = 1: A + B sin tan = 1 - .5/1.33 + .45/1.09 · 1.5
    EXPECT_NEAR(Fd_OrenNayar(0.5f, 0.5f, 1.0f, 1.0f), (1.0 - 0.5 / 1.33 + 0.45 / 1.09 * 1.5) / M_PI,
                1e-6);
    // FON's exact albedo (paper, equation 14) against the fit: 0.1 %.
    for (const float r : {0.2f, 1.0f})
        for (const float mu : {0.01f, 0.1f, 0.4f, 0.8f, 1.0f}) {
            const double s = std::sqrt(1.0 - double(mu) * mu);
            const double G =
                s * (std::acos(mu) - s * mu) + 2.0 / 3.0 * (s / mu * (1.0 - s * s * s) - s);
            const double A = 1.0 / (1.0 + (0.5 - 2.0 / (3.0 * M_PI)) * r);
            EXPECT_NEAR(E_FON(mu, r), A + r * A / M_PI * G, 1.5e-3) << r << " " << mu;
        }
}

TEST(DiffuseTerms, WhiteEonKeepsAllLightAndTheOthersNeverMakeAny) {
    for (const float NoV : {0.02f, 0.1f, 0.6f, 1.0f})
        for (const float r : {0.0f, 0.2f, 0.5f, 1.0f}) {
            EXPECT_NEAR(E_Eon(vec3(1.0f), NoV, r).z, 1.0f, 1e-6f);
            for (int model : {kDiffuseBurley, kDiffuseOrenNayar}) {
                BrdfModel m = defaultBrdfModel();
                m.diffuse = model;
                const float albedo = diffuseReflectance(m, vec3(1.0f), r, r, NoV).x;
                EXPECT_LE(albedo, 1.0f + 1e-6f);
                const double limited = diffuseIntegral(NoV, [&](float NoL, float VoH) {
                    return diffuse(m, vec3(1.0f), r, r, NoV, NoL, VoH).x;
                });
                EXPECT_NEAR(limited, albedo, 3e-4) << model << " " << NoV << " " << r;
            }
        }
    EXPECT_GT(E_Burley(0.02f, 1.0f), 1.5f); // which is why they are limited
    EXPECT_GT(E_OrenNayar(0.1f, 0.2f), 1.01f);
}

} // namespace
} // namespace patina::shading
