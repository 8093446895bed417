// Pictures lit with a light map: closer to the traced one, and explained.
#include "core/document/ViewChoices.h"
#include "core/edit/Edit.h"
#include "core/edit/Parameters.h"
#include "core/material/Material.h"
#include "core/trace/document/DocumentLightMap.h"
#include "core/trace/document/DocumentTraceInputs.h"
#include "core/trace/path/PathTracer.h"
#include "render/view/Explanation.h"
#include "tests/render/RenderTest.h"

#include <cmath>
#include <gmock/gmock.h>

namespace patina::render {
namespace {

constexpr int kSize = 48;

// A glossy floor under a red square of half its side, in a sky that is brighter on one side.
Document roofedFloor() {
    Document document = makeScene(makePlane());
    document.view.camera = cameraAbove();
    document.view.camera.pitchDeg = 35.0f;
    document.view.background = BackgroundMode::Off;
    document.environment().image = makeEnvironment(
        32, [](const glm::vec3& d) { return glm::vec3(1.0f + 0.8f * d.x, 1.0f, 0.8f); });
    Material& floor = document.materials[0];
    floor.baseColor = {0.6f, 0.6f, 0.6f};
    floor.metallic = 0.0f;
    floor.perceptualRoughness = 0.4f;
    Material roof = floor;
    roof.id = 12;
    roof.baseColor = {0.8f, 0.1f, 0.05f};
    roof.doubleSided = true;
    document.materials.push_back(roof);
    MeshInstance instance;
    instance.id = 11;
    instance.mesh = makePlane();
    instance.material = 12;
    instance.placement = glm::mat4(0.5f, 0, 0, 0, 0, -0.5f, 0, 0, 0, 0, -0.5f, 0, 0, 0.5f, 0, 1);
    document.meshes.push_back(instance);
    document.nextId = 13;
    return document;
}

class LightMapPicture : public RenderTest {
  protected:
    static BakeArtifactPtr bakedFor(const Document& document) {
        const auto inputs = lightMapInputs(document, [](const Image& image) {
            return computeIbl(image, {.cubeSize = 32, .levels = 5}, JobContext());
        });
        EXPECT_TRUE(inputs.ok());
        LightMapSettings settings;
        settings.size = 32;
        settings.samples = 128;
        Result<BakeArtifact> bake = bakeLightMap(*inputs, settings, JobContext());
        EXPECT_TRUE(bake.ok());
        return std::make_shared<const BakeArtifact>(*std::move(bake));
    }

    static Image traced(const Document& document) {
        const Result<TraceScene> scene = TraceScene::build(traceInputs(document), {});
        EXPECT_TRUE(scene.ok());
        TraceView view;
        view.camera = document.view.camera;
        view.width = view.height = kSize;
        view.transparent = true;
        Film film(kSize, kSize);
        EXPECT_TRUE(tracePaths(*scene, view, {}, film, 0, 256, {}).ok());
        return film.radiance(true);
    }

    // Root mean square difference of what both see as covered whole.
    static double error(const Image& drawn, const Image& truth) {
        double sum = 0.0;
        int count = 0;
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x) {
                if (truth.sample(x, y, 3) < 1.0f || drawn.sample(x, y, 3) < 1.0f)
                    continue;
                for (int c = 0; c < 3; ++c) {
                    const double d =
                        static_cast<double>(drawn.sample(x, y, c) - truth.sample(x, y, c));
                    sum += d * d;
                    ++count;
                }
            }
        EXPECT_GT(count, kSize * kSize);
        return std::sqrt(sum / count);
    }
};

} // namespace

TEST_F(LightMapPicture, IsMuchCloserToTheTracedOne) {
    Document document = roofedFloor();
    setIblOf(document);
    const Image truth = traced(document);
    const double before = error(draw(document, kSize), truth);
    attachBake(document, bakedFor(document));
    EXPECT_NEAR(error(draw(document, kSize), truth), before, 1e-6) << "not lit with it";
    document.view.lighting = LightingMode::LightMap;
    const double after = error(draw(document, kSize), truth);
    EXPECT_LT(after, 0.35 * before) << before;
}

TEST_F(LightMapPicture, NeedsABake) {
    Document document = roofedFloor();
    const ParameterInfo& lighting = *findParameter("view.lighting");
    const int mode = static_cast<int>(LightingMode::LightMap);
    EXPECT_THAT(whyUnavailable(lighting, document, mode), testing::HasSubstr("light map bake"));
    attachBake(document, bakedFor(document));
    EXPECT_EQ(whyUnavailable(lighting, document, mode), "");
}

TEST_F(LightMapPicture, IsExplained) {
    Document document = roofedFloor();
    setIblOf(document);
    attachBake(document, bakedFor(document));
    document.view.lighting = LightingMode::LightMap;
    FrameSettings settings;
    settings.samples = 1;
    draw(document, kSize, settings);
    int looked = 0;
    for (int y = 8; y < kSize; y += 8)
        for (int x = 8; x < kSize; x += 8) {
            const Result<Inspection> pixel = renderer().inspect(x, y);
            ASSERT_TRUE(pixel.ok());
            if (!pixel->onSurface())
                continue;
            ++looked;
            const Explanation explanation = explain(*pixel, document);
            EXPECT_TRUE(explanation.agrees()) << toText(explanation);
            EXPECT_THAT(toText(explanation), testing::HasSubstr("Correction by the Light Map"));
        }
    EXPECT_GT(looked, 10);
}

// The roof's texels are those of its front; seen from behind it has none.
TEST_F(LightMapPicture, TheBackOfASurfaceKeepsImageBasedLight) {
    Document document = roofedFloor();
    document.view.camera.pitchDeg = 89.0f;
    setIblOf(document);
    const glm::vec4 before = centerPixel(draw(document, kSize));
    attachBake(document, bakedFor(document));
    document.view.lighting = LightingMode::LightMap;
    const glm::vec4 after = centerPixel(draw(document, kSize));
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(after[c], before[c], 1e-3f);
}

} // namespace patina::render
