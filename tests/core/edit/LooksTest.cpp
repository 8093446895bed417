// Snapshots: what differs between two is listed exactly, and restored exactly.

#include "core/edit/Looks.h"

#include "core/document/Snapshot.h"
#include "core/document/ViewChoices.h"
#include "core/edit/ComparedValue.h"
#include "core/edit/Edit.h"
#include "core/edit/EditSession.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "tests/core/document/RandomDocument.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>

namespace patina {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

// A document that has several of everything.
Document fullDocument(std::uint32_t seed) {
    RandomDocument random(seed);
    Document document = random.make();
    while (document.materials.size() < 3)
        addMaterial(document, Material{});
    while (document.lights.size() < 3)
        addLight(document, Light{});
    while (document.environments.size() < 3)
        addEnvironment(document, Environment{});
    while (document.environment().softboxes.size() < 2)
        addSoftbox(document, Softbox{});
    while (document.meshes.size() < 3) {
        MeshInstance& mesh = document.meshes.emplace_back();
        mesh.id = document.takeId();
        mesh.material = document.materials.front().id;
    }
    return document;
}

// Any parameter of any element, to any value that its type has.
void editAtRandom(EditSession& session, RandomDocument& random) {
    const std::span<const ParameterInfo> all = parameters();
    const ParameterInfo& info = all[random.below(all.size())];
    const std::vector<Id> ids = RandomDocument::idsOf(session.document(), info.scope);
    if (!ids.empty())
        session.setParameter(info, {info.scope, ids[random.below(ids.size())]},
                             random.value(info, session.document()));
}

using Place = std::pair<std::pair<int, Id>, std::string_view>;

Place placeOf(const Target& target, const ParameterInfo* info) {
    return {{static_cast<int>(target.scope), target.id}, info ? info->id : std::string_view()};
}

std::set<Place> placesOf(const std::vector<LookDifference>& differences) {
    std::set<Place> places;
    for (const LookDifference& one : differences)
        EXPECT_TRUE(places.insert(placeOf(one.target, one.info)).second) << "listed twice";
    return places;
}

// Value by value, without the function under test. Both have the same elements.
std::set<Place> differingPlaces(const Document& a, const Document& b) {
    std::set<Place> places;
    for (const ParameterInfo& info : parameters()) {
        if (info.id.ends_with(".name") || info.id == "view.fovDeg" ||
            info.id == "view.depthOfField" || info.id == "view.fStop" ||
            info.id == "view.focusDistance" || info.id == "mesh.position" ||
            info.id == "mesh.rotationDeg" || info.id == "mesh.scale")
            continue;
        for (const Id id : RandomDocument::idsOf(a, info.scope))
            if ((info.scope != Scope::Environment || info.ofScene == (id == 0)) &&
                withoutPayload(info.get(a, id)) != withoutPayload(info.get(b, id)))
                places.insert(placeOf({info.scope, id}, &info));
    }
    return places;
}

// What a look leaves to the document.
Document withNamesAndCameraOf(const Document& from, Document document) {
    document.view.camera = from.view.camera;
    for (std::size_t i = 0; i < document.materials.size(); ++i)
        document.materials[i].name = from.materials[i].name;
    for (std::size_t i = 0; i < document.lights.size(); ++i)
        document.lights[i].name = from.lights[i].name;
    for (std::size_t i = 0; i < document.meshes.size(); ++i) {
        document.meshes[i].name = from.meshes[i].name;
        document.meshes[i].placement = from.meshes[i].placement;
    }
    for (std::size_t i = 0; i < document.environments.size(); ++i) {
        document.environments[i].name = from.environments[i].name;
        for (std::size_t k = 0; k < document.environments[i].softboxes.size(); ++k)
            document.environments[i].softboxes[k].name = from.environments[i].softboxes[k].name;
    }
    return document;
}

TEST(Looks, AfterThreeHundredEditsEachEntryRestoredTurnsOneIntoTheOther) {
    for (std::uint32_t seed = 1; seed <= 8; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        RandomDocument random(seed * 977);
        EditSession session;
        session.replace(fullDocument(seed));
        const Id first = session.keepSnapshot("A", nullptr);
        const Document before = session.document();
        for (int edit = 0; edit < 300; ++edit)
            editAtRandom(session, random);
        const Id second = session.keepSnapshot("B", nullptr);
        const Document after = session.document();
        const LookPtr a = after.snapshot(first)->look, b = after.snapshot(second)->look;

        std::vector<LookDifference> list = differencesOf(*a, *b);
        EXPECT_EQ(placesOf(list), differingPlaces(before, after));
        for (const LookDifference& one : list) {
            ASSERT_NE(one.info, nullptr);
            EXPECT_EQ(one.a, withoutPayload(one.info->get(before, one.target.id)));
            EXPECT_EQ(one.b, withoutPayload(one.info->get(after, one.target.id)));
            EXPECT_NE(one.a, one.b);
            EXPECT_NE(one.textA, one.textB) << one.info->id;
            EXPECT_EQ(whyNotRestored(after, *a, one), "");
        }

        // B into A, in any order; nothing that is not on the list changes on the way.
        std::shuffle(list.begin(), list.end(), std::mt19937(seed));
        const std::set<Place> all = placesOf(list);
        std::set<Place> left = all;
        for (const LookDifference& one : list) {
            const int steps = session.count();
            session.restoreLook(*a, {one}, "Restore");
            EXPECT_LE(session.count(), steps + 1);
            const std::set<Place> now = placesOf(differencesOf(*a, *lookOf(session.document())));
            EXPECT_FALSE(now.contains(placeOf(one.target, one.info))) << one.info->id;
            EXPECT_TRUE(std::ranges::includes(left, now)) << one.info->id;
            left = now;
        }
        EXPECT_THAT(left, IsEmpty());
        Document expected = withNamesAndCameraOf(session.document(), before);
        expected.snapshots = session.document().snapshots;
        expected.nextId = session.document().nextId;
        EXPECT_EQ(session.document(), expected);

        // And A into B at once, as one step.
        const int steps = session.count();
        session.restoreSnapshot(second);
        EXPECT_EQ(session.count(), steps + 1);
        EXPECT_EQ(session.document(), after);
        session.undo();
        EXPECT_EQ(session.document(), expected);
    }
}

TEST(Looks, ALookOfTheSameDocumentDiffersInNothingAndIsShared) {
    const Document document = fullDocument(3);
    const LookPtr one = lookOf(document), other = lookOf(document, one.get());
    EXPECT_THAT(differencesOf(*one, *other), IsEmpty());
    EXPECT_EQ(*one, *other);
    Document changed = document;
    changed.materials[1].metallic = changed.materials[1].metallic == 0.5f ? 0.25f : 0.5f;
    const LookPtr third = lookOf(changed, one.get());
    for (std::size_t i = 0; i < document.materials.size(); ++i)
        EXPECT_EQ(third->materials[i] == one->materials[i], i != 1) << "costs only what differs";
    EXPECT_EQ(third->lights, one->lights);
    EXPECT_EQ(third->environments, one->environments);
}

TEST(Looks, NamesCameraAndGeometryAreNoPartOfIt) {
    const Document document = fullDocument(4);
    Document changed = withNamesAndCameraOf(document, document);
    changed.materials[0].name += " renamed";
    changed.lights[0].name += " renamed";
    changed.view.camera.yawDeg += 10.0f;
    changed.view.camera.fovDeg = 20.0f;
    changed.meshes[0].placement.setPosition({2, 0, 0});
    changed.meshes[0].placement.setRotationDeg({0, 30, 0});
    EXPECT_THAT(differencesOf(*lookOf(document), *lookOf(changed)), IsEmpty());
    EXPECT_EQ(withLook(changed, *lookOf(document)), changed);
}

TEST(Looks, ElementsThatWereRemovedComeBackWhereTheyStood) {
    EditSession session;
    session.replace(fullDocument(5));
    const Id kept = session.keepSnapshot("Before", nullptr);
    const Document before = session.document();
    const Id material = before.materials[1].id;
    session.assignMaterial(before.meshes[0].id, material);
    const Id with = session.keepSnapshot("With it", nullptr);
    const Document assigned = session.document();
    session.removeMaterial(material);
    session.removeLight(before.lights[1].id);
    session.removeEnvironment(before.mix.first);
    session.removeSoftbox(session.document().environment().softboxes.empty()
                              ? 0
                              : session.document().environment().softboxes[0].id);
    const LookPtr look = session.document().snapshot(with)->look;
    const std::vector<LookDifference> list = differencesOf(*look, *lookOf(session.document()));
    const auto found = std::ranges::find_if(list, [&](const LookDifference& one) {
        return one.info == nullptr && one.target == Target{Scope::Material, material};
    });
    ASSERT_NE(found, list.end());
    EXPECT_EQ(found->textA, "there");
    EXPECT_EQ(found->textB, "not there");
    EXPECT_THAT(found->element, HasSubstr("Material"));

    const int steps = session.count();
    session.restoreSnapshot(with);
    EXPECT_EQ(session.count(), steps + 1);
    EXPECT_EQ(session.document(), assigned) << "order, ids and the mix too";
    // A value whose element is gone brings it along.
    session.removeMaterial(material);
    const std::vector<LookDifference> again = differencesOf(*look, *lookOf(session.document()));
    const auto reference = std::ranges::find_if(again, [](const LookDifference& one) {
        return one.info != nullptr && one.info->id == "mesh.material";
    });
    ASSERT_NE(reference, again.end());
    session.restoreLook(*look, {*reference}, "Restore Material");
    EXPECT_NE(session.document().material(material), nullptr);
    EXPECT_EQ(session.document().meshes[0].material, material);
    session.restoreSnapshot(kept);
    EXPECT_THAT(differencesOf(*before.snapshot(kept)->look, *lookOf(session.document())),
                IsEmpty());
}

TEST(Looks, OfWhatCameLaterLightsGoAndMaterialsStay) {
    EditSession session;
    session.replace(fullDocument(6));
    const Id kept = session.keepSnapshot("Before", nullptr);
    const Id light = session.addLight(LightType::Point);
    const Id material = session.addMaterial();
    const Id softbox = session.addSoftbox(10.0f, 20.0f);
    const LookPtr look = session.document().snapshot(kept)->look;
    const std::vector<LookDifference> list = differencesOf(*look, *lookOf(session.document()));
    ASSERT_THAT(list, SizeIs(3));
    for (const LookDifference& one : list) {
        EXPECT_EQ(one.textA, "not there");
        EXPECT_EQ(whyNotRestored(session.document(), *look, one).empty(),
                  one.target.scope != Scope::Material);
    }
    session.restoreSnapshot(kept);
    EXPECT_EQ(session.document().light(light), nullptr);
    EXPECT_EQ(session.document().softbox(softbox), nullptr);
    EXPECT_NE(session.document().material(material), nullptr) << "nothing shows it";
    ASSERT_THAT(differencesOf(*look, *lookOf(session.document())), SizeIs(1));
}

// Adding, removing, assigning at random: afterwards nothing is left that could be restored.
TEST(Looks, AfterRandomStructuralEditsOnlyWhatIsKeptDiffers) {
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        RandomDocument random(seed * 31);
        EditSession session;
        session.replace(fullDocument(seed));
        const Id kept = session.keepSnapshot("", nullptr);
        EXPECT_EQ(session.document().snapshot(kept)->name, "Snapshot 1");
        const auto any = [&](const auto& elements) {
            return elements.empty() ? Id{0} : elements[random.below(elements.size())].id;
        };
        for (int edit = 0; edit < 60; ++edit) {
            const Document& now = session.document();
            switch (random.below(10)) {
            case 0:
                session.removeMaterial(any(now.materials));
                break;
            case 1:
                session.duplicateMaterial(any(now.materials));
                break;
            case 2:
                session.removeLight(any(now.lights));
                break;
            case 3:
                session.duplicateLight(any(now.lights));
                break;
            case 4:
                session.removeEnvironment(any(now.environments));
                break;
            case 5:
                session.duplicateEnvironment(any(now.environments));
                break;
            case 6:
                session.removeSoftbox(any(now.environment().softboxes));
                break;
            case 7:
                session.addSoftbox(5.0f, 5.0f);
                break;
            case 8:
                session.removeMesh(any(now.meshes));
                break;
            default:
                editAtRandom(session, random);
            }
        }
        const LookPtr look = session.document().snapshot(kept)->look;
        const Document edited = session.document();
        session.restoreSnapshot(kept);
        const Document& now = session.document();
        for (const LookDifference& left : differencesOf(*look, *lookOf(now)))
            EXPECT_NE(whyNotRestored(now, *look, left), "") << left.element << " " << left.label;
        std::set<Id> ids;
        for (const auto& material : now.materials)
            EXPECT_TRUE(ids.insert(material.id).second);
        for (const auto& light : now.lights)
            EXPECT_TRUE(ids.insert(light.id).second);
        for (const auto& environment : now.environments) {
            EXPECT_TRUE(ids.insert(environment.id).second);
            for (const auto& softbox : environment.softboxes)
                EXPECT_TRUE(ids.insert(softbox.id).second);
        }
        for (const auto& mesh : now.meshes)
            EXPECT_TRUE(mesh.material == 0 || now.material(mesh.material) != nullptr);
        EXPECT_NE(now.environment(now.mix.first), nullptr);
        EXPECT_NE(now.mix.first, now.mix.second);
        session.undo();
        EXPECT_EQ(session.document(), edited) << "one step";
    }
}

