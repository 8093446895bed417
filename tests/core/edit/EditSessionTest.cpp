// Editing without a window: steps, undo, redo, merging, what was saved.

#include "core/edit/EditSession.h"
#include "core/edit/EditSteps.h"
#include "core/light/Light.h"
#include "core/material/Material.h"

#include "core/document/EnvironmentTitle.h"
#include "core/image/Image.h"
#include "tests/core/document/RandomDocument.h"

#include <gtest/gtest.h>
#include <set>
#include <utility>

namespace patina {
namespace {

struct Observer : EditObserver {
    Affects derive(Document& document) override {
        if (!follow)
            return Affects::Nothing;
        // Stands for whatever is derived from the document.
        document.view.backgroundBlur = document.environment().rotationDeg / 360.0f;
        return Affects::EnvironmentMap;
    }
    void documentChanged(const Change& change) override { changes.push_back(change); }
    void historyChanged() override { ++historyChanges; }
    void stepsDropped() override { ++drops; }

    bool follow = false;
    std::vector<Change> changes;
    int historyChanges = 0, drops = 0;
};

struct EditSessionTest : ::testing::Test {
    void SetUp() override {
        Document document;
        addMaterial(document, Material{});
        addLight(document, Light{});
        MeshInstance mesh;
        mesh.id = document.takeId();
        mesh.name = "Body";
        mesh.material = document.materials.front().id;
        document.meshes.push_back(mesh);
        session.replace(std::move(document));
        session.observe(&observer);
    }
    Target material() const { return {Scope::Material, session.document().materials.front().id}; }
    Target light() const { return {Scope::Light, session.document().lights.front().id}; }
    float roughness() const { return session.document().materials.front().perceptualRoughness; }

