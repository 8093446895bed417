// The classical ray tracer and its trees against closed forms.
#include "core/trace/whitted/WhittedTracer.h"

#include "core/job/Parallel.h"
#include "core/trace/whitted/TeachingHierarchy.h"
#include "tests/core/trace/TraceBall.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <map>
#include <numbers>
#include <vector>

namespace patina {
namespace {

TraceScene whittedScene(const TraceInputs& inputs) {
    Result<TraceScene> scene = TraceScene::build(inputs, {});
    EXPECT_TRUE(scene.ok()) << (scene.ok() ? std::string() : scene.error().text());
    return *std::move(scene);
}

TraceView viewFrom(float distance, int size = 16) {
    TraceView view;
    view.width = view.height = size;
    view.camera.distance = distance;
    return view;
}

Film whitted(const TraceScene& scene, const TraceView& view, const WhittedSettings& settings = {},
             std::uint32_t samples = 1) {
    Film film(view.width, view.height);
    EXPECT_TRUE(traceWhitted(scene, view, settings, film, 0, samples, {}).ok());
    return film;
}

// A square of 4 m in y = 0, seen from above.
MeshPtr floorMesh() {
    Mesh mesh;
    mesh.positions = {{-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}};
    mesh.normals.assign(4, {0, 1, 0});
    mesh.tangents.assign(4, {1, 0, 0, 1});
    mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return std::make_shared<const Mesh>(std::move(mesh));
}

TraceInputs floorUnderPoint(float roughness = 0.5f) {
    TraceInputs inputs;
    Material material;
    material.baseColor = {0.6f, 0.4f, 0.2f};
    material.metallic = 0.0f;
    material.perceptualRoughness = roughness;
    inputs.materials = {material};
    inputs.meshes = {{1, floorMesh(), glm::mat4(1.0f), 0}};
    inputs.model.fresnel = Fresnel::Dielectric; // of index 1: no gloss above the diffuse lobe
    inputs.model.ior = 1.0f;
    Light light;
    light.id = 9;
    light.type = LightType::Point;
    light.position = {0.5f, 1.5f, -0.25f};
    light.intensity = 7.0f;
    inputs.lights = {light};
    return inputs;
}

TraceView fromAbove() {
    TraceView view = viewFrom(3.0f);
    view.camera.pitchDeg = 60.0f;
    return view;
}

Material mirror(float reflectance) {
    Material material;
    material.baseColor = glm::vec3(reflectance);
    material.metallic = 1.0f;
    material.perceptualRoughness = 0.0f;
    material.doubleSided = true;
    return material;
}

// A cube from -1 to 1.
MeshPtr cubeMesh() {
    Mesh mesh;
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f}) {
            glm::vec3 n(0.0f), u(0.0f), v(0.0f);
            n[axis] = side;
            u[(axis + 1) % 3] = 1.0f;
            v[(axis + 2) % 3] = side; // u × v = n
            const auto first = static_cast<std::uint32_t>(mesh.positions.size());
            for (const glm::vec2 at :
                 {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
                mesh.positions.push_back(n + at.x * u + at.y * v);
                mesh.normals.push_back(n);
                mesh.tangents.emplace_back(u, 1.0f);
                mesh.uvs.emplace_back(0.5f * at + 0.5f);
            }
            for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u})
                mesh.indices.push_back(first + corner);
        }
    return std::make_shared<const Mesh>(std::move(mesh));
}

Material glass(float ior = 1.5f) {
    Material material;
    material.baseColor = glm::vec3(1.0f);
    material.metallic = 0.0f;
    material.perceptualRoughness = 0.0f;
    material.transmission = 1.0f;
    material.ior = ior;
    material.thinWalled = false;
    return material;
}

// Fresnel's equations for both polarisations, of a ray from index 1 to `eta`; 1 beyond the critical
// angle.
double fresnelOf(double cosine, double eta) {
    const double sin2 = (1.0 - cosine * cosine) / (eta * eta);
    if (sin2 >= 1.0)
        return 1.0;
    const double behind = std::sqrt(1.0 - sin2);
    const double s = (cosine - eta * behind) / (cosine + eta * behind);
    const double p = (eta * cosine - behind) / (eta * cosine + behind);
    return 0.5 * (s * s + p * p);
}

