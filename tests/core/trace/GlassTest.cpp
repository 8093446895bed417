// Glass against closed forms: the surface alone, and what paths make of bodies of it.
#include "core/trace/path/Glass.h"

#include "core/math/Sampling.h"
#include "core/trace/path/PathTracer.h"
#include "tests/core/math/SamplerCheck.h"
#include "tests/core/trace/GlassScenes.h"
#include "tests/core/trace/TraceBall.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace patina {

using std::numbers::pi;
using test::built;
using test::glass;
using test::lookedAt;

namespace {

GlassTerms terms(float perceptualRoughness, float eta, bool thinWalled, float NoV = 1.0f) {
    GlassTerms t;
    t.n = {0.0f, 0.0f, 1.0f};
    t.v = {std::sqrt(1.0f - NoV * NoV), 0.0f, NoV};
    t.NoV = NoV;
    t.eta = eta;
    t.thinWalled = thinWalled;
    t.alpha = glassAlpha(perceptualRoughness, eta, thinWalled);
    return t;
}

std::string nameOf(const GlassTerms& t) {
    return "alpha " + std::to_string(t.alpha) + ", eta " + std::to_string(t.eta) + ", cosine " +
           std::to_string(t.NoV) + (t.thinWalled ? ", thin" : "");
}

std::vector<GlassTerms> roughTerms() {
    std::vector<GlassTerms> all;
    for (const float roughness : {0.5f, 1.0f})
        for (const float NoV : {0.8f, 0.3f}) {
            for (const float eta : {1.5f, 1.0f / 1.5f, 2.4f})
                all.push_back(terms(roughness, eta, false, NoV));
            all.push_back(terms(roughness, 1.5f, true, NoV));
        }
    return all;
}

// A third number, independent of the two.
glm::vec3 withChoice(const glm::vec2& u) {
    const std::uint32_t mixed =
        hash32(std::bit_cast<std::uint32_t>(u.x) ^ hash32(std::bit_cast<std::uint32_t>(u.y)));
    return {u, static_cast<float>(mixed >> 8) * 0x1p-24f};
}

} // namespace

TEST(Glass, RefractsBySnellAndReflectsByFresnel) {
    for (const float eta : {1.33f, 1.5f, 2.4f, 1.0f / 1.33f, 1.0f / 1.5f})
        for (const float NoV : {1.0f, 0.8f, 0.6f, 0.3f, 0.05f}) {
            const GlassTerms t = terms(0.0f, eta, false, NoV);
            const double R = test::fresnel(NoV, eta);
            EXPECT_NEAR(glassReflectance(t, NoV), R, 2e-5) << nameOf(t);
            EXPECT_NEAR(glassReflectance(terms(0.0f, eta, true, NoV), NoV),
                        R + (R < 1.0 ? (1.0 - R) * (1.0 - R) * R / (1.0 - R * R) : 0.0), 2e-5);
            const GlassSample mirrored = sampleGlass(t, {0.5f, 0.5f, 0.0f});
            EXPECT_NEAR(mirrored.direction.x, -t.v.x, 1e-6);
            EXPECT_NEAR(mirrored.direction.z, t.v.z, 1e-6);
            const GlassSample on = sampleGlass(t, {0.5f, 0.5f, 1.0f - 0x1p-24f});
            EXPECT_EQ(on.through, R < 1.0) << nameOf(t);
            if (!on.through)
                continue;
            EXPECT_NEAR(on.direction.x, -t.v.x / eta, 1e-6) << nameOf(t);
            EXPECT_LT(on.direction.z, 0.0f);
            EXPECT_NEAR(on.weight.x, 1.0 / (eta * eta), 1e-5);
        }
}

TEST(Glass, TotallyReflectsBeyondTheCriticalAngle) {
    const double critical = std::sqrt(1.0 - 1.0 / (1.5 * 1.5)); // its cosine inside
    for (const double offset : {-1e-3, 1e-3}) {
        const auto NoV = static_cast<float>(critical + offset);
        EXPECT_EQ(glassReflectance(terms(0.0f, 1.0f / 1.5f, false, NoV), NoV) == 1.0f,
                  offset < 0.0);
    }
}

