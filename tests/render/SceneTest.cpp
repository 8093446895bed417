// What the renderer does with the rest of a document: environments, bakes, picking, changes.
#include "core/document/ViewChoices.h"
#include "core/light/Light.h"
#include "core/light/Orientation.h"
#include "core/material/Material.h"
#include "core/math/Shading.h"
#include "core/math/SphericalHarmonics.h"
#include "render/scene/Blocks.h"
#include "render/scene/EnvironmentLight.h"
#include "tests/render/RenderTest.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

namespace patina::render {
namespace {

using Scene = RenderTest;

// A soft spot of light around `direction` on black.
ImagePtr spot(const glm::vec3& direction) {
    return makeEnvironment(128, [=](const glm::vec3& d) {
        return glm::vec3(glm::dot(d, direction) > 0.95f ? 10.0f : 0.0f);
    });
}

// A camera at `position` on the unit circle looking at the origin; yaw 0 stands at +Z.
float yawTowards(const glm::vec3& position) {
    return glm::degrees(std::atan2(position.x, position.z));
}

TEST_F(Scene, EnvironmentRotatesCounterClockwiseSeenFromAbove) {
    // The spot lies at -Z. Turned by 90° it comes to -X, by -90° to +X.
    const struct {
        float rotationDeg;
        glm::vec3 at;
    } cases[] = {{0.0f, {0, 0, -1}}, {90.0f, {-1, 0, 0}}, {-90.0f, {1, 0, 0}}, {180.0f, {0, 0, 1}}};
    Document document = makeScene(makeSphere());
    document.environment().image = spot({0, 0, -1});
    document.view.background = BackgroundMode::Environment;
    Material& m = document.materials[0];
    setIblOf(document);
    for (const auto& c : cases) {
        SCOPED_TRACE(c.rotationDeg);
        document.environment().rotationDeg = c.rotationDeg;

        // Background: look away from the sphere, straight at the spot.
        document.meshes[0].visible = false;
        document.view.camera.yawDeg = yawTowards(-c.at);
        EXPECT_NEAR(centerPixel(draw(document)).x, 10.0f, 0.1f);
        document.view.background = BackgroundMode::Blurred;
        EXPECT_GT(centerPixel(draw(document)).x, 2.0f);
        document.view.background = BackgroundMode::Environment;
        document.view.camera.yawDeg = yawTowards(c.at);
        EXPECT_EQ(centerPixel(draw(document)).x, 0.0f);

        // Mirror and diffuse: the side of the sphere that faces the spot is the bright one.
        document.meshes[0].visible = true;
        m.metallic = 1.0f;
        m.baseColor = glm::vec3(1.0f);
        m.perceptualRoughness = 0.0f;
        EXPECT_NEAR(centerPixel(draw(document)).x, 10.0f, 0.5f);
        m.metallic = 0.0f;
        m.perceptualRoughness = 1.0f;
        const float lit = centerPixel(draw(document)).x;
        document.view.camera.yawDeg = yawTowards(-c.at);
        const float dark = centerPixel(draw(document)).x;
        EXPECT_GT(lit, 0.3f);
        EXPECT_LT(dark, 0.1f * lit);
    }
}

TEST_F(Scene, BackgroundIsAsBlurredAsAskedOrOff) {
    Document document = makeScene(makeSphere());
    document.environment().image = spot({0, 0, -1});
    document.meshes[0].visible = false;
    document.view.camera.yawDeg = yawTowards({0, 0, 1});
    setIblOf(document);
    document.view.background = BackgroundMode::Blurred;
    float last = 11.0f; // the more blurred, the darker the middle of the spot
    for (const float blur : {0.0f, 0.5f, 1.0f}) {
        document.view.backgroundBlur = blur;
        const glm::vec4 middle = centerPixel(draw(document));
        EXPECT_LT(middle.x, last - 1.0f) << blur;
        EXPECT_EQ(middle.w, 1.0f);
        last = middle.x;
    }
    document.view.background = BackgroundMode::Off;
    EXPECT_EQ(centerPixel(draw(document)), glm::vec4(0.0f));
}

// Fewer triangles may be drawn where that is hardly seen, only when asked for, and never close up.
TEST_F(Scene, ACoarseFrameLooksLikeTheFineOne) {
    Document document = makeScene(makeSphere(128));
    ASSERT_GT(document.triangleCount(), 30'000u);
    sceneRenderer().setIbl(uniformIbl(glm::vec3(1.0f)));
    document.materials[0].metallic = 1.0f;
    FrameSettings fine, coarse;
    fine.samples = coarse.samples = 1;
    coarse.coarse = true;
    const auto compare = [&] {
        const Image before = draw(document, 64, fine);
        coarse.reuseScene = true; // in vain: it is not the same scene
        const Image between = draw(document, 64, coarse);
        EXPECT_EQ(draw(document, 64, fine), before) << "nothing of it is left";
        double sum = 0.0;
        for (std::size_t i = 0; i < before.f32().size(); ++i)
            sum += static_cast<double>(std::abs(between.f32()[i] - before.f32()[i]));
        return sum / static_cast<double>(before.f32().size());
    };
    const double difference = compare();
    EXPECT_GT(difference, 0.0);
    EXPECT_LT(difference, 0.01);
    document.meshes[0].placement = glm::scale(glm::mat4(1.0f), glm::vec3(0.01f));
    document.view.camera.distance = 0.05f;
    EXPECT_GT(compare(), 0.0) << "the size in the picture counts, not that in the world";
    document.view.camera.distance = 0.015f;
    EXPECT_EQ(compare(), 0.0) << "close up";
    document.view.camera.distance = 0.0f;
    EXPECT_EQ(compare(), 0.0) << "inside";
}

TEST_F(Scene, BackgroundHasNoSeamAndMatchesTheImage) {
    // A smooth sky: the column behind the seam (+Z) must be as smooth as any other.
    Document document = makeScene(makeSphere());
    document.meshes[0].visible = false;
    const auto sky = [](const glm::vec3& d) {
        return glm::vec3(0.5f + 0.5f * d.x, 0.5f + 0.5f * d.y, 0.5f + 0.5f * d.z);
    };
    setBackground(makeEnvironment(256, sky), uniformIbl(glm::vec3(0.0f)));
    document.view.background = BackgroundMode::Environment;
    document.view.camera.yawDeg = 180.0f; // looks along +Z
    document.view.camera.fovDeg = 60.0f;
    const Image image = draw(document, 128);
    const float half = std::tan(glm::radians(30.0f));
    float worst = 0.0f;
    for (int y = 0; y < 128; ++y)
        for (int x = 0; x < 128; ++x) {
            const float right = ((static_cast<float>(x) + 0.5f) / 64.0f - 1.0f) * half;
            const float up = (1.0f - (static_cast<float>(y) + 0.5f) / 64.0f) * half;
            const glm::vec3 d = glm::normalize(glm::vec3(-right, up, 1.0f));
            worst = std::max(worst, glm::length(glm::vec3(pixel(image, x, y)) - sky(d)));
        }
    EXPECT_LT(worst, 0.01f);
}

// A tilted and rolled environment is seen, and lights, as its orientation says.
TEST_F(Scene, EnvironmentsAreTiltedAndRolled) {
    Document document = makeScene(makeSphere(64));
    const auto sky = [](const glm::vec3& d) {
        return glm::vec3(0.5f + 0.5f * d.x, 0.5f + 0.5f * d.y, 0.5f + 0.5f * d.z);
    };
    document.environment().image = makeEnvironment(256, sky);
    document.environment().rotationDeg = 50.0f;
    document.environment().tiltDeg = 40.0f;
    document.environment().rollDeg = -25.0f;
    document.view.background = BackgroundMode::Environment;
    document.view.camera.yawDeg = 0.0f; // looks along -Z
    document.view.camera.pitchDeg = 0.0f;
    document.view.camera.fovDeg = 60.0f;
    document.materials[0].baseColor = glm::vec3(1.0f);
    document.materials[0].perceptualRoughness = 1.0f;
    setIblOf(document);
    const Orientation stands = orientationOf(document.environment());
    const auto radianceFrom = [&](const glm::vec3& d) { return sky(stands.toPicture(d)); };
    const Image image = draw(document, 128);
    const float half = std::tan(glm::radians(30.0f));
    for (const glm::ivec2 at : {glm::ivec2(3, 5), {124, 4}, {5, 120}, {122, 123}}) {
        const float right = ((static_cast<float>(at.x) + 0.5f) / 64.0f - 1.0f) * half;
        const float up = (1.0f - (static_cast<float>(at.y) + 0.5f) / 64.0f) * half;
        const glm::vec3 d = glm::normalize(glm::vec3(right, up, -1.0f));
        EXPECT_LT(glm::length(glm::vec3(pixel(image, at.x, at.y)) - radianceFrom(d)), 0.01f)
            << at.x << ' ' << at.y;
    }
    // The irradiance of a sky 1/2 + d/2 is pi/2 + pi/3 of its axis' share.
    const Result<Image> irradiance = renderer().readView(shading::kViewIrradiance, ViewMode::Raw);
    ASSERT_TRUE(irradiance.ok());
    const glm::vec3 p = stands.toPicture({0, 0, 1});
    EXPECT_LT(
        glm::length(glm::vec3(pixel(*irradiance, 64, 64)) - glm::pi<float>() * (0.5f + p / 3.0f)),
        0.04f);
}

// Unshadowed transfer: T_i = ∫ max(0, n·ω) Y_i(ω) dω / pi = A_l Y_i(n) / pi.
std::vector<float> unshadowedTransfer(const Mesh& mesh, int order) {
    const auto stride = static_cast<std::size_t>(shCount(order));
    std::vector<float> values(mesh.vertexCount() * stride);
    for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
        std::vector<float> y(stride);
        evaluateSh(order, mesh.normals[v], std::span<float>(y));
        for (int l = 0; l < order; ++l)
            for (int m = -l; m <= l; ++m) {
                const auto i = static_cast<std::size_t>(shIndex(l, m));
                values[v * stride + i] =
                    static_cast<float>(cosineConvolution(l)) * y[i] / glm::pi<float>();
            }
    }
    return values;
}

TEST_F(Scene, PrtWithUnshadowedTransferIsTheIrradianceLighting) {
    Document document = makeScene(makeSphere(64));
    document.environment().image = makeEnvironment(64, [](const glm::vec3& d) {
        return glm::vec3(1.0f + d.x, 1.0f + 0.5f * d.y, 1.0f + d.z * d.x);
    });
    document.environment().rotationDeg = 35.0f;
    document.environment().exposureEv = 0.5f;
    document.materials[0].perceptualRoughness = 0.8f;
    setIblOf(document);
    FrameSettings settings;
    settings.samples = 1; // a covered sample of a silhouette is shaded outside its triangle
    const Image ibl = draw(document, 64, settings);
    for (const int order : {3, 5}) {
        auto artifact = std::make_shared<BakeArtifact>();
        artifact->kind = BakeKind::PrtVertex;
        artifact->order = order;
        artifact->vertices.push_back(
            {1, shCount(order), unshadowedTransfer(*document.meshes[0].mesh, order)});
        document.bakes = {artifact};
        document.view.lighting = LightingMode::Prt;
        const Image prt = draw(document, 64, settings);
        double sum = 0.0;
        float worst = 0.0f;
        for (std::size_t i = 0; i < prt.f32().size(); ++i) {
            worst = std::max(worst, std::abs(prt.f32()[i] - ibl.f32()[i]));
            sum += prt.f32()[i];
        }
        EXPECT_LT(worst, order == 3 ? 5e-3f : 5e-2f) << "order " << order;
        EXPECT_GT(sum, 100.0);
        document.view.lighting = LightingMode::Ibl;
        EXPECT_EQ(draw(document, 64, settings), ibl)
            << "a bake must not touch image-based lighting";
    }

    // Half the transfer, as a live preview: the diffuse part halves; clearing brings the bake back.
    document.view.lighting = LightingMode::Prt;
    document.materials[0].metallic = 0.0f;
    const float attached = centerPixel(draw(document)).x;
    std::vector<float> none(document.meshes[0].mesh->vertexCount() * 9, 0.0f);
    sceneRenderer().previewVertices(BakeKind::PrtVertex, 1, 9, none);
    const float specularOnly = centerPixel(draw(document)).x;
    std::vector<float> halfTransfer = unshadowedTransfer(*document.meshes[0].mesh, 3);
    for (float& value : halfTransfer)
        value *= 0.5f;
    sceneRenderer().previewVertices(BakeKind::PrtVertex, 1, 9, halfTransfer);
    const float half = centerPixel(draw(document)).x;
    EXPECT_GT(attached, 2.0f * specularOnly);
    EXPECT_NEAR(half - specularOnly, 0.5f * (attached - specularOnly), 0.02f * attached);
    sceneRenderer().clearPreview();
    EXPECT_EQ(centerPixel(draw(document)).x, attached);
}

TEST_F(Scene, BakedOcclusionDarkensAmbientLightOnly) {
    sceneRenderer().setIbl(uniformIbl(glm::vec3(1.0f)));
    Document document = makeScene(makePlane());
    document.view.camera = cameraAbove();
    document.materials[0].perceptualRoughness = 1.0f;
    const float open = centerPixel(draw(document)).x;
    const auto withVertexAo = [&](float value) {
        auto artifact = std::make_shared<BakeArtifact>();
        artifact->kind = BakeKind::AoVertex;
        artifact->vertices.push_back({1, 1, std::vector<float>(4, value)});
        return artifact;
    };
    document.bakes = {withVertexAo(0.0f)};
    EXPECT_NEAR(centerPixel(draw(document)).x, 0.0f, 0.02f);
    document.bakes = {withVertexAo(0.5f)};
    EXPECT_NEAR(centerPixel(draw(document)).x, 0.5f * open, 0.02f);
    document.materials[0].occlusionStrength = 0.5f;
    EXPECT_NEAR(centerPixel(draw(document)).x, 0.75f * open, 0.02f);
    document.materials[0].occlusionStrength = 1.0f;

    // A bake for another number of vertices is not drawn.
    auto other = std::make_shared<BakeArtifact>(*withVertexAo(0.0f));
    other->vertices[0].values.push_back(0.0f);
    document.bakes = {other};
    EXPECT_EQ(centerPixel(draw(document)).x, open);

    // A texel bake goes before the vertex bake and replaces the material's map.
    auto texel = std::make_shared<BakeArtifact>();
    texel->kind = BakeKind::AoTexel;
    texel->texels.push_back({2, makeImage(4, 4, 1, PixelType::F32, ColorEncoding::Data,
                                          [](int, int, int) { return 0.25f; })});
    document.materials[0].occlusionMap.image =
        makeImage(2, 2, 1, PixelType::U8, ColorEncoding::Data, [](int, int, int) { return 0.6f; });
    document.bakes = {withVertexAo(0.5f), texel};
    EXPECT_NEAR(centerPixel(draw(document)).x, 0.25f * open, 0.02f);
    document.bakes.clear();
    EXPECT_NEAR(centerPixel(draw(document)).x, 0.6f * open, 0.02f);

    // Live texels hide everything else.
    sceneRenderer().previewTexels(2, 2, std::vector<float>(4, 0.1f));
    EXPECT_NEAR(centerPixel(draw(document)).x, 0.1f * open, 0.02f);
    sceneRenderer().previewVertices(BakeKind::AoVertex, 1, 1, std::vector<float>(4, 0.9f));
    sceneRenderer().clearPreview();
    EXPECT_NEAR(centerPixel(draw(document)).x, 0.6f * open, 0.02f);

    // Analytic light is not ambient.
    sceneRenderer().setIbl(uniformIbl(glm::vec3(0.0f)));
    Light light;
    light.elevationDeg = 90.0f;
    document.lights = {light};
    const float lit = centerPixel(draw(document)).x;
    document.bakes = {withVertexAo(0.0f)};
    EXPECT_EQ(centerPixel(draw(document)).x, lit);
    EXPECT_GT(lit, 0.5f);
}

TEST_F(Scene, PickReturnsTheNearestInstanceUnderThePixel) {
    Document document = makeScene(makeSphere(16));
    document.meshes[0].id = 41;
    MeshInstance behind = document.meshes[0];
    behind.id = 42;
    behind.placement = glm::scale(glm::translate(glm::mat4(1.0f), {0.5f, 0, -3}), glm::vec3(2.0f));
    document.meshes.push_back(behind);
    document.view.camera.distance = 8.0f;
    EXPECT_EQ(renderer().pick(10, 10), 0u) << "before the first frame";
    draw(document, 100);
    EXPECT_EQ(renderer().pick(50, 50), 41u);
    EXPECT_EQ(renderer().pick(80, 50), 42u); // right of the small one
    EXPECT_EQ(renderer().pick(0, 0), 0u);
    EXPECT_EQ(renderer().pick(-1, 50), 0u);
    EXPECT_EQ(renderer().pick(50, 100), 0u);
    // Rows count from the top.
    document.meshes[1].placement = glm::translate(glm::mat4(1.0f), glm::vec3(0.0f, 2.05f, 0.0f));
    document.view.camera.fovDeg = 45.0f;
    draw(document, 100);
    EXPECT_EQ(renderer().pick(50, 20), 42u);
    document.meshes[1].visible = false;
    draw(document, 100);
    EXPECT_EQ(renderer().pick(50, 20), 0u);
    EXPECT_EQ(renderer().pick(50, 50), 41u);

    // What a mask cuts away cannot be picked.
    document.materials[0].alphaMode = AlphaMode::Mask;
    document.materials[0].opacity = 0.0f;
    draw(document, 100);
    EXPECT_EQ(renderer().pick(50, 50), 0u);
}

TEST_F(Scene, MultisamplingSmoothsEdgesAndLeavesTheInsideAlone) {
    Document document = makeScene(makePlane());
    document.view.camera = cameraAbove();
    document.view.camera.distance = 12.0f;
    document.meshes[0].placement = glm::rotate(glm::mat4(1.0f), 0.3f, glm::vec3(0, 1, 0));
    document.materials[0].baseColor = glm::vec3(0.0f);
    document.materials[0].emissive = glm::vec3(1.0f);
    FrameSettings settings;
    const auto levels = [&](int samples) {
        settings.samples = samples;
        const Image image = draw(document, 64, settings);
        std::set<float> seen;
        for (std::size_t i = 0; i < image.f32().size(); i += 4)
            seen.insert(image.f32()[i]);
        EXPECT_EQ(centerPixel(image).x, 1.0f);
        return seen.size();
    };
    EXPECT_EQ(levels(1), 2u);
    EXPECT_EQ(levels(4), 5u);
}

TEST_F(Scene, SmallChangesReachThePicture) {
    sceneRenderer().setIbl(uniformIbl(glm::vec3(1.0f)));
    Document document = makeScene(makePlane());
    document.view.camera = cameraAbove();
    document.materials[0].baseColor = glm::vec3(0.2f);
    const float before = centerPixel(draw(document)).x;
    const auto redraw = [&] {
        sceneRenderer().setDocument(document);
        FrameSettings settings;
        settings.width = settings.height = 64;
        settings.camera = document.view.camera;
        EXPECT_TRUE(renderer().render(settings, 0).ok());
        return centerPixel(renderer().readLinear()).x;
    };
    document.materials[0].baseColor = glm::vec3(0.4f);
    const float brighter = redraw();
    EXPECT_GT(brighter, 1.5f * before);
    // A number that changes the shader's variant, too.
    document.materials[0].alphaMode = AlphaMode::Mask;
    document.materials[0].opacity = 0.1f;
    EXPECT_EQ(redraw(), 0.0f);
    document.materials[0].alphaMode = AlphaMode::Opaque;
    EXPECT_EQ(redraw(), brighter);
    document.meshes[0].visible = false;
    EXPECT_EQ(redraw(), 0.0f);
    document.meshes[0].visible = true;
    document.lights.push_back(Light{});
    EXPECT_GT(redraw(), brighter);
    document.lights[0].enabled = false;
    EXPECT_EQ(redraw(), brighter);
    document.view.backgroundColor = glm::vec3(0.5f);
    document.meshes.clear();
    EXPECT_EQ(redraw(), 0.5f);
}

TEST_F(Scene, MoreLightsThanThereIsRoomForAreLeftOut) {
    Document document = makeScene(makePlane());
    document.view.camera = cameraAbove();
    Light light;
    light.elevationDeg = 90.0f;
    light.intensity = 1e-3f;
    light.castsShadow = false;
    const auto lit = [&](std::size_t count) {
        document.lights.assign(count, light);
        return centerPixel(draw(document, 8)).x;
    };
    const float one = lit(1);
    for (const int count : {64, 65, 70, kMaxLights}) // half floats
        EXPECT_NEAR(lit(std::size_t(count)), float(count) * one, 2e-3f * float(count) * one);
    EXPECT_NEAR(lit(kMaxLights + 400), float(kMaxLights) * one, 2e-3f * float(kMaxLights) * one);
}

TEST_F(Scene, ImpossibleSizesAreErrors) {
    Document document = makeScene(makePlane());
    FrameSettings settings;
    settings.width = 0;
    settings.height = 10;
    auto done = renderer().render(settings, 0);
    ASSERT_FALSE(done.ok());
    EXPECT_EQ(done.error().kind, ErrorKind::Usage);
    settings.width = 1'000'000;
    EXPECT_FALSE(renderer().render(settings, 0).ok());
}

TEST_F(Scene, OverlaysShowOnTheDisplayedPictureOnly) {
    Document document = makeScene(makeSphere(24));
    document.meshes[0].placement = glm::translate(glm::mat4(1.0f), glm::vec3(0, 1, 0));
    document.view.camera.pitchDeg = 20.0f;
    document.view.camera.distance = 8.0f;
    Light light;
    light.type = LightType::Point;
    light.position = {1.5f, 1.8f, 0.0f};
    document.lights = {light};
    const Image plain = draw(document, 128);
    const Image plainDisplayed = renderer().readDisplayed();
    FrameSettings settings;
    settings.showOverlays = true;
    settings.selectedMesh = 1;
    EXPECT_EQ(draw(document, 128, settings), plain);
    const Image overlaid = renderer().readDisplayed();
    int amber = 0, changed = 0;
    for (int y = 0; y < 128; ++y)
        for (int x = 0; x < 128; ++x) {
            const glm::vec4 p = pixel(overlaid, x, y);
            amber += p.x > 0.9f && p.y > 0.5f && p.y < 0.7f && p.z < 0.3f ? 1 : 0;
            changed += p != pixel(plainDisplayed, x, y) ? 1 : 0;
        }
    EXPECT_GT(amber, 60) << "outline";
    EXPECT_GT(changed, 500) << "grid";
}

} // namespace
} // namespace patina::render
