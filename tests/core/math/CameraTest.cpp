#include "core/math/Camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

using namespace patina;

namespace {

// The largest |x| and |y| of the box's corners in clip space, and whether all have depth in range.
struct Extent {
    float x = 0.0f, y = 0.0f;
    bool depthInRange = true;
};

Extent project(const Camera& camera, const Bounds& box, float aspect) {
    const glm::mat4 clip = camera.projectionMatrix(aspect, box) * camera.viewMatrix();
    Extent extent;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec4 p =
            clip * glm::vec4(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                             corner & 4 ? box.max.z : box.min.z, 1.0f);
        extent.x = std::max(extent.x, std::abs(p.x / p.w));
        extent.y = std::max(extent.y, std::abs(p.y / p.w));
        extent.depthInRange &= p.w > 0.0f && std::abs(p.z) <= p.w;
    }
    return extent;
}

// By the ray from the lens through the point, where it meets the plane in focus.
TEST(Camera, ThroughTheLensOnlyThePlaneInFocusStaysInPlace) {
    Bounds box;
    box.add(glm::vec3(-2.0f));
    box.add(glm::vec3(2.0f));
    Camera camera;
    camera.lens = {true, 0.1f, 3.5f};
    const glm::vec2 onLens(0.06f, -0.03f);
    const glm::mat4 middle = camera.worldToClip(1.5f, box),
                    lens = camera.worldToClip(1.5f, box, onLens);
    EXPECT_EQ(middle, camera.projectionMatrix(1.5f, box) * camera.viewMatrix());
    const auto seen = [](const glm::mat4& clip, const glm::vec3& at) {
        const glm::vec4 p = clip * glm::vec4(at, 1.0f);
        return glm::vec2(p.x / p.w, p.y / p.w);
    };
    const auto at = [&](float depth, float right, float up) {
        return camera.position() + depth * camera.forward() + right * camera.right() +
               up * camera.up();
    };
    for (const float depth : {2.0f, 3.5f, 6.0f}) {
        const glm::vec3 point = at(depth, 0.3f, 0.4f), from = camera.position(onLens);
        const glm::vec3 inFocus = from + (3.5f / depth) * (point - from);
        const glm::vec2 expected = seen(middle, inFocus), found = seen(lens, point);
        EXPECT_NEAR(found.x, expected.x, 1e-5f) << depth;
        EXPECT_NEAR(found.y, expected.y, 1e-5f) << depth;
    }
    EXPECT_GT(glm::distance(seen(lens, at(6.0f, 0.3f, 0.4f)), seen(middle, at(6.0f, 0.3f, 0.4f))),
              0.005f);
}

TEST(Camera, FramesAnyBoxTightlyInAnyPicture) {
    for (const glm::vec3 size : {glm::vec3(1), glm::vec3(4, 1, 1), glm::vec3(0.1f, 3, 0.2f),
                                 glm::vec3(1e-3f), glm::vec3(1e4f, 2e4f, 1e4f)})
        for (const float aspect : {0.5f, 1.0f, 16.0f / 9.0f})
            for (const float yaw : {0.0f, 30.0f, 200.0f})
                for (const float pitch : {-60.0f, 0.0f, 15.0f}) {
                    Bounds box;
                    box.add(glm::vec3(3.0f, -2.0f, 1.0f));
                    box.add(glm::vec3(3.0f, -2.0f, 1.0f) + size);
                    Camera camera;
                    camera.yawDeg = yaw;
                    camera.pitchDeg = pitch;
                    camera = frameBounds(camera, box, aspect);
                    const Extent extent = project(camera, box, aspect);
                    const float largest = std::max(extent.x, extent.y);
                    EXPECT_LE(largest, 0.93f);
                    EXPECT_TRUE(extent.depthInRange);
                    EXPECT_EQ(camera.yawDeg, yaw);
                    EXPECT_EQ(camera.target, box.center());
                }
}

TEST(Camera, ACubeFillsTheFrame) {
    Bounds box;
    box.add(glm::vec3(-1.0f));
    box.add(glm::vec3(1.0f));
    const Camera camera = frameBounds(Camera{}, box, 1.5f);
    const Extent extent = project(camera, box, 1.5f);
    EXPECT_NEAR(std::max(extent.x, extent.y), 1.0f / 1.12f, 1e-3f);
}

TEST(Camera, AxesAreOrthonormalAndLookAtTheTarget) {
    Camera camera;
    camera.yawDeg = 123.0f;
    camera.pitchDeg = -40.0f;
    EXPECT_NEAR(glm::dot(camera.right(), camera.forward()), 0.0f, 1e-6f);
    EXPECT_NEAR(glm::dot(camera.up(), camera.forward()), 0.0f, 1e-6f);
    EXPECT_NEAR(glm::length(camera.up()), 1.0f, 1e-6f);
    const glm::vec4 target = camera.viewMatrix() * glm::vec4(camera.target, 1.0f);
    EXPECT_NEAR(target.z, -camera.distance, 1e-5f); // straight ahead
    EXPECT_NEAR(target.x, 0.0f, 1e-5f);
}

// Yaw 0, pitch 0 stands on +Z and faces an asset's front.
TEST(Camera, TheDefaultSideIsTheFront) {
    Camera camera;
    camera.yawDeg = camera.pitchDeg = 0.0f;
    camera.distance = 2.0f;
    EXPECT_NEAR(camera.position().z, 2.0f, 1e-6f);
    camera.yawDeg = 90.0f;
    EXPECT_NEAR(camera.position().x, 2.0f, 1e-6f);
    camera.pitchDeg = 45.0f;
    EXPECT_GT(camera.position().y, 1.0f); // from above
}

} // namespace
