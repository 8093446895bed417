// What somebody chooses to compare, as a wall of the document as it is.
#include "core/cells/WallPlan.h"
#include "core/document/ViewChoices.h"
#include "core/edit/Edit.h"
#include "core/light/Light.h"
#include "core/material/Material.h"

#include <gmock/gmock.h>

namespace patina {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class WallPlans : public testing::Test {
  protected:
    WallPlans() {
        for (const char* name : {"Body", "Base"})
            addNamed(name);
    }
    Id addNamed(const char* name) {
        Material material;
        material.name = name;
        MeshInstance mesh;
        mesh.id = document.takeId();
        mesh.name = name;
        mesh.material = addMaterial(document, material);
        document.meshes.push_back(mesh);
        return mesh.material;
    }
    Id addEnvironmentNamed(const char* name) {
        Environment environment;
        environment.name = name;
        return addEnvironment(document, environment);
    }
    static AxisPlan of(Compared compared) {
        AxisPlan plan;
        plan.compared = compared;
        return plan;
    }
    std::vector<std::string> captions(const AxisPlan& plan) const {
        const Result<Wall> wall = planWall(document, {plan, {}});
        EXPECT_TRUE(wall.ok()) << (wall ? "" : wall.error().message);
        std::vector<std::string> result;
        if (wall)
            for (const WallEntry& entry : wall->columns.entries)
                result.push_back(entry.caption);
        return result;
    }
    std::string refusal(const WallPlan& plan) const {
        const Result<Wall> wall = planWall(document, plan);
        return wall ? std::string() : wall.error().message;
    }

    Document document;
};

TEST_F(WallPlans, TheFirstPlanComparesWhatTheSceneHasSeveralOf) {
    EXPECT_EQ(defaultWallPlan(document).columns.compared, Compared::Materials);
    EXPECT_EQ(defaultWallPlan(document).rows.compared, Compared::Nothing);
    addEnvironmentNamed("Studio");
    EXPECT_EQ(defaultWallPlan(document).columns.compared, Compared::Environments);
    EXPECT_EQ(defaultWallPlan(document).rows.compared, Compared::Materials);
    removeMaterial(document, document.materials.back().id);
    removeEnvironment(document, document.environments.back().id);
    const WallPlan values = defaultWallPlan(document);
    EXPECT_EQ(values.columns.compared, Compared::Values);
    EXPECT_THAT(captions(values.columns), ElementsAre("0.00", "0.25", "0.50", "0.75", "1.00"));
}

TEST_F(WallPlans, WhatIsAddedIsShownAndWhatIsHiddenIsNot) {
    AxisPlan plan = of(Compared::Materials);
    EXPECT_THAT(captions(plan), ElementsAre("Body", "Base"));
    plan.hidden = {document.materials[0].id};
    addNamed("Lid");
    EXPECT_THAT(captions(plan), ElementsAre("Base", "Lid"));
    removeMaterial(document, document.materials[1].id);
    EXPECT_THAT(captions(plan), ElementsAre("Lid"));
    plan.hidden.push_back(document.materials[1].id);
    EXPECT_THAT(refusal({plan, {}}), HasSubstr("nothing to show"));
}

TEST_F(WallPlans, OnlyWhatTheDocumentOffersIsShown) {
    EXPECT_THAT(captions(of(Compared::LightingModes)), testing::Not(testing::Contains("PRT")));
    for (const AxisChoice& choice : choicesOf(document, of(Compared::LightingModes), 64))
        EXPECT_NE(choice.shown, !choice.whyNot.empty()) << choice.caption;
    const auto curves = choicesOf(document, of(Compared::ToneCurves), 64);
    EXPECT_FALSE(curves.back().shown) << "OpenColorIO without a configuration";
    EXPECT_THAT(curves.back().whyNot, testing::Not(IsEmpty()));
    EXPECT_EQ(captions(of(Compared::ToneCurves)).size(), curves.size() - 1);
}

TEST_F(WallPlans, ASideOfATableHasAtMostEight) {
    for (int i = 0; i < 9; ++i)
        addEnvironmentNamed(std::to_string(i).c_str());
    const WallPlan table{of(Compared::Environments), of(Compared::Materials)};
    EXPECT_EQ(mostOnAxis(table), kMostOnWallSide);
    const Result<Wall> wall = planWall(document, table);
    ASSERT_TRUE(wall.ok());
    EXPECT_EQ(wall->width, kMostOnWallSide);
    EXPECT_EQ(wall->height, 2u);
    EXPECT_EQ(captions(of(Compared::Environments)).size(), 10u) << "a grid of them has more";
    AxisPlan few = of(Compared::Environments);
    few.hidden = {document.environments[0].id};
    EXPECT_EQ(choicesOf(document, few, kMostOnWallSide)[8].shown, true) << "the next one moves up";
}

TEST_F(WallPlans, RowsAloneStandBelowEachOther) {
    const Result<Wall> wall = planWall(document, {{}, of(Compared::Materials)});
    ASSERT_TRUE(wall.ok());
    EXPECT_EQ(wall->width, 1u);
    EXPECT_EQ(wall->height, 2u);
}

TEST_F(WallPlans, ValuesAreOfOneElementOrOfAll) {
    const ParameterInfo& roughness = *findParameter("material.perceptualRoughness");
    const Target base{Scope::Material, document.materials[1].id};
    Result<Wall> wall = planWall(document, {valuesPlan(roughness, base), {}});
    ASSERT_TRUE(wall.ok());
    EXPECT_EQ(wall->columns.title, "Roughness of Base");
    EXPECT_EQ(wall->columns.entries[0].cell.own.size(), 1u);
    wall = planWall(document, {valuesPlan(roughness, {Scope::Material, 0}), {}});
    ASSERT_TRUE(wall.ok());
    EXPECT_EQ(wall->columns.title, "Roughness of all materials");
    EXPECT_EQ(wall->columns.entries[0].cell.own.size(), 2u);
}

TEST_F(WallPlans, WhatIsGoneIsNamed) {
    AxisPlan values = valuesPlan(*findParameter("light.intensity"), {Scope::Light, 99});
    EXPECT_THAT(refusal({values, {}}), HasSubstr("its light is no longer in the scene"));
    AxisPlan materials = of(Compared::Materials);
    materials.meshes = {document.meshes[1].id};
    EXPECT_EQ(captions(materials).size(), 2u);
    removeMesh(document, document.meshes[1].id);
    EXPECT_THAT(refusal({materials, {}}), HasSubstr("mesh"));
    EXPECT_THAT(refusal({{}, {}}), HasSubstr("choose what"));
    values = valuesPlan(*findParameter("material.metallic"), {Scope::Material, 0});
    EXPECT_THAT(refusal({values, values}), HasSubstr("both set material.metallic"));
    values.count = 65;
    EXPECT_THAT(refusal({values, {}}), HasSubstr("2 to 64"));
    values.count = 2;
    values.to = 1.5f;
    EXPECT_THAT(refusal({values, {}}), HasSubstr("from 0 to 1"));
}

} // namespace
} // namespace patina
