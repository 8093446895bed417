#include "core/scene/SceneCameras.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

namespace patina {
namespace {

Bounds unitBox() {
    Bounds box;
    box.add(glm::vec3(-1.0f));
    box.add(glm::vec3(1.0f));
    return box;
}

void expectNear(const glm::vec3& a, const glm::vec3& b, float tolerance) {
    EXPECT_LT(glm::distance(a, b), tolerance)
        << a.x << " " << a.y << " " << a.z << " instead of " << b.x << " " << b.y << " " << b.z;
}

TEST(SceneCameras, AreSeenFromWhereTheyStand) {
    std::mt19937 random(11);
    const auto number = [&] { return static_cast<float>(random() / 4294967296.0 * 2.0 - 1.0); };
    for (int run = 0; run < 500; ++run) {
        SceneCamera camera;
        camera.position = 10.0f * glm::vec3(number(), number(), number());
        camera.forward = glm::normalize(glm::vec3(number(), number(), number()));
        if (std::abs(camera.forward.y) > 0.999f)
            continue;
        const glm::vec3 right = glm::normalize(glm::cross(camera.forward, glm::vec3(0, 1, 0)));
        camera.up = glm::cross(right, camera.forward);
        camera.fovDeg = 25.0f + 20.0f * number();
        std::string notice;
        const Camera view = cameraLike(camera, Camera(), unitBox(), notice);
        expectNear(view.position(), camera.position, 1e-4f);
        expectNear(view.forward(), camera.forward, 1e-5f);
        expectNear(view.up(), camera.up, 1e-4f);
        EXPECT_EQ(view.fovDeg, camera.fovDeg);
        EXPECT_GT(view.distance, 0.0f);
        EXPECT_EQ(notice, "");
    }
}

TEST(SceneCameras, WhatViewCamerasCannotDoIsTold) {
    std::string notice;
    SceneCamera tilted{"Tilted", {0, 0, 5}, {0, 0, -1}, {0.5f, std::sqrt(0.75f), 0}, 30.0f};
    (void)cameraLike(tilted, Camera(), unitBox(), notice);
    EXPECT_THAT(notice, testing::HasSubstr("\"Tilted\" is tilted by 30.0°"));
    // Straight down, with +X up in the picture, and straight up.
    for (const float sign : {-1.0f, 1.0f}) {
        notice.clear();
        const SceneCamera steep{"Top", {0, -5 * sign, 0}, {0, sign, 0}, {1, 0, 0}, 30.0f};
        const Camera view = cameraLike(steep, Camera(), unitBox(), notice);
        expectNear(view.position(), steep.position, 1e-4f);
        expectNear(view.up(), steep.up, 0.02f);
        EXPECT_EQ(view.pitchDeg, -89.0f * sign);
        EXPECT_THAT(notice, testing::HasSubstr("at 89°"));
    }
}

TEST(SceneCameras, TurnAboutTheMiddleOfTheScene) {
    std::string notice;
    const Bounds box = unitBox();
    const SceneCamera front{"Front", {0, 0, 5}, {0, 0, -1}, {0, 1, 0}, 30.0f};
    expectNear(cameraLike(front, Camera(), box, notice).target, {0, 0, 0}, 1e-5f);
    // One that looks away turns about what is before it.
    const SceneCamera away{"Away", {0, 0, 5}, {0, 0, 1}, {0, 1, 0}, 30.0f};
    EXPECT_GT(cameraLike(away, Camera(), box, notice).target.z, 5.0f);
    EXPECT_GT(cameraLike(away, Camera(), Bounds(), notice).target.z, 5.0f);
}

} // namespace
} // namespace patina
