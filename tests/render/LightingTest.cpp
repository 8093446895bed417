// The ways to light a scene, from one lamp to baked transfer, and the mix of diffuse light and
// reflections.
#include "core/document/Lighting.h"
#include "core/math/SphericalHarmonics.h"
#include "render/scene/EnvironmentLight.h"
#include "tests/render/RenderTest.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

namespace patina::render {
namespace {

using Lighting = RenderTest;

// Light of one direction: the irradiance of a directional light of E lux, and no reflections.
IblMaps lampOnly(const glm::vec3& toLight, const glm::vec3& E) {
    IblMaps maps = uniformIbl(glm::vec3(0.0f));
    std::array<float, 9> y{};
    evaluateSh(3, toLight, std::span<float>(y));
    for (std::size_t i = 0; i < 9; ++i)
        maps.irradianceSh[i] = maps.radianceSh[i] = E * y[i];
    convolveWithCosine(maps.irradianceSh);
    return maps;
}

// A plane seen from above.
Document matte() {
    Document document = makeScene(makePlane());
    document.view.camera = cameraAbove();
    document.environment.background = BackgroundMode::Off;
    document.materials[0].metallic = 0.0f;
    return document;
}

TEST_F(Lighting, MixWeighsDiffuseLightAgainstReflections) {
    EXPECT_EQ(mixWeights(0.5f), glm::vec2(1.0f));
    EXPECT_EQ(mixWeights(0.0f), glm::vec2(1.0f, 0.0f));
    EXPECT_EQ(mixWeights(1.0f), glm::vec2(0.0f, 1.0f));
    EXPECT_EQ(mixWeights(0.75f), glm::vec2(0.5f, 1.0f));
    EXPECT_EQ(mixWeights(0.25f), glm::vec2(1.0f, 0.5f));

    renderer().setIbl(uniformIbl(glm::vec3(1.0f)));
    Document document = matte();
    document.materials[0].emissive = glm::vec3(0.25f);
    document.materials[0].emissiveStrength = 1.0f;
    Light sun;
    sun.id = document.takeId();
    document.lights.push_back(sun);
    const auto at = [&](float mix) {
        document.view.reflectionMix = mix;
        return centerPixel(draw(document)).y;
    };
    const float both = at(0.5f), diffuse = at(0.0f), reflections = at(1.0f), half = at(0.75f);
    EXPECT_NEAR(both, diffuse + reflections - 0.25f, 2e-3f * both); // emission is in both
    EXPECT_NEAR(half, 0.5f * diffuse + reflections - 0.125f, 2e-3f * both);
    EXPECT_GT(diffuse, 0.3f);
    EXPECT_GT(reflections, 0.26f);
}

TEST_F(Lighting, OneLampFollowsTheCosine) {
    Document document = matte();
    document.view.lighting = LightingMode::Cosine;
    document.view.reflectionMix = 0.0f;
    const auto lit = [&](const glm::vec3& toLight) {
        renderer().setIbl(lampOnly(toLight, glm::vec3(4.0f)));
        return centerPixel(draw(document)).x;
    };
    const float above = lit({0, 1, 0});
    EXPECT_GT(above, 0.1f);
    EXPECT_NEAR(lit({0.8f, 0.6f, 0}), 0.6f * above, 1e-3f * above);
    EXPECT_EQ(lit({0.8f, -0.6f, 0}), 0.0f);
    // Irradiance of nine coefficients knows the lamp less sharply: E9(-0.6) > 0 is possible, and
    // its peak is 15/16 of 1 at most.
    document.view.lighting = LightingMode::ShIrradiance;
    EXPECT_NEAR(lit({0, 1, 0}), above * (0.09375f + 0.5f + 0.46875f) / 0.9921875f, 1e-2f * above);
}

// What hides nothing pays no heed to ambient occlusion.
TEST_F(Lighting, ClassicalLightIgnoresOcclusion) {
    renderer().setIbl(uniformIbl(glm::vec3(1.0f)));
    Document document = matte();
    auto bake = std::make_shared<BakeArtifact>();
    bake->kind = BakeKind::AoVertex;
    bake->vertices.push_back(
        {1, 1, std::vector<float>(document.meshes[0].mesh->vertexCount(), 0.25f)});
    document.bakes = {bake};
    document.view.reflectionMix = 0.0f;
    const float dark = centerPixel(draw(document)).x;
    EXPECT_GT(dark, 0.05f);
    for (const LightingMode mode : {LightingMode::ShIrradiance, LightingMode::Unshadowed}) {
        document.view.lighting = mode;
        EXPECT_NEAR(centerPixel(draw(document)).x, 4.0f * dark, 0.01f * dark);
    }
}

} // namespace
} // namespace patina::render