TEST(Looks, KeepingRenamingAndRemovingAreStepsAndIdsAreNeverReused) {
    EditSession session;
    session.replace(fullDocument(7));
    const Document start = session.document();
    const Id first = session.keepSnapshot("Warm", nullptr);
    EXPECT_EQ(session.undoText(), "Keep Warm");
    const Id second = session.keepSnapshot("Warm", nullptr);
    EXPECT_EQ(session.document().snapshot(second)->name, "Warm 2");
    session.renameSnapshot(second, "Cold");
    EXPECT_EQ(session.undoText(), "Rename Warm 2");
    session.renameSnapshot(second, "");
    session.renameSnapshot(second, "Cold");
    EXPECT_EQ(session.count(), 3) << "neither is an edit";
    session.removeSnapshot(first);
    EXPECT_EQ(session.undoText(), "Remove Warm");
    EXPECT_THAT(session.document().snapshots, SizeIs(1));
    session.goTo(0);
    EXPECT_EQ(session.document(), start);
    EXPECT_FALSE(session.isModified());
    const Id third = session.keepSnapshot("", nullptr);
    EXPECT_GT(third, second);
    EXPECT_TRUE(session.isModified());
    EXPECT_GT(session.addMaterial(), third);
    session.restoreSnapshot(12345); // there is none
    session.removeSnapshot(12345);
    EXPECT_EQ(session.count(), 2);
}

