// Pictures lit by radiosity: as the solution looks to a ray tracer, by elements, explained.
#include "core/document/ViewChoices.h"
#include "core/edit/Edit.h"
#include "core/edit/Parameters.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/radiosity/RadiosityPicture.h"
#include "core/trace/document/DocumentTraceInputs.h"
#include "render/FollowedRadiosity.h"
#include "render/view/Explanation.h"
#include "tests/render/RenderTest.h"

#include <cmath>
#include <gmock/gmock.h>
#include <numbers>

namespace patina::render {
namespace {

constexpr int kPictureSize = 48;

// A grey floor under a red square of half its side, which has two sides, and a sphere light.
Document litFloor() {
    Document document = makeScene(makePlane());
    document.view.camera = cameraAbove();
    document.view.camera.pitchDeg = 35.0f;
    document.view.background = BackgroundMode::Off;
    document.view.reflectionMix = 0.0f;
    document.view.lighting = LightingMode::Radiosity;
    document.view.radiosityArea = 0.02f;
    document.view.radiosityRays = 128;
    document.environment().enabled = false;
    Material& floor = document.materials[0];
    floor.baseColor = {0.6f, 0.6f, 0.6f};
    floor.metallic = 0.0f;
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
    Light& light = document.lights.emplace_back();
    light.id = 13;
    light.type = LightType::Sphere;
    light.position = {0.9f, 0.4f, 0.9f};
    light.radius = 0.1f;
    light.intensity = 30.0f;
    document.nextId = 14;
    return document;
}

class RadiosityPictureTest : public RenderTest {
  protected:
    FollowedRadiosity solve(const Document& document, const ViewSettings& view = {}) {
        FollowedRadiosity followed;
        const Result<void> solved = followed.update(sceneRenderer(), document, view, {});
        EXPECT_TRUE(solved) << solved.error().text();
        return followed;
    }
    static ViewSettings viewOf(ViewKind kind) {
        ViewSettings view;
        view.shown.kind = kind;
        return view;
    }
};

} // namespace

TEST_F(RadiosityPictureTest, IsWhatRaysSeeOfTheSolution) {
    const Document document = litFloor();
    const FollowedRadiosity followed = solve(document);
    const Image drawn = draw(document, kPictureSize);
    const LiveRadiosity& live = *followed.live();
    TraceView view;
    view.camera = document.view.camera;
    view.width = view.height = kPictureSize;
    view.transparent = true;
    const radiosity::SeenSolution seen(*live.scene, live.elements(), live.lit, live.solution);
    const Result<Image> traced =
        seen.picture(view, {radiosity::Look::Smooth, 16, 1, 0}, JobContext());
    ASSERT_TRUE(traced);
    double sum = 0.0, difference = 0.0;
    int count = 0;
    for (int y = 0; y < kPictureSize; ++y)
        for (int x = 0; x < kPictureSize; ++x) {
            if (traced->sample(x, y, 3) < 1.0f || drawn.sample(x, y, 3) < 1.0f)
                continue;
            ++count;
            for (int c = 0; c < 3; ++c) {
                sum += static_cast<double>(traced->sample(x, y, c));
                difference +=
                    std::abs(static_cast<double>(traced->sample(x, y, c) - drawn.sample(x, y, c)));
            }
        }
    EXPECT_GT(count, kPictureSize * kPictureSize / 4);
    EXPECT_LT(difference, 0.02 * sum) << "edges of the roof are within it";
}

TEST_F(RadiosityPictureTest, ViewsTellOfElements) {
    const Document document = litFloor();
    const FollowedRadiosity followed = solve(document);
    const LiveRadiosity& live = *followed.live();
    FrameSettings frame;
    frame.samples = 1;
    frame.view = viewOf(shading::kViewElementArea);
    draw(document, kPictureSize, frame);
    const Result<Image> areas = renderer().readView(shading::kViewElementArea, ViewMode::Raw);
    const Result<Image> sent = renderer().readView(shading::kViewElementLight, ViewMode::Raw);
    ASSERT_TRUE(areas);
    ASSERT_TRUE(sent);
    // Those that there are, and none in between.
    int looked = 0;
    for (int y = 0; y < kPictureSize; y += 5)
        for (int x = 0; x < kPictureSize; x += 5) {
            if (pixel(*areas, x, y).a < 1.0f)
                continue;
            ++looked;
            bool known = false;
            for (std::uint32_t e = 0; e < live.elements().size() && !known; ++e) {
                const glm::vec3 radiance(live.lit.radiosity(live.solution, e) / std::numbers::pi);
                const glm::vec4 shown = pixel(*sent, x, y);
                known = std::abs(pixel(*areas, x, y).r - float(live.elements().area(e))) < 1e-6f;
                for (int c = 0; c < 3; ++c)
                    known = known && std::abs(shown[c] - radiance[c]) < 2e-3f * radiance[c] + 1e-5f;
            }
            EXPECT_TRUE(known) << x << ' ' << y;
        }
    EXPECT_GT(looked, 20);
}

TEST_F(RadiosityPictureTest, IsExplained) {
    Document document = litFloor();
    document.view.reflectionMix = 0.5f;
    solve(document);
    FrameSettings settings;
    settings.samples = 1;
    draw(document, kPictureSize, settings);
    int looked = 0;
    for (int y = 8; y < kPictureSize; y += 8)
        for (int x = 8; x < kPictureSize; x += 8) {
            const Result<Inspection> inspected = renderer().inspect(x, y);
            ASSERT_TRUE(inspected);
            if (!inspected->onSurface())
                continue;
            ++looked;
            const Explanation explanation = explain(*inspected, document);
            EXPECT_TRUE(explanation.agrees()) << toText(explanation);
            EXPECT_THAT(toText(explanation), testing::HasSubstr("comes from radiosity"));
        }
    EXPECT_GT(looked, 10);
}

TEST_F(RadiosityPictureTest, FollowsEditsAndWhatIsHidden) {
    Document document = litFloor();
    FollowedRadiosity followed = solve(document);
    const glm::vec4 before = centerPixel(draw(document, kPictureSize));
    document.lights[0].gainEv = 1.0f;
    ASSERT_TRUE(followed.update(sceneRenderer(), document, {}, {}));
    const glm::vec4 brighter = centerPixel(draw(document, kPictureSize));
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(brighter[c], 2.0f * before[c], 2e-3f * brighter[c] + 1e-4f);
    document.meshes[1].visible = false;
    ASSERT_TRUE(followed.update(sceneRenderer(), document, {}, {}));
    const glm::vec4 floor = centerPixel(draw(document, kPictureSize));
    EXPECT_NEAR(floor.r, floor.g, 0.01f * floor.r) << "the red roof is gone, and its light";
    EXPECT_GT(std::abs(before.r - before.g), 0.1f * before.r);
}

TEST_F(RadiosityPictureTest, UntilItIsSolvedViewsAreEmptyAndThePictureHasImageBasedLight) {
    Document document = litFloor();
    document.environment().enabled = true;
    document.environment().image =
        makeEnvironment(16, [](const glm::vec3&) { return glm::vec3(0.5f); });
    setIblOf(document);
    const glm::vec4 unsolved = centerPixel(draw(document, kPictureSize));
    document.view.lighting = LightingMode::Ibl;
    const glm::vec4 ibl = centerPixel(draw(document, kPictureSize));
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(unsolved[c], ibl[c], 1e-5f);
    EXPECT_FALSE(isLitBy(LightingMode::Radiosity, document.view.lighting, {}));
    EXPECT_TRUE(isLitBy(LightingMode::Radiosity, document.view.lighting,
                        viewOf(shading::kViewRadiosityLight)));
    EXPECT_TRUE(isLitBy(LightingMode::Radiosity, document.view.lighting,
                        viewOf(shading::kViewElementLight)));
    ViewSettings split;
    split.split.emplace().other.kind = shading::kViewUnshot;
    EXPECT_TRUE(isLitBy(LightingMode::Radiosity, document.view.lighting, split));

    document.meshes.clear();
    EXPECT_THAT(whyUnavailable(*findParameter("view.lighting"), document,
                               static_cast<int>(LightingMode::Radiosity)),
                testing::HasSubstr("visible mesh"));
}

} // namespace patina::render