TEST(Glass, IsAsDenseAsItSays) {
    for (const GlassTerms& t : roughTerms()) {
        // Samples that meet the surface twice are lost: they count as outside of the histogram.
        constexpr double kLowest = -0.99999;
        int lost = 0;
        for (std::uint32_t i = 0; i < 65536; ++i)
            lost += sampleGlass(t, withChoice(sobolOwen2D(i, 3))).weight == glm::vec3(0.0f) ? 1 : 0;
        checkSampler(
            nameOf(t),
            [&](const glm::vec2& u) {
                const GlassSample sample = sampleGlass(t, withChoice(u));
                return sample.weight == glm::vec3(0.0f) ? glm::vec3(0.0f, 0.0f, -1.0f)
                                                        : sample.direction;
            },
            [&](const glm::dvec3& l) { return static_cast<double>(glassPdf(t, glm::vec3(l))); },
            kLowest, 1.0 - lost / 65536.0);
    }
}

// What a sample weighs is what the surface does in its direction over how likely that is, and what
// all of them weigh is its integral.
TEST(Glass, SamplesWeighWhatTheSurfaceDoes) {
    for (const GlassTerms& t : roughTerms()) {
        double sampled = 0.0;
        constexpr std::uint32_t kSamples = 1 << 14;
        for (std::uint32_t i = 0; i < kSamples; ++i) {
            const GlassSample sample = sampleGlass(t, withChoice(sobolOwen2D(i, 7)));
            if (sample.weight == glm::vec3(0.0f))
                continue;
            const float pdf = glassPdf(t, sample.direction);
            const glm::vec3 value = evaluateGlass(t, sample.direction);
            EXPECT_NEAR(sample.pdf, pdf, 5e-3f * pdf) << nameOf(t);
            EXPECT_NEAR(value.x / pdf, sample.weight.x, 5e-3f * sample.weight.x) << nameOf(t);
            EXPECT_EQ(sample.through, sample.direction.z < 0.0f);
            sampled += static_cast<double>(sample.weight.x) / kSamples;
        }
        double integral = 0.0;
        constexpr int kZ = 400, kPhi = 400;
        for (int i = 0; i < kZ; ++i)
            for (int j = 0; j < kPhi; ++j) {
                const double z = -1.0 + 2.0 * (i + 0.5) / kZ, phi = 2.0 * pi * (j + 0.5) / kPhi;
                const double r = std::sqrt(1.0 - z * z);
                integral += static_cast<double>(
                                evaluateGlass(t, glm::vec3(glm::dvec3(r * std::cos(phi),
                                                                      r * std::sin(phi), z)))
                                    .x) *
                            (2.0 / kZ) * (2.0 * pi / kPhi);
            }
        EXPECT_NEAR(sampled, integral, 6e-3 * integral) << nameOf(t);
    }
}

// f(v, l) / n² of one side is f(l, v) of the other: Veach 1997, equation 5.14.
TEST(Glass, IsReciprocalUpToTheIndex) {
    for (const float roughness : {0.4f, 0.9f})
        for (const float eta : {1.5f, 1.0f / 1.5f})
            for (const float outer : {0.95f, 0.6f})
                for (const float inner : {0.9f, 0.8f}) {
                    GlassTerms there = terms(roughness, eta, false, outer);
                    const glm::vec3 l(-std::sqrt(1.0f - inner * inner), 0.0f, -inner);
                    GlassTerms back = terms(roughness, 1.0f / eta, false, inner);
                    back.n = -back.n;
                    back.v = l;
                    const double f = evaluateGlass(there, l).x / inner,
                                 g = evaluateGlass(back, there.v).x / outer;
                    EXPECT_NEAR(f * eta * eta, g, 1e-4 * g) << nameOf(there);
                }
}

TEST(Glass, ASlabTransmitsByFresnelAndItsInnerReflections) {
    for (const float n : {1.33f, 1.5f, 2.4f})
        for (const float pitch : {88.0f, 60.0f, 35.0f, 15.0f}) {
            const double R = test::fresnel(std::sin(pitch * pi / 180.0), n);
            const double expected = (1.0 - R) / (1.0 + R);
            const TraceScene slab = built(test::slab(glass(n, false), test::lowerSky(1.0f)));
            EXPECT_NEAR(lookedAt(slab, pitch, 16384), expected, 4e-3) << n << " " << pitch;
            // A thin wall is both faces at once.
            const TraceScene wall = built(test::sheet(glass(n, true), test::lowerSky(1.0f)));
            EXPECT_NEAR(lookedAt(wall, pitch, 8192), expected, 4e-3) << n << " " << pitch;
        }
}

