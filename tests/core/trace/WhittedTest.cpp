// The classical ray tracer and its trees against closed forms.
#include "core/trace/whitted/WhittedTracer.h"

#include "core/job/Parallel.h"
#include "tests/core/trace/TraceBall.h"
#include "tests/core/trace/WhittedScenes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

namespace patina {

using test::floorMesh;
using test::floorUnderPoint;
using test::fromAbove;
using test::mirror;
using test::ofKind;
using test::ofVariedScene;
using test::variedScene;
using test::viewFrom;
using test::whitted;
using test::whittedScene;

// Lambert's law: albedo/π I cos/d² at each place that a ray of the camera meets.
TEST(Whitted, PointLightOnAFloorIsTheClosedForm) {
    const TraceInputs inputs = floorUnderPoint();
    const TraceScene scene = whittedScene(inputs);
    const TraceView view = fromAbove();
    const Light& light = inputs.lights[0];
    for (const LocalModel model : {LocalModel::Patina, LocalModel::Whitted1980}) {
        WhittedSettings settings;
        settings.model = model;
        const RayTree tree = traceRayTree(scene, view, settings, 7, 9, 1);
        const std::vector<RayNode> shadows = ofKind(tree, RayKind::Shadow);
        ASSERT_GE(shadows.size(), 4u);
        for (const RayNode& node : shadows) {
            const RayNode& seen = tree.nodes()[static_cast<std::size_t>(node.parent)];
            const glm::dvec3 to = glm::dvec3(light.position) - glm::dvec3(seen.position);
            const double distance = glm::length(to), cosine = to.y / distance;
            EXPECT_EQ(node.end, RayEnd::Lit);
            EXPECT_EQ(node.light, light.id);
            EXPECT_NEAR(node.distance, distance, 1e-4);
            for (int c = 0; c < 3; ++c) {
                const double albedo = static_cast<double>(inputs.materials[0].baseColor[c]);
                const double expected = albedo / std::numbers::pi *
                                        static_cast<double>(light.intensity) * cosine /
                                        (distance * distance);
                EXPECT_NEAR(node.contribution[c], expected, 2e-4 * expected);
            }
        }
    }
}

// And so what paths find straight from the light, over the whole picture.
TEST(Whitted, PointLightOnAFloorIsThatOfPaths) {
    const TraceScene scene = whittedScene(floorUnderPoint());
    const TraceView view = fromAbove();
    WhittedSettings settings;
    settings.contrast = 0.0f;
    settings.subdivisions = 4;
    const Film classical = whitted(scene, view, settings);
    Film paths(view.width, view.height);
    PathSettings direct;
    direct.maxBounces = 0;
    ASSERT_TRUE(tracePaths(scene, view, direct, paths, 0, 1024, {}).ok());
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const double expected = paths.at(x, y).luminance();
            EXPECT_NEAR(classical.at(x, y).luminance(), expected, 0.01 * expected + 2e-3)
                << x << " " << y;
        }
}

// Lights with extent give from their centre what they give a surface that faces it.
TEST(Whitted, AreaLightsCountByTheirCentre) {
    TraceInputs inputs = floorUnderPoint();
    for (const LightType type : {LightType::Sphere, LightType::Rectangle}) {
        Light& light = inputs.lights[0];
        light.type = type;
        light.position = {0.0f, 1.5f, 0.0f};
        light.azimuthDeg = 0.0f;
        light.elevationDeg = 90.0f;
        light.radius = 0.1f;
        light.width = light.height = 0.2f;
        const TraceScene scene = whittedScene(inputs);
        TraceView view = fromAbove();
        view.camera.pitchDeg = 89.0f;
        const RayTree tree = traceRayTree(scene, view, {}, 8, 8, 1);
        const RayNode shadow = ofKind(tree, RayKind::Shadow).front();
        const glm::vec3 seen = tree.nodes()[static_cast<std::size_t>(shadow.parent)].position;
        const glm::dvec3 to = glm::dvec3(light.position) - glm::dvec3(seen);
        const double d2 = glm::dot(to, to), cosine = to.y / std::sqrt(d2);
        const double area = type == LightType::Sphere ? std::numbers::pi * 0.01 : 0.04 * cosine;
        const double irradiance = static_cast<double>(light.intensity) * area / d2;
        EXPECT_NEAR(shadow.contribution.x, 0.6 / std::numbers::pi * irradiance * cosine,
                    0.01 * shadow.contribution.x);
    }
}

