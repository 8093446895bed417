// Shadows of local lights under transfer, by rays instead of harmonics.
#include "core/bake/local/NearShadows.h"
#include "core/bake/Bake.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/document/ViewChoices.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/math/Shading.h"
#include "tests/render/TransferScenes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/ext/matrix_transform.hpp>

namespace patina::render {
namespace {

using namespace shading;

// A white, matte floor from -1 to 1, and a wall on it at x = -0.225 that is half a metre high.
// Seen from above, where the wall is a line.
class NearShadowsTest : public LocalLightsTest {
  protected:
    static constexpr int kSize = 64;
    static constexpr float kWall = -0.225f;

    static Document wallOnFloor(int cells = 40) {
        Document document = makeScene(gridPlane(cells));
        document.view.camera = cameraAbove();
        document.view.reflectionMix = 0.0f; // diffuse light alone
        document.view.background = BackgroundMode::Off;
        document.materials[0].metallic = 0.0f;
        document.materials[0].baseColor = glm::vec3(1.0f);
        MeshInstance wall;
        wall.id = document.takeId();
        wall.mesh = makePlane();
        wall.material = document.takeId();
        document.materials.emplace_back().id = wall.material;
        wall.placement = glm::translate(glm::mat4(1.0f), {kWall, 0.25f, 0.0f}) *
                         glm::rotate(glm::mat4(1.0f), 1.5707963f, {0, 0, 1}) *
                         glm::scale(glm::mat4(1.0f), {0.25f, 1.0f, 0.6f});
        document.meshes.push_back(wall);
        document.view.lighting = LightingMode::Shadowed;
        return document;
    }

    static Light lightAbove(Document& document, LightType type) {
        Light light;
        light.id = document.takeId();
        light.type = type;
        light.color = {1.0f, 0.8f, 0.6f};
        light.castsShadow = false;
        light.position = {-0.85f, 0.9f, 0.0f};
        light.elevationDeg = 90.0f; // down
        light.outerConeDeg = 85.0f;
        light.innerConeDeg = 80.0f;
        light.radius = 0.05f;
        light.width = light.height = 0.1f;
        if (type == LightType::Sphere || type == LightType::Rectangle)
            light.intensity = 300.0f; // of a small area
        return light;
    }

    static BakeArtifactPtr baked(const Document& document, BakeKind kind,
                                 TransferKind transfer = TransferKind::Shadowed, int order = 8) {
        PrtSettings settings;
        settings.order = order;
        settings.samples = 64;
        settings.bounceSamples = 64;
        settings.transfer = transfer;
        settings.size = 64;
        TileSink nobody;
        auto bake = kind == BakeKind::PrtVertex
                        ? bakePrtVertex(bakeInputs(document), settings, nobody, {})
                        : bakePrtTexel(bakeInputs(document), settings, nobody, {});
        EXPECT_TRUE(bake.ok());
        return std::make_shared<const BakeArtifact>(std::move(bake).value());
    }

    static NearShadowsPtr traced(const Document& document) {
        auto shadows = traceNearShadows(nearShadowRequest(document), nullptr, 0, {});
        EXPECT_TRUE(shadows.ok());
        return *shadows;
    }
    // Every element of every part has this share of every light.
    static NearShadowsPtr everywhere(const Document& document, float share) {
        auto shadows = std::make_shared<NearShadows>(*traced(document));
        for (auto& ofLight : shadows->shares)
            for (NearShares& shares : ofLight)
                shares = std::make_shared<const std::vector<float>>(shares->size(), share);
        return shadows;
    }

