// Snapshots in the project's text: they come back as they were, cost what differs, and one that is
// damaged takes nothing else with it.

#include "core/base/Base64.h"
#include "core/document/Snapshot.h"
#include "core/edit/Edit.h"
#include "core/edit/EditSession.h"
#include "core/image/Qoi.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/scene/DocumentIO.h"
#include "core/scene/ProjectJson.h"
#include "core/worker/WorkerClient.h"
#include "tests/core/document/RandomDocument.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace patina {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

const std::filesystem::path kSnapshotProject = "/home/artist/project/chair.patina";

ImagePtr picture(int level) {
    Image image(16, 9, 3, PixelType::U8, ColorEncoding::Srgb);
    for (std::size_t i = 0; i < image.u8().size(); ++i)
        image.u8()[i] = static_cast<std::uint8_t>(i * 7 + static_cast<std::size_t>(level));
    return std::make_shared<const Image>(std::move(image));
}

void editAnything(EditSession& session, RandomDocument& random) {
    const auto any = [&](const auto& elements) {
        return elements.empty() ? Id{0} : elements[random.below(elements.size())].id;
    };
    const Document& now = session.document();
    switch (random.below(20)) {
    case 0:
        session.removeMaterial(any(now.materials));
        return;
    case 1:
        session.addMaterial();
        return;
    case 2:
        session.removeLight(any(now.lights));
        return;
    case 3:
        session.editStructure("Add", [](Document& document) { addLight(document, Light{}); });
        return;
    case 4:
        session.removeEnvironment(any(now.environments));
        return;
    case 5:
        session.addEnvironment({}, "Add");
        return;
    case 6:
        session.removeSoftbox(any(now.environment().softboxes));
        return;
    case 7:
        session.addSoftbox(1.0f, 2.0f);
        return;
    default:
        break;
    }
    const std::span<const ParameterInfo> all = parameters();
    const ParameterInfo& info = all[random.below(all.size())];
    const std::vector<Id> ids = RandomDocument::idsOf(now, info.scope);
    if (!ids.empty())
        session.setParameter(info, {info.scope, ids[random.below(ids.size())]},
                             random.value(info, now));
}

TEST(ProjectSnapshots, ComeBackAsTheyWere) {
    for (std::uint32_t seed = 1; seed <= 60; ++seed) {
        RandomDocument random(seed);
        EditSession session;
        session.replace(random.make());
        for (int kept = 0; kept < 4; ++kept) {
            session.keepSnapshot(kept % 2 == 0 ? "" : "näme \"x\"",
                                 kept == 2 ? nullptr : picture(kept));
            for (int edit = 0; edit < 30; ++edit)
                editAnything(session, random);
        }
        const std::string json = documentToJson(session.document(), kSnapshotProject);
        const Result<Document> back = documentFromJson(json, kSnapshotProject);
        ASSERT_TRUE(back.ok()) << "seed " << seed << ": " << back.error().text();
        ASSERT_THAT(back->snapshots, SizeIs(4)) << "seed " << seed;
        EXPECT_TRUE(back->unknownKeys == session.document().unknownKeys);
        EXPECT_TRUE(*back == session.document()) << "seed " << seed;
        EXPECT_EQ(documentToJson(*back, kSnapshotProject), json) << "seed " << seed;
    }
}

// A document with a few of everything and one snapshot before two edits.
class ProjectSnapshotsText : public testing::Test {
  protected:
    ProjectSnapshotsText() {
        Document document;
        for (int i = 0; i < 200; ++i)
            material = addMaterial(document, Material{});
        light = addLight(document, Light{});
        session.replace(document);
        first = session.keepSnapshot("Before", nullptr);
        session.setParameter(parameter("material.metallic"), {Scope::Material, material}, 1.0f);
        session.setParameter(parameter("view.exposureEv"), {Scope::View, 0}, 2.0f);
        second = session.keepSnapshot("After", picture(1));
    }
    nlohmann::json json() const {
        return nlohmann::json::parse(documentToJson(session.document(), kSnapshotProject));
    }
    EditSession session;
    Id material = 0, light = 0, first = 0, second = 0;
};

