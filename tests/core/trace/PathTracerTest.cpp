// Pictures by paths against exact values.
#include "core/trace/path/PathTracer.h"

#include "core/job/Parallel.h"
#include "core/light/DfgTable.h"
#include "core/math/Sampling.h"
#include "tests/core/trace/CornellScene.h"
#include "tests/core/trace/TraceBall.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <numbers>
#include <string>
#include <vector>

namespace patina {

using test::ball;
using test::ballUnderSky;
using test::uniformSky;

namespace {

TraceScene sceneOf(const TraceInputs& inputs) {
    Result<TraceScene> scene = TraceScene::build(inputs, {});
    EXPECT_TRUE(scene.ok()) << (scene.ok() ? std::string() : scene.error().text());
    return *std::move(scene);
}

Film traced(const TraceScene& scene, const TraceView& view, std::uint32_t samples,
            const PathSettings& settings = {}) {
    Film film(view.width, view.height);
    EXPECT_TRUE(tracePaths(scene, view, settings, film, 0, samples, {}).ok());
    return film;
}

TraceView lookAtBall(int size, float distance = 3.4f) {
    TraceView view;
    view.width = view.height = size;
    view.camera.distance = distance;
    return view;
}

} // namespace

// 132 numbers, each within 4 standard errors, its own and that of the truth. What is smaller than
// that, down to one percent, test_trace_bias finds in pictures.
TEST(PathTracer, CornellBoxHasItsIrradiance) {
    constexpr std::uint32_t kBatches = 48;
    for (const bool blocks : {false, true})
        for (std::size_t set = 0; set < test::kCornellWalls.size(); ++set) {
            const TraceScene scene = sceneOf(test::cornellBox(test::kCornellWalls[set], blocks));
            std::vector<library::CornellPoint> points;
            for (const library::CornellPoint& point : library::cornellPoints())
                if (point.blocks == blocks)
                    points.push_back(point);
            // Where the lamp does not shine light comes from small bright places.
            const auto samplesOf = [](const library::CornellPoint& point) {
                return point.direct > 0.0 ? 768u : 4096u;
            };
            std::vector<Film::Pixel> found(points.size() * kBatches);
            parallelFor({}, found.size(), 1, [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) {
                    const library::CornellPoint& point = points[i / kBatches];
                    PathSettings settings;
                    settings.seed = seedFor(7, static_cast<std::uint32_t>(i));
                    traceIrradiance(scene, point.position / 1000.0, point.normal, settings,
                                    samplesOf(point), found[i]);
                }
            });
            for (std::size_t p = 0; p < points.size(); ++p)
                for (int c = 0; c < 3; ++c) {
                    double sum = 0.0, squares = 0.0;
                    for (std::uint32_t b = 0; b < kBatches; ++b) {
                        const double mean = found[p * kBatches + b].sum[c] / samplesOf(points[p]);
                        sum += mean;
                        squares += mean * mean;
                    }
                    const double mean = sum / kBatches;
                    const double error =
                        std::sqrt((squares / kBatches - mean * mean) / (kBatches - 1));
                    const auto channel = 3 * set + static_cast<std::size_t>(c);
                    const double truth = points[p].irradiance(channel);
                    const double truthError = points[p].standardError(channel);
                    EXPECT_NEAR(mean, truth, 4.0 * std::hypot(error, truthError))
                        << points[p].name << (blocks ? ", blocks" : "") << ", channel " << channel;
                    EXPECT_LT(error, 0.007 * truth) << points[p].name;
                }
        }
}

// In light from all sides a white surface that loses nothing cannot be told from its surroundings,
// and any other shows its albedo.
TEST(PathTracer, WhiteFurnace) {
    constexpr int kSize = 16;
    for (const float metallic : {0.0f, 0.3f, 1.0f})
        for (const float roughness : {0.0f, 0.2f, 0.5f, 0.8f, 1.0f}) {
            Material material;
            material.baseColor = glm::vec3(1.0f);
            material.metallic = metallic;
            material.perceptualRoughness = roughness;
            const TraceScene scene = sceneOf(ballUnderSky(material));
            TraceView view = lookAtBall(kSize);
            view.transparent = true;
            if (metallic == 0.3f)
                view.camera.fovDeg = 1.0f; // N·V is 1 all over
            const Image picture = traced(scene, view, 512).radiance(true);
            double sum = 0.0, weight = 0.0;
            for (int y = 0; y < kSize; ++y)
                for (int x = 0; x < kSize; ++x) {
                    if (picture.sample(x, y, 3) < 1.0f)
                        continue;
                    sum += static_cast<double>(picture.sample(x, y, 1));
                    weight += 1.0;
                }
            ASSERT_GT(weight, 60.0);
            double expected = 1.0;
            if (metallic == 0.3f) { // Turquin 2019, equation 16, under core/light/DfgTable.h
                const double f0 = 0.04 + 0.3 * 0.96;
                const glm::dvec3 dfg = integrateDfg(1.0f, std::max(roughness, 0.045f));
                const double E = dfg.x + dfg.y;
                const double specular = (f0 * dfg.x + dfg.y) * (1.0 + f0 * (1.0 / E - 1.0));
                expected = specular + (1.0 - specular) * 0.7;
            }
            EXPECT_NEAR(sum / weight, expected, 0.002)
                << "metallic " << metallic << ", roughness " << roughness;
        }
}