// Rays that meet mirrors, rough things, things that glow, lights of every kind and the sky.
TraceInputs variedScene() {
    TraceInputs inputs = test::ballUnderSky(mirror(0.9f), 0.3f);
    Image sky(16, 8, 3, PixelType::F32, ColorEncoding::Linear);
    for (std::size_t i = 0; i < sky.f32().size(); ++i)
        sky.f32()[i] = 0.1f + 0.37f * static_cast<float>(i % 5);
    inputs.environments = {{std::make_shared<const Image>(sky), 30.0f, glm::vec3(1.0f)}};
    Material rough;
    rough.baseColor = {0.8f, 0.5f, 0.2f};
    rough.metallic = 0.0f;
    Material glow;
    glow.emissive = {2.0f, 4.0f, 6.0f};
    Material green = glass();
    green.attenuationColor = {0.2f, 0.9f, 0.3f};
    green.attenuationDistance = 0.5f;
    inputs.materials.push_back(rough);
    inputs.materials.push_back(glow);
    inputs.materials.push_back(green);
    glm::mat4 clear(0.4f);
    clear[3] = {-0.9f, -0.3f, 0.9f, 1.0f};
    inputs.meshes.push_back({4, test::ball(16), clear, 3});
    glm::mat4 below(1.0f);
    below[3] = {0.0f, -1.0f, 0.0f, 1.0f};
    inputs.meshes.push_back({2, floorMesh(), below, 1});
    glm::mat4 small(0.3f);
    small[3] = {1.3f, 0.4f, 0.6f, 1.0f};
    inputs.meshes.push_back({3, test::ball(8), small, 2});
    for (const LightType type : {LightType::Point, LightType::Spot, LightType::Directional,
                                 LightType::Sphere, LightType::Rectangle}) {
        Light light;
        light.id = 10 + static_cast<Id>(type);
        light.castsShadow = type != LightType::Spot;
        light.type = type;
        light.intensity = 2.0f;
        inputs.lights.push_back(light);
    }
    return inputs;
}

TraceView ofVariedScene() {
    TraceView view = viewFrom(4.5f, 20);
    view.camera.target = {0.2f, -0.2f, 0.0f};
    view.camera.pitchDeg = 25.0f;
    return view;
}

std::vector<RayNode> ofKind(const RayTree& tree, RayKind kind) {
    std::vector<RayNode> found;
    for (const RayNode& node : tree.nodes())
        if (node.kind == kind)
            found.push_back(node);
    return found;
}

} // namespace

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

// Snell's law, Fresnel's equations and total reflection, at every surface of a cube of glass.
TEST(Whitted, GlassFollowsSnellAndFresnel) {
    for (const float ior : {1.0f, 1.3f, 1.5f, 2.4f}) {
        TraceInputs inputs = test::ballUnderSky(glass(ior));
        inputs.meshes[0].mesh = cubeMesh();
        const TraceScene scene = whittedScene(inputs);
        TraceView view = viewFrom(5.0f);
        view.camera.pitchDeg = 35.0f;
        WhittedSettings settings;
        settings.minContribution = 1e-3f;
        int refracted = 0, total = 0, partly = 0;
        for (int y = 4; y < 12; ++y) {
            const RayTree tree = traceRayTree(scene, view, settings, 6, y, 1);
            for (const RayNode& node : tree.nodes()) {
                if (node.parent == RayNode::kNone || node.kind == RayKind::Shadow)
                    continue;
                const RayNode& from = tree.nodes()[static_cast<std::size_t>(node.parent)];
                const glm::dvec3 n(from.normal), d(from.direction), out(node.direction);
                const double cosine = -glm::dot(n, d);
                const double sine = glm::length(glm::cross(n, d));
                // Within the cube at its odd surfaces.
                const bool leaves = from.etaRatio > 1.0f;
                const double eta =
                    leaves ? 1.0 / static_cast<double>(ior) : static_cast<double>(ior);
                const double reflectance = fresnelOf(cosine, eta);
                const double ratio = static_cast<double>(node.weight.y / from.weight.y);
                EXPECT_NEAR(from.cosIncident, cosine, 1e-5);
                EXPECT_EQ(from.totalReflection, sine >= eta) << sine;
                if (node.kind == RayKind::Reflected) {
                    EXPECT_LT(glm::length(out - (d + 2.0 * cosine * n)), 1e-5);
                    EXPECT_NEAR(ratio, reflectance, 2e-4);
                    total += from.totalReflection ? 1 : 0;
                    partly += from.totalReflection ? 0 : 1;
                } else {
                    EXPECT_NEAR(glm::length(glm::cross(n, out)), sine / eta, 1e-5);
                    EXPECT_LT(glm::dot(n, out), 0.0);
                    EXPECT_NEAR(ratio, 1.0 - reflectance, 2e-4);
                    ++refracted;
                }
            }
        }
        EXPECT_GT(refracted, 20);
        if (ior >= 1.5f) { // the light that enters cannot leave by a side
            EXPECT_GT(total, 10);
        }
        EXPECT_EQ(partly > 0, ior != 1.0f);
    }
}

