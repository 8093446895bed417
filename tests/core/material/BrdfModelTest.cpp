// What the assembled models promise: energy, reciprocity, agreement with the table, finite numbers.
#include "core/edit/ParameterChoices.h"
#include "core/material/Material.h"
#include "tests/core/math/LobeQuadrature.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

namespace patina::shading {
namespace {

constexpr int kDistributions = static_cast<int>(patina::kDistributions.names().size());
constexpr int kVisibilities = static_cast<int>(patina::kVisibilities.names().size());
constexpr int kFresnels = static_cast<int>(patina::kFresnels.names().size());
constexpr int kDiffuses = static_cast<int>(patina::kDiffuses.names().size());

std::string nameOf(const BrdfModel& m) {
    return "D " + std::to_string(m.distribution) + ", V " + std::to_string(m.visibility) + ", F " +
           std::to_string(m.fresnel) + ", diffuse " + std::to_string(m.diffuse);
}

template <class Visit>
void forEachSpecularModel(const Visit& visit) {
    for (int d = 0; d < kDistributions; ++d)
        for (int v = 0; v < kVisibilities; ++v) {
            BrdfModel m = defaultBrdfModel();
            m.distribution = d;
            m.visibility = v;
            visit(m);
        }
}

vec3 viewerAt(float NoV) {
    return {std::sqrt(1.0f - NoV * NoV), 0.0f, NoV};
}

// Directional albedo of the specular lobe: shadeDirect itself in a white furnace.
vec3 specularIntegral(const SurfaceTerms& s) {
    glm::dvec3 sum(0.0);
    forEachReflection(s.model, s.NoV, s.alpha, [&](const LobeNode& n) {
        sum += glm::dvec3(shadeDirect(s, n.l, vec3(1.0f)).specular) * n.solidAngle;
    });
    return vec3(sum);
}

vec3 diffuseIntegral(const SurfaceTerms& s) {
    glm::dvec3 sum(0.0);
    constexpr std::uint32_t kSamples = 1u << 12;
    for (std::uint32_t i = 0; i < kSamples; ++i) {
        const vec3 l = cosineHemisphere(sobolOwen2D(i, 17));
        if (l.z > 0.0f)
            sum += glm::dvec3(shadeDirect(s, l, vec3(1.0f)).diffuse) /
                   double(cosineHemispherePdf(l.z)) / double(kSamples);
    }
    return vec3(sum);
}

TEST(WhiteMetal, KeepsAllLightForEveryDistributionAndVisibility) {
    forEachSpecularModel([](const BrdfModel& m) {
        for (const float r : {0.2f, 0.6f, 1.0f})
            for (const float NoV : {0.1f, 0.5f, 1.0f}) {
                const float alpha = alphaFromPerceptualRoughness(r);
                const SurfaceTerms s = makeSurface(m, {vec3(1.0f), 1.0f, r, 0.0f}, vec3(0, 0, 1),
                                                   viewerAt(NoV), quadratureDfg(m, NoV, alpha));
                EXPECT_NEAR(specularIntegral(s).x, 1.0, 5e-3)
                    << nameOf(m) << " " << r << " " << NoV;
                EXPECT_NEAR(s.specularAlbedo.x, 1.0, 1e-5);
            }
    });
}

TEST(WhiteMetal, LosesWhatTheTableSaysWithoutCompensation) {
    // 1 - E of GGX with height-correlated Smith and with Schlick's k = alpha / 2, by tanh-sinh
    // quadrature over half vectors.
    constexpr float kNoV[5] = {0.1f, 0.25f, 0.5f, 0.75f, 1.0f};
    const struct {
        int visibility;
        float r;
        double loss[5];
    } rows[] = {{kVisibilitySchlickIbl,
                 0.25f,
                 {0.317641530792, 0.169315214735, 0.067179645395, 0.026821330407, 0.005665604756}},
                {kVisibilitySchlickIbl,
                 0.5f,
                 {0.311456086272, 0.329704300407, 0.252919084952, 0.170079747198, 0.104933948125}},
                {kVisibilitySchlickIbl,
                 1.0f,
                 {0.442085782836, 0.509035488896, 0.590862907413, 0.649311063497, 0.69314718056}},
                {kVisibilitySmithCorrelated,
                 0.25f,
                 {0.103230364691, 0.038433050904, 0.011675999763, 0.006188875325, 0.004311939305}},
                {kVisibilitySmithCorrelated,
                 0.5f,
                 {0.108377648191, 0.159918100847, 0.142736564419, 0.108467110115, 0.084187569751}},
                {kVisibilitySmithCorrelated,
                 0.75f,
                 {0.151644164075, 0.255543657059, 0.336824154722, 0.367114637378, 0.373114343276}},
                {kVisibilitySmithCorrelated,
                 1.0f,
                 {0.23978952728, 0.402359478108, 0.549306144334, 0.63547339529, 0.69314718056}}};
    for (const auto& row : rows)
        for (int i = 0; i < 5; ++i) {
            BrdfModel m = defaultBrdfModel();
            m.visibility = row.visibility;
            m.multiScatter = 0;
            const vec2 dfg = quadratureDfg(m, kNoV[i], row.r * row.r);
            const SurfaceTerms s = makeSurface(m, {vec3(1.0f), 1.0f, row.r, 0.0f}, vec3(0, 0, 1),
                                               viewerAt(kNoV[i]), dfg);
            EXPECT_NEAR(1.0 - specularIntegral(s).x, row.loss[i], 1.5e-3)
                << nameOf(m) << " " << row.r << " " << kNoV[i];
            EXPECT_NEAR(1.0 - s.specularAlbedo.x, row.loss[i], 1.5e-3);
        }
}

TEST(Energy, SingleScatteringNeverMakesLightWhereTheModelPromisesIt) {
    forEachSpecularModel([](const BrdfModel& m) {
        for (const float r : {0.1f, 0.5f, 1.0f})
            for (const float NoV : {0.02f, 0.3f, 1.0f}) {
                const vec2 dfg = quadratureDfg(m, NoV, alphaFromPerceptualRoughness(r));
                const float E = dfg.x + dfg.y;
                EXPECT_GT(E, 0.0f);
                // Blinn-Phong has no masking of its own, and Beckmann's is not made for its wide
                // lobes.
                const bool smith = m.visibility == kVisibilitySmithCorrelated ||
                                   m.visibility == kVisibilitySmithSeparable;
                const bool promised =
                    m.distribution != kDistributionBlinnPhong || !smith || r < 0.5f;
                if (promised) {
                    EXPECT_LE(E, 1.002f) << nameOf(m) << " " << r << " " << NoV;
                }
            }
    });
    // What makeSurface() cuts.
    BrdfModel m = defaultBrdfModel();
    m.distribution = kDistributionBlinnPhong;
    m.multiScatter = 0;
    const vec2 dfg = quadratureDfg(m, 0.02f, 1.0f);
    EXPECT_GT(dfg.x + dfg.y, 1.5f);
    EXPECT_EQ(makeSurface(m, {vec3(1.0f), 1.0f, 1.0f, 0.0f}, vec3(0, 0, 1), viewerAt(0.02f), dfg)
                  .specularAlbedo,
              vec3(1.0f));
}

TEST(Energy, WhiteDielectricReturnsAtMostAllOfIt) {
    for (int diffuse = 0; diffuse < kDiffuses; ++diffuse)
        for (int d = 0; d < kDistributions; ++d)
            for (const float r : {0.2f, 0.6f, 1.0f})
                for (const float NoV : {0.1f, 0.5f, 1.0f}) {
                    BrdfModel m = defaultBrdfModel();
                    m.distribution = d;
                    m.diffuse = diffuse;
                    const vec2 dfg = quadratureDfg(m, NoV, alphaFromPerceptualRoughness(r));
                    const SurfaceTerms s =
                        makeSurface(m, {vec3(1.0f), 0.0f, r, r}, vec3(0, 0, 1), viewerAt(NoV), dfg);
                    const float total = specularIntegral(s).y + diffuseIntegral(s).y;
                    EXPECT_LE(total, 1.005f) << nameOf(m) << " " << r << " " << NoV;
                    EXPECT_GT(total, 0.6f) << nameOf(m) << " " << r << " " << NoV;
                    if (diffuse == kDiffuseLambert || diffuse == kDiffuseEon) {
                        EXPECT_NEAR(total, 1.0f, 5e-3f) << nameOf(m) << " " << r << " " << NoV;
                    }
                    // Image-based light knows the same albedo.
                    const ShadedLight ambient = shadeEnvironment(s, vec3(kPi), vec3(1.0f));
                    EXPECT_NEAR(ambient.diffuse.y + ambient.specular.y, total, 6e-3f) << nameOf(m);
                }
}

// As much of the specular layer as is shown takes from the diffuse lobe.
TEST(Energy, FadedLayerTakesItsShare) {
    BrdfModel m = defaultBrdfModel();
    m.diffuse = kDiffuseEon;
    for (const float r : {0.2f, 1.0f})
        for (const float NoV : {0.1f, 1.0f}) {
            const vec2 dfg = quadratureDfg(m, NoV, alphaFromPerceptualRoughness(r));
            const SurfaceTerms whole =
                makeSurface(m, {vec3(1.0f), 0.0f, r, r}, vec3(0, 0, 1), viewerAt(NoV), dfg);
            const SurfaceTerms same = fadeSpecularLayer(whole, 1.0f);
            EXPECT_EQ(same.transmission, whole.transmission);
            EXPECT_EQ(same.diffuseAlbedo, whole.diffuseAlbedo);
            for (const float shown : {0.0f, 0.3f, 1.0f}) {
                const SurfaceTerms s = fadeSpecularLayer(whole, shown);
                EXPECT_EQ(s.specularAlbedo, whole.specularAlbedo);
                EXPECT_NEAR(diffuseIntegral(s).y + shown * specularIntegral(s).y, 1.0f, 5e-3f);
                const ShadedLight ambient = shadeEnvironment(s, vec3(kPi), vec3(1.0f));
                EXPECT_NEAR(ambient.diffuse.y + shown * ambient.specular.y, 1.0f, 1e-5f);
            }
        }
}

TEST(Reciprocity, OfEverySingleLobe) {
    for (int f = 0; f < kFresnels; ++f)
        for (int diffuseModel = 0; diffuseModel < kDiffuses; ++diffuseModel)
            forEachSpecularModel([&](BrdfModel m) {
                m.fresnel = f;
                m.diffuse = diffuseModel;
                m.multiScatter = 0;
                m.f90 = 0.7f;
                m.conductorN = vec3(0.2f, 0.9f, 2.5f);
                m.conductorK = vec3(3.0f, 2.0f, 3.5f);
                for (std::uint32_t i = 0; i < 40; ++i) {
                    const vec3 v = cosineHemisphere(sobolOwen2D(i, 1));
                    const vec3 l = cosineHemisphere(sobolOwen2D(i, 2));
                    const float r = 0.1f + 0.9f * sobolOwen2D(i, 3).x;
                    if (std::min(v.z, l.z) < 1e-3f)
                        continue;
                    // A layer that takes nothing: what remains is the lobes themselves.
                    const auto at = [&](const vec3& viewer, const vec3& light) {
                        const SurfaceTerms s = makeSurface(m, {vec3(0.6f), 0.4f, r, r},
                                                           vec3(0, 0, 1), viewer, vec2(0.0f));
                        return shadeDirect(s, light, vec3(1.0f));
                    };
                    const ShadedLight a = at(v, l), b = at(l, v);
                    const double there = a.specular.x / l.z, back = b.specular.x / v.z;
                    ASSERT_NEAR(there, back, 1e-4 * std::max(there, back) + 1e-30) << nameOf(m);
                    if (diffuseModel == kDiffuseBurley) {
                        ASSERT_NEAR(Fd_Burley(v.z, l.z, 0.4f, r), Fd_Burley(l.z, v.z, 0.4f, r),
                                    1e-5);
                    } else {
                        ASSERT_NEAR(a.diffuse.x / l.z, b.diffuse.x / v.z, 1e-4 * a.diffuse.x / l.z)
                            << nameOf(m);
                    }
                }
            });
}

TEST(ExactFresnel, AlbedoUnderImageBasedLight) {
    // E F(c) at (1 - c)⁵ = bias / E against the integral with F inside, and against the fit by
    // Schlick; over roughness and angle.
    struct Material {
        const char* name;
        int fresnel;
        float metallic;
        vec3 n, k;
        double largest, rms, schlick; // errors; Schlick's is at least the last
    };
    const Material materials[] = {
        {"water", kFresnelDielectric, 0.0f, vec3(1.33f), vec3(0.0f), 0.018, 0.005, 0.05},
        {"glass", kFresnelDielectric, 0.0f, vec3(1.5f), vec3(0.0f), 0.018, 0.006, 0.03},
        {"gold", kFresnelConductor, 1.0f, vec3(0.18f, 0.42f, 1.37f), vec3(3.42f, 2.35f, 1.77f),
         0.018, 0.005, 0.015},
        {"iron", kFresnelConductor, 1.0f, vec3(2.87f), vec3(3.36f), 0.046, 0.0125, 0.15}};
    for (const Material& material : materials) {
        double largest = 0.0, square = 0.0, schlick = 0.0;
        int count = 0;
        for (const float r : {0.05f, 0.25f, 0.5f, 0.75f, 1.0f})
            for (const float NoV : {0.02f, 0.1f, 0.25f, 0.5f, 0.75f, 1.0f}) {
                BrdfModel m = defaultBrdfModel();
                m.fresnel = material.fresnel;
                m.multiScatter = 0;
                m.ior = material.n.x;
                m.conductorN = material.n;
                m.conductorK = material.k;
                const vec2 dfg = quadratureDfg(m, NoV, alphaFromPerceptualRoughness(r));
                const SurfaceTerms s = makeSurface(m, {vec3(0.5f), material.metallic, r, 0.0f},
                                                   vec3(0, 0, 1), viewerAt(NoV), dfg);
                const vec3 exact = specularIntegral(s);
                const vec3 fit = s.f0 * dfg.x + vec3(dfg.y);
                for (int c = 0; c < 3; ++c) {
                    const double error = std::abs(s.specularAlbedo[c] - exact[c]);
                    largest = std::max(largest, error);
                    square += error * error;
                    schlick = std::max(schlick, std::abs(double(fit[c]) - exact[c]));
                    ++count;
                }
            }
        EXPECT_LT(largest, material.largest) << material.name;
        EXPECT_LT(std::sqrt(square / count), material.rms) << material.name;
        EXPECT_GT(schlick, material.schlick) << material.name;
    }
}

TEST(ExactFresnel, AMirrorIsFresnelItself) {
    BrdfModel m = defaultBrdfModel();
    m.fresnel = kFresnelDielectric;
    m.ior = 1.8f;
    for (const float NoV : {0.05f, 0.3f, 1.0f}) {
        const float weight = schlickWeight(NoV); // table at roughness 0
        const SurfaceTerms s = makeSurface(m, {vec3(0.5f), 0.0f, 0.0f, 0.0f}, vec3(0, 0, 1),
                                           viewerAt(NoV), vec2(1.0f - weight, weight));
        EXPECT_NEAR(s.specularAlbedo.x, F_Dielectric(NoV, 1.8f), 2e-5f) << NoV;
    }
}

TEST(Choices, EachOneReachesThePicture) {
    // Switching one term changes the reflection of one light; so no dispatch is forgotten.
    const vec3 l = normalize(vec3(-0.6f, 0.2f, 0.5f));
    const auto shade = [&](const BrdfModel& m) {
        const SurfaceTerms s = makeSurface(m, {vec3(0.7f), 0.3f, 0.5f, 0.8f}, vec3(0, 0, 1),
                                           viewerAt(0.6f), vec2(0.8f, 0.05f));
        const ShadedLight light = shadeDirect(s, l, vec3(1.0f));
        return light.specular.x + light.diffuse.x;
    };
    std::vector<float> seen;
    const auto add = [&](const BrdfModel& m) {
        const float value = shade(m);
        for (const float other : seen)
            EXPECT_GT(std::abs(value - other), 1e-5f) << nameOf(m);
        seen.push_back(value);
    };
    const BrdfModel base = defaultBrdfModel();
    add(base);
    for (int i = 1; i < kDistributions; ++i) {
        BrdfModel m = base;
        m.distribution = i;
        add(m);
    }
    for (int i = 1; i < kVisibilities; ++i) {
        BrdfModel m = base;
        m.visibility = i;
        add(m);
    }
    for (int i = 1; i < kFresnels; ++i) {
        BrdfModel m = base;
        m.fresnel = i;
        m.f90 = 0.2f;
        m.ior = 1.9f;
        m.conductorN = vec3(0.3f);
        m.conductorK = vec3(4.0f);
        add(m);
    }
    for (int i = 1; i < kDiffuses; ++i) {
        BrdfModel m = base;
        m.diffuse = i;
        add(m);
    }
    BrdfModel lossy = base;
    lossy.multiScatter = 0;
    add(lossy);
}

TEST(Sweep, NoModelYieldsAnythingButFiniteLight) {
    // Roughness at and beyond its ends, grazing and backward views, black and too bright albedo,
    // lights anywhere: inside the surface, behind it, opposite the viewer, as close as 1e-14 m².
    constexpr float kRoughness[] = {-1.0f, 0.0f, 0.045f, 0.5f, 1.0f, 2.0f};
    constexpr float kMetallic[] = {0.0f, 0.5f, 1.0f};
    constexpr float kAlbedo[] = {0.0f, 0.5f, 1.0f, 20.0f};
    constexpr float kNoV[] = {-0.5f, 0.0f, 1e-6f, 1e-3f, 0.5f, 1.0f};
    const vec2 kDfg[] = {vec2(0.0f), vec2(0.9f, 0.05f), vec2(0.3f, 0.0f), vec2(1.2f, 0.1f)};
    std::uint32_t n = 0;
    for (int f = 0; f < kFresnels; ++f)
        for (int diffuseModel = 0; diffuseModel < kDiffuses; ++diffuseModel)
            forEachSpecularModel([&](BrdfModel m) {
                m.fresnel = f;
                m.diffuse = diffuseModel;
                m.multiScatter = static_cast<int>(n % 2);
                m.ior = n % 3 == 0 ? 1.0f : 2.4f;
                m.conductorK = vec3(n % 5 == 0 ? 0.0f : 3.0f);
                m.conductorN = vec3(n % 4 == 0 ? 0.01f : 1.0f);
                for (const float r : kRoughness)
                    for (const float NoV : kNoV) {
                        ++n;
                        const vec3 v = viewerAt(NoV), normal(0, 0, 1);
                        const SurfaceTerms s =
                            makeSurface(m, {vec3(kAlbedo[n % 4]), kMetallic[n % 3], r, r}, normal,
                                        v, kDfg[(n / 7) % 4]);
                        for (const vec3& l :
                             {-v, v, reflect(-v, normal), normal, -normal, vec3(1, 0, 0),
                              normalize(vec3(1.0f, 0.0f, 1e-6f)), uniformSphere(sobolOwen2D(n, 5))})
                            for (const float irradiance : {1.0f, 1e14f}) {
                                const ShadedLight light = shadeDirect(s, l, vec3(irradiance));
                                float pdf = brdfPdf(s, l);
                                for (const float value :
                                     {light.diffuse.x, light.specular.x, light.specular.z, pdf})
                                    ASSERT_TRUE(value >= 0.0f &&
                                                value <= std::numeric_limits<float>::max())
                                        << nameOf(m) << ", r " << r << ", N·V " << NoV << ", n "
                                        << n << ": " << value;
                            }
                        const ShadedLight ambient = shadeEnvironment(s, vec3(1e5f), vec3(1e5f));
                        ASSERT_TRUE(std::isfinite(ambient.diffuse.x + ambient.specular.x))
                            << nameOf(m);
                        float pdf = 0.0f;
                        const vec3 l =
                            sampleBrdf(s, vec3(sobolOwen2D(n, 6), sobolOwen2D(n, 7).x), pdf);
                        ASSERT_TRUE(std::isfinite(l.x + l.y + l.z) && pdf >= 0.0f &&
                                    std::isfinite(pdf))
                            << nameOf(m) << ", r " << r << ", N·V " << NoV;
                    }
            });
}

} // namespace
} // namespace patina::shading
