// The numbers behind the BRDF lens: against closed forms, published tables and plain integration.

#include "core/light/BrdfLens.h"

#include "core/light/DfgTable.h"
#include "core/light/LensCurves.h"

#include <cmath>
#include <gmock/gmock.h>
#include <numbers>

namespace patina {
namespace {

using shading::vec3;

constexpr Distribution kDistributions[] = {Distribution::GGX, Distribution::Beckmann,
                                           Distribution::BlinnPhong};
constexpr Visibility kVisibilities[] = {Visibility::SmithCorrelated, Visibility::SmithSeparable,
                                        Visibility::SchlickDirect,   Visibility::SchlickIbl,
                                        Visibility::Kelemen,         Visibility::Implicit};

BrdfLens lensOf(const ShadingModel& model, const SurfacePoint& material) {
    static DfgTables tables;
    return {model, material, tables.of(model)};
}

ShadingModel singleScatter() {
    ShadingModel model;
    model.multiScatter = false;
    return model;
}

SurfacePoint metal(float roughness, float reflectance = 1.0f) {
    return {vec3(reflectance), 1.0f, roughness, 0.0f};
}

TEST(BrdfLens, DistributionIsTheClosedForm) {
    // D = a² / (pi ((n·h)² (a² - 1) + 1)²), a = roughness²
    const struct {
        float roughness, NoH, D;
    } cases[] = {{0.25f, 1.0f, 81.4873308631f},  {0.25f, 0.9f, 0.0333240287707f},
                 {0.5f, 1.0f, 5.09295817894f},   {0.5f, 0.95f, 0.839880758206f},
                 {0.5f, 0.5f, 0.0339389133124f}, {1.0f, 0.5f, 0.318309886184f}};
    for (const auto& c : cases)
        EXPECT_NEAR(lensOf({}, metal(c.roughness)).distribution(std::acos(c.NoH)) / c.D, 1.0f,
                    2e-4f)
            << c.roughness << ' ' << c.NoH;
}

TEST(BrdfLens, TheCurveOfEveryDistributionIntegratesToOne) {
    for (const Distribution distribution : kDistributions)
        for (const float roughness : {0.0f, 0.1f, 0.3f, 0.6f, 1.0f}) {
            ShadingModel model;
            model.distribution = distribution;
            const BrdfLens lens = lensOf(model, metal(roughness));
            // ∫ D cos dω by the trapezoidal rule on the very points of the plot
            const std::vector<float> angles = lensAngles(0.0f, lens.alpha());
            double sum = 0.0;
            for (std::size_t i = 1; i < angles.size(); ++i) {
                const auto integrand = [&](float angle) {
                    return 2.0 * std::numbers::pi * double(lens.distribution(angle)) *
                           std::cos(angle) * std::sin(angle);
                };
                if (angles[i - 1] >= 0.0f)
                    sum += 0.5 * (integrand(angles[i - 1]) + integrand(angles[i])) *
                           (angles[i] - angles[i - 1]);
            }
            EXPECT_NEAR(sum, 1.0, 0.012) << int(distribution) << ' ' << roughness;
        }
}

TEST(BrdfLens, MaskingIsSmiths) {
    // G2 height-correlated, Heitz 2014, equation 99, at (N·V, N·L)
    const BrdfLens half = lensOf({}, metal(0.5f));
    EXPECT_NEAR(half.masking(-std::acos(0.1f), std::acos(0.1f)), 0.373001923296f, 1e-5f);
    EXPECT_NEAR(half.masking(-std::acos(0.75f), std::acos(0.25f)), 0.827828880196f, 1e-5f);
    EXPECT_NEAR(half.masking(0.0f, std::acos(0.25f)), 0.836140993509f, 1e-5f) << "G2 = G1";
    ShadingModel model;
    model.visibility = Visibility::SmithSeparable;
    EXPECT_NEAR(lensOf(model, metal(0.5f)).masking(-std::acos(0.1f), std::acos(0.1f)),
                0.295215966644f, 1e-5f);
    model.visibility = Visibility::SchlickDirect;
    EXPECT_NEAR(lensOf(model, metal(0.5f)).masking(-std::acos(0.5f), std::acos(0.5f)),
                0.609161213563f, 1e-5f);
    // Kelemen's depends on V·H, which both directions must be told apart for.
    model.visibility = Visibility::Kelemen;
    const BrdfLens kelemen = lensOf(model, metal(0.5f));
    EXPECT_NEAR(kelemen.masking(-0.6f, 0.6f), 1.0f, 1e-5f) << "N·L N·V / (V·H)²";
    EXPECT_NEAR(kelemen.masking(-0.6f, -0.6f), std::pow(std::cos(0.6f), 2.0f), 1e-5f);
    EXPECT_NEAR(half.masking(-1.0f, std::numbers::pi_v<float> / 2.0f), 0.0f, 2e-3f);
}

TEST(BrdfLens, FresnelIsTheModels) {
    // Fresnel's equations at n = 1.5
    ShadingModel exact;
    exact.fresnel = Fresnel::Dielectric;
    const BrdfLens glass = lensOf(exact, {vec3(0.5f), 0.0f, 0.3f, 0.0f});
    EXPECT_NEAR(glass.fresnel(std::acos(0.1f)).g, 0.571592520342f, 1e-5f);
    EXPECT_NEAR(glass.fresnel(std::acos(0.5f)).g, 0.0891867128022f, 1e-6f);
    EXPECT_NEAR(glass.fresnel(0.0f).g, 0.04f, 1e-6f);
    const BrdfLens schlick = lensOf({}, {vec3(0.5f), 0.0f, 0.3f, 0.0f});
    EXPECT_NEAR(schlick.fresnel(std::acos(0.5f)).g, 0.07f, 1e-6f);
    EXPECT_NEAR(schlick.fresnel(std::numbers::pi_v<float> / 2.0f).g, 1.0f, 1e-5f);
}

TEST(BrdfLens, TheBrdfIsCookAndTorrances) {
    // D G2 F / (4 N·L N·V) by hand at roughness 0.3, F0 = 0.5
    const vec3 v = glm::normalize(vec3(0.3f, 0.1f, 0.9f));
    const vec3 l = glm::normalize(vec3(-0.5f, 0.2f, 0.7f));
    const BrdfLens lens = lensOf(singleScatter(), metal(0.3f, 0.5f));
    EXPECT_NEAR(lens.brdf(l, v, LensLobe::Specular).g, 0.112074815921f, 2e-6f);
    EXPECT_EQ(lens.brdf(l, v, LensLobe::Diffuse), vec3(0.0f)) << "a metal has none";
    EXPECT_EQ(lens.brdf(l, v, LensLobe::Both), lens.brdf(l, v, LensLobe::Specular));
    const BrdfLens plastic = lensOf({}, {vec3(0.8f, 0.4f, 0.2f), 0.0f, 0.3f, 0.0f});
    const vec3 both = plastic.brdf(l, v, LensLobe::Both);
    EXPECT_EQ(both, plastic.brdf(l, v, LensLobe::Diffuse) + plastic.brdf(l, v, LensLobe::Specular));
    EXPECT_NEAR(plastic.brdf(l, v, LensLobe::Diffuse).r / plastic.brdf(l, v, LensLobe::Diffuse).b,
                4.0f, 0.01f);
    // The product of the factors that are plotted.
    const float theta = 0.5f, thetaV = 0.9f;
    const BrdfLens same = lensOf(singleScatter(), metal(0.4f));
    EXPECT_NEAR(same.brdf(lensDirection(-theta), lensDirection(thetaV), LensLobe::Specular).g,
                same.distribution(0.5f * (thetaV - theta)) * same.masking(-theta, thetaV) *
                    same.fresnel(0.5f * (thetaV + theta)).g /
                    (4.0f * std::cos(theta) * std::cos(thetaV)),
                1e-4f);
}

TEST(BrdfLens, LightAndViewerMayChangePlaces) {
    // Of every pair of D and V without compensation, which looks at the viewer only.
    for (const Distribution distribution : kDistributions)
        for (const Visibility visibility : kVisibilities) {
            ShadingModel model = singleScatter();
            model.distribution = distribution;
            model.visibility = visibility;
            const BrdfLens lens = lensOf(model, {vec3(0.7f), 1.0f, 0.5f, 0.3f});
            for (const float thetaL : {-1.3f, -0.6f, 0.2f})
                for (const float thetaV : {-0.9f, 0.4f, 1.2f}) {
                    const vec3 l = lensDirection(thetaL), v = lensDirection(thetaV);
                    const float there = lens.brdf(l, v, LensLobe::Specular).g;
                    EXPECT_GT(there, 0.0f);
                    EXPECT_NEAR(there / lens.brdf(v, l, LensLobe::Specular).g, 1.0f, 1e-4f)
                        << int(distribution) << ' ' << int(visibility);
                }
        }
}

TEST(BrdfLens, AlbedoCurvesAreTheTablesAndTheIntegral) {
    for (const Distribution distribution : kDistributions)
        for (const Visibility visibility :
             {Visibility::SmithCorrelated, Visibility::SchlickIbl, Visibility::Implicit})
            for (const float roughness : {0.2f, 0.5f, 1.0f})
                for (const float NoV : {0.1f, 0.5f, 0.97f}) {
                    ShadingModel model = singleScatter();
                    model.distribution = distribution;
                    model.visibility = visibility;
                    const float f0 = 0.3f;
                    const LensAlbedo albedo = lensOf(model, metal(roughness, f0))
                                                  .albedo(std::acos(NoV), LensLobe::Specular);
                    const glm::dvec3 dfg = integrateDfg(NoV, roughness, distribution, visibility);
                    const double expected = double(f0) * dfg.x + dfg.y; // Karis 2013, eq. 8
                    EXPECT_NEAR(albedo.single.g, expected, 2e-3)
                        << int(distribution) << int(visibility) << ' ' << roughness << ' ' << NoV;
                    EXPECT_NEAR(albedo.exact.g, expected, 1e-3)
                        << int(distribution) << int(visibility) << ' ' << roughness << ' ' << NoV;
                    const double E = dfg.x + dfg.y;
                    EXPECT_NEAR(albedo.multi.g,
                                std::min(expected * (1.0 + f0 * (1.0 - E) / E), 1.0), 3e-3);
                }
}

TEST(BrdfLens, AWhiteFurnaceReturnsAllWithCompensation) {
    for (const float roughness : {0.1f, 0.5f, 1.0f})
        for (const float theta : {0.0f, 0.7f, 1.3f}) {
            const LensAlbedo white = lensOf({}, metal(roughness)).albedo(theta, LensLobe::Both);
            EXPECT_NEAR(white.multi.g, 1.0f, 1e-5f);
            EXPECT_NEAR(white.exact.g, 1.0f, 3e-3f) << roughness << ' ' << theta;
            const LensAlbedo plastic =
                lensOf({}, {vec3(1.0f), 0.0f, roughness, 0.0f}).albedo(theta, LensLobe::Both);
            EXPECT_NEAR(plastic.multi.g, 1.0f, 1e-5f);
            EXPECT_NEAR(plastic.exact.g, 1.0f, 2e-3f) << roughness << ' ' << theta;
        }
    // 1 - ln 2 is all that scatters once at roughness 1, seen straight on.
    const LensAlbedo rough = lensOf(singleScatter(), metal(1.0f)).albedo(0.0f, LensLobe::Specular);
    EXPECT_NEAR(rough.single.g, 1.0f - std::log(2.0f), 1e-3f);
    EXPECT_NEAR(rough.exact.g, 1.0f - std::log(2.0f), 1e-3f);
    EXPECT_NEAR(rough.multi.g, 1.0f, 1e-5f);
}

TEST(BrdfLens, TheExactAlbedoIsThePlainIntegral) {
    // Of what brdf() says, over 40,000 directions in equal solid angles.
    ShadingModel model;
    model.distribution = Distribution::Beckmann;
    model.visibility = Visibility::SchlickDirect; // whose table is that of another k
    model.fresnel = Fresnel::Conductor;
    model.diffuse = Diffuse::Eon;
    const BrdfLens lens = lensOf(model, {vec3(0.9f, 0.5f, 0.3f), 0.4f, 0.6f, 0.8f});
    for (const float theta : {0.2f, 1.0f, 1.4f})
        for (const LensLobe lobe : {LensLobe::Specular, LensLobe::Diffuse, LensLobe::Both}) {
            constexpr int kHeights = 200, kAzimuths = 200;
            glm::dvec3 sum(0.0);
            for (int i = 0; i < kHeights; ++i)
                for (int k = 0; k < kAzimuths; ++k) {
                    const float z = (float(i) + 0.5f) / kHeights;
                    const float phi = shading::kTwoPi * (float(k) + 0.5f) / kAzimuths;
                    const float r = std::sqrt(1.0f - z * z);
                    sum += glm::dvec3(lens.brdf({r * std::cos(phi), r * std::sin(phi), z},
                                                lensDirection(theta), lobe) *
                                      z);
                }
            sum *= 2.0 * std::numbers::pi / (kHeights * kAzimuths);
            const vec3 exact = lens.albedo(theta, lobe).exact;
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(exact[c], sum[c], 1e-3) << theta << ' ' << int(lobe) << ' ' << c;
        }
}

TEST(BrdfLens, ExtremeMaterialsStayFinite) {
    for (const SurfacePoint& material :
         {SurfacePoint{vec3(0.0f), 0.0f, 0.0f, 0.0f}, SurfacePoint{vec3(0.0f), 1.0f, 0.0f, 1.0f},
          SurfacePoint{vec3(1.0f), 1.0f, 1.0f, 1.0f}, SurfacePoint{vec3(9.0f), -1.0f, 2.0f, -3.0f}})
        for (const Distribution distribution : kDistributions) {
            ShadingModel model;
            model.distribution = distribution;
            const BrdfLens lens = lensOf(model, material);
            for (const float theta : {0.0f, 0.8f, 1.5707963f, 2.0f}) {
                for (const float angle : lensAngles(theta, lens.alpha())) {
                    const vec3 f =
                        lens.brdf(lensDirection(-theta), lensDirection(angle), LensLobe::Both);
                    ASSERT_TRUE(std::isfinite(f.r) && f.r >= 0.0f) << theta << ' ' << angle;
                }
                const LensAlbedo albedo = lens.albedo(theta, LensLobe::Both);
                for (const vec3& share : {albedo.single, albedo.multi, albedo.exact}) {
                    EXPECT_GE(share.g, 0.0f);
                    EXPECT_LE(share.g, 1.8f) << "Blinn-Phong with Smith's terms at most";
                }
            }
        }
    const BrdfLens lens = lensOf({}, metal(0.3f));
    EXPECT_EQ(lens.brdf(lensDirection(1.7f), lensDirection(0.2f), LensLobe::Both), vec3(0.0f));
    EXPECT_EQ(lens.brdf(lensDirection(0.2f), lensDirection(1.7f), LensLobe::Both), vec3(0.0f));
}

TEST(BrdfLens, AnglesMissNoHighlight) {
    for (const float peak : {0.0f, 0.7f, 1.5f, 1.6f})
        for (const float alpha : {0.002025f, 0.1f, 1.0f}) {
            const std::vector<float> angles = lensAngles(peak, alpha);
            EXPECT_TRUE(std::is_sorted(angles.begin(), angles.end()));
            EXPECT_NEAR(angles.front(), -shading::kPi / 2.0f, 1e-6f);
            EXPECT_NEAR(angles.back(), shading::kPi / 2.0f, 1e-6f);
            const float inside = std::min(peak, shading::kPi / 2.0f);
            const auto within = std::count_if(angles.begin(), angles.end(), [&](float angle) {
                return std::abs(angle - inside) < 0.5f * alpha;
            });
            EXPECT_GE(within, 5) << peak << ' ' << alpha;
        }
}

// --- The lobe in space ---------------------------------------------------------------------------

TEST(LobeMesh, RadiusIsLinearOrFourDecades) {
    LobeScale scale;
    EXPECT_FLOAT_EQ(lobeRadius(2.0f, 8.0f, scale), 0.25f);
    scale.logarithmic = true;
    EXPECT_FLOAT_EQ(lobeRadius(8.0f, 8.0f, scale), 1.0f);
    EXPECT_FLOAT_EQ(lobeRadius(0.08f, 8.0f, scale), 0.5f);
    EXPECT_EQ(lobeRadius(8e-5f, 8.0f, scale), 0.0f);
    EXPECT_EQ(lobeRadius(0.0f, 8.0f, scale), 0.0f);
    EXPECT_EQ(lobeRadius(1.0f, 0.0f, scale), 0.0f) << "nothing is reflected at all";
}

TEST(LobeMesh, ValuesAreOfTheChosenChannel) {
    const vec3 f(0.4f, 0.2f, 0.1f);
    LobeScale scale;
    EXPECT_FLOAT_EQ(lobeValue(f, 0.5f, scale), 0.2126f * 0.4f + 0.7152f * 0.2f + 0.0722f * 0.1f);
    scale.channel = 2;
    EXPECT_FLOAT_EQ(lobeValue(f, 0.5f, scale), 0.1f);
    scale.cosine = true;
    EXPECT_FLOAT_EQ(lobeValue(f, 0.5f, scale), 0.05f);
}

TEST(LobeMesh, IsTheBrdfInEveryDirection) {
    const vec3 light = glm::normalize(vec3(-0.8f, 0.3f, 0.6f));
    for (const float roughness : {0.0f, 0.3f, 0.9f})
        for (const LobeEnd end : {LobeEnd::Light, LobeEnd::Viewer})
            for (const bool logarithmic : {false, true}) {
                const BrdfLens lens = lensOf({}, {vec3(0.8f, 0.5f, 0.3f), 0.5f, roughness, 0.0f});
                LobeScale scale;
                scale.logarithmic = logarithmic;
                scale.cosine = true;
                const float peak = lobePeak(lens, light, end, scale);
                const LobeMesh mesh = makeLobeMesh(lens, light, end, scale, peak);
                float farthest = 0.0f, lowest = 1.0f;
                for (const vec3& p : mesh.positions) {
                    const float r = glm::length(p);
                    farthest = std::max(farthest, r);
                    if (r < 1e-4f)
                        continue;
                    const vec3 d = p / r;
                    lowest = std::min(lowest, d.z);
                    const vec3 f = end == LobeEnd::Light ? lens.brdf(light, d, LensLobe::Both)
                                                         : lens.brdf(d, light, LensLobe::Both);
                    // Directions out of positions have rounding, which a mirror's peak magnifies.
                    if (roughness > 0.0f) {
                        EXPECT_NEAR(r, lobeRadius(lobeValue(f, d.z, scale), peak, scale), 2e-3f);
                    }
                }
                EXPECT_NEAR(farthest, 1.0f, 0.02f) << roughness;
                EXPECT_GE(lowest, 0.0f);
                if (logarithmic && roughness > 0.0f) {
                    EXPECT_LT(lowest, 0.05f) << "down to where four decades end";
                }
            }
}

TEST(LobeMesh, FacesLookOutwards) {
    for (const float theta : {0.0f, 0.9f, 1.5f}) {
        const BrdfLens lens = lensOf({}, {vec3(0.8f), 0.0f, 0.4f, 0.0f});
        const vec3 light = lensDirection(-theta);
        LobeScale scale;
        scale.logarithmic = true;
        const LobeMesh mesh = makeLobeMesh(lens, light, LobeEnd::Light, scale,
                                           lobePeak(lens, light, LobeEnd::Light, scale));
        ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
        ASSERT_EQ(mesh.colors.size(), mesh.positions.size());
        ASSERT_EQ(mesh.triangles.size() % 3, 0u);
        for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
            const vec3 a = mesh.positions[mesh.triangles[i]],
                       b = mesh.positions[mesh.triangles[i + 1]],
                       c = mesh.positions[mesh.triangles[i + 2]];
            // Seen from the origin inside, every face of a star-shaped body turns its back.
            EXPECT_GE(glm::dot(glm::cross(b - a, c - a), a), -1e-7f) << theta << ' ' << i;
        }
    }
}

} // namespace
} // namespace patina
