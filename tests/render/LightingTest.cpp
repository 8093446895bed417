// The lighting modes, from one directional light to baked transfer, and the mix of diffuse
// light and reflections.
#include "core/document/Lighting.h"
#include "core/bake/local/NearShadows.h"
#include "core/document/ViewChoices.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/math/Shading.h"
#include "core/math/SphericalHarmonics.h"
#include "render/pass/RelightPass.h"
#include "render/scene/EnvironmentLight.h"
#include "render/view/Recombine.h"
#include "tests/render/RenderTest.h"
#include "tests/render/TransferScenes.h"

#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/matrix.hpp>

namespace patina::render {
namespace {

using Lighting = RenderTest;

// Light of one direction: the irradiance of a directional light of E lux, and no reflections.
IblMaps dominantLightOnly(const glm::vec3& toLight, const glm::vec3& E) {
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
    document.view.background = BackgroundMode::Off;
    document.materials[0].metallic = 0.0f;
    return document;
}

TEST_F(Lighting, MixWeighsDiffuseLightAgainstReflections) {
    EXPECT_EQ(mixWeights(0.5f), glm::vec2(1.0f));
    EXPECT_EQ(mixWeights(0.0f), glm::vec2(1.0f, 0.0f));
    EXPECT_EQ(mixWeights(1.0f), glm::vec2(0.0f, 1.0f));
    EXPECT_EQ(mixWeights(0.75f), glm::vec2(0.5f, 1.0f));
    EXPECT_EQ(mixWeights(0.25f), glm::vec2(1.0f, 0.5f));

    sceneRenderer().setIbl(uniformIbl(glm::vec3(1.0f)));
    Document document = matte();
    document.materials[0].emissive = glm::vec3(0.25f);
    document.materials[0].emissiveStrength = 1.0f;
    const auto at = [&](float mix) {
        document.view.reflectionMix = mix;
        return centerPixel(draw(document)).y;
    };
    // Reflections that are not shown take nothing from the diffuse light.
    const float albedo = document.materials[0].baseColor.y;
    EXPECT_NEAR(at(0.0f), 0.25f + albedo, 1e-3f);
    const float specular = at(1.0f) - 0.25f;
    EXPECT_GT(specular, 0.02f);
    EXPECT_NEAR(at(0.5f), 0.25f + albedo * (1.0f - specular) + specular, 1e-3f);

    Light sun;
    sun.id = document.takeId();
    document.lights.push_back(sun);
    const float both = at(0.5f), diffuse = at(0.0f), reflections = at(1.0f);
    EXPECT_GT(diffuse, 0.3f + albedo);
    EXPECT_GT(reflections, 0.26f + specular);
    EXPECT_NEAR(at(0.25f), 0.5f * (diffuse + both), 2e-3f * both);
    EXPECT_NEAR(at(0.75f), 0.5f * (reflections + both), 2e-3f * both);
}

TEST_F(Lighting, TheDominantLightFollowsTheCosine) {
    Document document = matte();
    document.view.lighting = LightingMode::Cosine;
    document.view.reflectionMix = 0.0f;
    const auto lit = [&](const glm::vec3& toLight) {
        sceneRenderer().setIbl(dominantLightOnly(toLight, glm::vec3(4.0f)));
        return centerPixel(draw(document)).x;
    };
    const float above = lit({0, 1, 0});
    EXPECT_GT(above, 0.1f);
    EXPECT_NEAR(lit({0.8f, 0.6f, 0}), 0.6f * above, 1e-3f * above);
    EXPECT_EQ(lit({0.8f, -0.6f, 0}), 0.0f);
    // Irradiance of nine coefficients knows the light less sharply: E9(-0.6) > 0 is possible, and
    // its peak is 15/16 of 1 at most.
    document.view.lighting = LightingMode::ShIrradiance;
    EXPECT_NEAR(lit({0, 1, 0}), above * (0.09375f + 0.5f + 0.46875f) / 0.9921875f, 1e-2f * above);
}

// What hides nothing pays no heed to ambient occlusion.
TEST_F(Lighting, ClassicalLightIgnoresOcclusion) {
    sceneRenderer().setIbl(uniformIbl(glm::vec3(1.0f)));
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

// --- Transfer ---

// Light with something in all eight bands, different in every channel.
IblMaps lively() {
    IblMaps maps = uniformIbl(glm::vec3(0.0f));
    for (std::size_t i = 0; i < maps.radianceSh.size(); ++i) {
        const auto x = static_cast<float>(i);
        maps.radianceSh[i] =
            glm::vec3(std::sin(x), std::cos(1.3f * x), std::sin(2.1f * x + 1.0f)) * 0.3f;
    }
    maps.radianceSh[0] = glm::vec3(8.0f, 7.0f, 6.0f);
    std::copy_n(maps.radianceSh.begin(), 9, maps.irradianceSh.begin());
    convolveWithCosine(maps.irradianceSh);
    return maps;
}

Document ball() {
    Document document = makeScene(makeSphere(64));
    document.view.background = BackgroundMode::Off;
    document.materials[0].metallic = 0.0f;
    document.materials[0].baseColor = glm::vec3(1.0f);
    document.view.reflectionMix = 0.0f;
    return document;
}

// Every order, against the sum on the CPU at the middle of the ball.
TEST_F(Lighting, TransferIsTheDotProductInEveryOrder) {
    const IblMaps maps = lively();
    sceneRenderer().setIbl(maps);
    Document document = ball();
    document.view.lighting = LightingMode::Shadowed;
    const glm::vec3 n(0.0f, 0.0f, 1.0f); // the camera looks along -Z
    for (int order = 1; order <= 8; ++order) {
        document.bakes = {vertexBake(order, openTransfer(*document.meshes[0].mesh, order))};
        draw(document);
        const Result<Image> seen = renderer().readView(shading::kViewIrradiance, ViewMode::Raw);
        ASSERT_TRUE(seen);
        std::vector<float> y(static_cast<std::size_t>(shCount(order)));
        evaluateSh(order, n, std::span<float>(y));
        glm::vec3 expected(0.0f);
        for (int l = 0; l < order; ++l)
            for (int i = l * l; i < (l + 1) * (l + 1); ++i)
                expected += static_cast<float>(cosineConvolution(l)) *
                            y[static_cast<std::size_t>(i)] *
                            maps.radianceSh[static_cast<std::size_t>(i)];
        const glm::vec3 drawn(pixel(*seen, 31, 31));
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(drawn[c], expected[c], 0.03f * expected[c]) << "order " << order;
    }
}

// Of an open sky there is nothing to bake: the same light as through the transfer in closed form.
TEST_F(Lighting, UnshadowedNeedsNoBake) {
    sceneRenderer().setIbl(lively());
    Document document = ball();
    document.meshes[0].placement = glm::mat4(0.0f, 0.0f, -1.0f, 0.0f, 0.0f, 2.0f, 0.0f, 0.0f, 1.0f,
                                             0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f);
    document.environment().rotationDeg = 35.0f;
    document.environment().exposureEv = 0.5f;
    document.view.lighting = LightingMode::Unshadowed;
    const Image open = draw(document);
    // The transfer is in world space: that of the turned and stretched normals.
    Mesh turned = *document.meshes[0].mesh;
    const glm::mat3 toWorld =
        glm::transpose(glm::inverse(glm::mat3(document.meshes[0].placement.matrix())));
    for (glm::vec3& normal : turned.normals)
        normal = glm::normalize(toWorld * normal);
    document.view.lighting = LightingMode::Shadowed;
    document.bakes = {vertexBake(8, openTransfer(turned, 8))};
    const Image baked = draw(document);
    EXPECT_GT(centerPixel(open).x, 0.5f);
    float worst = 0.0f;
    for (std::size_t i = 0; i < open.f32().size(); ++i)
        worst = std::max(worst, std::abs(open.f32()[i] - baked.f32()[i]));
    EXPECT_LT(worst, 5e-3f);
}

// Half of the light straight, and of all three colours something by way of other surfaces.
TEST_F(Lighting, BouncesAddTheirColours) {
    sceneRenderer().setIbl(uniformIbl(glm::vec3(1.0f)));
    Document document = ball();
    const std::vector<float> open = openTransfer(*document.meshes[0].mesh, 3);
    std::vector<float> half = open, bounced(3 * open.size());
    for (std::size_t i = 0; i < open.size(); ++i) {
        half[i] *= 0.5f;
        for (std::size_t c = 0; c < 3; ++c)
            bounced[3 * i + c] = open[i] * (c == 0 ? 0.25f : c == 1 ? 0.125f : 0.0f);
    }
    const auto lit = [&](LightingMode mode) {
        document.view.lighting = mode;
        return glm::vec3(centerPixel(draw(document)));
    };
    document.bakes = {vertexBake(3, open)};
    const glm::vec3 all = lit(LightingMode::Prt);
    document.bakes = {vertexBake(3, half, bounced)};
    const glm::vec3 shadowed = lit(LightingMode::Shadowed), full = lit(LightingMode::Prt);
    const glm::vec3 expected = all * glm::vec3(0.75f, 0.625f, 0.5f);
    EXPECT_GT(all.x, 0.5f);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(shadowed[c], 0.5f * all[c], 2e-3f);
        EXPECT_NEAR(full[c], expected[c], 2e-3f);
    }

    // What a solver found for this light replaces the coefficients, until it is taken back.
    const std::size_t count = document.meshes[0].mesh->vertexCount();
    sceneRenderer().setBouncedLight(1, std::vector<glm::vec3>(count, glm::vec3(0.0f, 0.0f, 0.5f)));
    EXPECT_NEAR(centerPixel(draw(document)).z, all.z, 2e-3f);
    EXPECT_NEAR(centerPixel(draw(document)).x, 0.5f * all.x, 2e-3f);
    EXPECT_EQ(lit(LightingMode::Shadowed), shadowed);
    sceneRenderer().clearBouncedLight();
    EXPECT_EQ(lit(LightingMode::Prt), full);
}

// The left half of the texture sees nothing.
TEST_F(Lighting, TransferPerTexel) {
    sceneRenderer().setIbl(uniformIbl(glm::vec3(1.0f)));
    Document document = matte();
    document.view.reflectionMix = 0.0f;
    document.view.lighting = LightingMode::ShIrradiance;
    const float open = centerPixel(draw(document)).x;
    auto bake = std::make_shared<BakeArtifact>();
    bake->kind = BakeKind::PrtTexel;
    bake->order = 2;
    TexelBake texels;
    texels.material = 2;
    texels.side = 8;
    texels.stride = 4;
    texels.values.assign(8 * 8 * 4, 0.0f);
    for (std::size_t y = 0; y < 8; ++y)
        for (std::size_t x = 4; x < 8; ++x) {
            float* t = texels.values.data() + 4 * (8 * y + x);
            evaluateSh(2, glm::vec3(0, 1, 0), std::span<float>(t, 4));
            for (int i = 1; i < 4; ++i)
                t[i] *= 2.0f / 3.0f;
        }
    bake->texels = {texels};
    document.bakes = {bake};
    document.view.lighting = LightingMode::Prt;
    const Image picture = draw(document);
    EXPECT_GT(open, 0.05f);
    EXPECT_NEAR(pixel(picture, 44, 32).x, open, 2e-3f);
    EXPECT_NEAR(pixel(picture, 20, 32).x, 0.0f, 1e-4f);
    // Reflections go with it.
    document.view.reflectionMix = 1.0f;
    const Image reflections = draw(document);
    EXPECT_GT(pixel(reflections, 44, 32).x, 0.01f);
    EXPECT_NEAR(pixel(reflections, 20, 32).x, 0.0f, 1e-4f);
}

// --- Only what has changed is lit again ---

TEST_F(Lighting, StillLightCostsNothing) {
    GpuScene scene(context());
    ShaderLibrary shaders(context(), {});
    RelightPass relight(context(), shaders);
    Document document = ball();
    const std::uint64_t count = document.meshes[0].mesh->vertexCount();
    document.bakes = {vertexBake(3, openTransfer(*document.meshes[0].mesh, 3))};
    scene.update(document);
    gl::Buffer block(context(), "frame", sizeof(FrameBlock));
    const auto done = [&](LightingMode mode) {
        FrameBlock frame;
        scene.fill(frame, kDocumentLight, document.view.reflectionMix);
        block.writeValue(frame);
        block.bindUniform(kFrameBinding);
        const std::uint64_t before = relight.elementsDone();
        EXPECT_TRUE(relight.update(scene, {mode}, frame).ok());
        return relight.elementsDone() - before;
    };
    for (const LightingMode mode :
         {LightingMode::Ibl, LightingMode::Cosine, LightingMode::ShIrradiance})
        EXPECT_EQ(done(mode), 0u);
    for (const LightingMode mode :
         {LightingMode::Unshadowed, LightingMode::Shadowed, LightingMode::Prt}) {
        EXPECT_EQ(done(mode), count);
        EXPECT_EQ(done(mode), 0u);
    }
    // Side by side, neither takes the other's place.
    EXPECT_EQ(done(LightingMode::Unshadowed), 0u);
    EXPECT_EQ(done(LightingMode::Shadowed), 0u);
    const auto edited = [&] {
        scene.update(document);
        return done(LightingMode::Shadowed);
    };
    document.environment().exposureEv = 1.0f;
    EXPECT_EQ(edited(), count);
    EXPECT_EQ(done(LightingMode::Shadowed), 0u);
    Light lamp;
    lamp.id = 5;
    document.lights = {lamp};
    EXPECT_EQ(edited(), count);
    document.lights[0].shadowSoftness = 20.0f;
    EXPECT_EQ(edited(), count);
    EXPECT_EQ(relight.nearElementsDone(), 0u);
    document.lights[0].type = LightType::Point;
    EXPECT_EQ(edited(), count);
    EXPECT_EQ(done(LightingMode::Shadowed), 0u);
    // What is near is kept while the environment changes.
    EXPECT_EQ(relight.nearElementsDone(), count);
    document.environment().exposureEv = 2.0f;
    EXPECT_EQ(edited(), count);
    EXPECT_EQ(relight.nearElementsDone(), count);
    document.lights[0].position.x += 0.5f;
    EXPECT_EQ(edited(), count);
    document.lights[0].castsShadow = false; // says nothing to transfer
    document.view.exposureEv = 1.0f;
    EXPECT_EQ(edited(), 0u);
    document.meshes[0].placement = glm::translate(glm::mat4(1.0f), glm::vec3(0.0f, 0.1f, 0.0f));
    EXPECT_EQ(edited(), count);
    document.lights[0].enabled = false;
    EXPECT_EQ(edited(), count);
    document.meshes[0].placement = glm::mat4(1.0f); // transfer is of the world
    EXPECT_EQ(edited(), 0u);
    scene.previewVertices(BakeKind::PrtVertex, 1, 9, openTransfer(*document.meshes[0].mesh, 3));
    EXPECT_EQ(done(LightingMode::Shadowed), count);
    scene.setBouncedLight(kDocumentLight, 1, std::vector<glm::vec3>(count, glm::vec3(0.5f)));
    EXPECT_EQ(done(LightingMode::Shadowed), 0u);
    EXPECT_EQ(done(LightingMode::Prt), count);
    EXPECT_EQ(done(LightingMode::Prt), 0u);
}

// However many lights have traced shares, each item is lit by one dispatch for each kind of light.
TEST_F(Lighting, SharesOfAllLightsTakeOneDispatch) {
    GpuScene scene(context());
    ShaderLibrary shaders(context(), {});
    RelightPass relight(context(), shaders);
    Document document = ball();
    document.bakes = {vertexBake(3, openTransfer(*document.meshes[0].mesh, 3))};
    document.view.lighting = LightingMode::Shadowed;
    for (Id id = 1; id <= 8; ++id) {
        Light& light = document.lights.emplace_back();
        light.id = 100 + id;
        light.type = id <= 5 ? LightType::Point : LightType::Sphere;
    }
    scene.update(document);
    const auto shadows = traceNearShadows(nearShadowRequest(document), nullptr, 0, {});
    ASSERT_TRUE(shadows.ok());
    scene.setNearShadows(*shadows);
    EXPECT_EQ(scene.items()[0].lit->nearShares.sources.size(), 8u);
    gl::Buffer block(context(), "frame", sizeof(FrameBlock));
    const auto dispatches = [&] {
        FrameBlock frame;
        scene.fill(frame, kDocumentLight, document.view.reflectionMix);
        block.writeValue(frame);
        block.bindUniform(kFrameBinding);
        const std::uint64_t before = relight.nearDispatches();
        EXPECT_TRUE(relight.update(scene, {LightingMode::Shadowed}, frame).ok());
        return relight.nearDispatches() - before;
    };
    EXPECT_EQ(dispatches(), 2u); // points, spheres
    EXPECT_EQ(dispatches(), 0u);
    document.lights[2].position.x += 1.0f;
    scene.update(document);
    EXPECT_EQ(dispatches(), 2u);
}

// --- Occlusion of reflections ---

using shading::coneOcclusion;

glm::vec4 coneOf(const glm::vec3& bent, float visibility) {
    return {glm::normalize(bent) * visibility * 0.3257f, visibility};
}

TEST(ConeOcclusion, TakesNothingFromAnOpenSurface) {
    const glm::vec3 n(0.0f, 0.0f, 1.0f);
    for (const float alpha : {0.0f, 0.1f, 0.5f, 1.0f})
        for (const float angle : {0.0f, 0.5f, 1.2f, 1.55f})
            EXPECT_NEAR(
                coneOcclusion(coneOf(n, 1.0f), n, {std::sin(angle), 0.0f, std::cos(angle)}, alpha),
                1.0f, 1e-4f);
}

TEST(ConeOcclusion, FollowsWhatIsVisible) {
    const glm::vec3 n(0.0f, 0.0f, 1.0f), up = n;
    // Nothing is visible; less is visible; the lobe points away from what is visible.
    EXPECT_NEAR(coneOcclusion(glm::vec4(0.0f), n, up, 0.5f), 0.0f, 1e-5f);
    float last = 1.1f;
    for (const float visibility : {1.0f, 0.7f, 0.4f, 0.1f}) {
        const float open = coneOcclusion(coneOf(n, visibility), n, up, 1.0f);
        EXPECT_LT(open, last);
        last = open;
    }
    const glm::vec3 left = glm::normalize(glm::vec3(-1.0f, 0.0f, 1.0f));
    const glm::vec3 right(-left.x, 0.0f, left.z);
    EXPECT_GT(coneOcclusion(coneOf(left, 0.4f), n, left, 0.2f), 0.95f);
    EXPECT_LT(coneOcclusion(coneOf(left, 0.4f), n, right, 0.2f), 0.2f);
    // A lobe as wide as the hemisphere of a cone straight above: the share of solid angles,
    // (1 - sqrt(1 - 0.36)) / (1 - 1 / 3) = 0.3.
    EXPECT_NEAR(coneOcclusion(coneOf(n, 0.36f), n, up, 1.0f), 0.3f, 1e-3f);
}

// --- The explanation of a pixel ---

TEST_F(Lighting, PixelsUnderTransferAddUp) {
    Document document = makeScene(makeSphere(48));
    document.environment().image = makeEnvironment(64, [](const glm::vec3& d) {
        return glm::vec3(1.0f + d.x, 1.0f + 0.5f * d.y, 1.0f + d.z * d.x);
    });
    setIblOf(document);
    document.materials[0].perceptualRoughness = 0.3f;
    std::vector<float> values = openTransfer(*document.meshes[0].mesh, 4);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] *= i % 16 == 0 ? 0.2f : 0.1f;
    document.bakes = {vertexBake(4, std::move(values))};
    for (const LightingMode mode :
         {LightingMode::Cosine, LightingMode::ShIrradiance, LightingMode::Unshadowed,
          LightingMode::Shadowed, LightingMode::Prt})
        for (const float mix : {0.5f, 0.3f}) {
            document.view.lighting = mode;
            document.view.reflectionMix = mix;
            draw(document);
            const Result<Inspection> looked = renderer().inspect(36, 30);
            ASSERT_TRUE(looked) << looked.error().text();
            const RebuiltPixel rebuilt = recombine(*looked, document);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(rebuilt.radiance[c], looked->radiance[c], 1.0f / 255.0f)
                    << "mode " << static_cast<int>(mode) << " mix " << mix;
            if (mode == LightingMode::Shadowed) {
                EXPECT_LT(rebuilt.open, 0.99f);
            }
        }
}

} // namespace
} // namespace patina::render
