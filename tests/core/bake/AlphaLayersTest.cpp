// Layers of blended surfaces let through the product of what each lets through: in every estimator
// that casts rays, in one mesh and in several, with equal and different opacities, coincident or
// one above the other.
#include "core/bake/local/NearLightAt.h"
#include "core/bake/local/NearShadows.h"
#include "core/math/SphericalHarmonics.h"
#include "core/trace/path/PathTracer.h"
#include "tests/core/bake/BakeTestScene.h"
#include "tests/core/radiosity/RadiosityScenes.h"
#include "tests/core/trace/TraceBall.h"
#include "tests/core/trace/WhittedScenes.h"

#include <cmath>
#include <gtest/gtest.h>

namespace patina::test {
namespace {

struct Layers {
    const char* name;
    std::vector<float> opacities;
    double apart;         // metres; 0: coincident triangles
    bool oneMesh = false; // all of the first opacity

    [[nodiscard]] double through() const {
        double share = 1.0;
        for (const float opacity : opacities)
            share *= 1.0 - double{opacity};
        return share;
    }
};

const std::vector<Layers> kLayers{
    {"one", {0.5f}, 0.1},
    {"two", {0.5f, 0.5f}, 0.1},
    {"four", {0.5f, 0.5f, 0.5f, 0.5f}, 0.1},
    {"two of one mesh", {0.5f, 0.5f}, 0.1, true},
    {"four of one mesh", {0.5f, 0.5f, 0.5f, 0.5f}, 0.1, true},
    {"different ones", {0.5f, 0.1f}, 0.1},
    {"two in one place", {0.5f, 0.5f}, 0.0},
    {"three different ones in one place", {0.2f, 0.5f, 0.4f}, 0.0},
    {"two of one mesh in one place", {0.5f, 0.5f}, 0.0, true},
};

constexpr double kFirst = 0.2; // metres, height of the lowest

Mesh joined(const std::vector<Mesh>& meshes) {
    Mesh all;
    for (const Mesh& mesh : meshes) {
        const auto first = static_cast<std::uint32_t>(all.positions.size());
        all.positions.insert(all.positions.end(), mesh.positions.begin(), mesh.positions.end());
        all.uvs.insert(all.uvs.end(), mesh.uvs.begin(), mesh.uvs.end());
        for (const std::uint32_t index : mesh.indices)
            all.indices.push_back(first + index);
    }
    return all;
}

// A mesh a layer, or one of all.
std::vector<Mesh> sheets(const Layers& layers, double half) {
    std::vector<Mesh> meshes;
    for (std::size_t i = 0; i < layers.opacities.size(); ++i)
        meshes.push_back(planeMesh(half, 1, kFirst + layers.apart * static_cast<double>(i)));
    return layers.oneMesh ? std::vector<Mesh>{joined(meshes)} : meshes;
}

// A small floor, which is the first mesh, and sheets that hide all of the sky.
BakeInputs floorUnder(const Layers& layers) {
    std::vector<Mesh> meshes{planeMesh(0.01, 2)};
    for (Mesh& sheet : sheets(layers, 20.0))
        meshes.push_back(std::move(sheet));
    BakeInputs inputs = sceneOf(std::move(meshes));
    for (std::size_t i = 1; i < inputs.meshes.size(); ++i) {
        inputs.meshes[i].surface.alphaMode = AlphaMode::Blend;
        inputs.meshes[i].surface.opacity = layers.opacities[i - 1];
        inputs.meshes[i].surface.baseColor = glm::vec3(0.0f);
    }
    return inputs;
}

// The same for those that trace pictures; black, so that only what passes is seen.
TraceInputs quadUnder(const Layers& layers, float emission) {
    TraceInputs inputs;
    const auto add = [&](Mesh mesh, const Material& material) {
        inputs.materials.push_back(material);
        inputs.meshes.push_back({static_cast<Id>(inputs.meshes.size() + 1),
                                 std::make_shared<const Mesh>(sanitized(std::move(mesh))),
                                 glm::mat4(1.0f), inputs.materials.size() - 1});
    };
    Material floor;
    floor.baseColor = glm::vec3(0.5f);
    floor.perceptualRoughness = 1.0f;
    floor.emissive = glm::vec3(emission);
    add(planeMesh(2.0, 1), floor);
    std::vector<Mesh> all = sheets(layers, 2.0);
    for (std::size_t i = 0; i < all.size(); ++i) {
        Material veil;
        veil.baseColor = glm::vec3(0.0f);
        veil.doubleSided = true;
        veil.alphaMode = AlphaMode::Blend;
        veil.opacity = layers.opacities[i];
        add(std::move(all[i]), veil);
    }
    return inputs;
}

// From far above, so that all of the picture is the quad.
TraceView fromFarAbove() {
    TraceView view = viewFrom(5.0f);
    view.camera.pitchDeg = 89.0f;
    view.camera.fovDeg = 20.0f;
    return view;
}

double meanOf(const Film& film) {
    double sum = 0.0;
    for (const Film::Pixel& pixel : film.pixels())
        sum += pixel.luminance();
    return sum / static_cast<double>(film.pixels().size());
}

class AlphaLayers : public testing::TestWithParam<Layers> {};

TEST_P(AlphaLayers, AmbientOcclusion) {
    const BakeInputs inputs = floorUnder(GetParam());
    EXPECT_NEAR(valueAt(aoOf(inputs, 16384), inputs, 0, {0, 0, 0}), GetParam().through(), 0.015);
}

TEST_P(AlphaLayers, Transfer) {
    const BakeInputs inputs = floorUnder(GetParam());
    // Of light from everywhere alike: T_0 = Y_0 · the share that is open.
    const double kY00 = 0.5 / std::sqrt(kPi);
    EXPECT_NEAR(valueAt(prtOf(inputs, 1, 16384), inputs, 0, {0, 0, 0}) / kY00, GetParam().through(),
                0.015);
}

TEST_P(AlphaLayers, ShadowsOfLocalLights) {
    const Result<BakeScene> scene = BakeScene::build(floorUnder(GetParam()), {});
    ASSERT_TRUE(scene.ok());
    std::vector<BakePoint> points;
    for (int i = 0; i < 400; ++i) {
        const glm::dvec3 place(0.001 * (i % 20) - 0.01, 0.0, 0.001 * (i / 20.0) - 0.01);
        const BakeGeometry& geometry = *scene->geometry;
        const glm::vec3 origin((place - geometry.centre) * geometry.unitsPerMetre);
        points.push_back({origin + kRayOffset * glm::vec3(0, 1, 0), {0, 1, 0}});
    }
    NearEmitter emitter;
    emitter.position = {0.0f, 3.0f, 0.0f};
    for (const float radius : {0.0f, 0.3f}) {
        if (radius > 0.0f) {
            emitter.shape = NearEmitter::Shape::Sphere;
            emitter.radius = radius;
        }
        const auto shares = nearVisibility(*scene, points, emitter, {});
        ASSERT_TRUE(shares.ok());
        double mean = 0.0;
        for (const float share : *shares)
            mean += share / 400.0;
        EXPECT_NEAR(mean, GetParam().through(), radius > 0.0f ? 0.015 : 0.03) << radius;
    }
}

TEST_P(AlphaLayers, Paths) {
    const Result<TraceScene> scene = TraceScene::build(quadUnder(GetParam(), 1.0f), {});
    ASSERT_TRUE(scene.ok());
    const TraceView view = fromFarAbove();
    Film film(view.width, view.height);
    ASSERT_TRUE(tracePaths(*scene, view, {}, film, 0, 64, {}).ok());
    EXPECT_NEAR(meanOf(film), GetParam().through(), 0.015) << "seen through the layers";

    // And lit through them.
    TraceInputs inputs = quadUnder(GetParam(), 0.0f);
    Light sun;
    sun.type = LightType::Directional;
    sun.elevationDeg = 90.0f;
    inputs.lights = {sun};
    const Result<TraceScene> lit = TraceScene::build(inputs, {});
    ASSERT_TRUE(lit.ok());
    inputs.meshes.resize(1);
    const Result<TraceScene> open = TraceScene::build(inputs, {});
    ASSERT_TRUE(open.ok());
    // At many points: a ray to a light without extent is the same ray each time.
    double below = 0.0, above = 0.0;
    for (int i = 0; i < 4096; ++i) {
        const glm::dvec3 at(0.02 * (i % 64) - 0.64, 0.0, 0.02 * (i / 64.0) - 0.64);
        PathSettings settings;
        settings.seed = static_cast<std::uint32_t>(i);
        Film::Pixel through, all;
        traceIrradiance(*lit, at, {0, 1, 0}, settings, 1, through);
        traceIrradiance(*open, at, {0, 1, 0}, settings, 1, all);
        below += through.luminance();
        above += all.luminance();
    }
    // The sheets reflect some of the floor's light back to it.
    EXPECT_NEAR(below / above, GetParam().through(), 0.04);
}

TEST_P(AlphaLayers, ClassicalRayTracing) {
    const TraceScene scene = whittedScene(quadUnder(GetParam(), 1.0f));
    EXPECT_NEAR(meanOf(whitted(scene, fromFarAbove(), {}, 1)), GetParam().through(), 0.03);
}

TEST_P(AlphaLayers, Radiosity) {
    // Direct light on the floor, and what one face sends another.
    TraceInputs inputs = quadUnder(GetParam(), 0.0f);
    Light lamp;
    lamp.id = 7;
    lamp.type = LightType::Sphere;
    lamp.position = {0.0f, 3.0f, 0.0f};
    lamp.radius = 0.4f;
    inputs.lights = {lamp};
    const auto meanDirect = [](const TraceInputs& of) {
        const auto scene = divided(of, {.maxArea = 0.05}, {.lightSamples = 1024});
        double sum = 0.0;
        int count = 0;
        for (std::uint32_t e = 0; e < scene->elements.size(); ++e)
            if (scene->elements.face(e).mesh == 0) {
                sum += scene->lit.direct[e].x;
                ++count;
            }
        return sum / count;
    };
    const double through = meanDirect(inputs);
    inputs.meshes.resize(1);
    EXPECT_NEAR(through / meanDirect(inputs), GetParam().through(), 0.015);
}

INSTANTIATE_TEST_SUITE_P(All, AlphaLayers, testing::ValuesIn(kLayers),
                         [](const testing::TestParamInfo<Layers>& layers) {
                             std::string name;
                             for (const char* c = layers.param.name; *c != 0; ++c)
                                 name += *c == ' ' ? '_' : *c;
                             return name;
                         });

} // namespace
} // namespace patina::test