TEST(Looks, APictureThatCameLaterStaysThroughUndoAndRedo) {
    EditSession session;
    session.replace(fullDocument(8));
    const Id kept = session.keepSnapshot("A", nullptr);
    const auto picture = std::make_shared<const Image>(4, 2, 3, PixelType::U8, ColorEncoding::Srgb);
    session.setSnapshotPicture(kept, picture);
    EXPECT_EQ(session.count(), 1) << "no step";
    session.renameSnapshot(kept, "B");
    for (int index : {0, 1, 0, 2, 1}) {
        session.goTo(index);
        const Snapshot* snapshot = session.document().snapshot(kept);
        ASSERT_EQ(snapshot != nullptr, index > 0);
        if (snapshot == nullptr)
            continue;
        EXPECT_EQ(snapshot->picture, picture);
    }
    session.setSnapshotPicture(12345, picture); // there is none
}

TEST(Looks, RestoringOneValueSaysItsValuesInTheHistory) {
    EditSession session;
    Document document;
    const Id material = addMaterial(document, Material{});
    session.replace(document);
    const Id kept = session.keepSnapshot("A", nullptr);
    session.setParameter(parameter("material.metallic"), {Scope::Material, material}, 1.0f);
    session.setParameter(parameter("view.exposureEv"), {Scope::View, 0}, 2.0f);
    const LookPtr look = session.document().snapshot(kept)->look;
    const std::vector<LookDifference> list = differencesOf(*look, *lookOf(session.document()));
    ASSERT_THAT(list, SizeIs(2));
    EXPECT_EQ(list[1].label, "Exposure (EV)");
    session.restoreLook(*look, {list[0]}, "Restore Metallic");
    EXPECT_EQ(session.historyEntry(session.count()).values, "1.000 → 0.000");
    EXPECT_EQ(session.document().view.exposureEv, 2.0f);
}

