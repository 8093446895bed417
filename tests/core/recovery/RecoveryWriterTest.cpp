// What is kept of a document that changes, and that it comes back.

#include "core/recovery/RecoveryWriter.h"
#include "core/document/Snapshot.h"
#include "core/io/ImageIO.h"
#include "core/material/Material.h"
#include "core/recovery/RecoveryBakes.h"
#include "core/recovery/RecoveryLoader.h"
#include "core/scene/DocumentIO.h"
#include "core/scene/OutsidePictures.h"
#include "core/scene/Scene.h"
#include "core/worker/WorkerClient.h"
#include "tests/support/TemporaryFolder.h"

#include <gmock/gmock.h>

namespace patina {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr std::chrono::minutes kLong{1};

class RecoveryWriterTest : public ::testing::Test {
  protected:
    std::unique_ptr<RecoveryWriter> makeWriter(RecoveryWriter::Settings settings = {}) {
        return std::make_unique<RecoveryWriter>(
            root.path(),
            [this](const std::string& sentence) {
                const std::lock_guard lock(mutex);
                told.push_back(sentence);
            },
            settings);
    }
    RecoverySnapshot snapshot(const fs::path& file = {}) const {
        RecoverySnapshot result;
        result.document = document;
        result.name = file.empty() ? "Untitled" : file.filename().string();
        result.file = file;
        result.steps = 1;
        result.lastStep = "Change Rotation";
        return result;
    }
    BakeArtifactPtr someBake(BakeKind kind = BakeKind::AoVertex) const {
        BakeArtifact bake;
        bake.kind = kind;
        bake.inputs = {8, 9};
        bake.samplesDone = 64;
        for (const MeshInstance& mesh : document.meshes)
            bake.vertices.push_back(
                {mesh.id, 1, std::vector<float>(mesh.mesh->vertexCount(), 0.25f)});
        return std::make_shared<const BakeArtifact>(std::move(bake));
    }
    // The work of the writer, which has ended.
    AbandonedWorks found() { return abandonedWorks(root.path()); }
    Document recovered(const AbandonedWork& work) {
        auto opened = loadRecovered(worker, work.record, work.session->bakeFolder());
        EXPECT_TRUE(opened.ok()) << opened.error().text();
        notices = opened->notices;
        return opened->document;
    }