// Of a sheet both faces: 2R / (1 + R) comes back and the rest goes straight on.
TEST(Whitted, ASheetOfGlassIsBothOfItsFaces) {
    Material sheet = glass();
    sheet.thinWalled = true;
    sheet.baseColor = {0.9f, 0.5f, 0.25f};
    TraceInputs inputs = test::ballUnderSky(sheet);
    inputs.meshes[0].mesh = floorMesh();
    const TraceScene scene = whittedScene(inputs);
    TraceView view = fromAbove();
    view.camera.pitchDeg = 20.0f;
    const RayTree tree = traceRayTree(scene, view, {}, 7, 8, 1);
    ASSERT_EQ(ofKind(tree, RayKind::Refracted).size(), tree.sampleCount());
    for (const RayNode& node : tree.nodes()) {
        if (node.kind == RayKind::Camera)
            continue;
        const RayNode& from = tree.nodes()[static_cast<std::size_t>(node.parent)];
        const double once = fresnelOf(-static_cast<double>(from.direction.y), 1.5);
        const double reflectance = 2.0 * once / (1.0 + once);
        if (node.kind == RayKind::Reflected) {
            EXPECT_NEAR(node.weight.y, reflectance, 2e-4);
        } else {
            EXPECT_LT(glm::length(node.direction - from.direction), 1e-6f);
            EXPECT_NEAR(node.weight.y, 0.5 * (1.0 - reflectance), 2e-4);
        }
    }
}

// Through a sheet the background is seen as it would be without: as it was asked for, or not there.
TEST(Whitted, BehindASheetIsTheBackground) {
    Material sheet = glass();
    sheet.thinWalled = true;
    TraceInputs inputs = test::ballUnderSky(sheet, 0.5f);
    inputs.meshes[0].mesh = floorMesh();
    const TraceScene scene = whittedScene(inputs);
    TraceView view = fromAbove();
    WhittedSettings settings;
    settings.subdivisions = 0;
    const RayTree tree = traceRayTree(scene, view, settings, 8, 8, 1);
    double reflected = 0.0;
    for (const RayNode& node : ofKind(tree, RayKind::Reflected))
        reflected += 0.25 * static_cast<double>(node.weight.y);
    view.background = [](const glm::vec3&) { return glm::vec3(2.0f); };
    EXPECT_NEAR(whitted(scene, view, settings).at(8, 8).luminance(),
                reflected * 0.5 + (1.0 - reflected) * 2.0, 1e-4);
    view.transparent = true;
    const Film film = whitted(scene, view, settings);
    EXPECT_NEAR(film.at(8, 8).coverage, reflected, 1e-5);
    EXPECT_NEAR(film.at(8, 8).luminance(), reflected * 0.5, 1e-4);
    view.camera.distance = 20.0f;
    EXPECT_EQ(whitted(scene, view, settings).at(0, 0).coverage, 0.0f); // beside it
}

// Beer and Lambert's law, of what is seen through the body and of the light that comes through.
TEST(Whitted, BodiesAbsorbByTheLengthOfTheWay) {
    TraceInputs inputs = floorUnderPoint();
    Material body = glass(1.0f); // rays go straight on
    body.attenuationColor = {0.5f, 0.25f, 1.0f};
    body.attenuationDistance = 0.3f;
    inputs.materials.push_back(body);
    glm::mat4 slab(1.0f); // 0.2 m thick, above the floor
    slab[1].y = 0.1f;
    slab[3].y = 0.5f;
    inputs.meshes.push_back({2, cubeMesh(), slab, 1});
    inputs.lights[0].position = {0.1f, 1.5f, 0.1f};
    const TraceScene scene = whittedScene(inputs);
    TraceView view = fromAbove();
    view.camera.pitchDeg = 85.0f;
    const RayTree tree = traceRayTree(scene, view, {}, 8, 8, 1);
    int floors = 0;
    for (const RayNode& node : tree.nodes()) {
        if (node.kind != RayKind::Shadow || node.end != RayEnd::Lit)
            continue;
        const RayNode& seen = tree.nodes()[static_cast<std::size_t>(node.parent)];
        if (seen.mesh != 1)
            continue;
        ++floors;
        const double up = 0.2 / std::abs(static_cast<double>(node.direction.y));
        const double down = 0.2 / std::abs(static_cast<double>(seen.direction.y));
        EXPECT_NEAR(node.passes.x, std::pow(0.5, up / 0.3), 1e-4);
        EXPECT_NEAR(node.passes.y, std::pow(0.25, up / 0.3), 1e-4);
        EXPECT_NEAR(node.passes.z, 1.0, 1e-5);
        EXPECT_NEAR(seen.weight.x, std::pow(0.5, down / 0.3), 1e-4);
        EXPECT_NEAR(seen.weight.y, std::pow(0.25, down / 0.3), 1e-4);
    }
    EXPECT_EQ(floors, static_cast<int>(tree.sampleCount()));
}

