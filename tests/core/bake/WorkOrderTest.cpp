#include "core/bake/transfer/WorkOrder.h"
#include "core/bake/Bake.h"
#include "core/job/Parallel.h"
#include "core/math/Camera.h"
#include "tests/core/bake/BakeTestScene.h"

#include <gtest/gtest.h>

using namespace patina;
using namespace patina::test;

namespace {

// From +Z, straight at the origin.
BakeView frontView() {
    Camera camera;
    camera.yawDeg = camera.pitchDeg = 0.0f;
    camera.distance = 4.0f;
    const Bounds scene{glm::vec3(-1.0f), glm::vec3(1.0f)};
    return {camera.position(), camera.projectionMatrix(1.0f, scene) * camera.viewMatrix()};
}

class Watched : public Recorder {
  public:
    explicit Watched(std::optional<BakeView> view)
        : m_view(view) {}
    std::optional<BakeView> view() override { return m_view; }
    void vertices(Id mesh, std::size_t first, int stride, std::span<const float> values) override {
        Recorder::vertices(mesh, first, stride, values);
        meshes.push_back(mesh);
    }
    std::vector<Id> meshes; // as they came; with one thread only

  private:
    std::optional<BakeView> m_view;
};

TEST(WorkOrder, WhatIsSeenComesFirst) {
    const glm::vec3 front{0, 0, 1}, back{0, 0, -1};
    const std::vector<BakePoint> points{
        {{5, 0, 0}, front},          // beside the picture
        {{0, 0, 0}, back},           // in it, turned away
        {{0, 0, 0}, front},          // seen
        {{0, 0, 9}, front},          // behind the eye
        {{0.2f, 0.1f, 0.3f}, front}, // seen
        {{0, -1.5f, 0}, front},      // below the picture: half its height is 1.26 there
        {{0, -1.3f, 0}, {0, 1, 1}},  // within the margin
    };
    std::vector<PointRange> ranges;
    for (std::size_t i = 0; i < points.size(); ++i)
        ranges.push_back({i, 1});
    const std::vector<std::uint32_t> expected{2, 4, 6, 1, 0, 3, 5};
    EXPECT_EQ(workOrder(points, ranges, frontView()), expected);
    const std::vector<std::uint32_t> asTheyStand{0, 1, 2, 3, 4, 5, 6};
    EXPECT_EQ(workOrder(points, ranges, std::nullopt), asTheyStand);
}

TEST(WorkOrder, ARangeIsAsUrgentAsTheBestOfItsPoints) {
    std::vector<BakePoint> points(20, BakePoint{{9, 9, 0}, {0, 0, 1}});
    points[19].origin = {0, 0, 0}; // the last of the second range
    const std::vector<PointRange> ranges{{0, 10}, {10, 10}};
    const std::vector<std::uint32_t> expected{1, 0};
    EXPECT_EQ(workOrder(points, ranges, frontView()), expected);
}

// A scene far from the origin and at an odd scale is ordered as it is seen.
TEST(WorkOrder, ABakeVisitsWhatIsSeenFirstAndComesToTheSame) {
    BakeInputs inputs =
        sceneOf({sphereMesh(1.0, 24, 12, {0, 0, 0}), sphereMesh(1.0, 24, 12, {0, 0, 0}),
                 sphereMesh(1.0, 24, 12, {0, 0, 0})});
    const glm::vec3 place(300.0f, -20.0f, 40.0f);
    for (std::size_t m = 0; m < 3; ++m) // far left, far right, in the middle
        inputs.meshes[m].transform =
            glm::translate(glm::mat4(1.0f), place + glm::vec3(m == 2   ? 0.0f
                                                              : m == 0 ? -30.0f
                                                                       : 30.0f,
                                                              0, 0));
    Camera camera;
    camera.target = place;
    camera.distance = 5.0f;
    const Bounds scene{place - glm::vec3(32.0f), place + glm::vec3(32.0f)};
    const BakeView view{camera.position(),
                        camera.projectionMatrix(1.0f, scene) * camera.viewMatrix()};

    const ThreadLimit limit(1);
    AoSettings settings;
    settings.samples = 32;
    Watched watched(view), unwatched(std::nullopt);
    const Result<BakeArtifact> seen = bakeAoVertex(inputs, settings, watched, {});
    const Result<BakeArtifact> plain = bakeAoVertex(inputs, settings, unwatched, {});
    ASSERT_TRUE(seen.ok() && plain.ok());
    EXPECT_EQ(*seen, *plain);
    ASSERT_GT(watched.meshes.size(), 4u);
    EXPECT_EQ(watched.meshes.front(), 3u);
    EXPECT_EQ(unwatched.meshes.front(), 1u);
    // Nothing of the others comes before the last of the middle one.
    const auto last = std::find(watched.meshes.rbegin(), watched.meshes.rend(), Id{3}).base();
    EXPECT_EQ(std::count(watched.meshes.begin(), last, Id{3}), last - watched.meshes.begin());
}

} // namespace
