#include "core/bake/TransferRefinement.h"
#include "core/bake/Bake.h"
#include "tests/core/bake/BakeTestScene.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

using namespace patina;
using namespace patina::test;

namespace {

RefinementSettings settingsOf(float tolerance, int rounds) {
    RefinementSettings settings;
    settings.bake.order = 2;
    settings.bake.samples = 128;
    settings.tolerance = tolerance;
    settings.rounds = rounds;
    return settings;
}

} // namespace

// A floor of two triangles and a small ball on it: only the floor about the ball becomes finer.
TEST(TransferRefinement, SplitsWhereShadowsAre) {
    const BakeInputs inputs = sceneOf({planeMesh(4.0, 4), sphereMesh(0.5, 24, 16, {0, 0.5, 0})});
    const Result<RefinedMeshes> refined = refineForTransfer(inputs, settingsOf(0.01f, 4), {});
    ASSERT_TRUE(refined.ok());
    ASSERT_EQ(refined->meshes.size(), 2u);
    EXPECT_GE(refined->rounds, 2);
    EXPECT_LT(refined->errorAfter, 0.6 * refined->errorBefore);
    EXPECT_EQ(refined->triangles,
              refined->meshes[0]->triangleCount() + refined->meshes[1]->triangleCount());
    const Mesh& floor = *refined->meshes[0];
    double near = 0, far = 0;
    for (const glm::vec3& p : floor.positions)
        ++(std::max(std::abs(p.x), std::abs(p.z)) < 2.0f ? near : far);
    EXPECT_GT(near, 40.0); // 9 before
    EXPECT_GT(near, far);  // of a quarter of the area
}

TEST(TransferRefinement, WhatIsFineEnoughStays) {
    const BakeInputs inputs = sceneOf({planeMesh(4.0, 4)});
    const Result<RefinedMeshes> refined = refineForTransfer(inputs, settingsOf(0.02f, 3), {});
    ASSERT_TRUE(refined.ok());
    EXPECT_EQ(refined->meshes.at(0), inputs.meshes[0].mesh); // the very same
    EXPECT_EQ(refined->rounds, 0);
    EXPECT_EQ(refined->tooCoarse, 0u);
}

// A bake says how much of the surface that would split, and not when noise says it.
TEST(TransferRefinement, IsAdvisedOfCoarseMeshes) {
    const BakeInputs inputs = sceneOf({planeMesh(4.0, 4), sphereMesh(0.5, 24, 16, {0, 0.5, 0})});
    PrtSettings settings;
    settings.order = 2;
    const auto bakeWith = [&](int samples, bool fitted) {
        settings.samples = samples;
        settings.fitted = fitted;
        TileSink nobody;
        return *bakePrtVertex(inputs, settings, nobody, {});
    };
    const BakeArtifact coarse = bakeWith(128, true);
    const double share = coarseShare(inputs, coarse.vertices);
    EXPECT_GT(share, 0.05); // 8 of 32 triangles touch the ball's foot, of 64 of 67 m²
    EXPECT_LT(share, 0.5);
    EXPECT_LT(coarseShare(inputs, coarse.vertices, 0.02f), share);
    EXPECT_EQ(coarseShare(inputs, coarse.vertices, 10.0f), 0.0);
    const std::string note = coarse.note;
    EXPECT_EQ(note.find(fmt::format("On {:.1f} % of the surface", 100.0 * share)), 0u) << note;
    EXPECT_NE(note.find("too coarse"), std::string::npos);
    EXPECT_EQ(bakeWith(64, true).note, "");
    EXPECT_EQ(bakeWith(128, false).note, "");
    BakeInputs flat = sceneOf({planeMesh(4.0, 4)});
    TileSink nobody;
    settings.fitted = true;
    EXPECT_EQ(bakePrtVertex(flat, settings, nobody, {})->note, "");
}

TEST(TransferRefinement, EndsAtTheBudget) {
    const BakeInputs inputs = sceneOf({planeMesh(4.0, 4), sphereMesh(0.5, 24, 16, {0, 0.5, 0})});
    RefinementSettings settings = settingsOf(1e-6f, 12); // below all noise
    settings.maxTriangles = 3000;
    const Result<RefinedMeshes> refined = refineForTransfer(inputs, settings, {});
    ASSERT_TRUE(refined.ok());
    EXPECT_LE(refined->triangles, 3000u);
    EXPECT_GT(refined->tooCoarse, 0u);
}

TEST(TransferRefinement, RefusesSenselessSettings) {
    const BakeInputs inputs = sceneOf({planeMesh(4.0, 4)});
    for (const RefinementSettings& settings :
         {settingsOf(0.0f, 3), settingsOf(-1.0f, 3), settingsOf(NAN, 3), settingsOf(0.1f, 0),
          settingsOf(0.1f, 13)}) {
        const Result<RefinedMeshes> refined = refineForTransfer(inputs, settings, {});
        ASSERT_FALSE(refined.ok());
        EXPECT_EQ(refined.error().kind, ErrorKind::Usage);
    }
    EXPECT_FALSE(refineForTransfer({}, settingsOf(0.1f, 3), {}).ok());
}
