#include "core/document/LightPlacement.h"
#include "core/light/Light.h"

#include "core/edit/Edit.h"
#include "core/light/Lights.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace patina {
namespace {

// A cube of 2 m around the origin, or elsewhere and of another size, seen as the editor frames it.
Document cube(float size = 1.0f, const glm::vec3& center = glm::vec3(0.0f)) {
    Document document;
    auto mesh = std::make_shared<Mesh>();
    mesh->positions = {center - glm::vec3(size), center + glm::vec3(size),
                       center + glm::vec3(size, -size, size)};
    mesh->normals.assign(3, {0, 1, 0});
    mesh->indices = {0, 1, 2};
    MeshInstance instance;
    instance.id = document.takeId();
    instance.mesh = mesh;
    document.meshes = {instance};
    document.view.camera = frameBounds(document.view.camera, document.bounds(), 1.0f);
    return document;
}

// Within a picture as high as it is wide.
bool isSeen(const Document& document, const glm::vec3& p) {
    const Camera& camera = document.view.camera;
    Bounds scene = document.bounds();
    scene.add(p);
    const glm::vec4 clip =
        camera.projectionMatrix(1.0f, scene) * camera.viewMatrix() * glm::vec4(p, 1.0f);
    return clip.w > 0.0f && std::max(std::abs(clip.x), std::abs(clip.y)) < clip.w;
}

constexpr LightType kPlaced[] = {LightType::Point, LightType::Spot, LightType::Sphere,
                                 LightType::Rectangle};

TEST(LightPlacement, NewLightsAreInViewApartAndAsBright) {
    for (const LightType type : kPlaced)
        for (const float yaw : {0.0f, 120.0f, 240.0f})
            for (const float pitch : {-40.0f, 15.0f, 80.0f}) {
                Document document = cube();
                document.view.camera.yawDeg = yaw;
                document.view.camera.pitchDeg = pitch;
                for (int i = 0; i < 6; ++i) {
                    const Light plain = defaultLight(type, document.bounds());
                    const Light placed = placedInView(plain, document);
                    EXPECT_TRUE(isSeen(document, placed.position)) << yaw << ' ' << pitch;
                    EXPECT_NEAR(illuminanceAt(placed, {}) / illuminanceAt(plain, {}), 1.0f, 1e-3f);
                    EXPECT_GT(glm::length(placed.position), 1.0f) << "not inside of the model";
                    for (const Light& other : document.lights)
                        EXPECT_GT(glm::length(other.position - placed.position), 0.3f)
                            << i << ' ' << yaw << ' ' << pitch;
                    addLight(document, placed);
                }
            }
}

TEST(LightPlacement, ANewLightStandsBesideTheLastOne) {
    for (const LightType type : kPlaced) {
        Document document = cube();
        const Id first =
            addLight(document, placedInView(defaultLight(type, document.bounds()), document));
        const Light second = placedInView(defaultLight(type, document.bounds()), document);
        const float apart = glm::length(second.position - document.light(first)->position);
        EXPECT_GT(apart, 0.3f);
        EXPECT_LT(apart, 4.0f) << "of a scene with a radius of 1.7 m";
        // What has a direction still aims at the scene.
        if (hasDirection(type)) {
            const glm::vec3 aim = glm::normalize(second.position);
            EXPECT_NEAR(glm::dot(aim, second.directionToLight()), 1.0f, 1e-4f);
        }
    }
}

TEST(LightPlacement, TheDefaultPlaceIsKeptWhereItIsSeenAndFree) {
    Document document = cube();
    document.view.camera.distance *= 10.0f; // sees the environment, too
    const Light plain = defaultLight(LightType::Point, document.bounds());
    ASSERT_TRUE(isSeen(document, plain.position));
    EXPECT_EQ(placedInView(plain, document), plain);
}

TEST(LightPlacement, SunsComeFromDifferentSides) {
    Document document = cube();
    for (int i = 0; i < 5; ++i) {
        const Light sun =
            placedInView(defaultLight(LightType::Directional, document.bounds()), document);
        for (const Light& other : document.lights)
            EXPECT_LT(glm::dot(sun.directionToLight(), other.directionToLight()), 0.98f);
        addLight(document, sun);
    }
}

TEST(LightPlacement, EmptyAndTinyScenesAreNoTrouble) {
    Document empty;
    const Light light = placedInView(defaultLight(LightType::Sphere, empty.bounds()), empty);
    EXPECT_TRUE(std::isfinite(glm::length(light.position)));
    EXPECT_GT(light.intensity, 0.0f);
    Document tiny = cube(1e-4f, {100.0f, 0.0f, 0.0f});
    const Light small = placedInView(defaultLight(LightType::Spot, tiny.bounds()), tiny);
    EXPECT_TRUE(isSeen(tiny, small.position));
    EXPECT_TRUE(std::isfinite(small.intensity));
}

} // namespace
} // namespace patina