TEST_F(ProjectSnapshotsText, HoldsOnlyWhatDiffersFromTheDocument) {
    const nlohmann::json snapshots = json().at("snapshots");
    ASSERT_EQ(snapshots.size(), 2u);
    EXPECT_EQ(snapshots[0],
              nlohmann::json::parse(R"({"id": )" + std::to_string(first) +
                                    R"(, "name": "Before",
        "view": {"exposureEv": 0.0}, "materials": [{"id": )" +
                                    std::to_string(material) + R"(, "metallic": 0.0}]})"));
    EXPECT_EQ(snapshots[1].size(), 3u) << "id, name, picture: it is the document's look";
}

TEST_F(ProjectSnapshotsText, OfProjectsWithoutAnyNothingIsWritten) {
    session.removeSnapshot(first);
    session.removeSnapshot(second);
    EXPECT_FALSE(json().contains("snapshots"));
}

TEST_F(ProjectSnapshotsText, SixtyFourOfManyMaterialsStaySmall) {
    while (session.document().snapshots.size() < 64) {
        session.setParameter(parameter("material.perceptualRoughness"), {Scope::Material, material},
                             static_cast<float>(session.document().snapshots.size()) / 64.0f);
        session.keepSnapshot("", nullptr);
    }
    const std::string text = documentToJson(session.document(), kSnapshotProject);
    Document without = session.document();
    without.snapshots.clear();
    EXPECT_LT(text.size() - documentToJson(without, kSnapshotProject).size(), 64u * 300u);
    const Result<Document> back = documentFromJson(text, kSnapshotProject);
    ASSERT_TRUE(back.ok());
    EXPECT_TRUE(*back == session.document());
}

TEST_F(ProjectSnapshotsText, KeysOfANewerPatinaAreKept) {
    nlohmann::json changed = json();
    nlohmann::json& one = changed["snapshots"][0];
    one["mood"] = {{"warmth", 0.5}};
    one["view"]["vignette"] = 0.25;
    one["scene"]["fog"] = 1;
    one["materials"][0]["clearcoat"] = 0.75;
    one["lights"] = {{{"id", light}, {"gobo", "leaves"}}};
    const Result<Document> read = documentFromJson(changed.dump(), kSnapshotProject);
    ASSERT_TRUE(read.ok()) << read.error().text();
    ASSERT_THAT(read->snapshots, SizeIs(2));
    const auto written = nlohmann::json::parse(documentToJson(*read, kSnapshotProject));
    EXPECT_EQ(written.at("snapshots"), changed.at("snapshots"));
}

TEST_F(ProjectSnapshotsText, ADamagedOneIsLeftOutAndTheRestIsThere) {
    using Damage = std::function<void(nlohmann::json&)>;
    const std::vector<std::pair<Damage, std::string>> damages{
        {[](auto& one) { one = 7; }, "snapshots[0] should be an object"},
        {[](auto& one) { one.erase("name"); }, "snapshots[0].name is missing"},
        {[](auto& one) { one["id"] = 0; }, "snapshots[0].id"},
        {[](auto& one) { one["id"] = 1'000'000; }, "snapshots[0].id"},
        {[this](auto& one) { one["id"] = material; }, "something else's"},
        {[](auto& one) { one["view"]["exposureEv"] = "bright"; }, "snapshots[0].view.exposureEv"},
        {[](auto& one) { one["view"]["toneMap"] = "film"; }, "one of clamp"},
        {[](auto& one) { one["materials"][0]["metallic"] = 1.5; }, "materials[0].metallic"},
        {[](auto& one) { one["materials"][0]["id"] = 99'999; }, "materials[0]"},
        {[](auto& one) { one["materialIds"] = {99'999}; }, "materialIds"},
        {[this](auto& one) {
             one["materialIds"] = {material, material};
         },
         "nothing else has"},
        {[this](auto& one) {
             one["lightIds"] = {material};
             one["lights"] = {{{"id", material}}};
         },
         "something else's"},
        {[](auto& one) { one["environmentIds"] = nlohmann::json::array(); }, "environment"},
        {[](auto& one) { one["scene"]["first"] = 77; }, "environment"},
        {[](auto& one) { one["picture"] = "????"; }, "QOI"},
        {[](auto& one) { one["picture"] = 4; }, "picture"},
        {[](auto& one) {
             Image large(300, 2, 3, PixelType::U8, ColorEncoding::Srgb);
             one["picture"] = toBase64(encodeQoi(large));
         },
         "at most 256"},
    };
    Document expected = session.document();
    expected.snapshots.erase(expected.snapshots.begin());
    for (const auto& [damage, reason] : damages) {
        SCOPED_TRACE(reason);
        nlohmann::json changed = json();
        damage(changed["snapshots"][0]);
        const auto read = project::parseProject(changed.dump(), kSnapshotProject);
        ASSERT_TRUE(read.ok()) << read.error().text();
        ASSERT_THAT(read->leftOut, SizeIs(1));
        EXPECT_THAT(read->leftOut[0], HasSubstr(reason));
        EXPECT_THAT(read->leftOut[0], Not(HasSubstr("the project is damaged")));
        EXPECT_THAT(read->unknown, IsEmpty());
        EXPECT_TRUE(read->document == expected);
    }
    nlohmann::json changed = json();
    changed["snapshots"] = "none";
    const auto read = project::parseProject(changed.dump(), kSnapshotProject);
    ASSERT_TRUE(read.ok());
    EXPECT_THAT(read->leftOut, SizeIs(1));
    EXPECT_THAT(read->document.snapshots, IsEmpty());
}

// What only a snapshot shows is read with the project; what both show is one image.
TEST_F(ProjectSnapshotsText, ImagesAreReadOnce) {
    MapSlot wood;
    wood.source = "builtin:wood/baseColor";
    const ParameterInfo& map = parameter("material.baseColor.map");
    session.setParameter(map, {Scope::Material, material}, wood);
    MapSlot night;
    night.source = "builtin:night";
    session.setParameter(parameter("environment.image"), {Scope::Environment, 0}, night);
    session.keepSnapshot("Wood at night", nullptr);
    session.keepSnapshot("Again", nullptr);
    session.setParameter(map, {Scope::Material, material}, MapSlot{});
    session.setParameter(parameter("material.emissive.map"), {Scope::Material, material}, wood);
    night.source = "builtin:studio";
    session.setParameter(parameter("environment.image"), {Scope::Environment, 0}, night);
    session.keepSnapshot("Now", nullptr);
    WorkerClient worker;
    const Result<OpenedScene> opened = loadProjectText(
        worker, documentToJson(session.document(), kSnapshotProject), kSnapshotProject);
    ASSERT_TRUE(opened.ok()) << opened.error().text();
    EXPECT_THAT(opened->notices, IsEmpty());
    const Document& document = opened->document;
    ASSERT_THAT(document.snapshots, SizeIs(5));
    const Look &atNight = *document.snapshots[2].look, &now = *document.snapshots[4].look;
    const auto& shown = *document.material(material);
    ASSERT_NE(shown.emissiveMap.image, nullptr);
    EXPECT_EQ(atNight.materials.back()->baseColorMap.image, shown.emissiveMap.image);
    EXPECT_EQ(document.snapshots[3].look->materials.back()->baseColorMap.image,
              shown.emissiveMap.image);
    EXPECT_NE(atNight.environments[0]->fileImage, nullptr);
    EXPECT_EQ(document.snapshots[3].look->environments[0]->fileImage,
              atNight.environments[0]->fileImage);
    EXPECT_EQ(now.environments[0]->fileImage, document.environment().fileImage);
    EXPECT_NE(now.environments[0]->fileImage, atNight.environments[0]->fileImage);
}

TEST_F(ProjectSnapshotsText, AnImageThatIsGoneIsNamed) {
    MapSlot gone;
    gone.source = "/nowhere/wood.png";
    session.setParameter(parameter("material.baseColor.map"), {Scope::Material, material}, gone);
    session.keepSnapshot("Wood", nullptr);
    session.undo();
    session.redo();
    session.setParameter(parameter("material.baseColor.map"), {Scope::Material, material},
                         MapSlot{});
    WorkerClient worker;
    const Result<OpenedScene> opened = loadProjectText(
        worker, documentToJson(session.document(), kSnapshotProject), kSnapshotProject);
    ASSERT_TRUE(opened.ok()) << opened.error().text();
    EXPECT_THAT(opened->missingFiles, testing::Contains("/nowhere/wood.png"));
    const Look& look = *opened->document.snapshots[2].look;
    EXPECT_EQ(look.materials.back()->baseColorMap.source, "/nowhere/wood.png");
    EXPECT_NE(look.materials.back()->baseColorMap.problem, "");
}

TEST_F(ProjectSnapshotsText, OneThatIsLikeAnotherIsSharedWhenItIsRead) {
    const Result<Document> read =
        documentFromJson(documentToJson(session.document(), kSnapshotProject), kSnapshotProject);
    ASSERT_TRUE(read.ok());
    const Look &a = *read->snapshots[0].look, &b = *read->snapshots[1].look;
    std::size_t shared = 0;
    for (std::size_t i = 0; i < a.materials.size(); ++i)
        shared += a.materials[i] == b.materials[i] ? 1u : 0u;
    EXPECT_EQ(shared, a.materials.size() - 1);
}

} // namespace
} // namespace patina
