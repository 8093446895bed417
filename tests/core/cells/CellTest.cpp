// A cell is the document with what it has of its own.
#include "core/cells/Cell.h"
#include "core/document/ViewChoices.h"
#include "core/edit/Edit.h"
#include "core/edit/EditSession.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "tests/support/SecondEnvironment.h"

#include <gmock/gmock.h>
#include <random>

namespace patina {
namespace {

using testing::HasSubstr;

class Cells : public testing::Test {
  protected:
    Cells() {
        Material body;
        body.name = "Body";
        material = addMaterial(document, body);
        MeshInstance mesh;
        mesh.id = document.takeId();
        mesh.material = material;
        document.meshes.push_back(mesh);
        Light sun;
        sun.name = "Sun";
        light = addLight(document, sun);
        document.environment().rotationDeg = 10.0f;
        Environment other = document.environment();
        other.name = "Other";
        other.rotationDeg = 50.0f;
        environment = addEnvironment(document, other);
    }
    static CellEdit edit(const char* parameter, Target target, ParameterValue value) {
        return {target, findParameter(parameter), std::move(value)};
    }
    Document shown(const Cell& cell) {
        Result<Document> result = documentOf(document, cell);
        EXPECT_TRUE(result.ok()) << (result.ok() ? std::string() : result.error().text());
        return *result;
    }
    Document document;
    Id material = 0, light = 0, environment = 0;
};

TEST_F(Cells, WithNothingOfItsOwnItIsTheDocument) {
    EXPECT_EQ(shown({}), document);
    Cell same;
    same.environment = document.mix.first;
    EXPECT_EQ(shown(same), document);
}

// Any parameter of the table can be a cell's own, and nothing else changes.
TEST_F(Cells, EachParameterIsSetAsAUserWouldSetIt) {
    std::mt19937 random(11);
    for (const ParameterInfo& info : parameters()) {
        SCOPED_TRACE(info.id);
        if (info.type == ParameterType::Map)
            continue; // files
        Target target{info.scope, 0};
        if (info.scope == Scope::Material)
            target.id = material;
        else if (info.scope == Scope::Light)
            target.id = light;
        else if (info.scope == Scope::Mesh)
            target.id = document.meshes[0].id;
        else if (info.scope == Scope::Softbox)
            target.id = addSoftbox(document, {});
        ParameterValue value = info.get(document, target.id);
        if (float* number = std::get_if<float>(&value))
            *number = std::uniform_real_distribution(info.softMin, info.softMax)(random);
        else if (bool* flag = std::get_if<bool>(&value))
            *flag = !*flag;
        else if (int* choice = std::get_if<int>(&value); choice && !info.choices.empty())
            *choice = (*choice + 1) % static_cast<int>(info.choices.size());
        Document expected = document;
        for (const ParameterEdit& own : editsFor(expected, info, target, value))
            ASSERT_TRUE(applyParameter(expected, *own.info, target, own.value).ok());
        Cell cell;
        cell.own.push_back({target, &info, value});
        EXPECT_EQ(shown(cell), expected);
    }
}

TEST_F(Cells, ItsEnvironmentLightsItAloneAndHasTheNumbersOfTheCell) {
    fadeTo(document, environment);
    document.mix.fade = 0.5f;
    Cell cell;
    cell.environment = environment;
    EXPECT_EQ(shown(cell).environment().id, environment);
    EXPECT_EQ(shown(cell).secondEnvironment(), nullptr);
    cell.own.push_back(edit("environment.rotationDeg", {Scope::Environment, 0}, 90.0f));
    const Document turned = shown(cell);
    EXPECT_EQ(turned.environment().rotationDeg, 90.0f) << "of the one that lights the cell";
    EXPECT_EQ(turned.environment(document.mix.first)->rotationDeg, 10.0f);
    cell.camera = document.view.camera;
    cell.camera->yawDeg += 5.0f;
    EXPECT_EQ(shown(cell).view.camera, *cell.camera);
}

TEST_F(Cells, OfTwoTheUpperOneWins) {
    Cell row, column;
    row.environment = environment;
    row.own.push_back(edit("view.exposureEv", {Scope::View, 0}, 1.0f));
    column.own.push_back(edit("view.exposureEv", {Scope::View, 0}, 2.0f));
    column.own.push_back(edit("material.perceptualRoughness", {Scope::Material, material}, 0.25f));
    const Document both = shown(combined(column, row));
    EXPECT_EQ(both.environment().id, environment);
    EXPECT_EQ(both.view.exposureEv, 1.0f);
    EXPECT_EQ(both.material(material)->perceptualRoughness, 0.25f);
    EXPECT_EQ(shown(combined(row, column)).view.exposureEv, 2.0f);
}

TEST_F(Cells, WhatWasDeletedIsNamed) {
    Cell cell;
    cell.environment = environment;
    cell.own.push_back(edit("material.metallic", {Scope::Material, material}, 1.0f));
    removeMaterial(document, material);
    Result<Document> result = documentOf(document, cell);
    ASSERT_FALSE(result.ok());
    EXPECT_THAT(result.error().message, HasSubstr("material.metallic"));
    EXPECT_THAT(result.error().message, HasSubstr("no longer in the scene"));
    removeEnvironment(document, environment);
    result = documentOf(document, cell);
    ASSERT_FALSE(result.ok());
    EXPECT_THAT(result.error().message, HasSubstr("environment"));

    Cell dangling; // the mesh is there, the material it should get is not
    dangling.own.push_back(
        edit("mesh.material", {Scope::Mesh, document.meshes[0].id}, static_cast<int>(material)));
    EXPECT_FALSE(documentOf(document, dangling).ok());
}

TEST_F(Cells, PicturesThatItsParametersMakeAreGenerated) {
    document.environment().kind = EnvironmentKind::Sky;
    document.environment().image = nullptr; // nobody has asked for it
    Cell cell;
    Document same = shown(cell);
    resolveCell(same, document);
    EXPECT_EQ(same.environment().image, nullptr) << "linked: the document's";
    cell.own.push_back(edit("environment.skySunElevationDeg", {Scope::Environment, 0}, 70.0f));
    Document own = shown(cell);
    resolveCell(own, document);
    ASSERT_NE(own.environment().image, nullptr);
    Document high = document;
    high.environment().sky.sunElevationDeg = 70.0f;
    resolveCell(high, {});
    EXPECT_EQ(*own.environment().image, *high.environment().image);
}

// In one step, which undo takes back.
TEST_F(Cells, ACellBecomesTheScene) {
    MeshInstance other = document.meshes[0];
    other.id = document.takeId();
    document.meshes.push_back(other);
    Material gold;
    gold.name = "Gold";
    const Id second = addMaterial(document, gold);
    const Document before = document;
    EditSession session;
    session.replace(document);
    Cell cell;
    cell.environment = environment;
    for (const MeshInstance& mesh : document.meshes)
        cell.own.push_back(edit("mesh.material", {Scope::Mesh, mesh.id}, static_cast<int>(second)));
    cell.own.push_back(edit("environment.rotationDeg", {Scope::Environment, 0}, 77.0f));
    cell.own.push_back(edit("view.exposureEv", {Scope::View, 0}, 2.0f));
    putIntoScene(session, cell);
    EXPECT_EQ(session.count(), 1);
    EXPECT_EQ(session.document(), shown(cell));
    session.undo();
    EXPECT_EQ(session.document(), before);
}

} // namespace
} // namespace patina
