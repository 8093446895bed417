// What stands within another object tells nothing about the light beside it.
#include "core/bake/bounce/HiddenElements.h"
#include "core/bake/Bake.h"
#include "core/bake/bounce/Interreflection.h"
#include "tests/core/bake/BakeTestScene.h"

#include <gtest/gtest.h>

using namespace patina;
using namespace patina::test;

namespace {

BakeArtifact bake(const BakeInputs& inputs, std::uint64_t hitBudget = std::uint64_t{1} << 30) {
    TileSink sink;
    PrtSettings settings;
    settings.order = 1;
    settings.samples = 64;
    settings.transfer = TransferKind::Interreflected;
    settings.bounces = 1;
    settings.bounceSamples = 256;
    settings.hitBudget = hitBudget;
    Result<BakeArtifact> artifact = bakePrtVertex(inputs, settings, sink, {});
    EXPECT_TRUE(artifact.ok());
    return artifact ? std::move(*artifact) : BakeArtifact{};
}

// A floor of `cells` squares from -1 to 1, and on it a cube from -0.55 to 0.55.
BakeInputs cubeOnFloor(int cells) {
    Mesh cube = cubeMesh(0.55);
    for (glm::vec3& position : cube.positions)
        position.y += 0.55f;
    return sceneOf({planeMesh(1.0, cells), std::move(cube)});
}

float bouncedAt(const BakeArtifact& artifact, const BakeInputs& inputs, const glm::vec3& point) {
    return artifact.vertices[0].bounced[3 * vertexAt(*inputs.meshes[0].mesh, point)];
}

} // namespace

// The cube's wall stands between the floor's vertices at 0.5 and 0.75. Between them the floor is
// as bright as a floor is that has vertices everywhere.
TEST(HiddenElements, DarknessDoesNotRunOutFromBelowAnObject) {
    const BakeInputs fine = cubeOnFloor(32), coarse = cubeOnFloor(8);
    const BakeArtifact truth = bake(fine), artifact = bake(coarse);
    const float beside = bouncedAt(truth, fine, {0.625f, 0, 0});
    const float inside = bouncedAt(artifact, coarse, {0.5f, 0, 0}),
                outside = bouncedAt(artifact, coarse, {0.75f, 0, 0});
    EXPECT_NEAR(outside, bouncedAt(truth, fine, {0.75f, 0, 0}), 0.1f * outside);
    EXPECT_NEAR(0.5f * (inside + outside), beside, 0.25f * beside);
    EXPECT_EQ(bouncedAt(artifact, coarse, {0, 0, 0}), 0.0f); // farther in
}

TEST(HiddenElements, AreTheSameWhereHitsAreNotKept) {
    BakeInputs inputs = cubeOnFloor(8);
    EXPECT_EQ(bake(inputs, 0), bake(inputs));
    inputs.meshes[0].doubleSided = true; // backs have points and light of their own
    EXPECT_EQ(bake(inputs, 0), bake(inputs));
}

TEST(HiddenElements, TakeTheNearestPlaceThatSees) {
    // Vertices 0 1 2 / 3 4 5 / 6 7 8, the middle one pulled towards 1.
    Mesh mesh = planeMesh(1.0, 2);
    mesh.positions[4].z = -0.2f;
    BakeInputs inputs = sceneOf({mesh});
    inputs.meshes[0].doubleSided = true;
    const Result<BakeGeometry> geometry = makeBakeGeometry(inputs, {});
    const Result<BounceElements> elements = BounceElements::make(*geometry);
    const std::vector<BakePoint> before = elements->points(*geometry, {});
    const auto samePlace = [](const BakePoint& a, const BakePoint& b) {
        return a.origin == b.origin && a.normal == b.normal;
    };
    ASSERT_EQ(before.size(), 18u);
    const auto nearest = [&](std::size_t of, std::size_t begin, std::span<const std::size_t> all) {
        std::size_t best = all[0];
        for (const std::size_t v : all)
            if (glm::distance(before[begin + v].origin, before[begin + of].origin) <
                glm::distance(before[begin + best].origin, before[begin + of].origin))
                best = v;
        return begin + best;
    };

    // The middle of the front, and of the back all but one corner that no edge leads to.
    std::vector<std::uint8_t> hidden(18, 0);
    hidden[4] = 1;
    std::vector<BakePoint> points = before;
    EXPECT_EQ(moveHiddenPoints(*elements, hidden, points), std::vector<std::uint32_t>{4});
    const std::size_t around[] = {1, 3, 5, 7};
    EXPECT_TRUE(samePlace(points[4], before[nearest(4, 0, around)]));
    for (std::size_t v = 0; v < 18; ++v)
        EXPECT_EQ(samePlace(points[v], before[v]), v != 4) << v;

    // The back of the middle goes to a back.
    std::swap(hidden[4], hidden[13]);
    points = before;
    EXPECT_EQ(moveHiddenPoints(*elements, hidden, points), std::vector<std::uint32_t>{13});
    EXPECT_TRUE(samePlace(points[13], before[nearest(4, 9, around)]));

    // Nothing stands in for what is hidden all around.
    hidden.assign(18, 1);
    points = before;
    EXPECT_TRUE(moveHiddenPoints(*elements, hidden, points).empty());
    for (std::size_t v = 0; v < 18; ++v)
        EXPECT_TRUE(samePlace(points[v], before[v]));
}
