// Shadows against geometry: umbra, light, penumbra, and nothing where nothing should be.
#include "core/light/Light.h"
#include "core/light/Lights.h"
#include "core/material/Material.h"
#include "render/pass/ShadowPass.h"
#include "render/scene/ShadowView.h"
#include "tests/render/RenderTest.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

namespace patina::render {
namespace {

using Shadow = RenderTest;

constexpr int kPixels = 512;

// A ground of half size 2 and, at `height`, a plate of half size 1 whose edge lies above x = 0.
// Matte, white, seen straight from above through the plate, which the camera does not see: it is
// single-sided and faces down.
Document groundUnderPlate(float height, const Light& light) {
    Document document = makeScene(makePlane());
    document.materials[0].baseColor = glm::vec3(1.0f);
    document.materials[0].perceptualRoughness = 1.0f;
    document.meshes[0].placement = glm::scale(glm::mat4(1.0f), glm::vec3(2.0f));
    MeshInstance plate = document.meshes[0];
    plate.id = document.takeId();
    plate.placement = glm::rotate(glm::translate(glm::mat4(1.0f), glm::vec3(-1.0f, height, 0.0f)),
                                  glm::radians(180.0f), glm::vec3(1, 0, 0));
    document.meshes.push_back(plate);
    document.lights = {light};
    document.lights[0].id = document.takeId();
    document.view.camera = cameraAbove();
    document.view.camera.distance = 8.0f;
    return document;
}

Light sunAbove(float softnessDeg) {
    Light light;
    light.type = LightType::Directional;
    light.elevationDeg = 90.0f;
    light.intensity = 1.0f;
    light.shadowSoftness = softnessDeg;
    return light;
}

// World x of a column of the picture, on the ground.
float worldX(const Camera& camera, int column) {
    const float half = camera.distance * std::tan(glm::radians(0.5f * camera.fovDeg));
    return (2.0f * (static_cast<float>(column) + 0.5f) / kPixels - 1.0f) * half;
}

// The share of light along the middle row, from the same picture without a shadow.
std::vector<float> visibilityAlongX(const Image& shadowed, const Image& open) {
    std::vector<float> result;
    for (int x = 0; x < kPixels; ++x)
        result.push_back(pixel(shadowed, x, kPixels / 2).g / pixel(open, x, kPixels / 2).g);
    return result;
}

class Penumbra : public RenderTest {
  protected:
    // Draws with and without shadows and measures between 10 % and 90 % of the light. A disc-like
    // source seen past a straight edge gives a profile whose 10 % … 90 % span is 0.687 of its
    // width.
    float width(Document document, float* darkest = nullptr, float* lightest = nullptr) {
        const Image shadowed = draw(document, kPixels);
        document.lights[0].castsShadow = false;
        const std::vector<float> v = visibilityAlongX(shadowed, draw(document, kPixels));
        const auto crossing = [&](float level) {
            for (int x = 1; x < kPixels; ++x)
                if (v[static_cast<std::size_t>(x) - 1] < level &&
                    v[static_cast<std::size_t>(x)] >= level) {
                    const float a = v[static_cast<std::size_t>(x) - 1];
                    const float b = v[static_cast<std::size_t>(x)];
                    const float t = (level - a) / (b - a);
                    return worldX(document.view.camera, x - 1) * (1.0f - t) +
                           worldX(document.view.camera, x) * t;
                }
            return std::numeric_limits<float>::quiet_NaN();
        };
        if (darkest)
            *darkest = *std::min_element(v.begin(), v.end());
        if (lightest)
            *lightest = *std::max_element(v.begin(), v.end());
        m_edge = crossing(0.5f);
        return (crossing(0.9f) - crossing(0.1f)) / 0.687f;
    }
    float m_edge = 0.0f; // world x of half the light
};

TEST_F(Penumbra, OfTheSunIsAsWideAsItsDiscMakesIt) {
    for (const float height : {0.5f, 1.0f, 1.5f})
        for (const float softness : {4.0f, 8.0f}) {
            float darkest = 1.0f, lightest = 0.0f;
            const float measured =
                width(groundUnderPlate(height, sunAbove(softness)), &darkest, &lightest);
            const float geometric = height * 2.0f * std::tan(glm::radians(0.5f * softness));
            EXPECT_NEAR(measured, geometric, 0.2f * geometric) << height << ' ' << softness;
            EXPECT_NEAR(m_edge, 0.0f, 0.03f);
            EXPECT_EQ(darkest, 0.0f);
            EXPECT_NEAR(lightest, 1.0f, 1e-3f);
        }
}

TEST_F(Penumbra, OfASpotFollowsSimilarTriangles) {
    Light spot;
    spot.type = LightType::Spot;
    spot.elevationDeg = 90.0f;
    spot.position = {0.0f, 4.0f, 0.0f};
    spot.innerConeDeg = spot.outerConeDeg = 45.0f;
    spot.intensity = 10.0f;
    for (const float softness : {4.0f, 8.0f}) {
        spot.shadowSoftness = softness;
        const Document document = groundUnderPlate(1.0f, spot);
        const float source = 2.0f * std::tan(glm::radians(0.5f * softness)) *
                             glm::distance(spot.position, document.bounds().center());
        const float geometric = source * 1.0f / 3.0f; // gap over the plate's distance
        const float measured = width(document);
        EXPECT_NEAR(measured, geometric, 0.2f * geometric) << softness;
        EXPECT_NEAR(m_edge, 0.0f, 0.03f); // straight below the light
    }
}

TEST_F(Penumbra, OfAHardLightIsAFewTexelsOfTheMap) {
    const Document document = groundUnderPlate(1.0f, sunAbove(0.0f));
    EXPECT_LT(width(document), 5.0f * 4.2f / kShadowMapSize);
}

// Slopes and curves under one light: no acne where nothing shades.
TEST_F(Shadow, AConvexBodyDoesNotShadeItself) {
    for (const float softness : {0.0f, 1.0f, 5.0f})
        for (const float elevation : {10.0f, 50.0f}) {
            Document document = makeScene(makeSphere(96));
            document.materials[0].perceptualRoughness = 1.0f;
            Light light = sunAbove(softness);
            light.elevationDeg = elevation;
            light.azimuthDeg = 60.0f;
            document.lights = {light};
            const Image shadowed = draw(document, 256);
            document.lights[0].castsShadow = false;
            const Image open = draw(document, 256);
            float worst = 0.0f;
            for (int y = 0; y < 256; ++y)
                for (int x = 0; x < 256; ++x)
                    worst = std::max(worst, pixel(open, x, y).g - pixel(shadowed, x, y).g);
            // 1 lux on albedo 0.8 gives 0.25; at the terminator facets of the mesh may turn away.
            EXPECT_LT(worst, 0.012f) << softness << ' ' << elevation;
        }
}

TEST_F(Shadow, TouchesWhatCastsIt) {
    // A plate standing upright on the ground: its shadow begins at its foot.
    Document document = groundUnderPlate(1.0f, sunAbove(1.0f));
    document.meshes[1].placement =
        glm::rotate(glm::translate(glm::mat4(1.0f), glm::vec3(0.0f, 1.0f, 0.0f)),
                    glm::radians(90.0f), glm::vec3(0, 0, 1));
    document.lights[0].azimuthDeg = 90.0f; // from +X
    document.lights[0].elevationDeg = 45.0f;
    const Image shadowed = draw(document, kPixels);
    document.lights[0].castsShadow = false;
    const std::vector<float> v = visibilityAlongX(shadowed, draw(document, kPixels));
    for (int x = 0; x < kPixels; ++x) {
        const float at = worldX(document.view.camera, x);
        if (at < -0.04f && at > -1.3f) {
            EXPECT_LT(v[static_cast<std::size_t>(x)], 0.02f) << at;
        }
        if (at > 0.04f && at < 1.3f) {
            EXPECT_GT(v[static_cast<std::size_t>(x)], 0.98f) << at;
        }
    }
}

TEST_F(Shadow, CutOutsLetLightThroughAndGlassCastsNone) {
    Document document = groundUnderPlate(1.0f, sunAbove(0.5f));
    Material plate = document.materials[0];
    plate.id = document.meshes[1].material = document.takeId();
    document.materials.push_back(plate);
    const auto at = [&](float x) {
        const Image image = draw(document, kPixels);
        for (int column = 0; column < kPixels; ++column)
            if (worldX(document.view.camera, column) >= x)
                return pixel(image, column, kPixels / 2).g;
        return -1.0f;
    };
    const float lit = at(0.7f);
    EXPECT_GT(lit, 0.2f);
    EXPECT_EQ(at(-0.7f), 0.0f);
    document.materials[1].alphaMode = AlphaMode::Mask;
    document.materials[1].opacity = 0.3f;
    EXPECT_NEAR(at(-0.7f), lit, 0.02f);
    document.materials[1].opacity = 0.7f;
    EXPECT_EQ(at(-0.7f), 0.0f);
    document.materials[1].alphaMode = AlphaMode::Blend;
    document.materials[1].opacity = 0.0f;
    EXPECT_NEAR(at(-0.7f), lit, 0.02f);
}

TEST_F(Shadow, LightsThatMissTheSceneAndFlatScenesAreHarmless) {
    Document document = groundUnderPlate(1.0f, sunAbove(1.0f));
    Light spot;
    spot.type = LightType::Spot;
    spot.position = {0, 3, 0};
    spot.elevationDeg = -90.0f; // looks up, away
    Light inside = spot;
    inside.position = {0, 0.5f, 0}; // between plate and ground
    inside.elevationDeg = 90.0f;
    inside.outerConeDeg = 90.0f;
    Light grazing = sunAbove(1.0f);
    grazing.elevationDeg = 0.0f; // along the ground, which is flat
    for (const Light& light : {spot, inside, grazing})
        document.lights.push_back(light);
    Id id = 70;
    for (Light& light : document.lights)
        light.id = id++;
    for (int meshes = 2; meshes >= 0; --meshes) {
        document.meshes.resize(static_cast<std::size_t>(meshes));
        const Image image = draw(document, 64);
        const auto broken =
            std::ranges::find_if_not(image.f32(), [](float value) { return std::isfinite(value); });
        EXPECT_EQ(broken, image.f32().end())
            << meshes << " meshes, number " << broken - image.f32().begin();
    }
}

TEST_F(Shadow, OnlyFourLightsHaveOneAndTheyAreTheFirst) {
    Document document = groundUnderPlate(1.0f, sunAbove(1.0f));
    document.lights[0].intensity = 1.0f;
    for (int i = 0; i < 4; ++i) {
        document.lights.push_back(document.lights[0]);
        document.lights.back().id = 80 + static_cast<Id>(i);
    }
    const auto dark = [&] {
        const Image image = draw(document, kPixels);
        for (int column = 0; column < kPixels; ++column)
            if (worldX(document.view.camera, column) >= -0.7f)
                return pixel(image, column, kPixels / 2).g;
        return -1.0f;
    };
    const float one = dark(); // the fifth light passes through
    EXPECT_GT(one, 0.2f);
    document.lights[2].enabled = false; // so that the fifth gets its map
    EXPECT_EQ(dark(), 0.0f);
    document.lights[4].castsShadow = false;
    EXPECT_NEAR(dark(), one, 1e-3f);
}

class ShadowMaps : public gl::GlTest {};

TEST_F(ShadowMaps, AreDrawnAgainOnlyWhenLightOrGeometryChanges) {
    ShaderLibrary shaders(context(), {});
    GpuScene scene(context());
    ShadowPass pass(context(), shaders);
    Document document = groundUnderPlate(1.0f, sunAbove(1.0f));
    document.lights.push_back(document.lights[0]);
    document.lights[1].id = 90;
    document.lights[1].azimuthDeg = 10.0f;
    document.lights[1].elevationDeg = 60.0f;
    const auto update = [&] {
        scene.update(document);
        const std::size_t before = pass.mapsDrawn();
        EXPECT_TRUE(pass.update(scene).ok());
        return pass.mapsDrawn() - before;
    };
    EXPECT_EQ(update(), 2u);
    EXPECT_EQ(update(), 0u); // nothing new
    document.lights[1].intensity = 9.0f;
    document.lights[1].shadowSoftness = 3.0f;
    document.view.exposureEv = 1.0f;
    EXPECT_EQ(update(), 0u); // not of the map
    document.lights[1].elevationDeg = 50.0f;
    EXPECT_EQ(update(), 1u);
    glm::vec3 higher = document.meshes[1].placement.position();
    higher.y = 1.2f;
    document.meshes[1].placement.setPosition(higher);
    EXPECT_EQ(update(), 2u);
    Material& material = document.materials[0];
    material.baseColor = glm::vec3(0.1f);
    material.opacity = 0.9f;
    EXPECT_EQ(update(), 0u); // an opaque one has no holes
    material.alphaMode = AlphaMode::Mask;
    EXPECT_EQ(update(), 2u);
    material.opacity = 0.2f;
    EXPECT_EQ(update(), 2u);
    material.emissive = glm::vec3(1.0f);
    EXPECT_EQ(update(), 0u);
    material.alphaMode = AlphaMode::Opaque;
    EXPECT_EQ(update(), 2u) << "its holes are closed again";
    scene.previewVertices(BakeKind::AoVertex, document.meshes[0].id, 1, std::vector(4, 0.5f));
    EXPECT_EQ(update(), 0u) << "a preview has no shape";
    document.lights[0].enabled = false;
    EXPECT_EQ(update(), 1u);
    EXPECT_EQ(pass.lights().size(), 1u);
    EXPECT_EQ(pass.lights()[0], 90u);
}

TEST(ShadowView, HoldsTheWholeSceneOfADirectionalLight) {
    Bounds scene;
    scene.add(glm::vec3(-3, 0, -1));
    scene.add(glm::vec3(1, 2, 5));
    Light light;
    light.azimuthDeg = 30.0f;
    light.elevationDeg = 55.0f;
    const ShadowView view = shadowView(light, scene, 1024);
    ASSERT_FALSE(view.empty);
    glm::vec3 low(1.0f), high(0.0f);
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 p(i & 1 ? 1 : -3, i & 2 ? 2 : 0, i & 4 ? 5 : -1);
        const glm::vec4 h = view.worldToMap * glm::vec4(p, 1.0f);
        low = glm::min(low, glm::vec3(h) / h.w);
        high = glm::max(high, glm::vec3(h) / h.w);
    }
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_GT(low[axis], 0.0f);
        EXPECT_LT(high[axis], 1.0f);
    }
    EXPECT_LT(std::min(low.x, low.y), 0.05f); // and not much more
    EXPECT_LT(low.z, 0.05f);
    EXPECT_GT(high.z, 0.95f);
    // Farther along the light is deeper.
    const glm::vec4 a = view.worldToMap * glm::vec4(scene.center(), 1.0f);
    const glm::vec4 b =
        view.worldToMap * glm::vec4(scene.center() - light.directionToLight(), 1.0f);
    EXPECT_GT(b.z, a.z);
    EXPECT_NEAR(b.x, a.x, 1e-5f);
    EXPECT_TRUE(shadowView(light, Bounds{}, 1024).empty);
}

} // namespace
} // namespace patina::render