    const ParameterInfo& rough = parameter("material.perceptualRoughness");
    Observer observer;
    EditSession session;
};

TEST_F(EditSessionTest, AStepIsTakenBackAndDoneAgain) {
    session.setParameter(rough, material(), 0.25f);
    EXPECT_EQ(roughness(), 0.25f);
    EXPECT_EQ(session.undoText(), "Change Roughness of Material");
    EXPECT_FALSE(session.canRedo());
    session.undo();
    EXPECT_EQ(roughness(), 0.5f);
    EXPECT_EQ(session.redoText(), "Change Roughness of Material");
    session.redo();
    EXPECT_EQ(roughness(), 0.25f);
    ASSERT_EQ(observer.changes.size(), 3u);
    EXPECT_EQ(observer.changes.back().target, material());
    EXPECT_EQ(observer.historyChanges, 3);
}

TEST_F(EditSessionTest, EqualValuesMakeNoStepAndRangesHold) {
    session.setParameter(rough, material(), 0.5f);
    EXPECT_EQ(session.count(), 0);
    session.setParameter(rough, material(), 7.0f);
    EXPECT_EQ(roughness(), 1.0f);
    session.setParameter(rough, {Scope::Material, 9999}, 0.1f); // there is no such material
    EXPECT_EQ(session.count(), 1);
}

TEST_F(EditSessionTest, ADragIsOneStepAndNoneWhenItReturns) {
    const DragSession drag = session.newDragSession();
    for (const float value : {0.1f, 0.2f, 0.3f})
        session.setParameter(rough, material(), value, drag);
    EXPECT_EQ(session.count(), 1);
    session.undo();
    EXPECT_EQ(roughness(), 0.5f);
    session.redo();
    EXPECT_EQ(roughness(), 0.3f);

    const DragSession back = session.newDragSession();
    const DocumentState before = session.state();
    session.setParameter(rough, material(), 0.9f, back);
    session.setParameter(rough, material(), 0.3f, back);
    EXPECT_EQ(session.count(), 1);
    EXPECT_EQ(session.state(), before);
}

// An intensity and a type in one drag session stay apart; so do edits on two sides of a save.
TEST_F(EditSessionTest, OtherParametersElementsSessionsAndSavesStayApart) {
    const DragSession drag = session.newDragSession();
    session.setParameter(rough, material(), 0.1f, drag);
    session.setParameter(parameter("material.metallic"), material(), 0.1f, drag);
    session.setParameter(rough, material(), 0.2f, drag);
    EXPECT_EQ(session.count(), 3);
    session.setParameter(rough, material(), 0.3f, session.newDragSession());
    EXPECT_EQ(session.count(), 4);
    session.setParameter(rough, material(), 0.4f);
    session.setParameter(rough, material(), 0.5f);
    EXPECT_EQ(session.count(), 6);
    const DragSession other = session.newDragSession();
    session.setParameter(rough, material(), 0.6f, other);
    session.separateSteps();
    session.setParameter(rough, material(), 0.7f, other);
    EXPECT_EQ(session.count(), 8);
}

TEST_F(EditSessionTest, AnEditErasesWhatCouldBeRedone) {
    session.setParameter(rough, material(), 0.1f);
    session.setParameter(rough, material(), 0.2f);
    session.undo();
    session.undo();
    session.setParameter(rough, material(), 0.9f);
    EXPECT_EQ(session.count(), 1);
    EXPECT_FALSE(session.canRedo());
    session.undo();
    EXPECT_EQ(roughness(), 0.5f);
}

TEST_F(EditSessionTest, WhatArrivesByItselfErasesNothing) {
    session.setParameter(rough, material(), 0.1f);
    session.undo();
    const DocumentState before = session.state();
    auto bake = std::make_shared<BakeArtifact>();
    bake->kind = BakeKind::PrtVertex;
    session.attachBake(bake);
    EXPECT_EQ(session.document().bakes.size(), 1u);
    EXPECT_TRUE(session.canRedo());
    EXPECT_EQ(session.count(), 1);
    EXPECT_FALSE(session.state() == before);
    session.redo();
    EXPECT_EQ(roughness(), 0.1f);
    EXPECT_EQ(session.document().bakes.size(), 1u);
}

BakeArtifactPtr bakeWith(int samples) {
    auto bake = std::make_shared<BakeArtifact>();
    bake->kind = BakeKind::PrtVertex;
    bake->samplesDone = samples;
    return bake;
}

TEST_F(EditSessionTest, AFinishedBakeIsNoStepAndUndoLeavesIt) {
    session.setParameter(rough, material(), 0.1f);
    session.setSaved(session.state());
    const BakeArtifactPtr bake = bakeWith(64);
    session.attachBake(bake);
    EXPECT_EQ(session.count(), 1);
    EXPECT_TRUE(session.isModified());
    EXPECT_EQ(session.undoText(), "Change Roughness of Material");
    session.undo();
    EXPECT_EQ(roughness(), 0.5f);
    EXPECT_EQ(findBake(session.document(), BakeKind::PrtVertex), bake);
}

TEST_F(EditSessionTest, RemovingABakeIsAStep) {
    const auto attached = [&] { return findBake(session.document(), BakeKind::PrtVertex); };
    const BakeArtifactPtr first = bakeWith(64), renewed = bakeWith(65), later = bakeWith(128);
    session.removeBake(BakeKind::PrtVertex);
    EXPECT_EQ(session.count(), 0) << "there is none";
    session.attachBake(first);
    session.renewBake(first, renewed);
    session.removeBake(BakeKind::PrtVertex);
    EXPECT_EQ(session.undoText(), "Remove Bake");
    EXPECT_EQ(attached(), nullptr);
    session.undo();
    EXPECT_EQ(attached(), renewed) << "with what followed for it";
    session.redo();
    EXPECT_EQ(attached(), nullptr);
    session.attachBake(later);
    session.undo();
    EXPECT_EQ(attached(), later) << "a newer one stays";
    session.redo();
    EXPECT_EQ(attached(), nullptr);
    session.undo();
    EXPECT_EQ(attached(), later);
}

TEST_F(EditSessionTest, IdsAreNotGivenTwiceAlsoAfterUndo) {
    std::set<Id> ids;
    for (int i = 0; i < 4; ++i) {
        EXPECT_TRUE(ids.insert(session.addLight(LightType::Point)).second);
        EXPECT_TRUE(ids.insert(session.addMaterial()).second);
        session.undo();
        session.undo();
    }
}

TEST_F(EditSessionTest, AGroupIsOneStep) {
    const Document before = session.document();
    session.group("Set Up", [&] {
        session.setParameter(rough, material(), 0.1f);
        session.addLight(LightType::Spot);
        session.setParameter(rough, material(), 0.2f);
    });
    EXPECT_EQ(session.count(), 1);
    EXPECT_EQ(session.undoText(), "Set Up");
    const Document after = session.document();
    EXPECT_EQ(after.lights.size(), 2u);
    session.undo();
    EXPECT_EQ(session.document(), before);
    session.redo();
    EXPECT_EQ(session.document(), after);
    session.group("Nothing", [] {});
    EXPECT_EQ(session.count(), 1);
}

TEST_F(EditSessionTest, WhatFollowsFromAnEditIsThereWhenItIsTold) {
    observer.follow = true;
    session.setParameter(parameter("environment.rotationDeg"), {Scope::Environment, 0}, 90.0f);
    EXPECT_EQ(session.document().view.backgroundBlur, 0.25f);
    ASSERT_EQ(observer.changes.size(), 1u);
    EXPECT_TRUE(touches(observer.changes[0].affects, Affects::EnvironmentMap));
    session.undo();
    EXPECT_EQ(session.document().view.backgroundBlur, 0.0f);
}

TEST_F(EditSessionTest, ModifiedMeansOtherThanWhatWasSaved) {
    EXPECT_FALSE(session.isModified());
    session.setParameter(rough, material(), 0.1f);
    session.setParameter(rough, material(), 0.2f);
    EXPECT_TRUE(session.isModified());
    EXPECT_EQ(session.unsavedSteps(), 2);
    session.setSaved(session.state());
    EXPECT_FALSE(session.isModified());
    EXPECT_EQ(session.unsavedSteps(), 0);
    session.undo();
    EXPECT_TRUE(session.isModified());
    EXPECT_EQ(session.unsavedSteps(), 1);
    session.redo();
    EXPECT_FALSE(session.isModified());
    session.setCamera(Camera{.yawDeg = 12.0f, .lens = {}}); // navigation is no modification
    EXPECT_FALSE(session.isModified());
    session.forgetSaved();
    EXPECT_TRUE(session.isModified());
    EXPECT_EQ(session.unsavedSteps(), 0);
}

TEST_F(EditSessionTest, StepsEndAtTheirLimits) {
    EditSession small({.steps = 3, .payloadBytes = 100});
    small.observe(&observer);
    small.replace(session.document());
    for (int i = 0; i < 10; ++i)
        small.setParameter(rough, material(), 0.1f * static_cast<float>(i % 2) + 0.2f);
    EXPECT_EQ(small.count(), 3);
    EXPECT_EQ(small.index(), 3);
    EXPECT_EQ(observer.drops, 0);
    MapSlot slot;
    slot.source = "builtin:wood/baseColor";
    slot.image = std::make_shared<Image>(8, 8, 3, PixelType::U8, ColorEncoding::Srgb);
    small.setDiffering(material(), {{&parameter("material.baseColor.map"), slot}}, "Set Map");
    EXPECT_EQ(observer.drops, 0) << "the others keep nothing";
    EXPECT_EQ(small.count(), 3);
    EXPECT_EQ(small.document().materials.front().baseColorMap, slot);
}

// The oldest go first, and what is left is undone as ever.
TEST_F(EditSessionTest, TheOldestStepsGiveWayToMemory) {
    constexpr std::size_t kImage = std::size_t{8} * 8 * 3;
    EditSession small({.steps = 100, .payloadBytes = 3 * kImage});
    small.observe(&observer);
    small.replace(session.document());
    const auto slotOf = [](int i) {
        MapSlot slot;
        slot.source = "builtin:" + std::to_string(i);
        slot.image = std::make_shared<Image>(8, 8, 3, PixelType::U8, ColorEncoding::Srgb);
        return slot;
    };
    const auto setMap = [&](int i) {
        small.setDiffering(material(), {{&parameter("material.baseColor.map"), slotOf(i)}}, "Set");
    };
    setMap(0); // keeps one image, the others two each: what was, and what is
    EXPECT_EQ(small.historyBytes(), kImage);
    setMap(1);
    EXPECT_EQ(small.count(), 2);
    setMap(2);
    EXPECT_EQ(small.count(), 1) << "of five images three may stay, and the newest keeps two";
    EXPECT_EQ(observer.drops, 1);
    EXPECT_LE(small.historyBytes(), 3 * kImage);
    small.undo();
    EXPECT_EQ(small.document().materials.front().baseColorMap.source, "builtin:1");
    small.dropOldest(0);
    EXPECT_TRUE(small.canRedo()) << "what can be redone stays";
    small.redo();
    small.dropOldest(0);
    EXPECT_EQ(small.count(), 0);
    EXPECT_EQ(small.document().materials.front().baseColorMap.source, "builtin:2");
}

// A walk over every kind of edit, there and back.
TEST_F(EditSessionTest, EnvironmentsAreAddedChosenMixedAndRemoved) {
    const auto& document = session.document();
    const Id studio = document.mix.first;
    Environment sky;
    sky.kind = EnvironmentKind::Sky;
    sky.softboxes.resize(1);
    const Id added = session.addEnvironment(sky, "Add Sky");
    EXPECT_EQ(document.mix.first, added) << "it lights the scene";
    EXPECT_EQ(document.environment().kind, EnvironmentKind::Sky);
    EXPECT_NE(document.environment().softboxes[0].id, 0u);
    session.lightWith(studio);
    EXPECT_EQ(document.mix.first, studio);
    EXPECT_EQ(session.undoText(), "Light with Studio");

    // The one to fade to; it and the first change places where one takes the other's.
    const ParameterInfo& second = parameter("environment.second");
    const Target scene{Scope::Environment, 0};
    session.setParameter(second, scene, static_cast<int>(added));
    EXPECT_EQ(document.mix.second, added);
    EXPECT_EQ(document.mix.fade, 0.5f) << "seen at once";
    session.lightWith(added);
    EXPECT_EQ(document.mix.first, added);
    EXPECT_EQ(document.mix.second, studio);
    session.setParameter(second, scene, static_cast<int>(added));
    EXPECT_EQ(document.mix.second, 0u) << "nothing fades to itself";
    session.undo();
    session.setParameter(second, scene, 4711);
    EXPECT_EQ(document.mix.second, studio) << "there is none of that number";
    session.setParameter(parameter("environment.first"), scene, 0);
    EXPECT_EQ(document.mix.first, added);

    const int steps = session.index();
    session.removeEnvironment(added);
    EXPECT_EQ(document.mix.first, studio);
    EXPECT_EQ(document.mix.second, 0u);
    session.removeEnvironment(studio);
    EXPECT_EQ(document.environments.size(), 1u) << "the last one stays";
    EXPECT_EQ(session.count(), steps + 1);
    session.goTo(0);
    EXPECT_EQ(document.environments.size(), 1u);
    EXPECT_EQ(document.mix.first, studio);
    session.goTo(steps);
    EXPECT_EQ(document.mix.second, studio);

    for (int i = 0; i < 100; ++i)
        session.duplicateEnvironment(added);
    EXPECT_EQ(document.environments.size(), kMaxEnvironments);
    std::set<std::string> titles;
    for (const Environment& environment : document.environments)
        titles.insert(environmentTitle(environment));
    EXPECT_EQ(titles.size(), kMaxEnvironments) << "each has a name of its own";
}

// The picture that was made of an environment meanwhile is not lost by an undo of something else.
TEST_F(EditSessionTest, StepsOfTheListsKeepTheFinestPictures) {
    const Id sky = [&] {
        Environment environment;
        environment.kind = EnvironmentKind::Sky;
        return session.addEnvironment(environment, "Add Sky");
    }();
    const Id light = session.addLight(LightType::Point);
    const auto fine = std::make_shared<const Image>(8, 4, 3, PixelType::F32, ColorEncoding::Data);
    session.setEnvironmentImage(sky, fine);
    session.setBlendedImage(fine);
    session.undo();
    EXPECT_EQ(session.document().environment(sky)->image, fine);
    EXPECT_EQ(session.document().mix.blended, fine);
    session.redo();
    EXPECT_EQ(session.document().environment(sky)->image, fine);
    EXPECT_NE(session.document().light(light), nullptr);
    session.setEnvironmentImage(4711, nullptr); // there is none of that number
    EXPECT_EQ(session.document().environment(sky)->image, fine);
}

TEST_F(EditSessionTest, RandomEditsThenUndoAllIsTheInitialDocument) {
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE("replay with seed " + std::to_string(seed));
        RandomDocument random(seed);
        session.replace(random.make());
        const Document before = session.document();
        const auto any = [&](Scope scope) {
            const std::vector<Id> ids = RandomDocument::idsOf(session.document(), scope);
            return ids.empty() ? Id{0} : ids[random.below(ids.size())];
        };
        for (int edit = 0; edit < 200; ++edit) {
            switch (random.below(18)) {
            case 0:
                session.addLight(static_cast<LightType>(random.below(5)));
                break;
            case 1:
                session.duplicateLight(any(Scope::Light));
                break;
            case 2:
                session.removeLight(any(Scope::Light));
                break;
            case 3:
                session.duplicateMaterial(any(Scope::Material));
                break;
            case 4:
                session.removeMaterial(any(Scope::Material));
                break;
            case 5:
                session.assignMaterial(any(Scope::Mesh), any(Scope::Material));
                break;
            case 6:
                session.removeMesh(any(Scope::Mesh));
                break;
            case 7:
                session.addSoftbox(10.0f, 20.0f);
                session.duplicateSoftbox(any(Scope::Softbox));
                break;
            case 8:
                session.removeSoftbox(any(Scope::Softbox));
                break;
            case 9:
                session.duplicateEnvironment(any(Scope::Environment));
                break;
            case 10:
                session.removeEnvironment(any(Scope::Environment));
                break;
            case 11:
                session.lightWith(any(Scope::Environment));
                break;
            case 12:
                session.addSecondEnvironment(Environment(), "Fade");
                break;
            default: {
                const auto table = parameters();
                const ParameterInfo& info = table[random.below(table.size())];
                const Target target{info.scope, any(info.scope)};
                if (targetExists(session.document(), target))
                    session.setParameter(info, target, random.value(info, session.document()),
                                         random.below(3) == 0 ? session.newDragSession() : 0);
            }
            }
            if (random.below(5) == 0)
                session.undo();
            if (random.below(7) == 0)
                session.redo();
        }
        session.goTo(session.count());
        const Document after = session.document();
        session.goTo(0);
        ASSERT_EQ(session.document(), before);
        session.goTo(session.count());
        ASSERT_EQ(session.document(), after);
    }
}

// Unsaved work on top of what was saved: undo shows the saved state.
TEST_F(EditSessionTest, AWholeDocumentIsAStep) {
    const Document saved = session.document();
    Document work = saved;
    work.materials.front().metallic = 1.0f;
    session.push(std::make_unique<ReplaceDocumentStep>("Recover Unsaved Work", saved, work));
    EXPECT_EQ(session.document(), work);
    EXPECT_TRUE(session.isModified());
    EXPECT_EQ(session.unsavedSteps(), 1);
    session.undo();
    EXPECT_EQ(session.document(), saved);
    EXPECT_FALSE(session.isModified());
}

TEST_F(EditSessionTest, ShowingAndHidingSeveralMeshesMergesWithinASession) {
    session.editStructure("Copy", [](Document& document) {
        MeshInstance copy = document.meshes.front();
        copy.id = document.takeId();
        document.meshes.push_back(copy);
    });
    const Document before = session.document();
    const Id a = before.meshes[0].id, b = before.meshes[1].id;
    const DragSession walk = session.newDragSession();
    const auto show = [&](bool first, bool second, DragSession of) {
        session.push(std::make_unique<ShowMeshesStep>(
            "Show", session.document(), std::vector<std::pair<Id, bool>>{{a, first}, {b, second}},
            of));
    };
    show(true, false, walk);
    EXPECT_TRUE(touches(observer.changes.back().affects, Affects::Geometry));
    show(false, true, walk);
    EXPECT_EQ(session.count(), 2);
    EXPECT_FALSE(session.document().mesh(a)->visible);
    session.undo();
    EXPECT_EQ(session.document(), before);
    session.redo();
    EXPECT_FALSE(session.document().mesh(a)->visible);
    EXPECT_TRUE(session.document().mesh(b)->visible);
    show(true, true, walk); // back where it began
    EXPECT_EQ(session.count(), 1);
    show(true, false, session.newDragSession());
    show(true, true, session.newDragSession());
    EXPECT_EQ(session.count(), 3) << "other sessions are other steps";
}

} // namespace
} // namespace patina