// A mesh that gives off light is one light: a flat one a disc on its axis, a ball what it shows.
TEST(Whitted, EmissiveMeshesCountByTheirCentroid) {
    for (const bool flat : {true, false}) {
        TraceInputs inputs = floorUnderPoint();
        inputs.lights.clear();
        Material glow;
        glow.emissive = {4.0f, 2.0f, 1.0f};
        inputs.materials.push_back(glow);
        glm::mat4 above(0.1f);
        if (flat) // facing down
            above[1].y = above[2].z = -0.1f;
        above[3] = {0.0f, 1.0f, 0.0f, 1.0f};
        inputs.meshes.push_back({2, flat ? floorMesh() : test::ball(48), above, 1});
        const TraceScene scene = whittedScene(inputs);
        TraceView view = fromAbove();
        view.camera.distance = 0.5f;
        const RayTree tree = traceRayTree(scene, view, {}, 3, 8, 1);
        const std::vector<RayNode> shadows = ofKind(tree, RayKind::Shadow);
        EXPECT_EQ(shadows.size(), tree.sampleCount());
        for (const RayNode& node : shadows) {
            const RayNode& seen = tree.nodes()[static_cast<std::size_t>(node.parent)];
            EXPECT_EQ(node.glowing, 2u);
            EXPECT_EQ(node.end, RayEnd::Lit);
            const glm::dvec3 to = glm::dvec3(0.0, 1.0, 0.0) - glm::dvec3(seen.position);
            const double d2 = glm::dot(to, to), cosine = to.y / std::sqrt(d2);
            const double shown = flat ? 0.16 * cosine / (d2 + 0.16 / std::numbers::pi)
                                      : std::numbers::pi * 0.01 / d2;
            const double expected = 4.0 * shown * cosine * 0.6 / std::numbers::pi;
            EXPECT_NEAR(node.contribution.x, expected, 2e-3 * expected);
        }
    }
}

TEST(Whitted, AThingBetweenCastsAHardShadow) {
    TraceInputs inputs = floorUnderPoint();
    inputs.lights[0].position = {0.0f, 3.0f, 0.0f};
    glm::mat4 small(0.2f);
    small[3] = {0.0f, 1.5f, 0.0f, 1.0f};
    inputs.meshes.push_back({2, test::ball(16), small, 0});
    const TraceScene scene = whittedScene(inputs);
    TraceView view = fromAbove();
    view.camera.distance = 1.2f; // below the ball
    view.camera.pitchDeg = 20.0f;
    int blocked = 0, lit = 0;
    for (int y = 0; y < view.height; ++y) {
        const RayTree tree = traceRayTree(scene, view, {}, 8, y, 1);
        for (const RayNode& node : tree.nodes()) {
            if (node.kind != RayKind::Shadow || node.end == RayEnd::Facing)
                continue;
            // The shadow of a ball half way up is a disc of twice its size, and a little more:
            // rays to a point open as a cone.
            const float aside = glm::length(glm::vec2(node.origin.x, node.origin.z));
            if (node.end == RayEnd::Blocked) {
                ++blocked;
                EXPECT_LT(aside, 0.41f);
                EXPECT_EQ(node.mesh, 2u);
                EXPECT_EQ(node.contribution, glm::vec3(0.0f));
            } else {
                ++lit;
                EXPECT_GT(aside, 0.39f);
            }
        }
    }
    EXPECT_GT(blocked, 10);
    EXPECT_GT(lit, 10);
}

// A metal ball shows the sky where the law of reflection says.
TEST(Whitted, AMirrorBallReflectsTheSky) {
    TraceInputs inputs = test::ballUnderSky(mirror(0.9f));
    Image sky(64, 32, 3, PixelType::F32, ColorEncoding::Linear);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x)
            for (int c = 0; c < 3; ++c)
                sky.f32()[static_cast<std::size_t>((y * 64 + x) * 3 + c)] =
                    1.0f + 0.5f * static_cast<float>(std::sin(0.2 * x + c) * std::cos(0.1 * y));
    inputs.environments = {{std::make_shared<const Image>(sky), 0.0f, glm::vec3(1.0f)}};
    const TraceScene scene = whittedScene(inputs);
    const RayTree tree = traceRayTree(scene, viewFrom(3.4f), {}, 6, 5, 1);
    const std::vector<RayNode> reflected = ofKind(tree, RayKind::Reflected);
    ASSERT_GE(reflected.size(), 4u);
    for (const RayNode& node : reflected) {
        const RayNode& from = tree.nodes()[static_cast<std::size_t>(node.parent)];
        EXPECT_EQ(node.end, RayEnd::Missed);
        EXPECT_LT(glm::length(node.direction - glm::reflect(from.direction, from.normal)), 1e-6f);
        EXPECT_LT(glm::length(from.normal - glm::normalize(from.position)), 2e-3f);
        // Schlick's reflectance of a metal of 0.9; the table's rounding.
        const float cosine = -glm::dot(from.direction, from.normal);
        const float fresnel = 0.9f + 0.1f * std::pow(1.0f - cosine, 5.0f);
        EXPECT_NEAR(node.weight.x, fresnel, 3e-3f);
        EXPECT_EQ(node.contribution, node.weight * scene.environmentRadiance(node.direction));
    }
}

