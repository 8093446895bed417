#include "app/editor/document/DocumentController.h"
#include "core/light/Light.h"
#include "core/material/Material.h"

#include "app/editor/Session.h"
#include "app/editor/document/FileOnDisk.h"
#include "core/edit/Edit.h"
#include "core/edit/EditSession.h"
#include "core/io/ImageIO.h"
#include "core/scene/DocumentIO.h"
#include "tests/core/document/RandomDocument.h"

#include <QFile>
#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <gmock/gmock.h>
#include <random>

namespace patina::editor {
namespace {

using ::testing::HasSubstr;

struct Controller : ::testing::Test {
    void SetUp() override {
        QObject::connect(&controller, &DocumentController::changed,
                         [this](const Change& change) { changes.push_back(change); });
        QObject::connect(&controller, &DocumentController::noticed,
                         [this](const UserNotice& notice) { notices.push_back(notice); });
        controller.newDocument();
        settle();
        ASSERT_FALSE(document().materials.empty());
        changes.clear();
    }
    void settle() {
        ASSERT_TRUE(QTest::qWaitFor([&] { return !controller.tasks().busy(); }, 60'000));
    }
    const Document& document() const { return controller.document(); }
    UndoStack& undo() { return controller.undoStack(); }
    Target firstMaterial() const { return {Scope::Material, document().materials.front().id}; }
    float roughness() const { return document().materials.front().perceptualRoughness; }

    const ParameterInfo& rough = parameter("material.perceptualRoughness");
    Session session;
    DocumentController& controller = session.controller;
    std::vector<Change> changes;
    std::vector<UserNotice> notices;
    QTemporaryDir folder;
};

TEST_F(Controller, SetParameterIsOneUndoableStepWithAName) {
    const float before = roughness();
    controller.setParameter(rough, firstMaterial(), 0.25f);
    EXPECT_EQ(roughness(), 0.25f);
    EXPECT_EQ(undo().count(), 1);
    EXPECT_EQ(undo().undoText().toStdString(),
              "Change Roughness of " + document().materials.front().name);
    ASSERT_EQ(changes.size(), 1u);
    EXPECT_EQ(changes[0].affects, rough.affects);
    EXPECT_EQ(changes[0].target, firstMaterial());
    EXPECT_TRUE(controller.isModified());
    EXPECT_FALSE(controller.isPristine());
    undo().undo();
    EXPECT_EQ(roughness(), before);
    EXPECT_FALSE(controller.isModified());
}

TEST_F(Controller, ValuesAreClampedAndEqualOnesLeaveNoStep) {
    controller.setParameter(rough, firstMaterial(), 7.0f);
    EXPECT_EQ(roughness(), 1.0f);
    const int steps = undo().count();
    controller.setParameter(rough, firstMaterial(), 9.0f);
    EXPECT_EQ(undo().count(), steps);
}

TEST_F(Controller, ADragIsOneStepAndItsReturnLeavesNone) {
    const float before = roughness();
    const DragSession drag = controller.newDragSession();
    for (const float value : {0.11f, 0.12f, 0.13f})
        controller.setParameter(rough, firstMaterial(), value, drag);
    EXPECT_EQ(undo().count(), 1);
    EXPECT_EQ(roughness(), 0.13f);
    undo().undo();
    EXPECT_EQ(roughness(), before);
    undo().redo();
    EXPECT_EQ(roughness(), 0.13f);
    controller.setParameter(rough, firstMaterial(), before, drag);
    EXPECT_EQ(undo().count(), 0);
    EXPECT_FALSE(controller.isModified());
    EXPECT_EQ(roughness(), before);
}

TEST_F(Controller, DragsOfOtherSessionsParametersOrElementsStayApart) {
    const Target other{Scope::Material, document().materials.back().id};
    ASSERT_NE(other, firstMaterial());
    const DragSession drag = controller.newDragSession();
    controller.setParameter(rough, firstMaterial(), 0.11f, drag);
    controller.setParameter(rough, other, 0.12f, drag);
    EXPECT_EQ(undo().count(), 2);
    controller.setParameter(parameter("material.metallic"), other, 0.3f, drag);
    EXPECT_EQ(undo().count(), 3);
    controller.setParameter(parameter("material.metallic"), other, 0.4f,
                            controller.newDragSession());
    EXPECT_EQ(undo().count(), 4);
    controller.setParameter(rough, other, 0.2f); // typed values never merge
    controller.setParameter(rough, other, 0.3f);
    EXPECT_EQ(undo().count(), 6);
}

TEST_F(Controller, NavigationIsNeitherAStepNorAModification) {
    Camera camera = document().view.camera;
    camera.yawDeg += 10;
    controller.setCamera(camera);
    EXPECT_EQ(document().view.camera, camera);
    EXPECT_EQ(undo().count(), 0);
    EXPECT_FALSE(controller.isModified());
    ASSERT_EQ(changes.size(), 1u);
    EXPECT_EQ(changes[0].affects, Affects::Nothing);
}

TEST_F(Controller, StructureKeepsIdsThroughUndoAndRedo) {
    const Document before = document();
    const Id light = controller.addLight(LightType::Point);
    const Id copy = controller.duplicateMaterial(firstMaterial().id);
    ASSERT_NE(document().light(light), nullptr);
    ASSERT_NE(document().material(copy), nullptr);
    EXPECT_EQ(document().light(light)->type, LightType::Point);
    controller.assignMaterial(document().meshes.front().id, copy);
    EXPECT_EQ(document().meshes.front().material, copy);
    const Document after = document();
    while (undo().canUndo())
        undo().undo();
    EXPECT_EQ(document(), before);
    while (undo().canRedo())
        undo().redo();
    EXPECT_EQ(document(), after);
}

TEST_F(Controller, TheLastMaterialStaysAndMeshesNeverLoseTheirs) {
    while (document().materials.size() > 1)
        controller.removeMaterial(document().materials.back().id);
    const int steps = undo().count();
    controller.removeMaterial(document().materials.front().id);
    EXPECT_EQ(undo().count(), steps);
    for (const MeshInstance& mesh : document().meshes)
        EXPECT_NE(document().material(mesh.material), nullptr) << mesh.name;
}

// One random edit; returns a word for the failure message.
std::string randomEdit(DocumentController& controller, std::mt19937& random) {
    const Document& document = controller.document();
    const auto pick = [&](std::size_t count) { return random() % count; };
    const auto element = [&](const auto& list) { return list[pick(list.size())].id; };
    switch (pick(9)) {
    case 0:
        controller.addLight(pick(2) ? LightType::Point : LightType::Directional);
        return "add light";
    case 1:
        if (!document.lights.empty())
            controller.removeLight(element(document.lights));
        return "remove light";
    case 2:
        controller.duplicateMaterial(element(document.materials));
        return "duplicate material";
    case 3:
        controller.removeMaterial(element(document.materials));
        return "remove material";
    case 4:
        if (!document.meshes.empty())
            controller.assignMaterial(element(document.meshes), element(document.materials));
        return "assign";
    case 5: {
        const BakeKind kind = pick(2) ? BakeKind::AoVertex : BakeKind::PrtVertex;
        if (!findBake(document, kind))
            return "no bake"; // one that is made is no step
        controller.removeBake(kind);
        return "remove bake";
    }
    case 6:
        if (document.meshes.size() > 1)
            controller.removeMesh(element(document.meshes));
        return "remove mesh";
    case 7:
        controller.rename({Scope::Material, element(document.materials)},
                          QStringLiteral("Name %1").arg(pick(100)));
        return "rename";
    default:
        break;
    }
    const auto table = parameters();
    const ParameterInfo& info = table[pick(table.size())];
    Target target{info.scope, 0};
    if (info.scope == Scope::Material)
        target.id = element(document.materials);
    else if (info.scope == Scope::Light && !document.lights.empty())
        target.id = element(document.lights);
    else if (info.scope == Scope::Mesh && !document.meshes.empty())
        target.id = element(document.meshes);
    const float number = static_cast<float>(random() % 1000) / 250.0f - 1.0f;
    const DragSession drag = pick(3) == 0 ? controller.newDragSession() : 0;
    if (info.type == ParameterType::Float)
        controller.setParameter(info, target, number, drag);
    else if (info.type == ParameterType::Color || info.type == ParameterType::Vector)
        controller.setParameter(info, target, glm::vec3(number, 0.5f, -number), drag);
    else if (info.type == ParameterType::Bool)
        controller.setParameter(info, target, pick(2) == 0);
    else if (info.type == ParameterType::Choice)
        controller.setParameter(info, target, static_cast<int>(pick(info.choices.size())));
    else if (info.type == ParameterType::Map)
        controller.clearMap(info, target);
    return std::string(info.id);
}

// Pictures that are derived come by themselves, and are made anew.
Document withoutDerived(Document document) {
    for (Environment& environment : document.environments)
        environment.image = nullptr;
    document.mix.blended = nullptr;
    return document;
}

TEST_F(Controller, RandomEditsThenUndoAllIsTheInitialDocument) {
    for (unsigned seed = 1; seed <= 8; ++seed) {
        SCOPED_TRACE("replay with seed " + std::to_string(seed));
        std::mt19937 random(seed);
        undo().clear();
        for (const BakeKind kind : {BakeKind::AoVertex, BakeKind::PrtVertex}) {
            auto bake = std::make_shared<BakeArtifact>();
            bake->kind = kind;
            controller.attachBake(bake);
        }
        ASSERT_EQ(undo().count(), 0);
        const Document before = document();
        std::string history;
        for (int edit = 0; edit < 120; ++edit) {
            history += randomEdit(controller, random) + ", ";
            // Going back and forth on the way must not matter.
            if (random() % 5 == 0 && undo().canUndo())
                undo().undo();
            if (random() % 7 == 0 && undo().canRedo())
                undo().redo();
        }
        while (undo().canRedo()) // the walk may have ended with an undo
            undo().redo();
        const Document after = document();
        while (undo().canUndo())
            undo().undo();
        ASSERT_EQ(withoutDerived(document()), withoutDerived(before)) << history;
        while (undo().canRedo())
            undo().redo();
        ASSERT_EQ(withoutDerived(document()), withoutDerived(after)) << history;
    }
}

// --set edits by editsFor() and applyParameter(); the panels by the controller.
TEST_F(Controller, EveryEditIsThatOfTheCommandLine) {
    RandomDocument random(7);
    for (const LightType type : {LightType::Directional, LightType::Spot})
        controller.addLight(type);
    for (const ParameterInfo& info : parameters()) {
        if (info.type == ParameterType::Map || info.id == "environment.layout")
            continue; // which read files
        SCOPED_TRACE(std::string(info.id));
        const Id id = info.scope == Scope::Material ? document().materials.back().id
                      : info.scope == Scope::Mesh   ? document().meshes.back().id
                      : info.scope == Scope::Light  ? document().lights.back().id
                                                    : 0;
        if (info.scope == Scope::Softbox)
            continue; // the start scene has none
        for (int i = 0; i < 8; ++i) {
            Document expected = document();
            const Target target{info.scope, id};
            const ParameterValue value = random.value(info, expected);
            for (const ParameterEdit& edit : editsFor(expected, info, target, value))
                ASSERT_TRUE(applyParameter(expected, *edit.info, target, edit.value));
            controller.setParameter(info, target, value);
            ASSERT_EQ(withoutDerived(document()), withoutDerived(expected)) << "value " << i;
        }
    }
}

TEST_F(Controller, AddedModelsGetIdsOfTheirOwnAndAreOneStep) {
    const Document before = document();
    controller.addModel(QStringLiteral("builtin:cornell-box"));
    EXPECT_TRUE(controller.tasks().busy());
    settle();
    EXPECT_EQ(undo().count(), 1);
    EXPECT_GT(document().meshes.size(), before.meshes.size());
    std::set<Id> ids;
    std::size_t count = 0;
    for (const MeshInstance& mesh : document().meshes) {
        EXPECT_NE(document().material(mesh.material), nullptr) << mesh.name;
        ids.insert(mesh.id);
        ++count;
    }
    for (const Material& material : document().materials) {
        ids.insert(material.id);
        ++count;
    }
    EXPECT_EQ(ids.size(), count);
    undo().undo();
    EXPECT_EQ(document(), before);
}

TEST_F(Controller, ANewMapReplacesOneThatIsStillOnItsWay) {
    const ParameterInfo& map = parameter("material.baseColor.map");
    controller.setMap(map, firstMaterial(), QStringLiteral("builtin:wood/baseColor"));
    controller.setMap(map, firstMaterial(), QStringLiteral("builtin:leather/baseColor"));
    settle();
    QTest::qWait(200); // nothing to wait for: the first one must not come late
    EXPECT_EQ(document().materials.front().baseColorMap.source, "builtin:leather/baseColor");
    EXPECT_EQ(undo().count(), 1);
}

// What was asked for before is no edit made while the scene is opened: nothing is asked, and the
// light stays with the model that is opened in it.
TEST_F(Controller, WhatWasAskedForBeforeAModelIsOpenedDoesNotKeepItOut) {
    controller.setEnvironment(QStringLiteral("builtin:sunset"));
    controller.openScene(QStringLiteral("builtin:sphere"));
    settle();
    EXPECT_EQ(controller.displayName(), QStringLiteral("Sphere"));
    EXPECT_EQ(document().environment().source, "builtin:sunset");
    EXPECT_LE(undo().count(), 1); // the light's own step, where the model was there before it
    EXPECT_TRUE(notices.empty());
}

// The other order: the model is there long before the light that was asked for first.
TEST_F(Controller, ALightThatIsReadMoreSlowlyThanTheModelIsNotLost) {
    const QString sky = folder.filePath(QStringLiteral("large.hdr"));
    ASSERT_TRUE(saveImage(session.worker,
                          Image(4096, 2048, 3, PixelType::F32, ColorEncoding::Linear),
                          absolutePath(sky))
                    .ok());
    controller.setEnvironment(sky);
    controller.openScene(QStringLiteral("builtin:sphere"));
    settle();
    EXPECT_EQ(controller.displayName(), QStringLiteral("Sphere"));
    EXPECT_EQ(document().environment().source, sky.toStdString());
    EXPECT_TRUE(notices.empty());
}

TEST_F(Controller, AFileThatCannotBeOpenedChangesNothingAndIsNamed) {
    const Document before = document();
    bool worked = true;
    controller.openScene(folder.filePath(QStringLiteral("missing.glb")),
                         [&](bool ok) { worked = ok; });
    settle();
    EXPECT_FALSE(worked);
    EXPECT_EQ(document(), before);
    ASSERT_EQ(notices.size(), 1u);
    EXPECT_EQ(notices[0].kind, NoticeKind::Error);
    EXPECT_THAT(notices[0].text.toStdString(), HasSubstr("missing.glb"));
}

TEST_F(Controller, SavedAndOpenedAgainItIsTheSame) {
    controller.applyLibraryMaterial(firstMaterial().id, QStringLiteral("leather"));
    controller.setEnvironment(QStringLiteral("builtin:sunset"));
    controller.addModel(QStringLiteral("builtin:torus-knot"));
    settle();
    controller.addLight(LightType::Point);
    controller.setParameter(rough, firstMaterial(), 0.123456f);
    const QString file = folder.filePath(QStringLiteral("größe.patina"));
    bool worked = false;
    controller.saveAs(file, [&](bool ok) { worked = ok; });
    settle();
    ASSERT_TRUE(worked);
    EXPECT_FALSE(controller.isModified());
    EXPECT_EQ(controller.filePath(), file);
    EXPECT_EQ(controller.displayName(), QStringLiteral("größe.patina"));

    const Document saved = document();
    controller.newDocument();
    settle();
    ASSERT_NE(document(), saved);
    controller.openScene(file);
    settle();
    EXPECT_EQ(controller.filePath(), file);
    EXPECT_FALSE(controller.isModified());
    // Values by their text, payloads by their content: images and meshes are read anew.
    const std::filesystem::path path = file.toStdString();
    EXPECT_EQ(documentToJson(document(), path), documentToJson(saved, path));
    EXPECT_EQ(document().nextId, saved.nextId);
    ASSERT_EQ(document().meshes.size(), saved.meshes.size());
    for (std::size_t i = 0; i < saved.meshes.size(); ++i)
        EXPECT_EQ(*document().meshes[i].mesh, *saved.meshes[i].mesh) << saved.meshes[i].name;
    EXPECT_EQ(*document().environment().image, *saved.environment().image);
    EXPECT_EQ(*document().materials.front().baseColorMap.image,
              *saved.materials.front().baseColorMap.image);
}

TEST_F(Controller, EditsMadeWhileSavingStayUnsaved) {
    controller.setParameter(rough, firstMaterial(), 0.2f);
    controller.saveAs(folder.filePath(QStringLiteral("a.patina")));
    controller.setParameter(rough, firstMaterial(), 0.3f);
    settle();
    EXPECT_TRUE(controller.isModified());
}

TEST_F(Controller, SavingIntoAMissingFolderIsANoticeAndKeepsTheModification) {
    controller.setParameter(rough, firstMaterial(), 0.2f);
    bool worked = true;
    controller.saveAs(folder.filePath(QStringLiteral("no/such/folder/a.patina")),
                      [&](bool ok) { worked = ok; });
    settle();
    EXPECT_FALSE(worked);
    EXPECT_TRUE(controller.isModified());
    EXPECT_TRUE(controller.filePath().isEmpty());
    ASSERT_EQ(notices.size(), 1u);
    EXPECT_EQ(notices[0].kind, NoticeKind::Error);
}

TEST_F(Controller, UndoKeepsABoundedAmountOfImagesAlive) {
    const ParameterInfo& map = parameter("material.baseColor.map");
    constexpr int kSide = 4096; // 64 MiB each
    for (int index = 0; index < 24; ++index) {
        MapSlot slot;
        slot.source = "image " + std::to_string(index);
        slot.image = std::make_shared<Image>(kSide, kSide, 4, PixelType::U8, ColorEncoding::Srgb);
        controller.setParameter(map, firstMaterial(), slot);
        ASSERT_TRUE(controller.isModified());
    }
    EXPECT_LT(undo().count(), 24);
    EXPECT_GE(undo().count(), 1);
    EXPECT_EQ(document().materials.front().baseColorMap.source, "image 23");
    ASSERT_FALSE(notices.empty());
    EXPECT_THAT(notices[0].text.toStdString(), HasSubstr("undo"));
    undo().undo();
    EXPECT_EQ(document().materials.front().baseColorMap.source, "image 22");
    while (undo().canUndo())
        undo().undo();
    EXPECT_TRUE(controller.isModified()); // the way back to the saved state is gone
}

TEST_F(Controller, SelectionFollowsTheDocument) {
    SelectionModel& selection = session.selection;
    EXPECT_NE(document().material(selection.material()), nullptr);
    const MeshInstance mesh = document().meshes.back();
    selection.selectMesh(mesh.id);
    EXPECT_EQ(selection.mesh(), mesh.id);
    EXPECT_EQ(selection.material(), mesh.material);
    controller.removeMesh(mesh.id);
    EXPECT_EQ(selection.mesh(), 0u);
    controller.removeMaterial(mesh.material);
    EXPECT_NE(document().material(selection.material()), nullptr);
    const Id light = controller.addLight(LightType::Point);
    selection.selectLight(light);
    EXPECT_EQ(selection.light(), light);
    undo().undo();
    EXPECT_NE(selection.light(), light);
}

// Another document may use the same ids for other things: nothing of the selection is carried over.
TEST_F(Controller, AnotherDocumentIsSelectedFromAnew) {
    SelectionModel& selection = session.selection;
    const Id chosenFirst = selection.material(), light = selection.light();
    const auto other =
        std::find_if(document().materials.begin(), document().materials.end(),
                     [&](const Material& material) { return material.id != chosenFirst; });
    ASSERT_NE(other, document().materials.end());
    selection.selectMaterial(other->id);
    selection.selectMesh(document().meshes.back().id);
    controller.newDocument();
    settle();
    EXPECT_EQ(selection.material(), chosenFirst);
    EXPECT_EQ(selection.mesh(), 0u);
    EXPECT_EQ(selection.light(), light);
}

} // namespace
} // namespace patina::editor