TEST(Glass, ABodyAbsorbsByBeerAndLambert) {
    Material material = glass(1.5f, false);
    material.attenuationColor = {0.5f, 0.25f, 0.9f};
    material.attenuationDistance = 0.3f;
    const TraceScene slab = built(test::slab(material, test::lowerSky(1.0f)));
    Film::Pixel pixel;
    lookedAt(slab, 88.9f, 16384, &pixel);
    const double R = test::fresnel(1.0, 1.5);
    for (int c = 0; c < 3; ++c) {
        const double a = std::pow(material.attenuationColor[c], test::kSlabThickness / 0.3);
        const double expected = (1.0 - R) * (1.0 - R) * a / (1.0 - R * R * a * a);
        EXPECT_NEAR(pixel.sum[c] / pixel.samples, expected, 5e-3) << c;
    }
    // Without refraction the way through the slab alone counts.
    material.ior = 1.0f;
    const TraceScene fog = built(test::slab(material, test::lowerSky(1.0f)));
    Film::Pixel slanted;
    lookedAt(fog, 30.0f, 64, &slanted);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(slanted.sum[c] / slanted.samples,
                    std::pow(material.attenuationColor[c], 2.0 * test::kSlabThickness / 0.3), 2e-3);
}

// Concentric spheres: Bouguer's formula, n r sin(angle) stays as it is.
TEST(Glass, AHollowSphereBendsLightAsItsShellSays) {
    constexpr float kInner = 0.8f, kIndex = 1.5f;
    const TraceScene scene = built(test::hollowSphere(glass(kIndex, false), kInner, 192));
    for (const float b : {0.2f, 0.45f, 0.7f}) {
        glm::vec3 origin(b, 0.0f, 4.0f), direction(0.0f, 0.0f, -1.0f);
        Media media;
        int surfaces = 0;
        for (; surfaces < 16; ++surfaces) {
            const ClosestRay hit = scene.closest(origin, direction);
            if (hit.mesh == ClosestRay::kNothing)
                break;
            const TracePoint point = scene.pointAt(hit);
            const TraceSurface surface = scene.surfaceIn(point, -direction, media);
            const GlassSample on = sampleGlass(surface.glass, {0.5f, 0.5f, 1.0f - 0x1p-24f});
            ASSERT_TRUE(on.through);
            media.cross(point, surface.ior);
            origin = TraceScene::origin(point, true);
            direction = on.direction;
        }
        EXPECT_EQ(surfaces, 4);
        EXPECT_EQ(media.innermost(), Media::Medium());
        const double turned = 2.0 * (std::asin(b) - std::asin(b / kIndex) +
                                     std::asin(b / (kIndex * kInner)) - std::asin(b / kInner));
        EXPECT_NEAR(std::atan2(-direction.x, -direction.z), turned, 3e-3) << b;
    }
}

TEST(Glass, NothingIsLostInAFurnace) {
    std::vector<std::pair<std::string, TraceInputs>> scenes;
    scenes.emplace_back("ball", test::hollowSphere(glass(1.5f, false), 0.0f, 48));
    scenes.emplace_back("dense ball", test::hollowSphere(glass(3.0f, false), 0.0f, 48));
    scenes.emplace_back("hollow", test::hollowSphere(glass(1.5f, false), 0.85f, 48));
    for (const float roughness : {0.2f, 0.6f, 1.0f}) {
        Material body = glass(1.5f, false);
        body.perceptualRoughness = roughness;
        scenes.emplace_back("rough ball " + std::to_string(roughness),
                            test::hollowSphere(body, 0.0f, 48));
        scenes.emplace_back("rough slab " + std::to_string(roughness),
                            test::slab(body, {test::uniformSky(1.0f), 0.0f, glm::vec3(1.0f)}));
    }
    for (const float roughness : {0.0f, 0.5f, 1.0f}) {
        Material wall = glass(1.5f, true);
        wall.perceptualRoughness = roughness;
        scenes.emplace_back("bubble " + std::to_string(roughness),
                            test::hollowSphere(wall, 0.0f, 48));
        // Half of it is a white diffuse body.
        wall.transmission = 0.5f;
        scenes.emplace_back("milky bubble " + std::to_string(roughness),
                            test::hollowSphere(wall, 0.0f, 48));
    }
    Material byMap = glass(1.5f, false); // its number says metal, its map glass
    byMap.metallic = 1.0f;
    byMap.metallicMap.image =
        std::make_shared<const Image>(Image(1, 1, 1, PixelType::U8, ColorEncoding::Data));
    scenes.emplace_back("ball by its map", test::hollowSphere(byMap, 0.0f, 48));
    for (const auto& [name, inputs] : scenes) {
        Film film(12, 12);
        TraceView view;
        view.width = view.height = 12;
        view.camera.distance = 3.6f;
        ASSERT_TRUE(tracePaths(built(inputs), view, {}, film, 0, 500, {}).ok());
        double sum = 0.0;
        for (const Film::Pixel& pixel : film.pixels())
            sum += pixel.luminance() / static_cast<double>(film.pixels().size());
        // Light is long in rough bodies, where each face has the error of a table.
        EXPECT_NEAR(sum, 1.0, name.starts_with("rough") ? 0.015 : 0.008) << name;
    }
}