TEST(Whitted, TheSumOfATreeIsTheFilmToTheLastBit) {
    const TraceScene scene = whittedScene(variedScene());
    const TraceView view = ofVariedScene();
    std::map<RayEnd, int> ends;
    for (const LocalModel model : {LocalModel::Patina, LocalModel::Whitted1980})
        for (const bool stochastic : {false, true}) {
            WhittedSettings settings;
            settings.model = model;
            settings.softShadows = settings.gloss = stochastic;
            const std::uint32_t samples = stochastic ? 5 : 1;
            const Film film = whitted(scene, view, settings, samples);
            const Image image = film.radiance();
            for (int y = 0; y < view.height; y += 3)
                for (int x = 0; x < view.width; ++x) {
                    const RayTree tree = traceRayTree(scene, view, settings, x, y, samples);
                    const glm::vec3 sum = tree.radiance();
                    const float* pixel =
                        image.f32().data() +
                        std::size_t{3} * static_cast<std::size_t>(y * view.width + x);
                    ASSERT_EQ(sum, glm::vec3(pixel[0], pixel[1], pixel[2])) << x << " " << y;
                    for (const RayNode& node : tree.nodes())
                        ++ends[node.end];
                    // The roots hold everything.
                    glm::vec3 roots(0.0f);
                    const std::vector<glm::vec3> subtotals = tree.subtotals();
                    for (std::size_t i = 0; i < subtotals.size(); ++i)
                        if (tree.nodes()[i].parent == RayNode::kNone)
                            roots += subtotals[i];
                    EXPECT_LT(glm::length(roots - sum), 1e-5f * glm::length(sum) + 1e-6f);
                }
        }
    for (const RayEnd end :
         {RayEnd::Continues, RayEnd::Missed, RayEnd::NotReflecting, RayEnd::Emissive, RayEnd::Lit,
          RayEnd::Blocked, RayEnd::Facing, RayEnd::NoShadow})
        EXPECT_GT(ends[end], 0) << rayEndInfo(end).text;
}

// What a node adds is what the terms that it is told with make: the equation of the paper.
TEST(Whitted, TheTermsOfANodeMakeWhatItAdds) {
    const TraceScene scene = whittedScene(variedScene());
    const TraceView view = ofVariedScene();
    std::map<RayKind, int> kinds;
    for (const LocalModel model : {LocalModel::Patina, LocalModel::Whitted1980}) {
        WhittedSettings settings;
        settings.model = model;
        for (int y = 0; y < view.height; y += 3)
            for (int x = 0; x < view.width; ++x) {
                const RayTree tree = traceRayTree(scene, view, settings, x, y, 1);
                for (const RayNode& node : tree.nodes()) {
                    const RayTerms& terms = node.terms;
                    glm::vec3 expected = node.contribution;
                    if (node.end == RayEnd::Lit || node.end == RayEnd::NoShadow)
                        expected = node.weight * node.passes * terms.arriving *
                                   (terms.diffuse + terms.specular);
                    else if (node.kind != RayKind::Shadow && node.hit && node.end != RayEnd::Back)
                        expected =
                            node.weight * (terms.emission + terms.ambientLight * terms.ambient);
                    EXPECT_LT(glm::distance(node.contribution, expected),
                              1e-5f * glm::length(expected) + 1e-7f)
                        << rayKindInfo(node.kind).text << ' ' << rayEndInfo(node.end).text;
                    if (node.kind == RayKind::Reflected || node.kind == RayKind::Refracted) {
                        const RayNode& parent = tree.nodes()[static_cast<std::size_t>(node.parent)];
                        const glm::vec3 most = parent.weight * terms.factor;
                        for (int c = 0; c < 3; ++c) // less what a body absorbs
                            EXPECT_LE(node.weight[c], most[c] * 1.00001f + 1e-7f);
                    }
                    ++kinds[node.kind];
                }
            }
    }
    for (const RayKind kind :
         {RayKind::Camera, RayKind::Shadow, RayKind::Reflected, RayKind::Refracted})
        EXPECT_GT(kinds[kind], 0) << rayKindInfo(kind).text;
}

