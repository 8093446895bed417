// Light of lights and of two environments under radiance transfer, against what it should be.
#include "core/bake/Bake.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/document/ViewChoices.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/math/Shading.h"
#include "core/mix/EnvironmentBlend.h"
#include "core/mix/LightMix.h"
#include "tests/render/TransferScenes.h"
#include "tests/support/SecondEnvironment.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace patina::render {
namespace {

using namespace shading;

class TransferLights : public LocalLightsTest {
  protected:
    // A white, matte square seen from above, or more of them to a side, without an environment.
    static Document ground(int cells = 1) {
        Document document = makeScene(cells == 1 ? makePlane() : gridPlane(cells));
        document.view.camera = cameraAbove();
        document.view.background = BackgroundMode::Off;
        document.materials[0].metallic = 0.0f;
        document.materials[0].baseColor = glm::vec3(1.0f);
        document.view.lighting = LightingMode::Shadowed;
        return document;
    }
    static Light lightAbove(Document& document, LightType type) {
        Light light;
        light.id = document.takeId();
        light.type = type;
        light.color = {1.0f, 0.8f, 0.6f};
        light.castsShadow = false;
        light.position = {0.3f, 0.9f, -0.2f};
        return light;
    }
    static FrameSettings oneSample() {
        FrameSettings settings;
        settings.samples = 1;
        return settings;
    }
    Image irradiance(const Document& document, int size = 64) {
        draw(document, size, oneSample());
        auto image = renderer().readView(kViewIrradiance);
        EXPECT_TRUE(image.ok());
        return std::move(image).value();
    }
    // π / ρ of all diffuse light of the picture: what arrives, for a white and matte surface.
    Image diffuse(Document document, int size = 64) {
        document.view.reflectionMix = 0.0f;
        return draw(document, size, oneSample());
    }
    static float worst(const Image& a, const Image& b) {
        float largest = 0.0f;
        for (std::size_t i = 0; i < a.f32().size(); ++i)
            largest = std::max(largest, std::abs(a.f32()[i] - b.f32()[i]));
        return largest;
    }
};

// --- Distant lights ---

// E = E0 cos: exactly where the surface faces the disc, and as close as the bands allow elsewhere.
TEST_F(TransferLights, ADiscGivesTheCosineWithinItsBands) {
    Document document = ground();
    document.lights = {lightAbove(document, LightType::Directional)};
    Light& sun = document.lights[0];
    sun.intensity = 4.0f;
    struct Case {
        int order;
        float softness, most; // error in shares of E0, from straight above down to 5 degrees
    };
    for (const Case& c : {Case{3, 1.0f, 0.08f}, Case{5, 1.0f, 0.055f}, Case{8, 1.0f, 0.025f},
                          Case{5, 40.0f, 0.07f}}) {
        document.bakes = {openBake(document, c.order)};
        sun.shadowSoftness = c.softness;
        float off = 0.0f;
        for (const float elevation : {90.0f, 75.0f, 60.0f, 45.0f, 30.0f, 15.0f, 5.0f}) {
            sun.elevationDeg = elevation;
            const glm::vec4 E = pixel(irradiance(document), 31, 31) / sun.intensity;
            const float expected = std::sin(glm::radians(elevation));
            if (elevation == 90.0f) {
                EXPECT_NEAR(E.r, 1.0f, 1e-3f) << c.order;
            }
            EXPECT_NEAR(E.g, 0.8f * E.r, 1e-3f);
            EXPECT_NEAR(E.b, 0.6f * E.r, 1e-3f);
            off = std::max(off, std::abs(E.r - expected));
        }
        std::printf("[ figures  ] %d bands, disc of %g degrees: %.3f of E0 off\n", c.order,
                    double(c.softness), double(off));
        EXPECT_LT(off, c.most) << c.order;
        EXPECT_GT(off, 1e-4f);
    }
    // From below nothing arrives, and no surface gets less than nothing.
    sun.elevationDeg = -90.0f;
    EXPECT_NEAR(pixel(irradiance(document), 31, 31).r, 0.0f, 0.05f * sun.intensity);
}

// --- Lights near by
// --------------------------------------------------------------------------------

// Over an open plane each gives what its closed form says: a form factor of the cosine.
TEST_F(TransferLights, LightsNearByAgreeWithTheirClosedForms) {
    Document document = ground(24);
    document.bakes = {openBake(document, 8)};
    for (const LightType type :
         {LightType::Point, LightType::Spot, LightType::Sphere, LightType::Rectangle}) {
        Light light = lightAbove(document, type);
        light.elevationDeg = 90.0f; // emits down
        light.outerConeDeg = 80.0f;
        light.innerConeDeg = 10.0f;
        light.width = 0.8f;
        light.height = 0.4f;
        document.lights = {light};
        document.view.lighting = LightingMode::Ibl;
        const Image closed = diffuse(document, 48);
        for (const LightingMode mode : {LightingMode::Shadowed, LightingMode::Unshadowed}) {
            document.view.lighting = mode;
            const Image transfer = diffuse(document, 48);
            float largest = 0.0f, most = 0.0f;
            for (int y = 0; y < 48; ++y)
                for (int x = 0; x < 48; ++x)
                    for (int c = 0; c < 3; ++c) {
                        const float wanted = pixel(closed, x, y)[c];
                        largest = std::max(largest, wanted);
                        most = std::max(most, std::abs(pixel(transfer, x, y)[c] - wanted));
                    }
            std::printf("[ figures  ] light of type %d, mode %d: %.4f of its brightest off\n",
                        static_cast<int>(type), static_cast<int>(mode), double(most / largest));
            EXPECT_GT(largest, 0.05f);
            EXPECT_LT(most, 0.05f * largest) << static_cast<int>(type);
        }
    }
}

// A texel's place is that of its surface: the same light as per vertex.
TEST_F(TransferLights, TexelsSeeLightsNearByFromTheirOwnPlaces) {
    Document document = ground(24);
    document.lights = {lightAbove(document, LightType::Point)};
    document.meshes[0].placement =
        glm::translate(glm::mat4(1.0f), glm::vec3(0.2f, 0.0f, 0.0f)); // not the bake's own space
    document.bakes = {openBake(document, 3)};
    const Image vertices = diffuse(document);

    auto bake = std::make_shared<BakeArtifact>();
    bake->kind = BakeKind::PrtTexel;
    bake->order = 3;
    TexelBake texels;
    texels.material = 2;
    texels.side = 64;
    texels.stride = 9;
    const std::vector<float> one = openTransfer(*makePlane(), 3);
    for (int i = 0; i < texels.side * texels.side; ++i)
        texels.values.insert(texels.values.end(), one.begin(), one.begin() + 9);
    bake->texels = {texels};
    document.bakes = {bake};
    const Image perTexel = diffuse(document);
    float largest = 0.0f;
    for (int y = 8; y < 56; ++y)
        for (int x = 16; x < 56; ++x) {
            const glm::vec4 v = pixel(vertices, x, y), t = pixel(perTexel, x, y);
            largest = std::max(largest, v.r);
            EXPECT_NEAR(t.r, v.r, 0.03f * std::max(v.r, 0.1f)) << x << ' ' << y;
        }
    EXPECT_GT(largest, 0.3f);
}

// What came by way of other surfaces is multiplied by the same light.
TEST_F(TransferLights, LightsNearByBounce) {
    Document document = ground(8);
    document.lights = {lightAbove(document, LightType::Sphere)};
    document.bakes = {openBake(document, 4, 0.5f)};
    document.view.lighting = LightingMode::Shadowed;
    const glm::vec4 direct = centerPixel(diffuse(document));
    document.view.lighting = LightingMode::Prt;
    const glm::vec4 both = centerPixel(diffuse(document));
    EXPECT_GT(direct.r, 0.1f);
    EXPECT_NEAR(both.r, 1.5f * direct.r, 2e-3f * both.r);
    EXPECT_NEAR(both.g, 1.25f * direct.g, 2e-3f * both.g);
    EXPECT_NEAR(both.b, direct.b, 2e-3f * both.b);
}

// --- Shadows
// ---------------------------------------------------------------------------------------

// Weighted by how dark it is.
glm::vec2 shadowCentre(const Image& with, const Image& without) {
    glm::vec2 sum(0.0f);
    float weight = 0.0f;
    for (int y = 0; y < with.height(); ++y)
        for (int x = 0; x < with.width(); ++x) {
            const float missing = pixel(without, x, y).g - pixel(with, x, y).g;
            if (missing < 0.3f * pixel(without, x, y).g)
                continue;
            sum += missing * glm::vec2(x, y);
            weight += missing;
        }
    return weight > 0.0f ? sum / weight : glm::vec2(-1.0f);
}

TEST_F(TransferLights, ASpheresShadowFallsWhereTheShadowMapSays) {
    Document document = ground(48);
    MeshInstance ball;
    ball.id = document.takeId();
    ball.name = "ball";
    ball.mesh = makeSphere(24);
    ball.material = document.meshes[0].material;
    ball.placement =
        glm::scale(glm::translate(glm::mat4(1.0f), glm::vec3(0, 0.25f, 0)), glm::vec3(0.25f));
    document.meshes.push_back(ball);
    PrtSettings settings;
    settings.order = 8;
    settings.samples = 256;
    settings.fitted = false;
    TileSink nobody;
    auto bake = bakePrtVertex(bakeInputs(document), settings, nobody, {});
    ASSERT_TRUE(bake.ok());
    document.lights = {lightAbove(document, LightType::Directional)};
    Light& sun = document.lights[0];
    sun.azimuthDeg = 60.0f;
    sun.elevationDeg = 45.0f;
    sun.shadowSoftness = 8.0f;
    document.meshes[1].visible = false;
    document.view.lighting = LightingMode::Unshadowed;
    const Image open = diffuse(document);
    document.view.lighting = LightingMode::Ibl;
    const Image bare = diffuse(document);
    document.meshes[1].visible = true;
    sun.castsShadow = true;
    const Image mapped = diffuse(document);
    document.bakes = {std::make_shared<BakeArtifact>(std::move(*bake))};
    document.view.lighting = LightingMode::Shadowed;
    const Image transferred = diffuse(document);
    // Both without the ball itself, which covers the middle of the picture: on the far side.
    const auto farSide = [](Image image) {
        for (int y = 0; y < image.height(); ++y)
            for (int x = 0; x < image.width(); ++x)
                if (glm::length(glm::vec2(x, y) - 31.5f) < 11.0f)
                    for (int c = 0; c < 4; ++c)
                        image.f32()[static_cast<std::size_t>(4 * (y * image.width() + x) + c)] =
                            0.0f;
        return image;
    };
    const glm::vec2 map = shadowCentre(farSide(mapped), farSide(bare)),
                    transfer = shadowCentre(farSide(transferred), farSide(open));
    std::printf("[ figures  ] shadow at %.1f %.1f by the map, %.1f %.1f by transfer, of 64\n",
                double(map.x), double(map.y), double(transfer.x), double(transfer.y));
    ASSERT_GT(map.x, 0.0f);
    ASSERT_GT(transfer.x, 0.0f);
    EXPECT_GT(glm::length(map - 31.5f), 10.0f); // it is not under the ball
    EXPECT_LT(glm::length(map - transfer), 3.0f);
}

// --- The mix
// ---------------------------------------------------------------------------------------

ImagePtr sky(const glm::vec3& colour, float lamp) {
    return makeEnvironment(16, [&](const glm::vec3& d) {
        return colour * (1.0f + 0.5f * d.x) + (d.y > 0.8f ? lamp : 0.0f);
    });
}

Document ballUnderTransfer() {
    Document document = makeScene(makeSphere(32));
    document.view.background = BackgroundMode::Off;
    document.materials[0].metallic = 0.0f;
    document.materials[0].baseColor = glm::vec3(0.8f);
    document.environment().image = sky({0.4f, 0.5f, 0.6f}, 3.0f);
    document.environment().rotationDeg = 40.0f;
    document.bakes = {openBake(document, 5, 0.25f)};
    document.view.lighting = LightingMode::Prt;
    return document;
}

TEST_F(TransferLights, TheMixerActsLinearly) {
    Document document = ballUnderTransfer();
    setIblOf(document);
    document.lights = {lightAbove(document, LightType::Directional),
                       lightAbove(document, LightType::Point),
                       lightAbove(document, LightType::Sphere)};
    document.lights[0].azimuthDeg = 20.0f;
    document.lights[1].position = {1.0f, 1.5f, 1.5f};
    document.lights[2].position = {-0.5f, 1.0f, 2.0f};
    const auto E = [&] { return glm::vec3(pixel(irradiance(document), 33, 30)); };
    const auto close = [](const glm::vec3& a, const glm::vec3& b) {
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(a[c], b[c], 1e-4f * std::max(a[c], 1.0f));
    };
    const glm::vec3 all = E();
    document.environment().solo = true;
    const glm::vec3 environment = E();
    document.environment().solo = false;
    glm::vec3 sum = environment;
    std::vector<glm::vec3> alone;
    for (Light& light : document.lights) {
        light.solo = true;
        alone.push_back(E());
        sum += alone.back();
        EXPECT_GT(alone.back().r, 0.05f) << static_cast<int>(light.type);
        light.gainEv = 1.0f;
        close(E(), 2.0f * alone.back());
        light.gainEv = 0.0f;
        light.tint = {0.5f, 0.25f, 1.0f};
        close(E(), light.tint * alone.back());
        light.tint = glm::vec3(1.0f);
        light.solo = false;
    }
    close(all, sum);
    for (std::size_t i = 0; i < alone.size(); ++i) {
        document.lights[i].enabled = false;
        close(E(), all - alone[i]);
        document.lights[i].enabled = true;
    }
    document.environment().enabled = false;
    close(E(), all - environment);
    document.environment().enabled = true;
    document.environment().tint = {0.0f, 0.5f, 1.0f};
    document.environment().exposureEv = -1.0f;
    close(E(), all - environment + 0.5f * document.environment().tint * environment);
}

TEST_F(TransferLights, CrossFadeIsTheMixOfBothPictures) {
    Document document = ballUnderTransfer();
    Environment& second = test::addSecond(document, "second", sky({0.9f, 0.3f, 0.1f}, 0.0f));
    second.rotationDeg = -70.0f;
    second.exposureEv = 0.5f;
    const auto shown = [&](float fade, bool prepares) {
        document.mix.fade = fade;
        resolveBlend(document);
        if (prepares) {
            const Image& image = *shownEnvironment(document).image;
            Document lit = document;
            lit.environment().image = std::make_shared<const Image>(image);
            const auto maps = computeIbl(image, {.cubeSize = 32, .levels = 5}, {});
            EXPECT_TRUE(maps.ok());
            setBackground(shownEnvironment(document).image, *maps);
        }
        return draw(document, 64, oneSample());
    };
    const Image a = shown(0.0f, true), b = shown(1.0f, true);
    const auto mix = [&](float fade) {
        Image image = a;
        for (std::size_t i = 0; i < image.f32().size(); ++i)
            image.f32()[i] = (1.0f - fade) * a.f32()[i] + fade * b.f32()[i];
        return image;
    };
    EXPECT_GT(worst(a, b), 0.2f);
    // Reflections come from one picture of both, whose texels are half floats.
    for (const float fade : {0.25f, 0.7f})
        EXPECT_LT(worst(shown(fade, true), mix(fade)), 4e-3f) << fade;

    // While that picture is on its way diffuse light is right already: both have been seen.
    document.view.reflectionMix = 0.0f;
    const Image c = shown(0.0f, false), d = shown(1.0f, false), e = shown(0.4f, false);
    float off = 0.0f;
    for (std::size_t i = 0; i < c.f32().size(); ++i)
        off = std::max(off, std::abs(e.f32()[i] - 0.6f * c.f32()[i] - 0.4f * d.f32()[i]));
    EXPECT_GT(worst(c, d), 0.1f);
    EXPECT_LT(off, 1e-3f);
}

// A picture that has never been shown: by the coefficients that were handed over for it.
TEST_F(TransferLights, TheOtherPicturesLightComesAhead) {
    Document document = ballUnderTransfer();
    setIblOf(document);
    document.view.reflectionMix = 0.0f;
    const Image before = draw(document, 32, oneSample());
    const ImagePtr second = test::addSecond(document, "second", sky(glm::vec3(1.0f), 0.0f)).image;
    document.mix.fade = 0.5f;
    EXPECT_FALSE(sceneRenderer().knowsProjection(second));
    const Image unknown = draw(document, 32, oneSample());
    SceneRenderer::ProjectionSh coefficients{};
    std::ranges::copy(projectLatLong(*second, kMaxShOrder, {}), coefficients.begin());
    sceneRenderer().setProjection(second, coefficients);
    EXPECT_TRUE(sceneRenderer().knowsProjection(second));
    const Image known = draw(document, 32, oneSample());
    EXPECT_GT(worst(unknown, known), 0.05f);
    const std::vector<glm::vec3> light = sceneRenderer().transferLight(2);
    ASSERT_EQ(light.size(), 4u);
    document.mix.fade = 0.0f;
    draw(document, 32, oneSample());
    EXPECT_NEAR(light[0].x, 0.5f * (sceneRenderer().transferLight(2)[0].x + coefficients[0].x),
                1e-4f);
}

} // namespace
} // namespace patina::render