// Inside a body radiance is n² times that outside, wherever light from outside gets to.
TEST(Glass, RadianceInsideABodyIsThatOfItsIndexSquared) {
    for (const float n : {1.33f, 1.5f, 2.0f}) {
        const TraceScene ball = built(test::hollowSphere(glass(n, false), 0.0f, 48));
        for (const float distance : {1e-3f, 0.4f}) { // no ray from there is trapped
            TraceView view;
            view.width = view.height = 8;
            view.camera.distance = distance;
            view.camera.fovDeg = 90.0f;
            Film film(8, 8);
            ASSERT_TRUE(tracePaths(ball, view, {}, film, 0, 128, {}).ok());
            double sum = 0.0;
            for (const Film::Pixel& pixel : film.pixels())
                sum += pixel.luminance() / 64.0;
            EXPECT_NEAR(sum, n * n, 6e-3 * n * n) << n << " " << distance;
        }
    }
}

TEST(Glass, OfTheIndexOfAirCannotBeSeen) {
    for (const float roughness : {0.0f, 1.0f})
        for (const bool thinWalled : {false, true}) {
            Material air = glass(1.0f, thinWalled);
            air.perceptualRoughness = thinWalled ? 0.0f : roughness;
            TraceInputs inputs = test::hollowSphere(air, 0.0f, 24);
            inputs.environments = {test::checkeredSky()};
            const TraceScene with = built(inputs);
            inputs.meshes.clear();
            const TraceScene without = built(inputs);
            TraceView view;
            view.width = view.height = 16;
            view.camera.distance = 3.0f;
            Film seen(16, 16), bare(16, 16);
            ASSERT_TRUE(tracePaths(with, view, {}, seen, 0, 4, {}).ok());
            ASSERT_TRUE(tracePaths(without, view, {}, bare, 0, 4, {}).ok());
            for (std::size_t i = 0; i < seen.pixels().size(); ++i)
                EXPECT_EQ(seen.pixels()[i].sum, bare.pixels()[i].sum);
            // Nor does it cast a shadow.
            Film::Pixel shaded, open;
            traceIrradiance(with, {0.0, -1.5, 0.0}, {0, 1, 0}, {}, 4096, shaded);
            traceIrradiance(without, {0.0, -1.5, 0.0}, {0, 1, 0}, {}, 4096, open);
            EXPECT_NEAR(shaded.luminance(), open.luminance(), 2e-3 * open.luminance());
        }
}

TEST(Glass, LightThroughAWindowIsTheSameByEitherSearch) {
    for (const float roughness : {0.0f, 0.35f}) {
        Material pane = glass(1.5f, true);
        pane.baseColor = {0.9f, 0.6f, 0.3f};
        pane.perceptualRoughness = roughness;
        TraceInputs inputs = test::sheet(pane, test::checkeredSky());
        Light light;
        light.type = LightType::Sphere;
        light.position = {0.4f, 1.2f, 0.2f};
        light.radius = 0.3f;
        light.intensity = 3.0f;
        inputs.lights = {light};
        const TraceScene scene = built(inputs);
        std::vector<glm::dvec3> means;
        for (const LightSearch search :
             {LightSearch::Both, LightSearch::Lights, LightSearch::Surfaces}) {
            PathSettings settings;
            settings.search = search;
            Film::Pixel pixel;
            // Rays to lights seldom go where rough glass bends light to: one standard error of
            // 65,536 of them is 2.6 %.
            const std::uint32_t count = search == LightSearch::Lights ? 1 << 19 : 1 << 16;
            traceIrradiance(scene, {0.0, -0.5, 0.0}, {0, 1, 0}, settings, count, pixel);
            means.push_back(pixel.sum / static_cast<double>(pixel.samples));
        }
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(means[1][c], means[0][c], 0.03 * means[0][c]) << roughness;
            EXPECT_NEAR(means[2][c], means[0][c], 0.03 * means[0][c]) << roughness;
        }
    }
}

