// The hierarchy that is shown, and how many of its boxes and triangles rays test.
#include "core/trace/whitted/TeachingHierarchy.h"

#include "core/trace/whitted/WhittedTracer.h"
#include "tests/core/trace/WhittedScenes.h"

#include <algorithm>
#include <glm/common.hpp>
#include <gtest/gtest.h>
#include <vector>

namespace patina {

using test::ofVariedScene;
using test::variedScene;
using test::whittedScene;

TEST(Whitted, HeatMapsCountWhatTheTreeHas) {
    const TraceScene scene = whittedScene(variedScene());
    const TraceView view = ofVariedScene();
    const TeachingHierarchy hierarchy = TeachingHierarchy::build(*scene.geometry(), {});
    Film film(view.width, view.height);
    RayCountMap counts(view.width, view.height);
    ASSERT_TRUE(
        traceWhitted(scene, view, {}, film, 0, 1, {}, nullptr, {}, &counts, &hierarchy).ok());
    for (int y = 0; y < view.height; y += 4)
        for (int x = 0; x < view.width; x += 2) {
            const RayTree tree = traceRayTree(scene, view, {}, x, y, 1);
            std::uint32_t rays = 0, depth = 0;
            for (const RayNode& node : tree.nodes())
                if (wasCast(node.end)) {
                    ++rays;
                    depth = std::max(depth, static_cast<std::uint32_t>(node.depth));
                }
            const RayCounts& pixel = counts.pixels()[static_cast<std::size_t>(y * view.width + x)];
            EXPECT_EQ(pixel.rays, rays) << x << " " << y;
            EXPECT_EQ(pixel.depth, depth) << x << " " << y;
            EXPECT_GE(pixel.boxTests, rays);
            EXPECT_LT(pixel.triangleTests, rays * hierarchy.triangleCount() / 10);
        }
}

// What is found with the boxes is what is found without.
TEST(TeachingHierarchy, BoxesHoldWhatIsBelowThem) {
    const TraceScene scene = whittedScene(variedScene());
    const TeachingHierarchy hierarchy = TeachingHierarchy::build(*scene.geometry(), {});
    EXPECT_EQ(hierarchy.triangleCount(), scene.geometry()->triangleCount());
    ASSERT_EQ(hierarchy.boxes(0).size(), 1u);
    const TeachingHierarchy::Box whole = hierarchy.boxes(0)[0];
    glm::vec3 low(1e9f), high(-1e9f);
    for (const BakeGeometryMesh& mesh : scene.geometry()->meshes)
        for (const std::uint32_t i : mesh.mesh->indices) {
            low = glm::min(low, mesh.positions[i]);
            high = glm::max(high, mesh.positions[i]);
        }
    EXPECT_EQ(whole.low, low);
    EXPECT_EQ(whole.high, high);
    std::size_t before = 1;
    for (int level = 1; level < hierarchy.levels(); ++level) {
        const std::vector<TeachingHierarchy::Box> boxes = hierarchy.boxes(level);
        EXPECT_GT(boxes.size(), before);
        before = boxes.size();
        for (const TeachingHierarchy::Box& box : boxes)
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_GE(box.low[axis], low[axis]);
                EXPECT_LE(box.high[axis], high[axis]);
            }
    }
    // A ray that passes the scene tests its box alone.
    const TeachingHierarchy::Tests none = hierarchy.count({0, 5, 0}, {0, 1, 0}, 1e9f);
    EXPECT_EQ(none.boxes, 1u);
    EXPECT_EQ(none.triangles, 0u);
}

} // namespace patina
