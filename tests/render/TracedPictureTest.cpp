// Pictures by paths beside those of the GPU: shown by it, and the same where it takes no shortcut.
#include "core/document/DisplayedPicture.h"
#include "core/document/ViewChoices.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/trace/document/DocumentTraceInputs.h"
#include "core/trace/path/PathTracer.h"
#include "tests/render/RenderTest.h"

#include <cmath>
#include <cstdio>
#include <gmock/gmock.h>

namespace patina::render {
namespace {

Image traced(const Document& document, int size, std::uint32_t samples) {
    const Result<TraceScene> scene = TraceScene::build(traceInputs(document), {});
    EXPECT_TRUE(scene.ok());
    TraceView view;
    view.camera = document.view.camera;
    view.width = view.height = size;
    view.transparent = true;
    Film film(size, size);
    EXPECT_TRUE(tracePaths(*scene, view, {}, film, 0, samples, {}).ok());
    return film.radiance(true);
}

class TracedPicture : public RenderTest {};

} // namespace

TEST_F(TracedPicture, IsShownAsTheViewDisplaysIt) {
    Document document = makeScene(makeSphere(12));
    document.view.exposureEv = 0.7f;
    const ImagePtr picture =
        makeImage(24, 16, 4, PixelType::F32, ColorEncoding::Linear, [](int x, int y, int c) {
            return c == 3 ? 1.0f : 0.02f * static_cast<float>((x * 7 + y * 13 + c * 5) % 97);
        });
    for (const ToneMap curve : {ToneMap::PbrNeutral, ToneMap::Aces, ToneMap::Reinhard}) {
        document.view.toneMap = curve;
        sceneRenderer().setDocument(document);
        FrameSettings frame;
        frame.width = 24;
        frame.height = 16;
        frame.samples = 1;
        frame.camera = document.view.camera;
        frame.radiance = picture;
        ASSERT_TRUE(renderer().render(frame, 0).ok());
        const Image linear = renderer().readLinear(), shown = renderer().readDisplayed();
        const Result<Image> expected = displayedPicture(*picture, document.view, {});
        ASSERT_TRUE(expected.ok());
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 24; ++x)
                for (int c = 0; c < 3; ++c) {
                    EXPECT_NEAR(linear.sample(x, y, c), picture->sample(x, y, c), 2e-3f);
                    EXPECT_NEAR(shown.sample(x, y, c), expected->sample(x, y, c), 1.5f / 255.0f);
                }
        // The scene itself again.
        frame.radiance = nullptr;
        ASSERT_TRUE(renderer().render(frame, 0).ok());
        EXPECT_NE(renderer().readLinear().sample(3, 3, 0), linear.sample(3, 3, 0));
    }
}

// A ball hides nothing of itself, light without extent leaves nothing to be approximated, and an
// environment that is the same all over is looked up exactly.
TEST_F(TracedPicture, IsTheViewportsWhereThatIsExact) {
    constexpr int kSize = 48;
    Document document = makeScene(makeSphere(128));
    document.view.background = BackgroundMode::Off;
    document.environment().image =
        makeEnvironment(8, [](const glm::vec3&) { return glm::vec3(0.5f, 0.6f, 0.7f); });
    Material& material = document.materials[0];
    material.baseColor = {0.8f, 0.5f, 0.2f};
    Light sun, lamp, spot;
    sun.type = LightType::Directional;
    sun.shadowSoftness = 0.0f;
    sun.castsShadow = false;
    lamp.type = LightType::Point;
    lamp.position = {2.0f, 2.0f, 3.0f};
    lamp.intensity = 8.0f;
    spot.type = LightType::Spot;
    spot.position = {-3.0f, 0.5f, 2.0f};
    spot.azimuthDeg = -56.0f;
    spot.elevationDeg = 8.0f;
    spot.intensity = 10.0f;
    spot.castsShadow = false;
    Id id = 100;
    for (Light light : {sun, lamp, spot}) {
        light.id = ++id;
        document.lights.push_back(light);
    }
    for (const float metallic : {0.0f, 0.6f, 1.0f})
        // Narrower highlights differ within a pixel, of which the viewport takes the middle.
        for (const float roughness : {0.45f, 0.7f, 1.0f}) {
            material.metallic = metallic;
            material.perceptualRoughness = roughness;
            setIblOf(document);
            FrameSettings settings;
            settings.floats = true;
            const Image drawn = draw(document, kSize, settings);
            const Image paths = traced(document, kSize, 256);
            glm::dvec3 mean(0.0), expected(0.0);
            for (int y = 0; y < kSize; ++y)
                for (int x = 0; x < kSize; ++x)
                    for (int c = 0; c < 3; ++c) {
                        // Edges are sampled by each in its own way.
                        if (drawn.sample(x, y, 3) < 1.0f || paths.sample(x, y, 3) < 1.0f)
                            continue;
                        mean[c] += static_cast<double>(paths.sample(x, y, c));
                        expected[c] += static_cast<double>(drawn.sample(x, y, c));
                    }
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(mean[c] / expected[c], 1.0, 0.002)
                    << "metallic " << metallic << ", roughness " << roughness << ", " << c;
        }
}

