// The shared shading terms, run as C++, against closed forms and independently integrated values.
#include "core/math/Shading.h"

#include "core/light/Ibl.h"
#include "core/math/Sampling.h"
#include "tests/core/math/RelativeError.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace patina::shading {
namespace {

TEST(Distribution, ClosedFormValues) {
    // D = a² / (pi ((n·h)² (a² - 1) + 1)²), alpha = perceptualRoughness².
    constexpr std::array<float, 7> kNoH = {1.0f, 0.99f, 0.95f, 0.9f, 0.70710678f, 0.5f, 0.0f};
    constexpr double kD[5][7] = {{3183.09886184, 0.0795933098266, 0.0033422371807,
                                  0.000880993514067, 0.000127298493502, 5.65846518375e-05,
                                  3.18309886184e-05},
                                 {81.4873308631, 2.20835566588, 0.121828552803, 0.0333240287707,
                                  0.00493496227728, 0.00220474007215, 0.00124339799291},
                                 {5.09295817894, 3.0205512026, 0.839880758206, 0.343596436427,
                                  0.0704907706428, 0.0339389133124, 0.0198943678865},
                                 {1.00601643041, 0.924786747452, 0.686387221496, 0.505664766403,
                                  0.232474488634, 0.146514198508, 0.100715237425},
                                 {0.318309886184, 0.318309886184, 0.318309886184, 0.318309886184,
                                  0.318309886184, 0.318309886184, 0.318309886184}};
    for (int r = 0; r < 5; ++r)
        for (int i = 0; i < 7; ++i)
            expectRelative(D_GGX(kNoH[i], kRoughness[r] * kRoughness[r]), kD[r][i], 3e-5, "D");
}

TEST(Distribution, KeepsItsDigitsForTheSmallestAlpha) {
    const float alpha = alphaFromPerceptualRoughness(0.0f);
    EXPECT_FLOAT_EQ(alpha, 0.045f * 0.045f);
    for (const float NoH : {1.0f, 0.9999999f, 0.999999f, 0.99999f, 0.999f, 0.5f}) {
        const double a2 = static_cast<double>(alpha) * alpha, c = NoH;
        const double b = c * c * (a2 - 1.0) + 1.0;
        expectRelative(D_GGX(NoH, alpha), a2 / (M_PI * b * b), 1e-5, "D");
    }
    EXPECT_TRUE(std::isfinite(D_GGX(1.0f, alpha)));
}

TEST(Distribution, ProjectedAreaIsOne) {
    // ∫ D (n·h) dω = 1. In u with tan² = alpha² u / (1 - u) the peak is spread out.
    for (const float alpha : {0.002025f, 0.01f, 0.0625f, 0.25f, 0.5625f, 1.0f}) {
        const double a2 = static_cast<double>(alpha) * alpha;
        double sum = 0.0;
        constexpr int kSteps = 2000;
        for (int i = 0; i < kSteps; ++i) {
            const double u = (i + 0.5) / kSteps;
            const double q = 1.0 + (a2 - 1.0) * u;
            const double cos2 = (1.0 - u) / q, sin2 = a2 * u / q;
            const float D =
                D_GGX_Sin2(static_cast<float>(std::sqrt(cos2)), static_cast<float>(sin2), alpha);
            sum += M_PI * D * a2 / (q * q) / kSteps;
        }
        EXPECT_NEAR(sum, 1.0, 1e-5) << alpha;
    }
}

TEST(Visibility, ClosedFormValues) {
    // Smith G1 at five cosines and height-correlated G2 at four pairs.
    constexpr std::array<float, 5> kCosine = {0.1f, 0.25f, 0.5f, 0.75f, 1.0f};
    constexpr double kG1[5][5] = {
        {0.997537175967, 0.999625280987, 0.999925011248, 0.999980556312, 1.0},
        {0.918446442478, 0.985765617396, 0.997087353932, 0.999241603031, 1.0},
        {0.543337801597, 0.836140993509, 0.957063849442, 0.988133922667, 1.0},
        {0.299157608653, 0.588737259497, 0.834674291844, 0.945051987043, 1.0},
        {0.181818181818, 0.4, 0.666666666667, 0.857142857143, 1.0}};
    constexpr float kPairs[4][2] = {{0.1f, 0.1f}, {0.25f, 0.75f}, {0.5f, 0.5f}, {1.0f, 0.25f}};
    constexpr double kG2[5][4] = {{0.995086453135, 0.999605851867, 0.999850033742, 0.999625280987},
                                  {0.849191827895, 0.985028649431, 0.994191625602, 0.985765617396},
                                  {0.373001923296, 0.827828880196, 0.917662935482, 0.836140993509},
                                  {0.175887907177, 0.569251297834, 0.716258369657, 0.588737259497},
                                  {0.1, 0.375, 0.5, 0.4}};
    for (int r = 0; r < 5; ++r) {
        const float alpha = kRoughness[r] * kRoughness[r];
        for (int i = 0; i < 5; ++i)
            expectRelative(G1_SmithGGX(kCosine[i], alpha), kG1[r][i], 1e-5, "G1");
        for (int i = 0; i < 4; ++i) {
            const float NoV = kPairs[i][0], NoL = kPairs[i][1];
            expectRelative(V_SmithGGXCorrelated(NoV, NoL, alpha) * 4.0f * NoV * NoL, kG2[r][i],
                           1e-5, "G2");
        }
    }
}

TEST(Fresnel, SchlickValues) {
    constexpr std::array<float, 6> kCosine = {0.0f, 0.1f, 0.25f, 0.5f, 0.75f, 1.0f};
    constexpr double kF[3][6] = {{1.0, 0.6068704, 0.2678125, 0.07, 0.0409375, 0.04},
                                 {1.0, 0.795245, 0.61865234375, 0.515625, 0.50048828125, 0.5},
                                 {1.0, 1.0, 1.0, 1.0, 1.0, 1.0}};
    constexpr std::array<float, 3> kF0 = {0.04f, 0.5f, 1.0f};
    for (int f = 0; f < 3; ++f)
        for (int i = 0; i < 6; ++i)
            expectRelative(F_Schlick(vec3(kF0[f]), 1.0f, kCosine[i]).y, kF[f][i], 1e-5, "F");
    // f90 < 1 is reached at grazing incidence
    EXPECT_FLOAT_EQ(F_Schlick(vec3(0.04f), 0.5f, 0.0f).x, 0.5f);
}

// Of the default model.
SurfaceTerms surfaceOf(const vec3& baseColor, float metallic, float perceptualRoughness,
                       const vec3& n, const vec3& v, const vec2& dfg) {
    return makeSurface(defaultBrdfModel(), {baseColor, metallic, perceptualRoughness, 0.0f}, n, v,
                       dfg);
}

// A table entry that says "nothing is lost": the lobe is then the bare single-scatter one.
const vec2 kNoLoss(1.0f, 0.0f);

TEST(ShadeDirect, WholeBrdfAtOnePair) {
    // f cos for n = +z, v = norm(.3, .1, .9), l = norm(-.5, .2, .7), height-correlated.
    const vec3 n(0, 0, 1), v = normalize(vec3(0.3f, 0.1f, 0.9f));
    const vec3 l = normalize(vec3(-0.5f, 0.2f, 0.7f));
    const struct {
        float perceptualRoughness;
        double dielectric, halfMetal; // F0 = 0.04, F0 = 0.5
    } cases[] = {{0.1f, 0.000114031096912, 0.0014249204311},
                 {0.3f, 0.0071087208645, 0.088829818121},
                 {0.6f, 0.0136703757626, 0.170823558244},
                 {1.0f, 0.00290748491462, 0.0363316215503}};
    for (const auto& c : cases) {
        const SurfaceTerms dielectric =
            surfaceOf(vec3(0.8f), 0.0f, c.perceptualRoughness, n, v, kNoLoss);
        expectRelative(shadeDirect(dielectric, l, vec3(1.0f)).specular.x, c.dielectric, 1e-4,
                       "dielectric");
        const SurfaceTerms metal =
            surfaceOf(vec3(0.5f), 1.0f, c.perceptualRoughness, n, v, kNoLoss);
        expectRelative(shadeDirect(metal, l, vec3(3.0f)).specular.z, 3.0 * c.halfMetal, 1e-4,
                       "metal");
        EXPECT_EQ(shadeDirect(metal, l, vec3(3.0f)).diffuse, vec3(0.0f));
    }
}

TEST(ShadeDirect, DiffuseIsAlbedoOverPiTimesIrradiance) {
    const vec3 n(0, 0, 1), v(0, 0, 1), l = normalize(vec3(0.0f, 0.6f, 0.8f));
    // No specular layer (scale = bias = 0): what the documents promise for Lambert.
    const SurfaceTerms bare = surfaceOf(vec3(0.5f, 0.25f, 1.0f), 0.0f, 0.5f, n, v, vec2(0.0f));
    const ShadedLight light = shadeDirect(bare, l, vec3(2.0f));
    EXPECT_NEAR(light.diffuse.x, 0.5 / M_PI * 2.0 * 0.8, 1e-6);
    EXPECT_NEAR(light.diffuse.y, 0.25 / M_PI * 2.0 * 0.8, 1e-6);
    EXPECT_NEAR(light.diffuse.z, 1.0 / M_PI * 2.0 * 0.8, 1e-6);

    // With the layer: 1 - albedo of the compensated lobe, (F0 A + B) (1 + F0 (1 - E) / E).
    const SurfaceTerms layered = surfaceOf(vec3(0.5f), 0.0f, 0.5f, n, v, vec2(0.8f, 0.1f));
    const double albedo = (0.04 * 0.8 + 0.1) * (1.0 + 0.04 * (1.0 - 0.9) / 0.9);
    EXPECT_NEAR(layered.specularAlbedo.x, albedo, 1e-6);
    EXPECT_NEAR(shadeDirect(layered, l, vec3(2.0f)).diffuse.x,
                0.5 * (1.0 - albedo) / M_PI * 2.0 * 0.8, 1e-6);
    // Half a metal has half the diffuse colour and an F0 half-way.
    const SurfaceTerms mixed = surfaceOf(vec3(0.5f), 0.5f, 0.5f, n, v, vec2(0.0f));
    EXPECT_NEAR(mixed.diffuseColor.x, 0.25f, 1e-6f);
    EXPECT_NEAR(mixed.f0.x, 0.27f, 1e-6f);
}

TEST(ShadeDirect, LightBehindTheSurfaceGivesNothing) {
    const SurfaceTerms s = surfaceOf(vec3(0.8f), 0.0f, 0.4f, vec3(0, 0, 1), vec3(0, 0, 1), kNoLoss);
    for (const vec3 l : {vec3(0, 0, -1), normalize(vec3(1, 0, -0.01f)), vec3(1, 0, 0)}) {
        const ShadedLight light = shadeDirect(s, l, vec3(1.0f));
        EXPECT_EQ(light.diffuse, vec3(0.0f));
        EXPECT_EQ(light.specular, vec3(0.0f));
    }
}

TEST(ShadeDirect, IsFiniteEverywhere) {
    for (std::uint32_t i = 0; i < 20000; ++i) {
        const vec3 n = uniformSphere(sobolOwen2D(i, 1)), v = uniformSphere(sobolOwen2D(i, 2));
        vec3 l = uniformSphere(sobolOwen2D(i, 3));
        if (i % 7 == 0)
            l = -v;
        if (i % 7 == 1)
            l = reflect(-v, n);
        const SurfaceTerms s =
            surfaceOf(vec3(1.0f), static_cast<float>(i % 3) / 2.0f,
                      static_cast<float>(i % 11) / 10.0f, n, v, vec2(0.9f, 0.02f));
        const ShadedLight light = shadeDirect(s, l, vec3(1.0f));
        ASSERT_TRUE(std::isfinite(light.specular.x) && light.specular.x >= 0.0f) << i;
        ASSERT_TRUE(std::isfinite(light.diffuse.x) && light.diffuse.x >= 0.0f) << i;
    }
}

TEST(SpecularLobe, IsReciprocal) {
    const vec3 n(0, 0, 1);
    for (std::uint32_t i = 0; i < 5000; ++i) {
        const vec3 v = cosineHemisphere(sobolOwen2D(i, 1)), l = cosineHemisphere(sobolOwen2D(i, 2));
        if (v.z < 1e-3f || l.z < 1e-3f)
            continue;
        const float r = 0.1f + 0.9f * sobolOwen2D(i, 3).x;
        const SurfaceTerms sv = surfaceOf(vec3(0.7f), 1.0f, r, n, v, kNoLoss);
        const SurfaceTerms sl = surfaceOf(vec3(0.7f), 1.0f, r, n, l, kNoLoss);
        const double a = shadeDirect(sv, l, vec3(1.0f)).specular.x / l.z;
        const double b = shadeDirect(sl, v, vec3(1.0f)).specular.x / v.z;
        ASSERT_NEAR(a, b, 1e-4 * std::max(a, b)) << i;
    }
}

// Reflected radiance of a surface in a white furnace (radiance 1 everywhere), by importance
// sampling of shadeDirect itself.
struct Furnace {
    double diffuse = 0.0, specular = 0.0;
};

Furnace furnace(const SurfaceTerms& s) {
    Furnace result;
    constexpr std::uint32_t kSamples = 1u << 14;
    const vec3 wo(s.v.x, s.v.y, s.NoV);
    for (std::uint32_t i = 0; i < kSamples; ++i) {
        const vec2 u = sobolOwen2D(i, 17);
        const vec3 wm = sampleVndfGGX(u, wo, s.alpha);
        const vec3 wi = reflect(-wo, wm);
        if (wi.z > 0.0f) {
            const vec3 h = normalize(wo + wi);
            result.specular += shadeDirect(s, wi, vec3(1.0f)).specular.x /
                               vndfReflectionPdf(s.NoV, h.z, s.alpha) / kSamples;
        }
        const vec3 wd = cosineHemisphere(u);
        if (wd.z > 0.0f)
            result.diffuse +=
                shadeDirect(s, wd, vec3(1.0f)).diffuse.x / cosineHemispherePdf(wd.z) / kSamples;
    }
    return result;
}

TEST(Furnace, NothingIsLostAndNothingIsMade) {
    for (const float r : {0.2f, 0.5f, 0.8f, 1.0f})
        for (const float NoV : {0.1f, 0.3f, 0.7f, 1.0f}) {
            const vec3 v(std::sqrt(1.0f - NoV * NoV), 0.0f, NoV);
            const vec2 dfg(integrateDfg(NoV, r));
            const SurfaceTerms metal = surfaceOf(vec3(1.0f), 1.0f, r, vec3(0, 0, 1), v, dfg);
            EXPECT_NEAR(furnace(metal).specular, 1.0, 4e-3) << "metal " << r << " " << NoV;

            const SurfaceTerms white = surfaceOf(vec3(1.0f), 0.0f, r, vec3(0, 0, 1), v, dfg);
            const Furnace dielectric = furnace(white);
            EXPECT_NEAR(dielectric.specular, white.specularAlbedo.x, 3e-3) << r << " " << NoV;
            EXPECT_NEAR(dielectric.diffuse + dielectric.specular, 1.0, 4e-3)
                << "white dielectric " << r << " " << NoV;

            const SurfaceTerms grey = surfaceOf(vec3(0.5f), 0.3f, r, vec3(0, 0, 1), v, dfg);
            const Furnace some = furnace(grey);
            EXPECT_LT(some.diffuse + some.specular, 0.95) << r << " " << NoV;
            EXPECT_GT(some.diffuse + some.specular, 0.3) << r << " " << NoV;
        }
}

TEST(Furnace, EnvironmentShadingAgreesWithDirectShading) {
    // A constant environment: irradiance pi, prefiltered radiance 1.
    const SurfaceTerms s =
        surfaceOf(vec3(0.6f), 0.2f, 0.5f, vec3(0, 0, 1), normalize(vec3(0.5f, 0, 1)),
                  vec2(integrateDfg(0.894427f, 0.5f)));
    const ShadedLight light = shadeEnvironment(s, vec3(kPi), vec3(1.0f));
    const Furnace expected = furnace(s);
    EXPECT_NEAR(light.diffuse.x, expected.diffuse, 2e-3);
    EXPECT_NEAR(light.specular.x, expected.specular, 2e-3);
}

TEST(Environment, LatLongDirections) {
    // USC convention: u = 0.5 + atan2(x, -z) / 2pi, v = acos(y) / pi.
    const struct {
        vec3 direction;
        double u, v;
    } cases[] = {{{1, 0, 0}, 0.75, 0.5},
                 {{-1, 0, 0}, 0.25, 0.5},
                 {{0, 0, -1}, 0.5, 0.5},
                 {{0.26726124f, 0.53452248f, 0.80178373f}, 0.948791808825, 0.320491482014},
                 {{-0.66666667f, 0.33333333f, -0.66666667f}, 0.375, 0.391826552031}};
    for (const auto& c : cases) {
        const vec2 uv = latLongFromDirection(c.direction);
        EXPECT_NEAR(uv.x, c.u, 1e-6);
        EXPECT_NEAR(uv.y, c.v, 1e-6);
    }
    EXPECT_NEAR(latLongFromDirection(vec3(0, 1, 0)).y, 0.0, 1e-7);
    EXPECT_NEAR(latLongFromDirection(vec3(0, -1, 0)).y, 1.0, 1e-7);
    EXPECT_NEAR(
        length(directionFromLatLong(vec2(0.75f, 0.25f)) - vec3(0.70710678f, 0.70710678f, 0.0f)),
        0.0, 1e-6);
    for (std::uint32_t i = 0; i < 5000; ++i) {
        const vec3 d = uniformSphere(sobolOwen2D(i, 4));
        ASSERT_LT(length(directionFromLatLong(latLongFromDirection(d)) - d), 2e-6f) << i;
    }
}

TEST(Environment, RotationIsCounterClockwiseFromAbove) {
    const float quarter = 0.5f * kPi;
    EXPECT_LT(length(rotateY(vec3(0, 0, 1), quarter) - vec3(1, 0, 0)), 1e-6f);
    EXPECT_LT(length(rotateY(vec3(1, 0, 0), quarter) - vec3(0, 0, -1)), 1e-6f);
    EXPECT_LT(length(rotateY(vec3(0, 1, 0), quarter) - vec3(0, 1, 0)), 1e-6f);
}

TEST(Environment, IrradianceFromNineCoefficients) {
    // Hemisphere of radiance 1 above +z: E = pi (1 + n.z) / 2, exact in nine coefficients.
    std::vector<vec3> sh(9, vec3(0.0f));
    sh[0] = vec3(1.77245385091f * shCosineFactor(0));
    sh[2] = vec3(1.53499006192f * shCosineFactor(1));
    for (const float z : {1.0f, 0.5f, 0.0f, -0.5f, -1.0f})
        EXPECT_NEAR(irradianceFromSh9(sh.data(), vec3(std::sqrt(1.0f - z * z), 0.0f, z)).x,
                    M_PI * (1.0 + z) / 2.0, 2e-6);
    // The light of a point far away: nine coefficients dip to -4 % behind it, which is cut.
    float y[9];
    shBasis9(vec3(0, 0, 1), y);
    for (int i = 0; i < 9; ++i)
        sh[i] = vec3(y[i] * shCosineFactor(i == 0 ? 0 : i < 4 ? 1 : 2));
    EXPECT_NEAR(irradianceFromSh9(sh.data(), vec3(0, 0, 1)).x, 1.0625, 1e-5);
    const float z = -8.0f / 15.0f;
    EXPECT_EQ(irradianceFromSh9(sh.data(), vec3(std::sqrt(1.0f - z * z), 0, z)).x, 0.0f);
}

TEST(Environment, PrefilteredLevelSpansTheChain) {
    for (const float side : {1.0f, 64.0f, 256.0f})
        for (const int levels : {2, 8, 22}) {
            EXPECT_EQ(prefilteredRoughness(0, levels, side), 0.0f);
            EXPECT_EQ(prefilteredRoughness(levels - 1, levels, side), 1.0f);
            float before = -1.0f;
            for (int level = 0; level < levels; ++level) {
                const float r = prefilteredRoughness(level, levels, side);
                EXPECT_GT(r, before);
                before = r;
                EXPECT_NEAR(prefilteredLevel(r, levels, side), static_cast<float>(level), 1e-3f)
                    << level << " of " << levels << ", side " << side;
            }
        }
    // Continuous and rising, also at whole levels
    float before = 0.0f;
    for (int i = 0; i <= 10'000; ++i) {
        const float level = prefilteredLevel(static_cast<float>(i) / 10'000.0f, 22, 256.0f);
        EXPECT_GE(level, before - 1e-5f) << i;
        EXPECT_LT(level, before + 0.02f) << i;
        before = level;
    }
    EXPECT_EQ(before, 21.0f);
    EXPECT_EQ(prefilteredLevel(0.7f, 1, 1.0f), 0.0f) << "uniform light has one level";
}

TEST(Environment, SpecularOcclusionHasItsLimits) {
    for (const float alpha : {0.01f, 0.3f, 1.0f})
        for (const float NoV : {0.1f, 0.5f, 1.0f}) {
            EXPECT_NEAR(specularOcclusion(NoV, 1.0f, alpha), 1.0f, 1e-6f);
            EXPECT_NEAR(specularOcclusion(NoV, 0.0f, alpha), 0.0f, 1e-6f);
            EXPECT_LT(specularOcclusion(NoV, 0.4f, alpha), specularOcclusion(NoV, 0.6f, alpha));
        }
}

TEST(Color, SrgbValues) {
    constexpr std::array<float, 8> kLinear = {0.0f,  0.001f,    0.0031308f, 0.01f,
                                              0.18f, 0.214041f, 0.5f,       1.0f};
    constexpr std::array<double, 8> kEncoded = {
        0.0,          0.01292,        0.040449936,    0.0998528227341,
        0.4613561295, 0.499999848223, 0.735356983052, 1.0};
    for (int i = 0; i < 8; ++i) {
        EXPECT_NEAR(srgbEncode(kLinear[i]), kEncoded[i], 1e-6);
        EXPECT_NEAR(srgbDecode(srgbEncode(kLinear[i])), kLinear[i], 1e-6);
    }
    EXPECT_NEAR(srgbDecode(0.5f), 0.214041140482, 1e-6);
    EXPECT_FLOAT_EQ(srgbEncode(7.0f), 1.0f);
    EXPECT_EQ(srgbEncode(-1.0f), 0.0f);
    EXPECT_NEAR(luminance(vec3(1.0f)), 1.0f, 1e-6f);
    EXPECT_GT(luminance(vec3(0, 1, 0)), luminance(vec3(1, 0, 0)));
}

TEST(NormalMap, DecodesBothConventions) {
    EXPECT_LT(length(decodeNormalTs(vec3(0.5f, 0.5f, 1.0f), 1.0f, 1.0f) - vec3(0, 0, 1)), 1e-6f);
    const vec3 texel(0.75f, 0.75f, 0.5f + 0.5f * 0.70710678f);
    const vec3 up = decodeNormalTs(texel, 1.0f, 1.0f), down = decodeNormalTs(texel, 1.0f, -1.0f);
    EXPECT_LT(length(up - vec3(0.5f, 0.5f, 0.70710678f)), 1e-5f);
    EXPECT_LT(length(down - vec3(0.5f, -0.5f, 0.70710678f)), 1e-5f);
    // Strength scales the slope x / z.
    const vec3 strong = decodeNormalTs(texel, 2.0f, 1.0f);
    EXPECT_NEAR(strong.x / strong.z, 2.0f * up.x / up.z, 1e-5f);
    EXPECT_LT(length(decodeNormalTs(texel, 0.0f, 1.0f) - vec3(0, 0, 1)), 1e-6f);
    // Damaged texels stay finite and point outwards.
    for (const vec3 bad : {vec3(0.5f), vec3(0.0f), vec3(0.5f, 0.5f, 0.0f)}) {
        const vec3 n = decodeNormalTs(bad, 1.0f, 1.0f);
        EXPECT_NEAR(length(n), 1.0f, 1e-6f);
        EXPECT_GT(n.z, 0.0f);
    }
}

TEST(NormalMap, TurnsIntoTheWorld) {
    // A wall that faces +Z with u to the right: up in the image is +Y when w = +1.
    const vec3 n(0, 0, 1);
    EXPECT_LT(length(normalTsToWorld(vec3(0, 1, 0), n, vec4(1, 0, 0, 1)) - vec3(0, 1, 0)), 1e-6f);
    EXPECT_LT(length(normalTsToWorld(vec3(0, 1, 0), n, vec4(1, 0, 0, -1)) - vec3(0, -1, 0)), 1e-6f);
    EXPECT_LT(length(normalTsToWorld(vec3(1, 0, 0), n, vec4(1, 0, 0, 1)) - vec3(1, 0, 0)), 1e-6f);
    // Interpolated tangents: neither unit nor orthogonal.
    EXPECT_LT(length(normalTsToWorld(vec3(0, 0, 1), n, vec4(2, 0, 3, 1)) - n), 1e-6f);
    EXPECT_LT(length(normalTsToWorld(vec3(1, 0, 0), n, vec4(2, 0, 3, 1)) - vec3(1, 0, 0)), 1e-6f);
    EXPECT_EQ(normalTsToWorld(vec3(1, 0, 0), n, vec4(0, 0, 1, 1)), n);
}

} // namespace
} // namespace patina::shading
