// A cell that shows a snapshot, and axes of snapshots.

#include "core/cells/Cell.h"
#include "core/cells/WallAxes.h"
#include "core/cells/WallPlan.h"
#include "core/document/Snapshot.h"
#include "core/edit/Edit.h"
#include "core/edit/EditSession.h"
#include "core/light/Light.h"
#include "core/material/Material.h"

#include <gmock/gmock.h>

namespace patina {
namespace {

using testing::HasSubstr;

class SnapshotCells : public testing::Test {
  protected:
    SnapshotCells() {
        Document document;
        material = addMaterial(document, Material{});
        MeshInstance& mesh = document.meshes.emplace_back();
        mesh.id = document.takeId();
        mesh.material = material;
        document.environment().kind = EnvironmentKind::Sky;
        session.replace(std::move(document));
        before = session.document();
        rough = session.keepSnapshot("Rough", nullptr);
        session.setParameter(parameter("material.perceptualRoughness"), {Scope::Material, material},
                             0.0f);
        session.setParameter(parameter("environment.skySunElevationDeg"), {Scope::Environment, 0},
                             5.0f);
        session.addLight(LightType::Point);
        smooth = session.keepSnapshot("Smooth", nullptr);
    }
    Document shown(const Cell& cell) const { return *documentOf(session.document(), cell); }
    static Cell of(Id snapshot) {
        Cell cell;
        cell.snapshot = snapshot;
        return cell;
    }

    EditSession session;
    Document before;
    Id material = 0, rough = 0, smooth = 0;
};

TEST_F(SnapshotCells, ShowsTheDocumentAsItWas) {
    EXPECT_EQ(shown(of(smooth)), session.document());
    Document expected = before;
    expected.snapshots = session.document().snapshots;
    expected.nextId = session.document().nextId;
    EXPECT_EQ(shown(of(rough)), expected);
    Document resolved = shown(of(rough));
    resolveCell(resolved, session.document());
    EXPECT_NE(resolved.environment().image, nullptr) << "another sun, another picture";
}

TEST_F(SnapshotCells, WhatElseItHasOfItsOwnComesOnTop) {
    Cell cell = of(rough);
    cell.own.push_back(
        {{Scope::Material, material}, findParameter("material.perceptualRoughness"), 0.25f});
    EXPECT_EQ(shown(cell).material(material)->perceptualRoughness, 0.25f);
    EXPECT_TRUE(shown(cell).lights.empty());
    EXPECT_EQ(combined(of(rough), of(smooth)).snapshot, smooth);
    EXPECT_EQ(combined(of(rough), Cell{}).snapshot, rough);
}

TEST_F(SnapshotCells, PutIntoTheSceneIsOneStep) {
    const int steps = session.count();
    putIntoScene(session, of(rough));
    EXPECT_EQ(session.count(), steps + 1);
    EXPECT_EQ(session.document().material(material)->perceptualRoughness, 0.5f);
    EXPECT_TRUE(session.document().lights.empty());
}

TEST_F(SnapshotCells, OneThatWasRemovedIsNamed) {
    session.removeSnapshot(rough);
    const Result<Document> result = documentOf(session.document(), of(rough));
    ASSERT_FALSE(result.ok());
    EXPECT_THAT(result.error().message, HasSubstr("snapshot"));
}

TEST_F(SnapshotCells, AreRowsOrColumnsOfAWall) {
    WallPlan plan;
    plan.columns.compared = Compared::Snapshots;
    plan.rows = valuesPlan(*findParameter("view.exposureEv"), {Scope::View, 0});
    Result<Wall> wall = planWall(session.document(), plan);
    ASSERT_TRUE(wall.ok()) << wall.error().text();
    ASSERT_EQ(wall->columns.entries.size(), 2u);
    EXPECT_EQ(wall->columns.title, "Snapshot");
    EXPECT_EQ(wall->columns.entries[0].caption, "Rough");
    EXPECT_EQ(wall->columns.entries[1].cell.snapshot, smooth);
    plan.columns.hidden = {rough};
    EXPECT_EQ(planWall(session.document(), plan)->columns.entries.size(), 1u);
    plan.rows = plan.columns;
    wall = planWall(session.document(), plan);
    ASSERT_FALSE(wall.ok());
    EXPECT_THAT(wall.error().message, HasSubstr("both show snapshots"));
    plan.rows = {};
    session.removeSnapshot(rough);
    session.removeSnapshot(smooth);
    EXPECT_FALSE(planWall(session.document(), plan).ok());
}

TEST_F(SnapshotCells, AreFoundByName) {
    const std::vector<std::string> both{"Smooth", "Rough"}, wrong{"smoth"};
    EXPECT_EQ(*snapshotsNamed(session.document(), both), (std::vector<Id>{smooth, rough}));
    const auto unknown = snapshotsNamed(session.document(), wrong);
    ASSERT_FALSE(unknown.ok());
    EXPECT_THAT(unknown.error().message, HasSubstr("\"Rough\", \"Smooth\""));
    const auto none = snapshotsNamed(before, both);
    ASSERT_FALSE(none.ok());
    EXPECT_THAT(none.error().message, HasSubstr("no snapshots"));
}

} // namespace
} // namespace patina