// The mean over points of the lens is the path tracer's blur.
TEST_F(TracedPicture, HasTheDepthOfFieldOfTheViewports) {
    constexpr int kSize = 48;
    Document document = makeScene(makeSphere(64));
    document.view.background = BackgroundMode::Off;
    document.materials[0].baseColor = glm::vec3(0.0f);
    document.materials[0].emissive = {0.5f, 1.0f, 0.25f};
    document.environment().image =
        makeEnvironment(8, [](const glm::vec3&) { return glm::vec3(0.0f); });
    Camera& camera = document.view.camera;
    camera.lens = {true, 0.06f, 0.6f * camera.distance};
    setIblOf(document);
    sceneRenderer().setDocument(document);
    FrameSettings frame;
    frame.width = frame.height = kSize;
    frame.floats = true;
    frame.camera = camera;
    frame = withDepthOfField(frame);
    ASSERT_TRUE(frame.accumulate);
    int frames = 0;
    do {
        ASSERT_TRUE(renderer().render(frame, 0).ok());
        ASSERT_LE(++frames, ViewRenderer::kLensFrames);
    } while (!renderer().isSteady());
    EXPECT_EQ(frames, ViewRenderer::kLensFrames);
    const Image drawn = renderer().readLinear(), paths = traced(document, kSize, 1024);
    frame.camera.lens.depthOfField = false;
    frame.accumulate = false;
    ASSERT_TRUE(renderer().render(frame, 0).ok());
    const Image pinhole = renderer().readLinear();
    const auto compare = [&](const Image& a) { // RMS of what covers; light
        double squares = 0.0, mean = 0.0, expected = 0.0;
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x) {
                const double apart = static_cast<double>(a.sample(x, y, 3)) -
                                     static_cast<double>(paths.sample(x, y, 3));
                squares += apart * apart;
                mean += static_cast<double>(a.sample(x, y, 1));
                expected += static_cast<double>(paths.sample(x, y, 1));
            }
        return std::pair(std::sqrt(squares / (kSize * kSize)), mean / expected);
    };
    const auto [rms, light] = compare(drawn);
    EXPECT_LT(rms, 0.015); // 64 points of the lens, 1024 paths
    EXPECT_GT(compare(pinhole).first, 10.0 * rms);
    EXPECT_NEAR(light, 1.0, 0.005);
}

// Maps lie on the surface as the viewport has them, turned and scaled, normals included.
TEST_F(TracedPicture, HasTheViewportsMaps) {
    constexpr int kSize = 64;
    Document document = makeScene(makePlane());
    document.view.camera = cameraAbove();
    document.view.background = BackgroundMode::Off;
    Light sun;
    sun.id = 100;
    sun.type = LightType::Directional;
    sun.shadowSoftness = 0.0f;
    sun.azimuthDeg = 70.0f;
    document.lights = {sun};
    Material& material = document.materials[0];
    material.perceptualRoughness = 0.7f;
    const auto gradient = [](ColorEncoding encoding) {
        return makeImage(16, 16, 3, PixelType::U8, encoding, [](int x, int y, int c) {
            return (c == 0   ? 0.2f + 0.04f * static_cast<float>(x)
                    : c == 1 ? 0.3f + 0.03f * static_cast<float>(y)
                             : 0.9f);
        });
    };
    for (const float turn : {0.0f, 30.0f}) {
        material.baseColorMap.image = gradient(ColorEncoding::Srgb);
        material.normalMap.image = gradient(ColorEncoding::Data);
        material.perceptualRoughnessMap.image = gradient(ColorEncoding::Data);
        material.perceptualRoughnessMap.channel = MapChannel::G;
        for (MapSlot* map : {&material.baseColorMap, &material.normalMap}) {
            map->uvScale = {0.7f, 0.5f};
            map->uvOffset = {0.2f, 0.3f};
            map->uvRotationDeg = turn;
        }
        FrameSettings settings;
        settings.floats = true;
        const Image drawn = draw(document, kSize, settings);
        const Image paths = traced(document, kSize, 64);
        double worst = 0.0;
        int compared = 0;
        for (int y = 4; y < kSize - 4; ++y)
            for (int x = 4; x < kSize - 4; ++x) {
                if (drawn.sample(x, y, 3) < 1.0f || paths.sample(x, y, 3) < 1.0f)
                    continue;
                ++compared;
                for (int c = 0; c < 3; ++c)
                    worst = std::max(worst, std::abs(static_cast<double>(paths.sample(x, y, c)) -
                                                     static_cast<double>(drawn.sample(x, y, c))));
            }
        EXPECT_GT(compared, 1000);
        EXPECT_LT(worst, 0.02) << "turned by " << turn;
    }
}

// A base colour that cannot be read shows as the viewport's pattern, not as white.
TEST_F(TracedPicture, LacksWhatTheViewportLacks) {
    constexpr int kSize = 48;
    Document document = makeScene(makePlane());
    document.view.camera = cameraAbove();
    document.view.background = BackgroundMode::Off;
    Material& material = document.materials[0];
    material.perceptualRoughness = 1.0f;
    material.baseColorMap.source = "missing.png";
    ASSERT_TRUE(material.baseColorMap.assigned());
    Light sun;
    sun.id = 100;
    sun.type = LightType::Directional;
    sun.shadowSoftness = 0.0f;
    document.lights = {sun};
    FrameSettings settings;
    settings.floats = true;
    const Image drawn = draw(document, kSize, settings);
    const Image paths = traced(document, kSize, 64);
    int magenta = 0, same = 0;
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            const bool is = drawn.sample(x, y, 0) > 2.0f * drawn.sample(x, y, 1) + 1e-4f;
            magenta += is ? 1 : 0;
            same += is == (paths.sample(x, y, 0) > 2.0f * paths.sample(x, y, 1) + 1e-4f) ? 1 : 0;
        }
    EXPECT_GT(magenta, kSize * kSize / 8);
    EXPECT_LT(magenta, kSize * kSize * 7 / 8);
    EXPECT_GT(same, kSize * kSize * 8 / 10) << "but for the edges of its fields";
}

} // namespace patina::render
