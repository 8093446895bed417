// More lights than a frame's block of uniforms holds: drawn from storage buffers, those with a
// range where it reaches.
#include "render/scene/ManyLights.h"
#include "core/bake/local/NearShadows.h"
#include "core/document/ViewChoices.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "render/scene/LightBlocks.h"
#include "render/scene/LightCells.h"
#include "tests/render/TransferScenes.h"

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <random>
#include <set>

namespace patina::render {
namespace {

using namespace shading;

class ManyLightsTest : public RenderTest {
  protected:
    static constexpr int kSize = 48;

    // A ball on a plane, without an environment.
    static Document ballOnPlane() {
        Document document = makeScene(gridPlane(8));
        document.view.background = BackgroundMode::Off;
        document.materials[0].metallic = 0.3f;
        document.view.camera.yawDeg = 30.0f;
        document.view.camera.pitchDeg = 50.0f;
        document.view.camera.distance = 4.0f;
        MeshInstance ball = document.meshes[0];
        ball.id = document.takeId();
        ball.mesh = makeSphere(16);
        ball.placement = glm::translate(glm::mat4(1.0f), {0.0f, 0.3f, 0.0f}) *
                         glm::scale(glm::mat4(1.0f), glm::vec3(0.3f));
        document.meshes.push_back(ball);
        return document;
    }
    // Mostly points and spots with a small range; of the others, and of those without an end, some.
    static std::vector<Light> lightsOverPlane(std::size_t count, Id firstId) {
        std::mt19937 random(count);
        std::uniform_real_distribution<float> unit(0.0f, 1.0f);
        std::vector<Light> lights(count);
        for (std::size_t i = 0; i < count; ++i) {
            Light& light = lights[i];
            light.id = firstId + static_cast<Id>(i);
            light.type = i % 3 == 1 ? LightType::Spot : LightType::Point;
            if (i % 40 == 7)
                light.type = LightType::Directional;
            if (i % 40 == 17)
                light.type = LightType::Sphere;
            if (i % 40 == 27)
                light.type = LightType::Rectangle;
            light.castsShadow = false;
            light.range = i % 16 == 5 ? 0.0f : 0.15f + 0.2f * unit(random);
            light.position = {2.4f * unit(random) - 1.2f, 0.05f + 0.3f * unit(random),
                              2.4f * unit(random) - 1.2f};
            light.color = {unit(random), unit(random), unit(random)};
            light.intensity = 0.02f;
            light.radius = light.width = light.height = 0.05f;
            light.elevationDeg = 90.0f;
        }
        return lights;
    }
    Image floats(const Document& document) {
        FrameSettings settings;
        settings.samples = 1;
        settings.floats = true;
        return draw(document, kSize, settings);
    }
    // Of as many pictures as lights in lots of 64 take, in double precision.
    std::vector<double> sumOfLots(Document document) {
        const std::vector<Light> all = std::move(document.lights);
        std::vector<double> sum;
        for (std::size_t first = 0; first < all.size(); first += kUniformLights) {
            const std::size_t end = std::min(first + kUniformLights, all.size());
            document.lights.assign(all.begin() + static_cast<std::ptrdiff_t>(first),
                                   all.begin() + static_cast<std::ptrdiff_t>(end));
            const Image picture = floats(document);
            sum.resize(picture.f32().size(), 0.0);
            for (std::size_t i = 0; i < sum.size(); ++i)
                sum[i] += double(picture.f32()[i]);
        }
        return sum;
    }
    void expectSumOfLots(const Document& document, const char* what) {
        const std::vector<double> sum = sumOfLots(document);
        const Image picture = floats(document);
        ASSERT_EQ(picture.f32().size(), sum.size());
        double brightest = 0.0;
        for (std::size_t i = 0; i < sum.size(); ++i) {
            if (i % 4 == 3)
                continue; // alpha
            ASSERT_NEAR(double(picture.f32()[i]), sum[i], 1e-5 * sum[i] + 1e-7)
                << what << ", number " << i;
            brightest = std::max(brightest, sum[i]);
        }
        EXPECT_GT(brightest, 0.05) << what;
    }
};

TEST_F(ManyLightsTest, ThePictureIsTheSumOfThoseOfSixtyFour) {
    for (const std::size_t count : {65u, 256u, 1024u}) {
        Document document = ballOnPlane();
        document.lights = lightsOverPlane(count, 100);
        expectSumOfLots(document, "lights by themselves");
    }
}

// Without one light that has a range, and with points alone.
TEST_F(ManyLightsTest, OneKindOfLightAlone) {
    Document document = ballOnPlane();
    document.lights = lightsOverPlane(256, 100);
    for (Light& light : document.lights)
        light.range = 0.0f;
    expectSumOfLots(document, "no ranges");
    for (Light& light : document.lights) {
        light.type = LightType::Point;
        light.range = 0.3f;
    }
    expectSumOfLots(document, "points with ranges");
}

TEST_F(ManyLightsTest, UnderTransferTheyAddUpToo) {
    Document document = ballOnPlane();
    document.lights = lightsOverPlane(150, 100);
    for (Light& light : document.lights) // distant ones ring in few bands
        if (light.type == LightType::Directional)
            light.type = LightType::Point;
    document.bakes = {openBake(document, 2)};
    document.view.lighting = LightingMode::Shadowed;
    const std::vector<double> sum = sumOfLots(document);
    const Image picture = floats(document);
    for (std::size_t i = 0; i < sum.size(); ++i)
        if (i % 4 != 3) {
            // Bands ring below zero, where pictures end: a sum of cut pictures may be brighter.
            ASSERT_LE(double(picture.f32()[i]), 1.00001 * sum[i] + 1e-6) << i;
        }
    // Traced shares of all, in which nothing is hidden, are those of open surfaces.
    const auto shadows = traceNearShadows(nearShadowRequest(document), nullptr, 0, {});
    ASSERT_TRUE(shadows.ok());
    sceneRenderer().setNearShadows(*shadows);
    expectSumOfLots(document, "traced shares");
}

// The light of a pixel is divided among all of them, in reach or not, and adds up.
TEST_F(ManyLightsTest, AnInspectedPixelNamesAllOfThem) {
    Document document = ballOnPlane();
    document.lights = lightsOverPlane(300, 100);
    const Image picture = floats(document);
    const auto pixelOf = renderer().inspect(kSize / 2, kSize / 2 + 8);
    ASSERT_TRUE(pixelOf.ok());
    const Inspection& inspected = *pixelOf;
    ASSERT_EQ(inspected.lights.size(), 300u);
    const glm::vec3 position(inspected.value(kRecordPosition));
    std::set<Id> named;
    glm::vec3 sum(0.0f);
    std::size_t reaching = 0;
    for (const LightShare& light : inspected.lights) {
        named.insert(light.light);
        sum += light.diffuse + light.specular;
        reaching += light.diffuse != glm::vec3(0.0f) ? 1 : 0;
        const Light* of = document.light(light.light);
        ASSERT_NE(of, nullptr);
        if (of->type == LightType::Point || of->type == LightType::Spot) {
            EXPECT_LT(glm::distance(light.toLight, glm::normalize(of->position - position)), 1e-3f);
        }
    }
    EXPECT_EQ(named.size(), 300u);
    EXPECT_GT(reaching, 20u);
    EXPECT_LT(reaching, 150u);
    const glm::vec4 shown = pixel(picture, kSize / 2, kSize / 2 + 8);
    EXPECT_LT(glm::distance(sum, glm::vec3(shown)), 1e-4f * glm::length(glm::vec3(shown)) + 1e-6f);
}

// A view of one light's terms shows it where it does not reach, too, as among few lights.
TEST_F(ManyLightsTest, TheChosenLightIsSeenEverywhere) {
    Document document = ballOnPlane();
    document.lights = lightsOverPlane(300, 100);
    FrameSettings settings;
    settings.samples = 1;
    settings.view.light = 100 + 33; // a point or spot with a range
    ASSERT_GT(document.light(settings.view.light)->range, 0.0f);
    settings.view.shown.kind = kViewNoL;
    draw(document, kSize, settings);
    const auto many = renderer().readView(kViewNoL);
    document.lights = {*document.light(settings.view.light)};
    draw(document, kSize, settings);
    const auto one = renderer().readView(kViewNoL);
    ASSERT_TRUE(many.ok() && one.ok());
    EXPECT_TRUE(std::ranges::equal(many->f32(), one->f32()));
    EXPECT_GT(*std::ranges::max_element(one->f32()), 0.5f);
}

// Cells are made once for a scene and its lights, not for each frame.
TEST_F(ManyLightsTest, FramesMakeNothingAnew) {
    ManyLights many(context());
    Document document = ballOnPlane();
    document.lights = lightsOverPlane(300, 100);
    const Bounds box = document.bounds();
    for (int frame = 0; frame < 3; ++frame)
        many.set(packLights(document, {}), box);
    EXPECT_EQ(many.rebuilds(), 1u);
    document.lights[5].position.x += 0.1f;
    many.set(packLights(document, {}), box);
    EXPECT_EQ(many.rebuilds(), 2u);
}

TEST(LightCells, HoldWhatReachesAPositionAndLittleElse) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
    std::vector<LightBlock> lights(1024);
    for (LightBlock& light : lights) {
        light.place =
            glm::vec4(40.0f * unit(random), 3.0f * unit(random), 40.0f * unit(random), -1);
        const float range = 1.5f + unit(random);
        light.color.w = 1.0f / (range * range);
    }
    const Bounds box{{-35.0f, -2.0f, -35.0f}, {35.0f, 2.0f, 35.0f}};
    const LightCells cells = makeLightCells(lights, 24, 1000, box);
    std::size_t listed = 0;
    constexpr int kPositions = 4000;
    for (int n = 0; n < kPositions; ++n) {
        // Outside of the box, too.
        const glm::vec3 at(40.0f * unit(random), 4.0f * unit(random), 40.0f * unit(random));
        const std::span<const std::uint32_t> own = cells.lightsAt(at);
        EXPECT_TRUE(std::ranges::is_sorted(own));
        listed += own.size();
        for (std::uint32_t i = 24; i < 1000; ++i)
            if (glm::distance(glm::vec3(lights[i].place), at) * std::sqrt(lights[i].color.w) <
                1.0f) {
                EXPECT_TRUE(std::ranges::binary_search(own, i));
            }
    }
    EXPECT_LT(listed, std::size_t{kPositions} * 20); // of 976
    // A box without extent, none at all, ranges without limit, no light.
    const Bounds point{glm::vec3(1.0f), glm::vec3(1.0f)};
    EXPECT_EQ(makeLightCells(lights, 0, 1024, point).lightsAt(glm::vec3(7.0f)).size(), 1024u);
    EXPECT_EQ(makeLightCells(lights, 0, 1024, Bounds{}).lightsAt(glm::vec3(7.0f)).size(), 1024u);
    for (LightBlock& light : lights)
        light.color.w = 1e-12f;
    const LightCells far = makeLightCells(lights, 0, 1024, box);
    EXPECT_EQ(far.lightsAt(glm::vec3(0.0f)).size(), 1024u);
    EXPECT_LT(far.lists.size(), std::size_t{2} << 20);
    EXPECT_TRUE(makeLightCells({}, 0, 0, box).lightsAt(glm::vec3(0.0f)).empty());
}

TEST(LightLimits, SayWhatIsLeftOut) {
    Document document;
    document.lights.resize(kMaxLights);
    for (Light& light : document.lights) {
        light.id = document.takeId();
        light.type = LightType::Point;
    }
    EXPECT_TRUE(lightLimits(document).empty());
    document.lights.emplace_back().type = LightType::Point;
    ASSERT_EQ(lightLimits(document).size(), 1u);
    EXPECT_EQ(lightLimits(document)[0].text,
              "Only the first 4096 of 4097 lights are drawn; switch others off to see the rest.");
    EXPECT_EQ(packLights(document, {}).lights.size(), std::size_t{kMaxLights});
    document.lights[7].enabled = false;
    EXPECT_TRUE(lightLimits(document).empty());
    for (std::size_t i = 0; i < 5; ++i)
        document.lights[i].type = LightType::Spot;
    ASSERT_EQ(lightLimits(document).size(), 1u);
    EXPECT_EQ(lightLimits(document)[0].id, "shadows");
}

} // namespace
} // namespace patina::render
