// What a camera sees of a scene under transfer, against pictures that are known.
#include "core/rank/SweepPixels.h"

#include "core/bake/Bake.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/bake/document/TransferPoint.h"
#include "core/library/Meshes.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/math/SphericalHarmonics.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>

using namespace patina;
using testing::HasSubstr;

namespace {

// A ball of this colour.
Document ballDocument(const glm::vec3& color) {
    Document document;
    Material& material = document.materials.emplace_back();
    material.id = document.takeId();
    material.baseColor = color;
    MeshInstance& instance = document.meshes.emplace_back();
    instance.id = document.takeId();
    instance.material = material.id;
    Mesh mesh = library::makeSphere(96, 48);
    (void)sanitizeMesh(mesh);
    instance.mesh = std::make_shared<const Mesh>(std::move(mesh));
    return document;
}

std::vector<float> radianceOf(const SweepPixels& pixels, const std::vector<glm::vec3>& light) {
    std::vector<float> out(3 * pixels.count());
    sweepRadiance(pixels, light, 0, pixels.count(), out);
    return out;
}

std::vector<glm::vec3> uniformLight(float radiance, int order) {
    std::vector<glm::vec3> light(std::size_t(shCount(order)), glm::vec3(0.0f));
    light[0] = glm::vec3(radiance * std::sqrt(4.0f * std::numbers::pi_v<float>));
    return light;
}

} // namespace

TEST(SweepPixels, UniformLightShowsTheAlbedo) {
    const Document document = ballDocument({0.8f, 0.4f, 0.2f});
    const Camera camera = frameBounds({}, document.bounds(), 1.5f);
    const SweepPixels pixels = *traceSweepPixels(document, nullptr, camera, 48, 32, {});
    EXPECT_EQ(pixels.covered, pixels.count());
    EXPECT_GT(pixels.count(), 200u);
    const std::vector<float> radiance = radianceOf(pixels, uniformLight(2.0f, pixels.order));
    for (std::size_t p = 0; p < pixels.count(); ++p) {
        ASSERT_NEAR(radiance[p], 1.6f, 2e-3f);
        ASSERT_NEAR(radiance[pixels.count() + p], 0.8f, 2e-3f);
        ASSERT_NEAR(radiance[2 * pixels.count() + p], 0.4f, 2e-3f);
    }
    // Any piece of the picture is the same as in the whole.
    std::vector<float> piece(3 * 10);
    sweepRadiance(pixels, uniformLight(2.0f, pixels.order), 5, 15, piece);
    for (std::size_t p = 0; p < 10; ++p)
        EXPECT_EQ(piece[10 + p], radiance[pixels.count() + 5 + p]);
}

TEST(SweepPixels, ShowsWhatLightFromAboveMakesOfABall) {
    const Document document = ballDocument(glm::vec3(1.0f));
    Camera camera = frameBounds({}, document.bounds(), 1.0f);
    camera.yawDeg = camera.pitchDeg = 0.0f;
    const SweepPixels pixels = *traceSweepPixels(document, nullptr, camera, 65, 65, {});
    // L = 1 + y: radiance is 1 + 2/3 n.y (A_1 / π).
    std::vector<glm::vec3> light = uniformLight(1.0f, pixels.order);
    std::vector<double> up(4);
    evaluateSh(2, glm::dvec3(0.0, 1.0, 0.0), std::span(up));
    for (std::size_t i = 1; i < 4; ++i)
        light[i] = glm::vec3(float(up[i] * 4.0 * std::numbers::pi / 3.0));
    const std::vector<float> radiance = radianceOf(pixels, light);
    float top = 0.0f, middle = 0.0f;
    for (std::size_t p = 0; p < pixels.count(); ++p) {
        if (pixels.places[p] == 32u * 65u + 32u)
            middle = radiance[p];
        top = std::max(top, radiance[p]);
    }
    EXPECT_NEAR(middle, 1.0f, 0.02f) << "the normal is horizontal there";
    EXPECT_NEAR(top, 1.0f + 2.0f / 3.0f, 0.08f) << "nearly up at the outline";
    EXPECT_GT(radiance[0], radiance[pixels.count() - 1]) << "rows begin at the top";
}

TEST(SweepPixels, ABakeIsLookedUpWhereTheRayMeetsIt) {
    const Document document = ballDocument(glm::vec3(0.5f));
    PrtSettings settings;
    settings.order = 4;
    settings.samples = 64;
    TileSink sink;
    const BakeArtifact bake = *bakePrtVertex(bakeInputs(document), settings, sink, {});
    const Camera camera = frameBounds({}, document.bounds(), 1.0f);
    const SweepPixels pixels = *traceSweepPixels(document, &bake, camera, 24, 24, {});
    EXPECT_EQ(pixels.order, 4);
    // A convex body hides nothing of itself: the same as in closed form, but for the bake's noise.
    const SweepPixels open = *traceSweepPixels(document, nullptr, camera, 24, 24, {});
    EXPECT_EQ(pixels.places, open.places);
    for (std::size_t p = 0; p < pixels.count(); ++p)
        ASSERT_NEAR(pixels.transfer[p], open.transfer[p], 0.01f);
    // Of another mesh.
    BakeArtifact other = bake;
    other.vertices[0].mesh = 99;
    EXPECT_THAT(traceSweepPixels(document, &other, camera, 24, 24, {}).error().message,
                HasSubstr("bake the scene anew"));
}

TEST(SweepPixels, LightsOfTheDocumentStay) {
    Document document = ballDocument(glm::vec3(0.5f));
    const Camera camera = frameBounds({}, document.bounds(), 1.0f);
    const std::vector<glm::vec3> none(25, glm::vec3(0.0f));
    for (const float value :
         radianceOf(*traceSweepPixels(document, nullptr, camera, 9, 9, {}), none))
        EXPECT_EQ(value, 0.0f);
    Light light;
    light.id = document.takeId();
    document.lights.push_back(light);
    const SweepPixels lit = *traceSweepPixels(document, nullptr, camera, 9, 9, {});
    const std::vector<float> radiance = radianceOf(lit, none);
    EXPECT_GT(*std::ranges::max_element(radiance), 0.0f);
}

TEST(SweepPixels, MetalHasNoDiffuseLightAndNothingIsNothing) {
    Document document = ballDocument(glm::vec3(0.5f));
    document.materials[0].metallic = 1.0f;
    const Camera camera = frameBounds({}, document.bounds(), 1.0f);
    EXPECT_THAT(traceSweepPixels(document, nullptr, camera, 9, 9, {}).error().message,
                HasSubstr("metal"));
    Camera away = camera;
    away.target += glm::vec3(100.0f, 0.0f, 0.0f);
    EXPECT_THAT(traceSweepPixels(document, nullptr, away, 9, 9, {}).error().message,
                HasSubstr("no surface"));
    document.meshes[0].visible = false;
    EXPECT_FALSE(traceSweepPixels(document, nullptr, camera, 9, 9, {}).ok());
}