// A closed sphere from inside: E0 / (1 - rho) (ground truth furnace.closed_sphere: the geometric
// series), and its first terms where bounces are counted.
TEST(PathTracer, ClosedSphereByBounces) {
    TraceInputs inputs;
    inputs.model.fresnel = Fresnel::Dielectric;
    inputs.model.ior = 1.0f;
    Material& wall = inputs.materials.emplace_back();
    wall.emissive = glm::vec3(1.0f);
    wall.doubleSided = true;
    inputs.meshes = {{1, ball(48), glm::mat4(1.0f), 0}};
    for (const float rho : {0.18f, 0.5f, 0.8f}) {
        inputs.materials[0].baseColor = glm::vec3(rho);
        const TraceScene scene = sceneOf(inputs);
        double expected = 1.0, power = 1.0;
        for (int bounces = 0; bounces <= 4; ++bounces) {
            expected += power *= static_cast<double>(rho);
            const bool endless = bounces == 4;
            if (endless)
                expected = 1.0 / (1.0 - static_cast<double>(rho));
            TraceView view = lookAtBall(8, 0.01f);
            PathSettings settings;
            if (!endless)
                settings.maxBounces = bounces;
            const Film film = traced(scene, view, 256, settings);
            double sum = 0.0;
            for (int y = 0; y < 8; ++y)
                for (int x = 0; x < 8; ++x)
                    sum += film.at(x, y).sum.y / film.at(x, y).samples / 64.0;
            EXPECT_NEAR(sum, expected, 0.005 * expected) << "rho " << rho << ", " << bounces;
        }
    }
}

TEST(PathTracer, SameNumbersForAnyThreadsAndInAnyPieces) {
    const TraceScene scene = sceneOf(test::cornellBox(test::kCornellWalls[0], true));
    TraceView view;
    view.width = 40;
    view.height = 24;
    view.camera = {{0.278f, 0.273f, 0.28f}, 180.0f, 0.0f, 1.08f, 39.3f, {}};
    const Film whole = traced(scene, view, 8);
    EXPECT_GT(whole.at(20, 12).sum.y, 0.0);
    for (const int threads : {1, 2, 7}) {
        const ThreadLimit limit(threads);
        EXPECT_TRUE(traced(scene, view, 8) == whole) << threads;
    }
    Film pieces(view.width, view.height);
    for (const std::uint32_t first : {0u, 3u, 4u})
        ASSERT_TRUE(tracePaths(scene, view, {}, pieces, first,
                               first == 0   ? 3
                               : first == 3 ? 1
                                            : 4,
                               {})
                        .ok());
    EXPECT_TRUE(pieces == whole);
}

TEST(PathTracer, NothingThereIsTheSky) {
    TraceInputs inputs;
    inputs.environments = {{uniformSky(2.0f), 0.0f, glm::vec3(0.5f, 1.0f, 1.5f)}};
    const TraceScene scene = sceneOf(inputs);
    TraceView view = lookAtBall(4);
    const Image sky = traced(scene, view, 2).radiance(true);
    EXPECT_FLOAT_EQ(sky.sample(1, 2, 0), 1.0f);
    EXPECT_FLOAT_EQ(sky.sample(1, 2, 2), 3.0f);
    EXPECT_EQ(sky.sample(1, 2, 3), 1.0f);
    view.transparent = true;
    const Image nothing = traced(scene, view, 2).radiance(true);
    EXPECT_EQ(nothing.sample(1, 2, 0), 0.0f);
    EXPECT_EQ(nothing.sample(1, 2, 3), 0.0f);
    view.transparent = false;
    view.background = [](const glm::vec3&) { return glm::vec3(0.25f); };
    EXPECT_FLOAT_EQ(traced(scene, view, 2).radiance().sample(1, 2, 0), 0.25f);
    inputs.environments.clear();
    EXPECT_EQ(traced(sceneOf(inputs), lookAtBall(4), 2).radiance().sample(1, 2, 0), 0.0f);
}

