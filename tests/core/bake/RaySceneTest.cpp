#include "core/bake/RayScene.h"
#include "tests/core/bake/BakeTestScene.h"

#include <gtest/gtest.h>
#include <random>

using namespace patina;
using namespace patina::test;

namespace {

OcclusionRay rayFrom(const glm::vec3& origin, const glm::vec3& direction) {
    OcclusionRay ray;
    ray.origin = origin;
    ray.direction = direction;
    return ray;
}

} // namespace

TEST(RayScene, AgreesWithTheSphereEquationForAnyStreamLength) {
    // Radius 1 is the scene's unit already.
    const Result<BakeGeometry> geometry =
        makeBakeGeometry(sceneOf({sphereMesh(1.0, 256, 128)}), {});
    ASSERT_TRUE(geometry.ok());
    EXPECT_EQ(geometry->unitsPerMetre, 1.0);
    const Result<RayScene> scene = RayScene::build(*geometry, {});
    ASSERT_TRUE(scene.ok());
    EXPECT_GT(scene->memoryBytes(), 1'000'000u);
    std::mt19937 random(3);
    const auto number = [&] { return float(random() / 4294967296.0 * 4.0 - 2.0); };
    for (const std::size_t length : {1u, 7u, 31u, 32u, 333u, 2048u}) {
        std::vector<OcclusionRay> rays;
        for (std::size_t i = 0; i < length; ++i)
            rays.push_back(rayFrom({number(), number(), 3.0f}, {0, 0, -1}));
        const std::vector<OcclusionRay> before = rays;
        EXPECT_EQ(scene->occlude(rays), 0u);
        for (std::size_t i = 0; i < length; ++i) {
            const float r = std::hypot(before[i].origin.x, before[i].origin.y);
            if (std::abs(r - 1.0f) > 0.001f) {
                EXPECT_EQ(rays[i].occluded(), r < 1.0f) << r;
            }
        }
    }
}

TEST(RayScene, DistancesBoundTheRay) {
    const Result<BakeGeometry> geometry = makeBakeGeometry(sceneOf({sphereMesh(1.0)}), {});
    ASSERT_TRUE(geometry.ok());
    const Result<RayScene> scene = RayScene::build(*geometry, {});
    ASSERT_TRUE(scene.ok());
    std::vector<OcclusionRay> rays(3, rayFrom({0.1f, 0.1f, 3.0f}, {0, 0, -1}));
    rays[0].maxDistance = 1.5f; // ends before the sphere
    rays[1].maxDistance = 2.5f;
    rays[2].minDistance = 5.0f; // starts behind it
    EXPECT_EQ(scene->occlude(rays), 0u);
    EXPECT_FALSE(rays[0].occluded());
    EXPECT_TRUE(rays[1].occluded());
    EXPECT_FALSE(rays[2].occluded());
}

TEST(RayScene, RaysThatAreNotFiniteAreLeftOutAndTheRestIsAnswered) {
    const Result<BakeGeometry> geometry = makeBakeGeometry(sceneOf({sphereMesh(1.0)}), {});
    ASSERT_TRUE(geometry.ok());
    const Result<RayScene> scene = RayScene::build(*geometry, {});
    ASSERT_TRUE(scene.ok());
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float inf = std::numeric_limits<float>::infinity();
    for (const std::size_t repeats : {1u, 100u}) { // single rays and streams
        std::vector<OcclusionRay> rays;
        for (std::size_t i = 0; i < repeats; ++i) {
            rays.push_back(rayFrom({0.1f, 0.1f, 3}, {0, 0, -1}));
            rays.push_back(rayFrom({nan, 0, 3}, {0, 0, -1}));
            rays.push_back(rayFrom({0, 0, 3}, {0, inf, -1}));
            rays.push_back(rayFrom({0, -inf, 3}, {0, 0, -1}));
            rays.push_back(rayFrom({0, 0, 3}, {0, 0, 0}));
            rays.push_back(rayFrom({0, 0, 3}, {0, 0, -1}));
            rays.back().maxDistance = nan;
            rays.push_back(rayFrom({0, 0, 3}, {0, 0, -1}));
            rays.back().minDistance = nan;
        }
        EXPECT_EQ(scene->occlude(rays), 6 * repeats);
        for (std::size_t i = 0; i < rays.size(); ++i)
            EXPECT_EQ(rays[i].occluded(), i % 7 == 0) << i;
    }
}

TEST(RayScene, RefusedMemoryIsAnError) {
    const Result<BakeGeometry> geometry =
        makeBakeGeometry(sceneOf({sphereMesh(1.0, 256, 128)}), {});
    ASSERT_TRUE(geometry.ok());
    const Result<RayScene> scene = RayScene::build(*geometry, {}, 100'000);
    ASSERT_FALSE(scene.ok());
    EXPECT_EQ(scene.error().kind, ErrorKind::Internal);
    EXPECT_NE(scene.error().message.find("memory"), std::string::npos);
}

TEST(RayScene, ACancelledBuildSaysSo) {
    const Result<BakeGeometry> geometry = makeBakeGeometry(sceneOf({sphereMesh(1.0)}), {});
    ASSERT_TRUE(geometry.ok());
    JobControl control;
    control.cancel();
    const Result<RayScene> scene = RayScene::build(*geometry, control.context());
    ASSERT_FALSE(scene.ok());
    EXPECT_EQ(scene.error().kind, ErrorKind::Cancelled);
}