TEST(Glass, APointShinesThroughAWindowButNotThroughABody) {
    Light light;
    light.type = LightType::Point;
    light.position = {0.4f, 1.2f, 0.2f};
    light.intensity = 3.0f;
    Material pane = glass(1.5f, true);
    pane.baseColor = {0.9f, 0.6f, 0.3f};
    for (const bool thinWalled : {true, false}) {
        pane.thinWalled = thinWalled;
        TraceInputs inputs = test::sheet(pane, test::checkeredSky());
        inputs.environments.clear();
        inputs.lights = {light};
        Film::Pixel pixel; // 2 m below the light
        traceIrradiance(built(inputs), {0.4, -0.8, 0.2}, {0, 1, 0}, {}, 64, pixel);
        const double R = test::fresnel(1.0, 1.5);
        for (int c = 0; c < 3; ++c) {
            const double straight = pane.baseColor[c] * (1.0 - R) / (1.0 + R) * 3.0 / 4.0;
            EXPECT_NEAR(pixel.sum[c] / pixel.samples, thinWalled ? straight : 0.0, 2e-3);
        }
    }
}

TEST(Glass, SaysWhichLightsNoPathCanFindThroughIt) {
    for (const bool thinWalled : {true, false})
        for (const LightType type : {LightType::Point, LightType::Directional, LightType::Sphere}) {
            TraceInputs inputs = test::sheet(glass(1.5f, thinWalled), test::checkeredSky());
            EXPECT_FALSE(built(inputs).limit());
            Light light;
            light.type = type;
            light.radius = 0.1f;
            light.shadowSoftness = 0.0f;
            inputs.lights = {light};
            EXPECT_EQ(built(inputs).limit().has_value(), !thinWalled && type != LightType::Sphere);
            inputs.materials[0].transmission = 0.0f;
            EXPECT_FALSE(built(inputs).limit());
        }
}

TEST(Glass, LeavesNoPixelWithoutANumber) {
    for (const float roughness : {0.0f, 0.046f, 1.0f})
        for (const float n : {1.0f, 1.0005f, 1.001f, 3.0f})
            for (const bool thinWalled : {false, true}) {
                Material m = glass(n, thinWalled);
                m.perceptualRoughness = roughness;
                m.transmission = roughness > 0.0f ? 0.4f : 1.0f; // of a mixture, too
                m.attenuationColor = {0.0f, 0.5f, 1.0f};
                m.attenuationDistance = 0.1f;
                // A closed body, and one that is only entered.
                for (const TraceInputs& inputs :
                     {test::hollowSphere(m, 0.5f, 16), test::sheet(m, test::checkeredSky())}) {
                    TraceView view;
                    view.width = view.height = 8;
                    view.camera.distance = 2.0f;
                    Film film(8, 8);
                    ASSERT_TRUE(tracePaths(built(inputs), view, {}, film, 0, 16, {}).ok());
                    EXPECT_EQ(film.invalid(), 0u) << roughness << " " << n;
                    for (const Film::Pixel& pixel : film.pixels())
                        EXPECT_GE(std::min({pixel.sum.x, pixel.sum.y, pixel.sum.z}), 0.0);
                }
            }
}

// A caustic: light that a ball gathers below itself, against photons that are sent from the lamp.
TEST(Glass, ACausticHasTheFluxOfPhotons) {
    const test::CausticScene caustic;
    const TraceScene scene = built(caustic.inputs());
    const double photons = caustic.photonFlux(3000000);
    // The disc's flux is the mean of its points' irradiance over its area.
    constexpr std::uint32_t kPoints = 3000, kSamples = 40;
    double sum = 0.0, squares = 0.0;
    for (std::uint32_t i = 0; i < kPoints; ++i) {
        const glm::vec2 at = shading::concentricDisc(sobolOwen2D(i, 11));
        PathSettings settings;
        settings.seed = seedFor(5, i);
        Film::Pixel pixel;
        traceIrradiance(scene, {caustic.discRadius * at.x, 0.0, caustic.discRadius * at.y},
                        {0, 1, 0}, settings, kSamples, pixel);
        const double mean = pixel.sum.y / pixel.samples;
        sum += mean / kPoints;
        squares += mean * mean / kPoints;
    }
    const double area = pi * caustic.discRadius * caustic.discRadius;
    EXPECT_NEAR(sum * area, photons, 0.02 * photons);
    EXPECT_LT(std::sqrt((squares - sum * sum) / kPoints), 0.005 * sum) << "is known to .5 %";
}

} // namespace patina
