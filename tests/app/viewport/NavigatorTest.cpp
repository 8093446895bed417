#include "app/editor/viewport/Navigator.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

using namespace patina;
using namespace patina::editor;

namespace {

Camera someCamera() {
    Camera camera;
    camera.target = {0.3f, 1.2f, -0.7f};
    camera.yawDeg = 25.0f;
    camera.pitchDeg = 10.0f;
    camera.distance = 3.0f;
    return camera;
}

// Where a world point appears, in pixels from the centre, y down.
glm::vec2 project(const Camera& camera, const glm::vec3& point, float height) {
    const glm::vec3 d = point - camera.position();
    const float scale = 0.5f * height / std::tan(0.5f * glm::radians(camera.fovDeg)) /
                        glm::dot(d, camera.forward());
    return {scale * glm::dot(d, camera.right()), -scale * glm::dot(d, camera.up())};
}

TEST(Navigator, OrbitKeepsTargetAndDistanceAndTheSurfaceFollowsThePointer) {
    const Camera before = someCamera();
    const glm::vec3 front = before.target - 0.5f * before.forward(); // nearest to the camera
    const Camera after = orbit(before, {30.0f, 20.0f});
    EXPECT_EQ(after.target, before.target);
    EXPECT_NEAR(glm::length(after.position() - after.target), before.distance, 1e-5f);
    const glm::vec2 moved = project(after, front, 500.0f) - project(before, front, 500.0f);
    EXPECT_GT(moved.x, 1.0f);
    EXPECT_GT(moved.y, 1.0f);
}

TEST(Navigator, OrbitNeverGoesOverThePole) {
    Camera camera = someCamera();
    for (int i = 0; i < 100; ++i)
        camera = orbit(camera, {0.0f, 50.0f});
    EXPECT_LE(camera.pitchDeg, 89.0f);
    EXPECT_GT(glm::length(camera.up()), 0.99f);
}

TEST(Navigator, PanKeepsTheTargetsPointUnderThePointer) {
    const Camera before = someCamera();
    const glm::vec2 drag(37.0f, -21.0f);
    const Camera after = pan(before, drag, 600.0f);
    const glm::vec2 shown = project(after, before.target, 600.0f);
    EXPECT_NEAR(shown.x, drag.x, 0.01f);
    EXPECT_NEAR(shown.y, drag.y, 0.01f);
}

TEST(Navigator, DollyIsReversibleAndBounded) {
    const Camera before = someCamera();
    EXPECT_LT(dolly(before, 1.0f, 1.0f).distance, before.distance);
    EXPECT_NEAR(dolly(dolly(before, 3.0f, 1.0f), -3.0f, 1.0f).distance, before.distance, 1e-4f);
    EXPECT_GT(dolly(before, 1e4f, 1.0f).distance, 0.0f);
    EXPECT_TRUE(std::isfinite(dolly(before, -1e4f, 1.0f).distance));
}

TEST(Navigator, LookTurnsAboutTheCamerasOwnPosition) {
    const Camera before = someCamera();
    const Camera after = look(before, {40.0f, 25.0f});
    EXPECT_NEAR(glm::length(after.position() - before.position()), 0.0f, 1e-5f);
    EXPECT_GT(glm::dot(after.forward(), before.right()), 0.05f); // dragging right looks right
    EXPECT_LT(after.forward().y, before.forward().y);            // dragging down looks down
}

TEST(Navigator, FlyMovesAlongTheCamerasAxes) {
    const Camera before = someCamera();
    const Camera after = fly(before, {1.0f, 2.0f, 3.0f});
    const glm::vec3 moved = after.position() - before.position();
    EXPECT_NEAR(glm::dot(moved, before.right()), 1.0f, 1e-5f);
    EXPECT_NEAR(glm::dot(moved, before.up()), 2.0f, 1e-5f);
    EXPECT_NEAR(glm::dot(moved, before.forward()), 3.0f, 1e-5f);
}

} // namespace