    Image picture(const Document& document) {
        FrameSettings settings;
        settings.samples = 1;
        return draw(document, kSize, settings);
    }
    // Red of the floor at a place.
    static float at(const Image& image, const Document& document, float x, float z) {
        const glm::mat4 toClip = document.view.camera.projectionMatrix(1.0f, document.bounds()) *
                                 document.view.camera.viewMatrix();
        const glm::vec4 clip = toClip * glm::vec4(x, 0.0f, z, 1.0f);
        return pixel(image, int((0.5f + 0.5f * clip.x / clip.w) * kSize),
                     int((0.5f - 0.5f * clip.y / clip.w) * kSize))
            .r;
    }
    // Where the wall hides all of the light, and where it hides nothing of it.
    template <class Visit>
    static void inUmbra(Visit visit) {
        for (float x = -0.12f; x <= 0.35f; x += 0.06f)
            for (float z = -0.3f; z <= 0.31f; z += 0.1f)
                visit(x, z);
    }
    template <class Visit>
    static void inOpen(Visit visit) {
        for (float z = -0.7f; z <= 0.71f; z += 0.1f) {
            for (float x = -0.8f; x <= -0.3f; x += 0.06f)
                visit(x, z);
            visit(0.85f, z);
        }
    }
    // Mean and largest share of the open light that is left in the umbra, and the largest error in
    // the open in shares of the brightest.
    struct Quality {
        float leakMean = 0.0f, leakMost = 0.0f, openError = 0.0f;
    };
    static Quality qualityOf(const Image& image, const Image& open, const Document& document) {
        Quality q;
        int count = 0;
        inUmbra([&](float x, float z) {
            const float leak = at(image, document, x, z) / at(open, document, x, z);
            q.leakMean += leak;
            q.leakMost = std::max(q.leakMost, std::abs(leak));
            ++count;
        });
        q.leakMean /= float(count);
        float brightest = 0.0f;
        inOpen([&](float x, float z) {
            brightest = std::max(brightest, at(open, document, x, z));
            q.openError = std::max(q.openError,
                                   std::abs(at(image, document, x, z) - at(open, document, x, z)));
        });
        EXPECT_GT(brightest, 0.05f);
        q.openError /= brightest;
        return q;
    }
    void expectMended(Document document, LightType type, const char* what) {
        document.lights = {lightAbove(document, type)};
        document.view.lighting = LightingMode::Ibl;
        const Image open = picture(document); // closed forms; nothing casts a shadow
        document.view.lighting = LightingMode::Shadowed;
        sceneRenderer().setNearShadows(nullptr);
        const Quality before = qualityOf(picture(document), open, document);
        sceneRenderer().setNearShadows(traced(document));
        const Quality after = qualityOf(picture(document), open, document);
        std::printf(
            "[ figures  ] %s, light of type %d: left in the umbra %.3f (most %.3f) in bands, "
            "%.4f (most %.4f) by rays; open surface %.4f and %.4f off\n",
            what, static_cast<int>(type), double(before.leakMean), double(before.leakMost),
            double(after.leakMean), double(after.leakMost), double(before.openError),
            double(after.openError));
        EXPECT_GT(before.leakMost, 0.10f) << "the fault that rays are for";
        EXPECT_LT(after.leakMost, 0.01f);
        EXPECT_LT(after.openError, 0.02f);
    }
};

constexpr LightType kLocal[] = {LightType::Point, LightType::Spot, LightType::Sphere,
                                LightType::Rectangle};

// Per vertex and per texel. (One test: drivers in software compile for some seconds.)
TEST_F(NearShadowsTest, NothingIsLeftInTheUmbra) {
    Document vertices = wallOnFloor(), texels = wallOnFloor(1);
    vertices.bakes = {baked(vertices, BakeKind::PrtVertex)};
    texels.bakes = {baked(texels, BakeKind::PrtTexel)};
    for (const LightType type : kLocal) {
        expectMended(vertices, type, "vertices");
        expectMended(texels, type, "texels");
    }
}

// What bounces is transfer's as before: in the umbra it is all there is.
TEST_F(NearShadowsTest, LightByWayOfOtherSurfacesStays) {
    Document document = wallOnFloor();
    document.bakes = {openBake(document, 3, 0.5f)};
    document.lights = {lightAbove(document, LightType::Sphere),
                       lightAbove(document, LightType::Rectangle)};
    const Image direct = picture(document);
    document.view.lighting = LightingMode::Prt;
    const Image both = picture(document);
    sceneRenderer().setNearShadows(everywhere(document, 0.0f));
    const Image bounced = picture(document);
    document.view.lighting = LightingMode::Shadowed;
    const Image nothing = picture(document);
    inOpen([&](float x, float z) {
        const float most = at(both, document, x, z);
        EXPECT_NEAR(at(bounced, document, x, z), most - at(direct, document, x, z), 2e-3f * most);
        EXPECT_GT(at(bounced, document, x, z), 0.2f * most);
        EXPECT_EQ(at(nothing, document, x, z), 0.0f);
    });
}

// The share scales the closed form; without one harmonics stand in, for each element.
TEST_F(NearShadowsTest, SharesScaleTheOpenLightAndHarmonicsStandIn) {
    Document document = wallOnFloor();
    document.bakes = {openBake(document, 3)};
    document.lights = {lightAbove(document, LightType::Point),
                       lightAbove(document, LightType::Sphere)};
    const Image before = picture(document);
    document.view.lighting = LightingMode::Ibl;
    const Image open = picture(document);
    document.view.lighting = LightingMode::Shadowed;
    sceneRenderer().setNearShadows(everywhere(document, 0.25f));
    const Image quarter = picture(document);
    inOpen([&](float x, float z) {
        EXPECT_NEAR(at(quarter, document, x, z), 0.25f * at(open, document, x, z),
                    2e-3f * at(open, document, x, z));
    });
    const auto same = [](const Image& a, const Image& b) {
        return std::ranges::equal(a.f32(), b.f32());
    };
    sceneRenderer().setNearShadows(everywhere(document, -1.0f));
    EXPECT_TRUE(same(picture(document), before));
    // One light has moved since: what is known is shown, until it is set again or taken away.
    sceneRenderer().setNearShadows(everywhere(document, 0.25f));
    document.lights[0].position.x += 0.2f;
    EXPECT_FALSE(same(picture(document), quarter));
    // Of one light alone: the other is as harmonics have it.
    Document one = document;
    one.lights[1].enabled = false;
    sceneRenderer().setNearShadows(everywhere(one, 0.0f));
    const Image second = picture(document);
    document.lights[0].enabled = false;
    sceneRenderer().setNearShadows(nullptr);
    EXPECT_TRUE(same(picture(document), second));
}

TEST_F(NearShadowsTest, NewSharesLightAnewAndEqualOnesDoNot) {
    Document document = wallOnFloor();
    document.bakes = {openBake(document, 3)};
    document.lights = {lightAbove(document, LightType::Point)};
    const NearShadowsPtr shadows = everywhere(document, 1.0f);
    sceneRenderer().setNearShadows(nullptr);
    const Image without = picture(document);
    sceneRenderer().setNearShadows(shadows);
    const Image with = picture(document);
    EXPECT_FALSE(std::ranges::equal(with.f32(), without.f32()));
    sceneRenderer().setNearShadows(std::make_shared<const NearShadows>(*shadows));
    EXPECT_TRUE(std::ranges::equal(picture(document).f32(), with.f32()));
    sceneRenderer().setNearShadows(nullptr);
    EXPECT_TRUE(std::ranges::equal(picture(document).f32(), without.f32()));
}

// Terms and background add up to the picture, and F8's light is what it shows.
TEST_F(NearShadowsTest, TermsStillAddUpToThePicture) {
    Document document = wallOnFloor();
    MeshInstance other = document.meshes[1]; // which the light reaches over the wall
    other.id = document.takeId();
    other.placement.setPosition({1.0f, 0.25f, 0.0f});
    document.meshes.push_back(other);
    document.bakes = {baked(document, BakeKind::PrtVertex, TransferKind::Interreflected, 3)};
    document.lights = {lightAbove(document, LightType::Point),
                       lightAbove(document, LightType::Rectangle)};
    document.view.lighting = LightingMode::Prt;
    document.view.reflectionMix = 0.5f;
    sceneRenderer().setNearShadows(nullptr);
    picture(document); // so that everything is there to be given shares
    sceneRenderer().setNearShadows(traced(document));
    const Image whole = picture(document);
    std::vector<float> sum(whole.f32().size(), 0.0f);
    for (const ViewKind kind : kTermViews) {
        auto term = renderer().readView(kind);
        ASSERT_TRUE(term.ok());
        for (std::size_t i = 0; i < sum.size(); ++i)
            sum[i] += term->f32()[i];
    }
    for (std::size_t i = 0; i < sum.size(); ++i) {
        const bool isAlpha = i % 4 == 3;
        EXPECT_NEAR(isAlpha ? whole.f32()[i] : sum[i], whole.f32()[i],
                    2e-3f * std::max(1.0f, whole.f32()[i]))
            << i;
    }
    // Light by way of other surfaces is all that reaches the umbra, and it does.
    document.view.reflectionMix = 0.0f;
    const Image diffuse = picture(document);
    document.view.lighting = LightingMode::Shadowed;
    const Image direct = picture(document);
    inUmbra([&](float x, float z) {
        EXPECT_LT(at(direct, document, x, z), 1e-3f);
        EXPECT_GT(at(diffuse, document, x, z), 0.0f);
    });
}

} // namespace
} // namespace patina::render
