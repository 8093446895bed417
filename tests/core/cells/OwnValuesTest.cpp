#include "core/cells/OwnValues.h"
#include "core/cells/WallAxes.h"
#include "core/edit/EditSession.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/scene/Scene.h"

#include <gtest/gtest.h>

namespace patina {
namespace {

const ParameterInfo& rotation() {
    return *findParameter("environment.rotationDeg");
}

class OwnValuesTest : public testing::Test {
  protected:
    void SetUp() override {
        document = startDocument();
        environments = {document.mix.first, addEnvironment(document, Environment()),
                        addEnvironment(document, Environment())};
        wall = *makeWall({environmentAxis(document, environments)});
    }
    [[nodiscard]] float rotationOf(std::size_t cell) const {
        return documentOf(document, cellsOf(wall, own)[cell].cell)->environment().rotationDeg;
    }
    [[nodiscard]] CellEdit turned(float degrees) const {
        return {{Scope::Environment, 0}, &rotation(), degrees};
    }

    Document document;
    std::vector<Id> environments;
    Wall wall;
    std::vector<OwnValues> own;
};

TEST_F(OwnValuesTest, AValueIsOneCellsAlone) {
    setOwnValue(own, cellsOf(wall)[1], turned(90.0f));
    EXPECT_FLOAT_EQ(rotationOf(0), 0.0f);
    EXPECT_FLOAT_EQ(rotationOf(1), 90.0f);
    EXPECT_FLOAT_EQ(rotationOf(2), 0.0f);
    setOwnValue(own, cellsOf(wall, own)[1], turned(45.0f)); // of the cell as it is now
    EXPECT_FLOAT_EQ(rotationOf(1), 45.0f);
    ASSERT_EQ(own.size(), 1u);
    EXPECT_EQ(own[0].own.values.size(), 1u) << "one value of a parameter";
    // What it does not have of its own follows the document.
    document.environment(environments[0])->rotationDeg = 10.0f;
    document.environment(environments[1])->rotationDeg = 10.0f;
    EXPECT_FLOAT_EQ(rotationOf(0), 10.0f);
    EXPECT_FLOAT_EQ(rotationOf(1), 45.0f);
}

TEST_F(OwnValuesTest, LinkedAgainItShowsTheDocuments) {
    const CellEdit exposure{{Scope::View, 0}, findParameter("view.exposureEv"), 1.0f};
    setOwnValue(own, cellsOf(wall)[2], turned(90.0f));
    setOwnValue(own, cellsOf(wall)[2], exposure);
    linkValue(own, cellsOf(wall)[1], {Scope::Environment, 0}, rotation()); // has none
    linkValue(own, cellsOf(wall)[2], {Scope::Environment, 0}, rotation());
    EXPECT_FLOAT_EQ(rotationOf(2), 0.0f);
    EXPECT_EQ(cellsOf(wall, own)[2].own.values, std::vector<CellEdit>{exposure});
    linkValue(own, cellsOf(wall)[2], exposure.target, *exposure.info);
    EXPECT_TRUE(own.empty());
    EXPECT_EQ(cellsOf(wall, own), cellsOf(wall));
}

TEST_F(OwnValuesTest, ItGoesWithItsCell) {
    setOwnValue(own, cellsOf(wall)[2], turned(90.0f));
    wall = *makeWall({environmentAxis(document, std::vector{environments[2], environments[0]})});
    EXPECT_FLOAT_EQ(rotationOf(0), 90.0f);
    EXPECT_FLOAT_EQ(rotationOf(1), 0.0f);
    wall = *makeWall({environmentAxis(document, std::vector{environments[0], environments[1]})});
    EXPECT_FLOAT_EQ(rotationOf(1), 0.0f);
}

// Of a column's value and the cell's own, the cell's wins.
TEST_F(OwnValuesTest, ItIsAboveItsColumnsValue) {
    const Target target{Scope::Environment, 0};
    wall = *makeWall({*valueAxis(document, rotation(), {&target, 1}, 0.0f, 90.0f, 3, false)});
    setOwnValue(own, cellsOf(wall)[1], turned(7.0f));
    EXPECT_FLOAT_EQ(rotationOf(0), 0.0f);
    EXPECT_FLOAT_EQ(rotationOf(1), 7.0f);
    EXPECT_FLOAT_EQ(rotationOf(2), 90.0f);
}

TEST_F(OwnValuesTest, AnEnvironmentIsOneCellsAlone) {
    const auto lightOf = [&](std::size_t cell) {
        return documentOf(document, cellsOf(wall, own)[cell].cell)->mix.first;
    };
    setOwnElement(own, cellsOf(wall)[0], CellElement::Environment, environments[2]);
    EXPECT_EQ(lightOf(0), environments[2]);
    EXPECT_EQ(lightOf(1), environments[1]);
    EXPECT_EQ(cellsOf(wall, own)[0].own.element(CellElement::Environment), environments[2]);
    EXPECT_EQ(cellsOf(wall, own)[0].shared.environment, environments[0]);
    // A value beside it is that of the environment which lights the cell.
    setOwnValue(own, cellsOf(wall, own)[0], turned(90.0f));
    ASSERT_EQ(own.size(), 1u);
    EXPECT_FLOAT_EQ(rotationOf(0), 90.0f);
    linkValue(own, cellsOf(wall, own)[0], {Scope::Environment, 0}, rotation());
    EXPECT_EQ(lightOf(0), environments[2]) << "the other one stays";
    setOwnElement(own, cellsOf(wall, own)[0], CellElement::Environment, 0);
    EXPECT_EQ(lightOf(0), environments[0]);
    EXPECT_TRUE(own.empty());

    // Removed from the scene: the cell says so.
    setOwnElement(own, cellsOf(wall)[1], CellElement::Environment, environments[2]);
    removeEnvironment(document, environments[2]);
    const Result<Document> shown = documentOf(document, cellsOf(wall, own)[1].cell);
    ASSERT_FALSE(shown);
    EXPECT_NE(shown.error().message.find("no longer in the scene"), std::string::npos);
}

TEST_F(OwnValuesTest, AMaterialCoversAllVisibleMeshesOfACell) {
    const Id gold = addMaterial(document, Material()), clay = addMaterial(document, Material());
    document.meshes.resize(1);
    for (const bool visible : {true, false}) {
        MeshInstance copy = document.meshes.front();
        copy.id = document.takeId();
        copy.visible = visible;
        document.meshes.push_back(copy);
    }
    const Id before = document.meshes.back().material;
    // Its column sets one, too: the cell's own wins.
    wall = *makeWall({materialAxis(document, std::array{clay, gold})});
    const auto coverOf = [&](std::size_t cell) {
        const Result<Document> shown = documentOf(document, cellsOf(wall, own)[cell].cell);
        std::vector<Id> ids;
        for (const MeshInstance& mesh : shown->meshes)
            ids.push_back(mesh.material);
        return ids;
    };
    ASSERT_EQ(coverOf(0), (std::vector{clay, clay, before}));
    setOwnElement(own, cellsOf(wall)[0], CellElement::Material, gold);
    EXPECT_EQ(coverOf(0), (std::vector{gold, gold, before})) << "hidden meshes keep theirs";
    EXPECT_EQ(cellsOf(wall, own)[0].own.element(CellElement::Material), gold);
    EXPECT_EQ(document.meshes.front().material, before) << "the scene is as it was";

    EditSession session;
    session.replace(document);
    putIntoScene(session, cellsOf(wall, own)[0].cell);
    EXPECT_EQ(session.document().meshes[1].material, gold);
    EXPECT_EQ(session.document().meshes[2].material, before);

    setOwnElement(own, cellsOf(wall)[0], CellElement::Material, 0);
    EXPECT_TRUE(own.empty());
    EXPECT_EQ(coverOf(0), (std::vector{clay, clay, before}));

    setOwnElement(own, cellsOf(wall)[0], CellElement::Material, 4711);
    const Result<Document> gone = documentOf(document, cellsOf(wall, own)[0].cell);
    ASSERT_FALSE(gone);
    EXPECT_NE(gone.error().message.find("material of this cell is no longer"), std::string::npos);
}

TEST_F(OwnValuesTest, ASnapshotIsBelowWhatElseACellHasOfItsOwn) {
    EditSession session;
    document.view.exposureEv = 2.0f;
    session.replace(document);
    const Id kept = session.keepSnapshot("Bright", nullptr);
    session.setParameter(*findParameter("view.exposureEv"), {Scope::View, 0}, 0.0f);
    document = session.document();
    const auto exposureOf = [&](std::size_t cell) {
        return documentOf(document, cellsOf(wall, own)[cell].cell)->view.exposureEv;
    };
    EXPECT_FLOAT_EQ(exposureOf(1), 0.0f);
    setOwnElement(own, cellsOf(wall)[1], CellElement::Snapshot, kept);
    EXPECT_FLOAT_EQ(exposureOf(1), 2.0f);
    EXPECT_FLOAT_EQ(exposureOf(0), 0.0f);
    setOwnValue(own, cellsOf(wall, own)[1],
                {{Scope::View, 0}, findParameter("view.exposureEv"), 1.0f});
    EXPECT_FLOAT_EQ(exposureOf(1), 1.0f);
    EXPECT_EQ(documentOf(document, cellsOf(wall, own)[1].cell)->mix.first, environments[1])
        << "its column's environment comes on top of the snapshot's";
}

} // namespace
} // namespace patina
