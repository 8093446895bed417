// Sampling of the lobes: the draws follow their densities, and estimates with them are right and
// bounded.
#include "core/math/Sampling.h"
#include "tests/core/math/LobeQuadrature.h"
#include "tests/core/math/RelativeError.h"
#include "tests/core/math/SamplerCheck.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace patina::shading {
namespace {

BrdfModel withTerms(int distribution, int diffuse = kDiffuseLambert) {
    BrdfModel m = defaultBrdfModel();
    m.distribution = distribution;
    m.diffuse = diffuse;
    return m;
}

vec3 viewerAt(float NoV) {
    return {std::sqrt(1.0f - NoV * NoV) * 0.6f, std::sqrt(1.0f - NoV * NoV) * 0.8f, NoV};
}

TEST(HalfVectors, InverseOfTheCumulativeDistribution) {
    // cos theta at u for GGX: cos² = (1 - u) / (1 + (a² - 1) u).
    constexpr float kU[5] = {0.0f, 0.25f, 0.5f, 0.75f, 0.99f};
    constexpr double kCosine[5][5] = {
        {1.0, 0.99998333375, 0.99995000375, 0.999850033742, 0.995086453135},
        {1.0, 0.999349593427, 0.998052578483, 0.994191625602, 0.849191827895},
        {1.0, 0.989743318611, 0.970142500145, 0.917662935482, 0.373001923296},
        {1.0, 0.951101277244, 0.871575537125, 0.716258369657, 0.175887907177},
        {1.0, 0.866025403784, 0.707106781187, 0.5, 0.1}};
    for (int r = 0; r < 5; ++r)
        for (int i = 0; i < 5; ++i) {
            const float alpha = kRoughness[r] * kRoughness[r];
            const vec2 u(kU[i], 0.3f);
            EXPECT_NEAR(sampleHalfVectorGGX(u, alpha).z, kCosine[r][i], 1e-6);
            // tan² = -a² log(1 - u); cos^(2 / a²) = 1 - u
            const double a2 = double(alpha) * alpha;
            EXPECT_NEAR(sampleHalfVectorBeckmann(u, alpha).z,
                        1.0 / std::sqrt(1.0 - a2 * std::log1p(-double(kU[i]))), 1e-6);
            const vec3 blinn = sampleHalfVectorBlinnPhong(u, alpha);
            const double sin2 = -std::expm1(a2 * std::log1p(-double(kU[i])));
            EXPECT_NEAR(blinn.x * blinn.x + blinn.y * blinn.y, sin2, 1e-5 * sin2 + 1e-12);
        }
}

TEST(HalfVectors, FollowTheirDensities) {
    for (const float alpha : {0.3f, 0.7f, 1.0f})
        for (int d : {kDistributionGGX, kDistributionBeckmann, kDistributionBlinnPhong})
            checkSampler(
                "half vector, D " + std::to_string(d),
                [&](glm::vec2 u) {
                    return d == kDistributionGGX        ? sampleHalfVectorGGX(u, alpha)
                           : d == kDistributionBeckmann ? sampleHalfVectorBeckmann(u, alpha)
                                                        : sampleHalfVectorBlinnPhong(u, alpha);
                },
                [&](const glm::dvec3& h) {
                    return distribution(withTerms(d), float(h.z), float(1.0 - h.z * h.z), alpha) *
                           h.z;
                },
                0.0);
}

TEST(HalfVectors, ReflectionsFollowTheirDensities) {
    // Above the horizon; what is reflected below it carries no light.
    for (const float alpha : {0.3f, 0.8f})
        for (const float NoV : {0.9f, 0.3f})
            for (int d : {kDistributionGGX, kDistributionBeckmann, kDistributionBlinnPhong}) {
                const BrdfModel m = withTerms(d);
                const vec3 wo = viewerAt(NoV);
                const auto pdf = [&](float NoH, float sin2, float VoH) {
                    return specularReflectionPdf(m, NoV, NoH, sin2, VoH, alpha);
                };
                double above = 0.0;
                forEachReflection(m, NoV, alpha, [&](const LobeNode& n) {
                    above += pdf(n.NoH, n.sin2, n.VoH) * n.solidAngle;
                });
                EXPECT_GT(above, 0.4);
                checkSampler(
                    "reflection, D " + std::to_string(d),
                    [&](glm::vec2 u) {
                        return glm::reflect(-wo, sampleHalfVector(m, u, wo, alpha));
                    },
                    [&](const glm::dvec3& wi) {
                        const vec3 h = normalize(wo + vec3(wi));
                        return pdf(h.z, h.x * h.x + h.y * h.y, dot(wo, h));
                    },
                    0.0, above);
            }
}

TEST(EonSampling, FollowsItsDensity) {
    for (const float r : {0.0f, 0.4f, 1.0f})
        for (const float NoV : {1.0f, 0.6f, 0.1f}) {
            const vec3 wo = viewerAt(NoV);
            checkSampler(
                "EON r " + std::to_string(r) + " N·V " + std::to_string(NoV),
                [&](glm::vec2 u) { return sampleEon(u, wo, r); },
                [&](const glm::dvec3& wi) { return eonPdf(wo, vec3(wi), r); }, 0.0);
        }
}

TEST(EonSampling, WeightsAreCloseToTheAlbedo) {
    // f cos / pdf of a white body: what cosine sampling leaves unbounded at grazing views.
    double worst = 0.0, worstCosine = 0.0;
    for (const float r : {0.2f, 0.6f, 1.0f})
        for (const float NoV : {0.05f, 0.3f, 0.7f, 1.0f}) {
            const vec3 wo = viewerAt(NoV);
            for (std::uint32_t i = 0; i < 2000; ++i) {
                const vec2 u = sobolOwen2D(i, 3);
                const auto weight = [&](const vec3& wi, float pdf) {
                    return wi.z > 1e-4f
                               ? Fd_Eon(vec3(1.0f), NoV, wi.z, dot(wo, wi), r).x * wi.z / pdf
                               : 0.0f;
                };
                const vec3 wi = sampleEon(u, wo, r), wc = cosineHemisphere(u);
                worst = std::max<double>(worst, weight(wi, eonPdf(wo, wi, r)));
                worstCosine = std::max<double>(worstCosine, weight(wc, cosineHemispherePdf(wc.z)));
            }
        }
    EXPECT_LT(worst, 2.0);
    EXPECT_GT(worstCosine, 3.0);
}

TEST(SurfaceSampling, EstimatesTheReflectionOfTheFurnace) {
    // E[shadeDirect / pdf] is the directional albedo; weights stay bounded.
    for (int d : {kDistributionGGX, kDistributionBeckmann, kDistributionBlinnPhong})
        for (int diffuse : {kDiffuseLambert, kDiffuseBurley, kDiffuseOrenNayar, kDiffuseEon})
            for (const float r : {0.0f, 0.3f, 1.0f})
                for (const float NoV : {0.2f, 0.9f}) {
                    const BrdfModel m = withTerms(d, diffuse);
                    const float alpha = alphaFromPerceptualRoughness(r);
                    const SurfaceTerms s = makeSurface(m, {vec3(0.8f), 0.2f, r, r}, vec3(0, 0, 1),
                                                       viewerAt(NoV), quadratureDfg(m, NoV, alpha));
                    double sum = 0.0, largest = 0.0;
                    constexpr std::uint32_t kSamples = 4096;
                    for (std::uint32_t i = 0; i < kSamples; ++i) {
                        const vec2 u = sobolOwen2D(i, 11);
                        float pdf = 0.0f;
                        const vec3 l = sampleBrdf(s, vec3(u, sobolOwen2D(i, 12).x), pdf);
                        if (pdf <= 0.0f)
                            continue;
                        EXPECT_GT(l.z, 0.0f);
                        const ShadedLight light = shadeDirect(s, l, vec3(1.0f));
                        const double weight = (light.diffuse.x + light.specular.x) / pdf;
                        largest = std::max(largest, weight);
                        sum += weight / kSamples;
                    }
                    const double expected = s.diffuseAlbedo.x + s.specularAlbedo.x;
                    EXPECT_NEAR(sum, expected, 0.015)
                        << "D " << d << ", diffuse " << diffuse << ", r " << r << ", " << NoV;
                    EXPECT_LT(largest, 15.0) << "D " << d << ", diffuse " << diffuse << ", r " << r;
                }
}

TEST(SurfaceSampling, TurnsWithTheSurface) {
    // A surface that faces elsewhere gives the turned direction with the same density.
    const vec3 n = normalize(vec3(1.0f, -2.0f, 0.5f));
    vec3 t, b;
    orthonormalBasis(n, t, b);
    for (int diffuse : {kDiffuseLambert, kDiffuseEon}) {
        const BrdfModel m = withTerms(kDistributionGGX, diffuse);
        const vec3 v = viewerAt(0.5f);
        const vec3 world = v.x * t + v.y * b + v.z * n;
        const auto at = [&](const vec3& normal, const vec3& viewer) {
            return makeSurface(m, {vec3(0.5f), 0.0f, 0.4f, 0.6f}, normal, viewer,
                               vec2(0.9f, 0.02f));
        };
        const SurfaceTerms up = at(vec3(0, 0, 1), v), turned = at(n, world);
        for (std::uint32_t i = 0; i < 200; ++i) {
            const vec3 u(sobolOwen2D(i, 1), sobolOwen2D(i, 2).x);
            float pdfUp = 0.0f, pdfTurned = 0.0f;
            const vec3 a = sampleBrdf(up, u, pdfUp), w = sampleBrdf(turned, u, pdfTurned);
            EXPECT_NEAR(pdfTurned, pdfUp, 2e-3f * pdfUp + 1e-6f);
            // the frame of +z is x, y, z
            EXPECT_LT(length(w - (a.x * t + a.y * b + a.z * n)), 1e-4f);
        }
    }
}

} // namespace
} // namespace patina::shading