// The pixels of a file are read as its layout says: neither is restored without the other.
TEST(Looks, AnImageComesWithItsLayout) {
    const auto image = [](float value) {
        Image pixels(2, 1, 3, PixelType::F32, ColorEncoding::Linear);
        std::ranges::fill(pixels.f32(), value);
        return std::make_shared<const Image>(std::move(pixels));
    };
    EditSession session;
    Document document;
    Environment& environment = document.environment();
    environment.source = "/sky.hdr";
    environment.layout = EnvironmentLayout::AngularMap;
    environment.image = environment.fileImage = image(1.0f);
    const ImagePtr angular = environment.image;
    session.replace(document);
    const Id kept = session.keepSnapshot("A", nullptr);
    session.editStructure("Other", [&](Document& edited) {
        edited.environment().source = "/other.hdr";
        edited.environment().layout = EnvironmentLayout::LatLong;
        edited.environment().image = edited.environment().fileImage = image(2.0f);
    });
    const LookPtr look = session.document().snapshot(kept)->look;
    EXPECT_EQ(look->environments[0]->image, nullptr) << "what is derived is not kept";
    for (const char* name : {"environment.image", "environment.layout"}) {
        SCOPED_TRACE(name);
        const auto list = differencesOf(*look, *lookOf(session.document()));
        const auto found = std::ranges::find(list, findParameter(name), &LookDifference::info);
        ASSERT_NE(found, list.end());
        session.restoreLook(*look, {*found}, "Restore");
        EXPECT_EQ(session.document().environment().source, "/sky.hdr");
        EXPECT_EQ(session.document().environment().layout, EnvironmentLayout::AngularMap);
        EXPECT_EQ(session.document().environment().image, angular);
        session.undo();
    }
}

} // namespace
} // namespace patina
