// Saving while the user goes on working: "saved" only when it is, the newest last, nothing of a
// running operation lost or landing where it does not belong.

#include "app/editor/Session.h"
#include "core/document/ViewChoices.h"
#include "core/edit/Edit.h"
#include "core/edit/EditSession.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/scene/DocumentIO.h"

#include <QDir>
#include <QFile>
#include <QTemporaryDir>
#include <QTest>
#include <gmock/gmock.h>

namespace patina::editor {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

struct Saving : ::testing::Test {
    void SetUp() override {
        QObject::connect(&controller, &DocumentController::noticed,
                         [this](const UserNotice& notice) { notices.push_back(notice); });
        controller.newDocument();
        settle();
        ASSERT_FALSE(document().materials.empty());
    }
    void settle() {
        ASSERT_TRUE(QTest::qWaitFor([&] { return !controller.tasks().busy(); }, 60'000));
        QCoreApplication::processEvents();
    }
    const Document& document() const { return controller.document(); }
    UndoStack& undo() { return controller.undoStack(); }
    Target firstMaterial() const { return {Scope::Material, document().materials.front().id}; }
    float roughness() const { return document().materials.front().perceptualRoughness; }
    void setRoughness(float value, DragSession drag = 0) {
        controller.setParameter(rough, firstMaterial(), value, drag);
    }
    QString file(const char* name) const { return folder.filePath(QLatin1String(name)); }
    void save(const QString& to) {
        bool worked = false;
        controller.saveAs(to, [&](bool ok) { worked = ok; });
        settle();
        ASSERT_TRUE(worked);
    }
    static float roughnessIn(const QString& project) {
        QFile text(project);
        EXPECT_TRUE(text.open(QIODevice::ReadOnly)) << project.toStdString();
        const Result<Document> there =
            documentFromJson(text.readAll().toStdString(), project.toStdString());
        EXPECT_TRUE(there.ok());
        return there.ok() ? there->materials.front().perceptualRoughness : -1.0f;
    }
    BakeArtifactPtr bake(BakeKind kind, float value = 0.5f) const {
        BakeArtifact artifact;
        artifact.kind = kind;
        artifact.samplesDone = static_cast<int>(value * 1000);
        artifact.order = holdsTransfer(kind) ? 1 : 0;
        for (const MeshInstance& mesh : document().meshes)
            artifact.vertices.push_back(
                {mesh.id, 1, std::vector<float>(mesh.mesh->vertexCount(), value)});
        return std::make_shared<const BakeArtifact>(std::move(artifact));
    }

    const ParameterInfo& rough = parameter("material.perceptualRoughness");
    Session session;
    DocumentController& controller = session.controller;
    std::vector<UserNotice> notices;
    QTemporaryDir folder;
};

// --- "Saved" only when it is
// -----------------------------------------------------------------------

TEST_F(Saving, ASaveInTheMiddleOfADragLeavesTheDragUnsaved) {
    const DragSession drag = controller.newDragSession();
    setRoughness(0.2f, drag);
    setRoughness(0.356f, drag);
    controller.saveAs(file("a.patina"));
    setRoughness(0.808f, drag); // the hand has not stopped
    settle();
    EXPECT_EQ(roughnessIn(file("a.patina")), 0.356f);
    EXPECT_TRUE(controller.isModified());
    // What was saved is a step to come back to.
    undo().undo();
    EXPECT_EQ(roughness(), 0.356f);
    EXPECT_FALSE(controller.isModified());
    undo().redo();
    EXPECT_TRUE(controller.isModified());
}

TEST_F(Saving, ADragThatGoesOnAfterASaveIsModified) {
    const DragSession drag = controller.newDragSession();
    setRoughness(0.3f, drag);
    save(file("a.patina"));
    EXPECT_FALSE(controller.isModified());
    setRoughness(0.31f, drag);
    EXPECT_TRUE(controller.isModified());
    // Back to where the drag began is not back to what was saved.
    undo().undo();
    EXPECT_FALSE(controller.isModified());
    undo().undo();
    EXPECT_TRUE(controller.isModified());
}

TEST_F(Saving, UndoAndAnotherEditDuringASaveIsModified) {
    setRoughness(0.3f);
    controller.saveAs(file("a.patina"));
    undo().undo();
    setRoughness(0.7f); // the undo stack stands where it stood
    settle();
    EXPECT_EQ(roughnessIn(file("a.patina")), 0.3f);
    EXPECT_TRUE(controller.isModified());
}

TEST_F(Saving, ADragThatReturnsToTheSavedValueIsSaved) {
    setRoughness(0.3f);
    save(file("a.patina"));
    int told = 0;
    QObject::connect(&controller, &DocumentController::fileChanged, [&] { ++told; });
    const DragSession drag = controller.newDragSession();
    setRoughness(0.4f, drag);
    EXPECT_TRUE(controller.isModified());
    setRoughness(0.3f, drag);
    EXPECT_FALSE(controller.isModified());
    EXPECT_EQ(told, 2) << "the title follows";
}

TEST_F(Saving, ABakeThatChangedAfterTheSaveIsUnsaved) {
    const BakeArtifactPtr before = bake(BakeKind::AoVertex, 0.25f);
    controller.attachBake(before);
    save(file("a.patina"));
    EXPECT_FALSE(controller.isModified());
    // The same again, as after an edit of albedo that was undone.
    const auto same = std::make_shared<const BakeArtifact>(*before);
    controller.renewBake(before, same);
    EXPECT_FALSE(controller.isModified());
    auto other = std::make_shared<BakeArtifact>(*before);
    other->albedo = Hash{1, 2};
    controller.renewBake(same, other);
    EXPECT_TRUE(controller.isModified());
}

// --- One at a time, the newest last
// ----------------------------------------------------------------

TEST_F(Saving, TheNewestSaveIsWhatTheFileHolds) {
    // The older content takes longer to write: it has bakes.
    const QString to = file("a.patina");
    for (int round = 0; round < 10; ++round) {
        std::vector<int> results;
        controller.attachBake(bake(BakeKind::AoVertex, static_cast<float>(round + 1) / 100));
        setRoughness(0.1f);
        controller.saveAs(to, [&](bool ok) { results.push_back(ok ? 1 : -1); });
        controller.removeBake(BakeKind::AoVertex);
        setRoughness(0.2f + static_cast<float>(round) / 100);
        controller.saveAs(to, [&](bool ok) { results.push_back(ok ? 2 : -2); });
        settle();
        EXPECT_THAT(results, ElementsAre(1, 2)) << "each tells its result, in order";
        EXPECT_EQ(roughnessIn(to), 0.2f + static_cast<float>(round) / 100);
        EXPECT_FALSE(controller.isModified());
    }
    EXPECT_EQ(QDir(folder.path()).entryList(QDir::Files | QDir::Hidden).size(), 1);
}

TEST_F(Saving, SaveGoesWhereSaveAsIsOnItsWay) {
    controller.saveAs(file("a.patina"));
    settle();
    EXPECT_EQ(controller.saveTarget(), file("a.patina"));
    controller.saveAs(file("b.patina"));
    EXPECT_EQ(controller.saveTarget(), file("b.patina")) << "not over the file that is left";
    setRoughness(0.7f);
    controller.saveAs(controller.saveTarget());
    settle();
    EXPECT_EQ(controller.filePath(), file("b.patina"));
    EXPECT_EQ(roughnessIn(file("b.patina")), 0.7f);
    // One that fails gives no name.
    controller.saveAs(file("no/such/folder/c.patina"));
    settle();
    EXPECT_EQ(controller.saveTarget(), file("b.patina"));
}

TEST_F(Saving, OpeningAnotherSceneTakesNoSaveBack) {
    setRoughness(0.3f);
    int result = 0;
    controller.saveAs(file("a.patina"), [&](bool ok) { result = ok ? 1 : -1; });
    controller.openScene(QStringLiteral("builtin:sphere"));
    controller.tasks().cancelAll();
    controller.openScene(QStringLiteral("builtin:sphere"));
    settle();
    EXPECT_EQ(result, 1);
    EXPECT_EQ(roughnessIn(file("a.patina")), 0.3f);
    // Whichever came first, the scene that was opened is not the file that was saved.
    if (document().meshes.front().source == "builtin:sphere") {
        EXPECT_TRUE(controller.filePath().isEmpty());
    }
}

// --- Background results and undo
// -------------------------------------------------------------------

TEST_F(Saving, AFinishedBakeErasesNothingThatCanBeRedone) {
    setRoughness(0.3f);
    setRoughness(0.6f);
    undo().undo();
    ASSERT_TRUE(undo().canRedo());
    controller.attachBake(bake(BakeKind::PrtVertex));
    controller.showLighting(LightingMode::Prt);
    EXPECT_NE(findBake(document(), BakeKind::PrtVertex), nullptr);
    EXPECT_EQ(document().view.lighting, LightingMode::Prt);
    EXPECT_TRUE(controller.isModified());
    ASSERT_TRUE(undo().canRedo());
    undo().redo();
    EXPECT_EQ(roughness(), 0.6f);
    EXPECT_NE(findBake(document(), BakeKind::PrtVertex), nullptr);
    undo().undo();
    undo().undo();
    EXPECT_NE(findBake(document(), BakeKind::PrtVertex), nullptr);
}

TEST_F(Saving, ABakeWithoutAStepIsUnsavedWhereverUndoLeads) {
    setRoughness(0.3f);
    setRoughness(0.6f);
    save(file("a.patina"));
    undo().undo();
    controller.attachBake(bake(BakeKind::AoVertex));
    undo().redo(); // where it was saved, but for the bake
    EXPECT_TRUE(controller.isModified());
    save(file("a.patina"));
    EXPECT_FALSE(controller.isModified());
}

TEST_F(Saving, UndoKeepsWhatFollowedForABake) {
    const BakeArtifactPtr first = bake(BakeKind::AoVertex, 0.25f);
    controller.attachBake(first);
    const BakeArtifactPtr followed = bake(BakeKind::AoVertex, 0.75f);
    controller.renewBake(first, followed);
    controller.removeBake(BakeKind::AoVertex);
    undo().undo();
    EXPECT_EQ(findBake(document(), BakeKind::AoVertex), followed) << "not the one of old albedo";
}

TEST_F(Saving, WhatWasReadWaitsUntilNothingCanBeRedone) {
    setRoughness(0.3f);
    const Document before = document();
    const ParameterInfo& map = parameter("material.baseColor.map");
    controller.setMap(map, firstMaterial(), QStringLiteral("builtin:wood/baseColor"));
    controller.applyLibraryMaterial(document().materials.back().id, QStringLiteral("leather"));
    undo().undo(); // before they are read
    settle();
    ASSERT_TRUE(undo().canRedo()) << "the way forward is still there";
    EXPECT_EQ(document().materials.front().baseColorMap, before.materials.front().baseColorMap);
    EXPECT_EQ(document().materials.back(), before.materials.back());
    ASSERT_EQ(notices.size(), 2u);
    EXPECT_EQ(notices[0].kind, NoticeKind::Info);
    undo().redo();
    QCoreApplication::processEvents();
    EXPECT_EQ(roughness(), 0.3f);
    EXPECT_EQ(document().materials.front().baseColorMap.source, "builtin:wood/baseColor");
    EXPECT_EQ(undo().count(), 3);
    EXPECT_NE(document().materials.back(), before.materials.back());
}

// Undo takes an element away; the next one must not get its identifier, or what is still being read
// for the first would go to the second.
TEST_F(Saving, IdentifiersAreUsedOnce) {
    const Id first = controller.addLight(LightType::Point);
    undo().undo();
    const Document before = document();
    const Id second = controller.addLight(LightType::Spot);
    EXPECT_NE(first, second);
    undo().undo();
    EXPECT_EQ(document(), before);

    const Id copy = controller.duplicateMaterial(firstMaterial().id);
    controller.setMap(parameter("material.baseColor.map"), {Scope::Material, copy},
                      QStringLiteral("builtin:wood/baseColor"));
    undo().undo();
    const Id other = controller.duplicateMaterial(firstMaterial().id);
    ASSERT_NE(document().material(other), nullptr);
    settle();
    EXPECT_NE(document().material(other)->baseColorMap.source, "builtin:wood/baseColor");
    EXPECT_NE(copy, other);
}

// --- Edits while a scene opens
// ---------------------------------------------------------------------

TEST_F(Saving, EditsMadeWhileASceneOpensAreNotReplacedUnasked) {
    bool done = false;
    controller.openScene(QStringLiteral("builtin:sphere"), [&](bool) { done = true; });
    setRoughness(0.42f);
    settle();
    EXPECT_EQ(roughness(), 0.42f);
    EXPECT_TRUE(controller.isModified());
    EXPECT_FALSE(done);
    ASSERT_EQ(notices.size(), 1u);
    EXPECT_THAT(notices[0].text.toStdString(), HasSubstr("edited meanwhile"));

    // Who can be asked is asked; the answer may come late.
    std::function<void()> answer;
    controller.setReplaceQuestion([&](const std::function<void()>& proceed) { answer = proceed; });
    controller.openScene(QStringLiteral("builtin:sphere"), [&](bool) { done = true; });
    setRoughness(0.43f);
    settle();
    EXPECT_EQ(roughness(), 0.43f);
    ASSERT_TRUE(answer);
    answer();
    EXPECT_TRUE(done);
    EXPECT_EQ(document().meshes.front().source, "builtin:sphere");

    // What was undone again is no edit.
    done = false;
    controller.openScene(QStringLiteral("builtin:plane"), [&](bool) { done = true; });
    setRoughness(0.44f);
    undo().undo();
    settle();
    EXPECT_TRUE(done);
    EXPECT_EQ(document().meshes.front().source, "builtin:plane");
}

// --- The folder moved, the file changed
// ------------------------------------------------------------

struct Asked : Saving {
    void SetUp() override {
        Saving::SetUp();
        controller.setSaveQuestion(
            [this](const SaveQuestion& question) { questions.push_back(question); });
    }
    // Saves and expects to be asked.
    void expectAsked(SaveQuestion::Reason reason) {
        questions.clear();
        controller.saveAs(controller.filePath());
        settle();
        ASSERT_EQ(questions.size(), 1u);
        EXPECT_EQ(questions[0].reason, reason);
        EXPECT_TRUE(controller.isModified());
        EXPECT_TRUE(notices.empty());
    }
    std::vector<SaveQuestion> questions;
};

TEST_F(Asked, BeforeAFileThatOthersChangedIsOverwritten) {
    save(file("a.patina"));
    setRoughness(0.3f);
    save(file("a.patina"));
    EXPECT_TRUE(questions.empty()) << "our own saves are no change";
    QFile::remove(file("b.patina"));
    setRoughness(0.4f);
    save(file("b.patina"));
    QFile::remove(file("a.patina"));
    QFile::copy(file("b.patina"), file("a.patina")); // the other's work
    controller.openScene(file("a.patina"));
    settle();
    ASSERT_EQ(controller.filePath(), file("a.patina"));
    QFile theirs(file("a.patina"));
    ASSERT_TRUE(theirs.open(QIODevice::Append));
    theirs.write("\n");
    theirs.close();
    setRoughness(0.5f);
    expectAsked(SaveQuestion::Reason::Changed);
    EXPECT_EQ(roughnessIn(file("a.patina")), 0.4f);
    questions[0].overwrite();
    settle();
    EXPECT_EQ(roughnessIn(file("a.patina")), 0.5f);
    EXPECT_FALSE(controller.isModified());
    setRoughness(0.6f);
    save(file("a.patina"));
    EXPECT_EQ(questions.size(), 1u) << "asked once";
}

TEST_F(Asked, WhenTheFolderIsGone) {
    ASSERT_TRUE(QDir(folder.path()).mkdir(QStringLiteral("work")));
    save(file("work/a.patina"));
    controller.attachBake(bake(BakeKind::AoVertex));
    ASSERT_TRUE(QDir(folder.path()).rename(QStringLiteral("work"), QStringLiteral("moved")));
    expectAsked(SaveQuestion::Reason::FolderGone);
    EXPECT_FALSE(QDir(file("work")).exists());
}

TEST_F(Asked, BeforeAWriteProtectedFileIsReplaced) {
    save(file("a.patina"));
    ASSERT_TRUE(QFile::setPermissions(file("a.patina"), QFile::ReadOwner));
    setRoughness(0.3f);
    expectAsked(SaveQuestion::Reason::ReadOnly);
    EXPECT_NE(roughnessIn(file("a.patina")), 0.3f);
    questions[0].overwrite();
    settle();
    EXPECT_EQ(roughnessIn(file("a.patina")), 0.3f);
}

TEST_F(Asked, WhenTheProjectIsOpenInAnotherEditor) {
    save(file("a.patina"));
    auto other = std::make_unique<Session>();
    std::vector<UserNotice> told;
    QObject::connect(&other->controller, &DocumentController::noticed,
                     [&](const UserNotice& notice) { told.push_back(notice); });
    other->controller.openScene(file("a.patina"));
    ASSERT_TRUE(QTest::qWaitFor([&] { return !other->controller.tasks().busy(); }, 60'000));
    ASSERT_EQ(told.size(), 1u);
    EXPECT_EQ(told[0].kind, NoticeKind::Warning);
    EXPECT_THAT(told[0].text.toStdString(), HasSubstr("another editor"));

    setRoughness(0.3f);
    expectAsked(SaveQuestion::Reason::OpenElsewhere);
    EXPECT_NE(roughnessIn(file("a.patina")), 0.3f);
    questions[0].overwrite();
    settle();
    EXPECT_EQ(roughnessIn(file("a.patina")), 0.3f);
    setRoughness(0.4f);
    save(file("a.patina"));
    EXPECT_EQ(questions.size(), 1u) << "asked once for one other editor";
    // When it is closed nobody is in the way.
    other.reset();
    setRoughness(0.5f);
    save(file("a.patina"));
    EXPECT_EQ(questions.size(), 1u);
}

TEST_F(Asked, AndAnAnswerForADocumentThatIsGoneSavesNothing) {
    save(file("a.patina"));
    ASSERT_TRUE(QFile::setPermissions(file("a.patina"), QFile::ReadOwner));
    setRoughness(0.3f);
    expectAsked(SaveQuestion::Reason::ReadOnly);
    const auto answer = questions[0].overwrite;
    controller.newDocument();
    settle();
    setRoughness(0.9f);
    answer();
    settle();
    EXPECT_NE(roughnessIn(file("a.patina")), 0.9f);
}

} // namespace
} // namespace patina::editor