// A closed scene of glass in uniform light shows that light: nothing is lost but what is cut.
TEST(Whitted, GlassInUniformLightIsInvisible) {
    for (const bool thin : {false, true}) {
        Material material = glass();
        material.thinWalled = thin;
        const TraceScene scene = whittedScene(test::ballUnderSky(material, 0.7f));
        WhittedSettings settings;
        settings.maxDepth = 32;
        settings.minContribution = kLeastContribution;
        const Film film = whitted(scene, viewFrom(3.4f), settings);
        for (const Film::Pixel& pixel : film.pixels())
            EXPECT_NEAR(pixel.luminance(), 0.7, 0.004);
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

TEST(Whitted, HeatMapsCountWhatTheTreeHas) {
    const TraceScene scene = whittedScene(variedScene());
    const TraceView view = ofVariedScene();
    const TeachingHierarchy hierarchy = TeachingHierarchy::build(*scene.geometry(), {});
    Film film(view.width, view.height);
    RayCountMap counts(view.width, view.height);
    ASSERT_TRUE(
        traceWhitted(scene, view, {}, film, 0, 1, {}, nullptr, {}, &counts, &hierarchy).ok());
    for (int y = 0; y < view.height; y += 4)
        for (int x = 0; x < view.width; x += 2) {
            const RayTree tree = traceRayTree(scene, view, {}, x, y, 1);
            std::uint32_t rays = 0, depth = 0;
            for (const RayNode& node : tree.nodes())
                if (wasCast(node.end)) {
                    ++rays;
                    depth = std::max(depth, static_cast<std::uint32_t>(node.depth));
                }
            const RayCounts& pixel = counts.pixels()[static_cast<std::size_t>(y * view.width + x)];
            EXPECT_EQ(pixel.rays, rays) << x << " " << y;
            EXPECT_EQ(pixel.depth, depth) << x << " " << y;
            EXPECT_GE(pixel.boxTests, rays);
            EXPECT_LT(pixel.triangleTests, rays * hierarchy.triangleCount() / 10);
        }
}

// What is found with the boxes is what is found without.
TEST(TeachingHierarchy, BoxesHoldWhatIsBelowThem) {
    const TraceScene scene = whittedScene(variedScene());
    const TeachingHierarchy hierarchy = TeachingHierarchy::build(*scene.geometry(), {});
    EXPECT_EQ(hierarchy.triangleCount(), scene.geometry()->triangleCount());
    ASSERT_EQ(hierarchy.boxes(0).size(), 1u);
    const TeachingHierarchy::Box whole = hierarchy.boxes(0)[0];
    glm::vec3 low(1e9f), high(-1e9f);
    for (const BakeGeometryMesh& mesh : scene.geometry()->meshes)
        for (const std::uint32_t i : mesh.mesh->indices) {
            low = glm::min(low, mesh.positions[i]);
            high = glm::max(high, mesh.positions[i]);
        }
    EXPECT_EQ(whole.low, low);
    EXPECT_EQ(whole.high, high);
    std::size_t before = 1;
    for (int level = 1; level < hierarchy.levels(); ++level) {
        const std::vector<TeachingHierarchy::Box> boxes = hierarchy.boxes(level);
        EXPECT_GT(boxes.size(), before);
        before = boxes.size();
        for (const TeachingHierarchy::Box& box : boxes)
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_GE(box.low[axis], low[axis]);
                EXPECT_LE(box.high[axis], high[axis]);
            }
    }
    // A ray that passes the scene tests its box alone.
    const TeachingHierarchy::Tests none = hierarchy.count({0, 5, 0}, {0, 1, 0}, 1e9f);
    EXPECT_EQ(none.boxes, 1u);
    EXPECT_EQ(none.triangles, 0u);
}

} // namespace patina