// What a light gives a surface, in closed form (core/light/Lights.h).
TEST(PathTracer, LightsGiveTheirIlluminance) {
    for (const LightType type : {LightType::Point, LightType::Spot, LightType::Directional,
                                 LightType::Sphere, LightType::Rectangle}) {
        Light light;
        light.type = type;
        light.intensity = 3.0f;
        light.position = {0.0f, 2.0f, 0.0f};
        light.azimuthDeg = 0.0f;
        light.elevationDeg = 90.0f;
        TraceInputs inputs;
        inputs.lights = {light};
        const TraceScene scene = sceneOf(inputs);
        // Of a rectangle by rows: pi L F.
        float expected = 3.0f;
        if (type == LightType::Point || type == LightType::Spot)
            expected = 3.0f / 4.0f;
        if (type == LightType::Sphere)
            expected = 3.0f * shading::kPi * shading::sphereFormFactor(1.0f, 0.25f * 0.25f / 4.0f);
        if (type == LightType::Rectangle)
            expected = 3.0f * shading::kPi *
                       shading::quadFormFactor({-.5f, -.5f, 2}, {.5f, -.5f, 2}, {.5f, .5f, 2},
                                               {-.5f, .5f, 2});
        Film::Pixel pixel;
        traceIrradiance(scene, glm::dvec3(0.0), {0, 1, 0}, {}, 4096, pixel);
        EXPECT_NEAR(pixel.sum.y / 4096.0, static_cast<double>(expected),
                    2e-3 * static_cast<double>(expected))
            << static_cast<int>(type);
    }
}

// Over pictures of other seeds: the error that the film states is not less than the one that they
// have, and less than that of independent samples.
TEST(PathTracer, StatesTheErrorThatItHas) {
    const TraceScene scene = sceneOf(test::cornellBox(test::kCornellWalls[0], true));
    TraceView view;
    view.width = 40;
    view.height = 24;
    view.camera = {{0.278f, 0.273f, 0.28f}, 180.0f, 0.0f, 1.08f, 39.3f, {}};
    constexpr int kSeeds = 24;
    for (const std::uint32_t samples : {15u, 31u, 64u}) {
        std::vector<Film> films;
        double stated = 0.0, independent = 0.0;
        for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
            PathSettings settings;
            settings.seed = 100 + seed;
            films.push_back(traced(scene, view, samples, settings));
            for (const Film::Pixel& pixel : films.back().pixels()) {
                stated += pixel.halvesVariance() / kSeeds;
                independent += pixel.variance() / kSeeds;
            }
        }
        double variance = 0.0;
        for (std::size_t i = 0; i < films[0].pixels().size(); ++i) {
            double sum = 0.0, squares = 0.0;
            for (const Film& film : films) {
                const double value = film.pixels()[i].luminance();
                sum += value;
                squares += value * value;
            }
            variance += (squares - sum * sum / kSeeds) / (kSeeds - 1);
        }
        EXPECT_GT(std::sqrt(stated / variance), 0.9) << samples;
        EXPECT_LT(std::sqrt(stated / independent), 0.9) << samples;
    }
}

TEST(Film, NoiseIsHowFarTheHalvesAreApart) {
    Film film(2, 1);
    EXPECT_FALSE(film.noise().has_value());
    // The first 64 of 100 samples are 1, the others 3.
    for (int i = 0; i < 100; ++i) {
        film.at(0, 0).add(glm::vec3(i < 64 ? 1.0f : 3.0f), 1.0f);
        film.at(1, 0).add(glm::vec3(2.0f), 1.0f);
    }
    EXPECT_NEAR(film.at(0, 0).firstSum, 64.0f, 1e-4f);
    EXPECT_NEAR(film.at(0, 0).halvesVariance(), 4.0 * 64 * 36 / 1e4, 1e-5);
    const double mean = (1.72 + 2.0) / 2.0;
    ASSERT_TRUE(film.noise().has_value());
    EXPECT_NEAR(*film.noise(), std::sqrt(4.0 * 64 * 36 / 1e4 / 2.0) / mean, 1e-5);
    // As of independent samples.
    EXPECT_NEAR(film.at(0, 0).variance(), 4.0 * .64 * .36 / 99.0, 1e-6);
    EXPECT_NEAR(film.at(1, 0).variance(), 0.0, 1e-6);
    film.at(0, 0).add(glm::vec3(std::nanf("")), 1.0f);
    EXPECT_EQ(film.invalid(), 1u);
    EXPECT_EQ(film.leastSamples(), 100u) << "one pixel has 101";
    EXPECT_TRUE(std::isfinite(film.radiance().sample(0, 0, 0)));
}

} // namespace patina
