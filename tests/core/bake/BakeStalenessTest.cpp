#include "core/bake/document/BakeStaleness.h"
#include "core/bake/Bake.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/bake/domain/BakeOptions.h"
#include "core/document/Document.h"
#include "tests/core/bake/BakeTestScene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace patina;
using namespace patina::test;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

namespace {

class BakeStalenessTest : public ::testing::Test {
  protected:
    void SetUp() override {
        for (const char* name : {"Ball", "Wall"}) {
            MeshInstance mesh;
            mesh.id = document.takeId();
            mesh.name = name;
            mesh.mesh = std::make_shared<const Mesh>(sanitized(planeMesh(1.0, 2)));
            document.meshes.push_back(mesh);
        }
        request.prt.samples = 64;
        bake.kind = BakeKind::PrtVertex;
        bake.inputs = inputs();
        bake.settings = settingsText(request);
        for (const MeshInstance& mesh : document.meshes) {
            VertexBake part;
            part.mesh = mesh.id;
            part.stride = 9;
            part.values.resize(mesh.mesh->vertexCount() * 9);
            bake.vertices.push_back(part);
        }
    }
    [[nodiscard]] Hash inputs() const { return hashBakeInputs(bakeInputs(document)); }
    [[nodiscard]] BakeStaleness staleness(const Hash& albedo = {}) const {
        return bakeStaleness(bake, document, inputs(), albedo);
    }

    Document document;
    BakeArtifact bake;
    BakeRequest request;
};

TEST_F(BakeStalenessTest, AFreshBakeIsNotStale) {
    EXPECT_FALSE(staleness().stale());
    EXPECT_THAT(staleness().reasons, IsEmpty());
    EXPECT_FALSE(staleness({3, 4}).stale()) << "nothing bounces in this one";
}

TEST_F(BakeStalenessTest, SaysWhatChangedOfTheGeometry) {
    const Document before = document;
    document.meshes[1].visible = false;
    EXPECT_TRUE(staleness().geometry);
    EXPECT_THAT(staleness().reasons, ElementsAre("“Wall” was hidden"));
    document = before;
    document.meshes.erase(document.meshes.begin());
    EXPECT_THAT(staleness().reasons, ElementsAre("a mesh was removed"));
    document = before;
    document.meshes[0].mesh = std::make_shared<const Mesh>(sanitized(planeMesh(1.0, 3)));
    EXPECT_THAT(staleness().reasons, ElementsAre("“Ball” has other vertices"));
    document = before;
    document.meshes.push_back(document.meshes[0]);
    document.meshes.back().id = document.takeId();
    document.meshes.back().name = "Lamp";
    EXPECT_THAT(staleness().reasons, ElementsAre("“Lamp” was added or shown"));
    document = before;
    document.meshes[0].placement.setPosition({1, 0, 0});
    EXPECT_TRUE(staleness().geometry);
    EXPECT_EQ(staleness().reasons.size(), 1u);
}

TEST_F(BakeStalenessTest, AlbedoCountsWhereLightBounces) {
    bake.albedo = {1, 1};
    EXPECT_FALSE(staleness({1, 1}).stale());
    EXPECT_TRUE(staleness({1, 2}).albedo);
    EXPECT_FALSE(staleness({1, 2}).geometry);
    EXPECT_EQ(staleness({1, 2}).reasons.size(), 1u);

    const Document before = document;
    document.meshes[0].placement.setPosition({1, 0, 0});
    EXPECT_TRUE(staleness({1, 2}).geometry);
    EXPECT_TRUE(staleness({1, 2}).albedo) << "of the same meshes";
    document.meshes[0].visible = false; // and so its albedo is none of the scene's
    EXPECT_THAT(staleness({1, 2}).reasons, ElementsAre("“Ball” was hidden"));
    EXPECT_FALSE(staleness({1, 2}).albedo);
    document = before;
    document.meshes.push_back(document.meshes[0]);
    document.meshes.back().id = document.takeId();
    EXPECT_FALSE(staleness({1, 2}).albedo);
}

TEST_F(BakeStalenessTest, NamesTheSettingsThatDifferWithoutCallingItStale) {
    request.prt.samples = 50; // traced as 64
    EXPECT_THAT(settingDifferences(bake, request), IsEmpty());
    request.prt.samples = 256;
    request.prt.order = 5;
    EXPECT_FALSE(staleness().stale());
    const SettingDifference bands{"Bands", "3", "5"}, rays{"Rays", "64", "256"};
    EXPECT_THAT(settingDifferences(bake, request), ElementsAre(bands, rays));
    bake.settings.erase("order"); // of an older file
    EXPECT_THAT(settingDifferences(bake, request), ElementsAre(rays));
}

TEST_F(BakeStalenessTest, ABakeThatWasStoppedSaysAtHowManyRays) {
    bake.samplesDone = 64;
    EXPECT_EQ(stoppedEarly(bake), std::nullopt);
    bake.samplesDone = 32;
    ASSERT_TRUE(stoppedEarly(bake));
    EXPECT_EQ(stoppedEarly(bake)->done, 32);
    EXPECT_EQ(stoppedEarly(bake)->asked, 64);
    // Bakes to a tolerance may well be done with fewer.
    bake.settings["tolerance"] = "0.01";
    EXPECT_EQ(stoppedEarly(bake), std::nullopt);
    bake.stopped = true;
    EXPECT_TRUE(stoppedEarly(bake));
    bake.settings.erase("samples"); // unshadowed transfer casts none
    EXPECT_EQ(stoppedEarly(bake), std::nullopt);
}

// By the bake itself, with and without a tolerance.
TEST_F(BakeStalenessTest, AStopIsNotedInTheBake) {
    class StopAfterFirstPass : public TileSink {
      public:
        explicit StopAfterFirstPass(JobControl& control)
            : m_control(control) {}
        void passDone(int /*samples*/) override { m_control.stop(); }

      private:
        JobControl& m_control;
    };
    for (const float tolerance : {0.0f, 1e-6f}) {
        JobControl control;
        StopAfterFirstPass sink(control);
        request.prt.samples = 1024;
        request.prt.tolerance = tolerance;
        const Result<BakeArtifact> stopped =
            bakePrtVertex(bakeInputs(document), request.prt, sink, control.context());
        ASSERT_TRUE(stopped) << stopped.error().text();
        ASSERT_TRUE(stoppedEarly(*stopped)) << tolerance;
        EXPECT_LT(stoppedEarly(*stopped)->done, 1024);
        EXPECT_EQ(stoppedEarly(*stopped)->asked, 1024);
        TileSink nobody;
        const Result<BakeArtifact> whole =
            bakePrtVertex(bakeInputs(document), request.prt, nobody, JobContext());
        ASSERT_TRUE(whole) << whole.error().text();
        EXPECT_FALSE(stoppedEarly(*whole)) << tolerance;
    }
}

} // namespace