    test::TemporaryFolder root, files;
    WorkerClient worker;
    Document document = startDocument();
    std::mutex mutex;
    std::vector<std::string> told;
    std::vector<Notice> notices;
};

TEST_F(RecoveryWriterTest, TheNewestStateComesBack) {
    auto writer = makeWriter();
    for (int i = 1; i <= 50; ++i) {
        document.environment().rotationDeg = static_cast<float>(i);
        if (i == 20)
            document.snapshots.push_back({document.takeId(), "Kept", lookOf(document), nullptr});
        writer->keep(snapshot());
    }
    ASSERT_TRUE(writer->flush(kLong));
    writer.reset();
    const AbandonedWorks works = found();
    ASSERT_THAT(works.works, SizeIs(1));
    EXPECT_EQ(works.works[0].record.lastStep, "Change Rotation");
    const Document back = recovered(works.works[0]);
    EXPECT_EQ(documentToJson(back, "/x.patina"), documentToJson(document, "/x.patina"));
    ASSERT_THAT(back.snapshots, SizeIs(1));
    EXPECT_EQ(back.snapshots[0].look->environments[0]->rotationDeg, 20.0f);
    EXPECT_FALSE(back.meshes.empty());
    EXPECT_GT(back.meshes.front().mesh->vertexCount(), 0u);
    EXPECT_THAT(notices, IsEmpty());
}

TEST_F(RecoveryWriterTest, NothingIsLeftOfWorkThatWasSaved) {
    auto writer = makeWriter();
    writer->keep(snapshot());
    ASSERT_TRUE(writer->flush(kLong));
    writer->clear();
    ASSERT_TRUE(writer->flush(kLong));
    writer.reset();
    EXPECT_THAT(root.files(), IsEmpty());
}

TEST_F(RecoveryWriterTest, ABakeThatIsOnlyInMemoryIsKeptAndWrittenOnce) {
    document.bakes = {someBake()};
    auto writer = makeWriter();
    writer->keep(snapshot());
    ASSERT_TRUE(writer->flush(kLong));
    document.environment().rotationDeg = 12.0f;
    writer->keep(snapshot());
    ASSERT_TRUE(writer->flush(kLong));
    writer.reset();
    const AbandonedWorks works = found();
    ASSERT_THAT(works.works, SizeIs(1));
    EXPECT_THAT(works.works[0].record.leftOut, IsEmpty());
    std::size_t bakes = 0;
    for ([[maybe_unused]] const auto& entry :
         fs::directory_iterator(works.works[0].session->bakeFolder()))
        ++bakes;
    EXPECT_EQ(bakes, 1u);
    const Document back = recovered(works.works[0]);
    ASSERT_THAT(back.bakes, SizeIs(1));
    EXPECT_EQ(*back.bakes[0], *document.bakes[0]);
    EXPECT_EQ(back.environment().rotationDeg, 12.0f);
}

TEST_F(RecoveryWriterTest, ABakeOfAHiddenMeshIsKeptToo) {
    document.bakes = {someBake()};
    document.meshes.front().visible = false;
    auto writer = makeWriter();
    writer->keep(snapshot());
    ASSERT_TRUE(writer->flush(kLong));
    writer.reset();
    const AbandonedWorks works = found();
    ASSERT_THAT(works.works, SizeIs(1));
    EXPECT_THAT(recovered(works.works[0]).bakes, SizeIs(1));
}

TEST_F(RecoveryWriterTest, ABakeThatIsReplacedLeavesNothingBehind) {
    RecoveryWriter::Settings settings;
    settings.bakePause = std::chrono::milliseconds(0);
    auto writer = makeWriter(settings);
    for (int i = 0; i < 3; ++i) {
        auto bake = std::make_shared<BakeArtifact>(*someBake());
        bake->samplesDone = i;
        document.bakes = {bake};
        writer->keep(snapshot());
        ASSERT_TRUE(writer->flush(kLong));
    }
    writer->keep(snapshot());
    ASSERT_TRUE(writer->flush(kLong));
    writer.reset();
    const AbandonedWorks works = found();
    ASSERT_THAT(works.works, SizeIs(1));
    std::size_t bakes = 0;
    for ([[maybe_unused]] const auto& entry :
         fs::directory_iterator(works.works[0].session->bakeFolder()))
        ++bakes;
    EXPECT_EQ(bakes, 1u);
    EXPECT_EQ(recovered(works.works[0]).bakes.at(0)->samplesDone, 2);
}

TEST_F(RecoveryWriterTest, ABakeThatIsTooLargeIsLeftOutAndSaidNowAndLater) {
    document.bakes = {someBake()};
    RecoveryWriter::Settings settings;
    settings.maxBakeBytes = 100;
    auto writer = makeWriter(settings);
    writer->keep(snapshot());
    ASSERT_TRUE(writer->flush(kLong));
    writer.reset();
    EXPECT_THAT(told, Contains(HasSubstr("A crash would lose the baked ambient occlusion")));
    const AbandonedWorks works = found();
    ASSERT_THAT(works.works, SizeIs(1));
    EXPECT_THAT(recovered(works.works[0]).bakes, IsEmpty());
    EXPECT_THAT(notices, Contains(::testing::Field(&Notice::message, HasSubstr("not recovered"))));
}

TEST_F(RecoveryWriterTest, ABakeOfTheSavedProjectIsNotWrittenAgainAndComesFromThere) {
    const fs::path file = files / "scene.patina";
    document.bakes = {someBake()};
    ASSERT_TRUE(saveProject(worker, document, file).ok());
    const Hash before = hashFile(file);
    auto writer = makeWriter();
    writer->setSavedFile(file);
    document.environment().rotationDeg = 5.0f;
    RecoverySnapshot unsaved = snapshot(file);
    unsaved.savedBakes = document.bakes;
    writer->keep(std::move(unsaved));
    ASSERT_TRUE(writer->flush(kLong));
    writer.reset();
    const AbandonedWorks works = found();
    ASSERT_THAT(works.works, SizeIs(1));
    EXPECT_FALSE(fs::exists(works.works[0].session->bakeFolder()));
    EXPECT_TRUE(savedFileUnchanged(works.works[0].record));
    const Document back = recovered(works.works[0]);
    ASSERT_THAT(back.bakes, SizeIs(1));
    EXPECT_EQ(back.bakes[0]->vertices, document.bakes[0]->vertices);
    EXPECT_EQ(back.environment().rotationDeg, 5.0f);
    EXPECT_EQ(hashFile(file), before) << "the user's file is the user's";
    files.write("scene.patina", std::string_view("changed by somebody else"));
    EXPECT_FALSE(savedFileUnchanged(works.works[0].record));
}

TEST_F(RecoveryWriterTest, AFolderThatCannotBeWrittenIsToldOnce) {
    files.write("notAFolder", std::string_view("x"));
    RecoveryWriter writer(files / "notAFolder", [this](const std::string& sentence) {
        const std::lock_guard lock(mutex);
        told.push_back(sentence);
    });
    for (int i = 0; i < 3; ++i) {
        writer.keep(snapshot());
        ASSERT_TRUE(writer.flush(kLong));
    }
    EXPECT_THAT(told, SizeIs(1));
}

// What the user saw before the crash needs no question after it, and what was left out stays so.
TEST_F(RecoveryWriterTest, PicturesOutsideTheProjectsFolderComeBackAsTheyWere) {
    for (const char* name : {"shown.png", "secret.png"})
        ASSERT_TRUE(
            saveImage(worker, Image(2, 2, 3, PixelType::U8, ColorEncoding::Srgb), files / name)
                .ok());
    Material& material = document.materials.front();
    material.baseColorMap.source = files / "shown.png";
    material.baseColorMap.image =
        std::make_shared<const Image>(2, 2, 3, PixelType::U8, ColorEncoding::Srgb);
    material.emissiveMap.source = files / "secret.png";
    material.emissiveMap.problem = kOutsideProjectProblem;
    auto writer = makeWriter();
    writer->keep(snapshot(files / "project/theirs.patina"));
    ASSERT_TRUE(writer->flush(kLong));
    writer.reset();
    const AbandonedWorks works = found();
    ASSERT_THAT(works.works, SizeIs(1));
    const Document back = recovered(works.works[0]);
    EXPECT_NE(back.materials.front().baseColorMap.image, nullptr);
    EXPECT_EQ(back.materials.front().emissiveMap.image, nullptr);
    EXPECT_EQ(back.materials.front().emissiveMap.problem, kOutsideProjectProblem);
}

TEST_F(RecoveryWriterTest, RecoveredWorkGoesOnInItsFolder) {
    {
        auto first = makeWriter();
        first->keep(snapshot());
        ASSERT_TRUE(first->flush(kLong));
    }
    auto writer = makeWriter();
    {
        AbandonedWorks works = found();
        ASSERT_THAT(works.works, SizeIs(1));
        document.environment().rotationDeg = 77.0f;
        writer->keep(snapshot());
        writer->adopt(std::move(works.works[0].session));
    }
    ASSERT_TRUE(writer->flush(kLong));
    EXPECT_THAT(found().works, IsEmpty()) << "it runs";
    writer.reset();
    const AbandonedWorks works = found();
    ASSERT_THAT(works.works, SizeIs(1)) << "not twice";
    EXPECT_EQ(recovered(works.works[0]).environment().rotationDeg, 77.0f);
}

} // namespace
} // namespace patina