// Within a ball of mirror a ray has no way out.
TEST(Whitted, BranchesEndByDepthAndByContribution) {
    TraceInputs inputs = test::ballUnderSky(mirror(0.8f));
    const TraceScene scene = whittedScene(inputs);
    const TraceView view = viewFrom(0.5f, 4);
    WhittedSettings settings;
    settings.maxDepth = 5;
    settings.minContribution = 1e-4f;
    settings.subdivisions = 0;
    const auto deepest = [&] {
        const RayTree tree = traceRayTree(scene, view, settings, 1, 2, 1);
        EXPECT_EQ(tree.sampleCount(), 4u);
        return tree.nodes().back();
    };
    RayNode last = deepest();
    EXPECT_EQ(last.end, RayEnd::Depth);
    EXPECT_EQ(last.depth, 6);
    EXPECT_FALSE(last.hit);
    EXPECT_FALSE(wasCast(last.end));

    settings.maxDepth = 32;
    settings.minContribution = 0.3f;
    last = deepest();
    EXPECT_EQ(last.end, RayEnd::Contribution);
    EXPECT_LT(last.weight.x, 0.3f);
    EXPECT_GT(last.weight.x, 0.3f * 0.79f); // its parent was above
}

TEST(Whitted, PixelsAreDividedWhereTheirCornersDiffer) {
    TraceInputs inputs = floorUnderPoint();
    inputs.materials[0].emissive = glm::vec3(1.0f);
    inputs.lights.clear();
    const TraceScene scene = whittedScene(inputs);
    TraceView view = viewFrom(8.0f, 32);
    view.camera.pitchDeg = 80.0f;
    std::map<std::size_t, int> pixels;
    for (int x = 0; x < view.width; ++x) {
        const RayTree tree = traceRayTree(scene, view, {}, x, 16, 1);
        ++pixels[tree.sampleCount()];
        double shares = 0.0;
        for (const RayNode& node : ofKind(tree, RayKind::Camera))
            shares += node.share;
        EXPECT_EQ(shares, 1.0);
    }
    EXPECT_EQ(pixels.begin()->first, 4u);
    EXPECT_GT(pixels[4], 20);
    EXPECT_GE(pixels.rbegin()->first, 14u); // the borders
    EXPECT_LE(pixels.rbegin()->first, 25u);
}

TEST(Whitted, SameBytesForAnyNumberOfThreads) {
    const TraceScene scene = whittedScene(variedScene());
    TraceView view = ofVariedScene();
    view.width = 70;
    view.height = 37;
    for (const bool stochastic : {false, true}) {
        WhittedSettings settings;
        settings.softShadows = settings.gloss = stochastic;
        std::vector<Film> films;
        std::vector<std::vector<std::uint32_t>> rays;
        for (const int threads : {1, 2, 7}) {
            const ThreadLimit limit(threads);
            Film film(view.width, view.height);
            RayCountMap counts(view.width, view.height);
            ASSERT_TRUE(traceWhitted(scene, view, settings, film, 0, stochastic ? 3 : 1, {},
                                     nullptr, {}, &counts)
                            .ok());
            films.push_back(std::move(film));
            for (const RayCounts& pixel : counts.pixels())
                rays.emplace_back().push_back(pixel.rays);
        }
        EXPECT_EQ(films[0], films[1]);
        EXPECT_EQ(films[0], films[2]);
    }
}

// Soft shadows and gloss are the direct light of paths, without bias.
TEST(Whitted, StochasticSwitchesConvergeToPaths) {
    TraceInputs inputs = floorUnderPoint();
    inputs.lights[0].type = LightType::Sphere;
    inputs.lights[0].position = {0.0f, 1.0f, 0.0f};
    inputs.lights[0].radius = 0.3f;
    glm::mat4 small(0.2f);
    small[3] = {0.3f, 0.4f, 0.0f, 1.0f};
    inputs.meshes.push_back({2, test::ball(16), small, 0});
    const TraceScene scene = whittedScene(inputs);
    const TraceView view = fromAbove();
    WhittedSettings settings;
    settings.softShadows = true;
    const Film soft = whitted(scene, view, settings, 1024);
    Film paths(view.width, view.height);
    PathSettings direct;
    direct.maxBounces = 0;
    ASSERT_TRUE(tracePaths(scene, view, direct, paths, 0, 1024, {}).ok());
    double all = 0.0, difference = 0.0;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            all += paths.at(x, y).luminance();
            difference += std::abs(soft.at(x, y).luminance() - paths.at(x, y).luminance());
        }
    EXPECT_LT(difference, 0.01 * all);
}

} // namespace patina
