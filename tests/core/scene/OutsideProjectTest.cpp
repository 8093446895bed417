// Pictures outside a project's folder: shown where this user saved the project with them, left out
// of a project that comes from somebody else, until the user agrees.
#include "core/scene/OutsidePictures.h"

#include "core/base/AtomicFile.h"
#include "core/document/Snapshot.h"
#include "core/edit/EditSession.h"
#include "core/export/Export.h"
#include "core/scene/DocumentIO.h"
#include "core/scene/OutsideGrants.h"
#include "tests/core/scene/SceneFixture.h"

#include <cstdlib>
#include <gmock/gmock.h>
#include <thread>

namespace patina {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

class OutsideProjectTest : public SceneFixture {
  protected:
    OutsideProjectTest() { beUser("theirs"); }
    ~OutsideProjectTest() override {
        if (m_before)
            ::setenv("XDG_STATE_HOME", m_before->c_str(), 1);
        else
            ::unsetenv("XDG_STATE_HOME");
    }
    // Whoever saves and opens from now on: each user has a state folder.
    void beUser(const std::string& name) const {
        ::setenv("XDG_STATE_HOME", (m_folder.path() / ("state of " + name)).c_str(), 1);
    }
    // A project that shows a picture and an environment of another folder, and two of its own.
    fs::path saveProjectWithSecrets() {
        writeImage("project/own.png", 2, 2, {1, 2, 3});
        Document document = startDocument();
        Material& material = document.materials.at(0);
        material.baseColorMap = mapOf(secret, ColorEncoding::Srgb);
        material.normalMap = mapOf((m_folder / "project/own.png").string(), ColorEncoding::Data);
        document.environment().source = light;
        const fs::path project = m_folder / "project/scene.patina";
        const Result<void> saved = saveProject(m_worker, document, project);
        EXPECT_TRUE(saved.ok()) << saved.error().text();
        return project;
    }
    MapSlot mapOf(const std::string& source, ColorEncoding encoding) {
        MapSlot slot;
        slot.source = source;
        const Result<ImagePtr> image = loadMapImage(m_worker, source, encoding);
        EXPECT_TRUE(image.ok());
        slot.image = image.ok() ? *image : nullptr;
        return slot;
    }
    static const MapSlot& secretOf(const OpenedScene& scene) {
        return scene.document.materials.at(0).baseColorMap;
    }
    OpenedScene openWith(WorkerClient& worker, const fs::path& project) {
        Result<OpenedScene> opened = openScene(worker, project.string());
        EXPECT_TRUE(opened.ok());
        return opened.ok() ? *std::move(opened) : OpenedScene{};
    }

    std::optional<std::string> m_before =
        std::getenv("XDG_STATE_HOME") != nullptr
            ? std::optional<std::string>(std::getenv("XDG_STATE_HOME"))
            : std::nullopt;
    const std::string secret = writeImage("private/secret.png", 4, 4, {200, 10, 20});
    const std::string light =
        save(Image(64, 32, 3, PixelType::F32, ColorEncoding::Linear), "private/light.exr");
};

TEST_F(OutsideProjectTest, SomebodyElsesShowsAndExportsNoneOfYourPictures) {
    const fs::path project = saveProjectWithSecrets();
    beUser("mine");
    const OpenedScene opened = open(project.string());
    EXPECT_EQ(secretOf(opened).image, nullptr);
    EXPECT_EQ(secretOf(opened).source, secret) << "it is kept as a reference";
    EXPECT_EQ(secretOf(opened).problem, kOutsideProjectProblem);
    EXPECT_NE(opened.document.materials.at(0).normalMap.image, nullptr) << "in its own folder";
    EXPECT_EQ(opened.document.environment().problem, kOutsideProjectProblem);
    ASSERT_NE(opened.document.environment().image, nullptr) << "a neutral grey";
    EXPECT_NEAR(opened.document.environment().image->f32()[0], 0.5f, 1e-6f);
    EXPECT_TRUE(mentions(opened.notices, "outside the project's folder"));
    EXPECT_THAT(opened.missingFiles, IsEmpty());
    const OutsidePictures outside = outsidePictures(opened.document);
    EXPECT_THAT(outside.ofProject, UnorderedElementsAre(secret, light));
    EXPECT_THAT(outside.ofMaps, ElementsAre(secret));
    EXPECT_THAT(outside.models, IsEmpty());

    ExportSettings settings;
    settings.output = m_folder / "out/out.gltf";
    settings.format = ExportFormat::Gltf;
    std::vector<std::string> names;
    for (const PlannedFile& file : planExport(opened.document, settings).files)
        names.push_back(file.path.filename().string());
    EXPECT_THAT(names, testing::Not(Contains(testing::HasSubstr("secret"))));
}

TEST_F(OutsideProjectTest, YourOwnOpensWithoutAQuestion) {
    const fs::path project = saveProjectWithSecrets();
    for (const fs::path& name : {project, m_folder / "project/../project/./scene.patina"}) {
        const OpenedScene opened = open(name.string());
        EXPECT_NE(secretOf(opened).image, nullptr) << name;
        EXPECT_TRUE(opened.document.environment().problem.empty());
        EXPECT_THAT(outsidePictures(opened.document).files, IsEmpty());
    }
}

TEST_F(OutsideProjectTest, WhatOthersAddToYoursIsLeftOut) {
    const std::string other = writeImage("private/other.png", 4, 4, {1, 1, 1});
    const fs::path project = saveProjectWithSecrets();
    Result<std::string> text = readTextFile(project, 1 << 20);
    ASSERT_TRUE(text.ok());
    const std::size_t at = text->find("secret.png");
    ASSERT_NE(at, std::string::npos);
    text->replace(at, 10, "other.png");
    ASSERT_TRUE(writeFileAtomically(project, *text).ok());
    const OpenedScene opened = open(project.string());
    EXPECT_EQ(secretOf(opened).image, nullptr);
    EXPECT_TRUE(opened.document.environment().problem.empty()) << "as saved";
    EXPECT_THAT(outsidePictures(opened.document).ofProject, ElementsAre(other));
    // Nor is a copy of it in another place yours.
    const fs::path copy = m_folder / "copy/scene.patina";
    fs::create_directories(copy.parent_path());
    ASSERT_TRUE(writeFileAtomically(copy, *text).ok());
    EXPECT_NE(open(copy.string()).document.environment().problem, "");
}

TEST_F(OutsideProjectTest, LinksDoNotHideWhereAFileLies) {
    const fs::path project = saveProjectWithSecrets();
    fs::remove(m_folder / "project/own.png");
    fs::create_symlink(secret, m_folder / "project/own.png");
    beUser("mine");
    const OpenedScene opened = open(project.string());
    EXPECT_EQ(opened.document.materials.at(0).normalMap.image, nullptr);
    EXPECT_EQ(opened.document.materials.at(0).normalMap.problem, kOutsideProjectProblem);
}

TEST_F(OutsideProjectTest, AMissingFileIsMissing) {
    const fs::path project = saveProjectWithSecrets();
    fs::remove(secret);
    beUser("mine");
    const OpenedScene opened = open(project.string());
    EXPECT_THAT(opened.missingFiles, ElementsAre(secret));
    EXPECT_THAT(outsidePictures(opened.document).ofProject, ElementsAre(light));
}

TEST_F(OutsideProjectTest, AgreeingReadsThem) {
    const fs::path project = saveProjectWithSecrets();
    beUser("mine");
    WorkerClient worker;
    worker.allowOutside(m_folder / "project/other.patina");
    EXPECT_EQ(secretOf(openWith(worker, project)).image, nullptr);
    worker.allowOutside(project);
    EXPECT_NE(secretOf(openWith(worker, project)).image, nullptr);
    WorkerClient toAll; // --allow-outside
    toAll.allowOutsideOfAll();
    EXPECT_NE(secretOf(openWith(toAll, project)).image, nullptr);
    // For one of the pictures, and for good.
    ASSERT_TRUE(grantOutside(project, {secret}, outsideGrantsFile()).ok());
    const OpenedScene granted = open(project.string());
    EXPECT_NE(secretOf(granted).image, nullptr);
    EXPECT_THAT(outsidePictures(granted.document).ofProject, ElementsAre(light));
}

TEST_F(OutsideProjectTest, SavingDoesNotAgreeToWhatWasLeftOut) {
    const fs::path project = saveProjectWithSecrets();
    beUser("mine");
    OpenedScene opened = open(project.string());
    opened.document.materials.at(0).name = "Renamed";
    ASSERT_TRUE(saveProject(m_worker, opened.document, project).ok());
    const OpenedScene again = open(project.string());
    EXPECT_EQ(again.document.materials.at(0).name, "Renamed");
    EXPECT_EQ(secretOf(again).image, nullptr);
    EXPECT_EQ(secretOf(again).source, secret);
    EXPECT_EQ(again.document.environment().source, light);
    EXPECT_EQ(again.document.environment().problem, kOutsideProjectProblem);
}

TEST_F(OutsideProjectTest, SnapshotsAreNoWayAround) {
    EditSession session;
    Document document = startDocument();
    document.materials.at(0).baseColorMap = mapOf(secret, ColorEncoding::Srgb);
    document.environment().source = light;
    session.replace(std::move(document));
    session.keepSnapshot("secret", {});
    Document plain = session.document();
    plain.materials.at(0).baseColorMap = {};
    plain.environment().source = "builtin:studio";
    const fs::path project = m_folder / "project/scene.patina";
    fs::create_directories(project.parent_path());
    ASSERT_TRUE(saveProject(m_worker, plain, project).ok());
    const auto lookOf = [](const OpenedScene& scene) {
        return scene.document.snapshots.at(0).look;
    };
    EXPECT_NE(lookOf(open(project.string()))->materials.at(0)->baseColorMap.image, nullptr);

    beUser("mine");
    OpenedScene opened = open(project.string());
    EXPECT_EQ(lookOf(opened)->materials.at(0)->baseColorMap.image, nullptr);
    EXPECT_EQ(lookOf(opened)->environments.at(0)->problem, kOutsideProjectProblem);
    EXPECT_THAT(outsidePictures(opened.document).ofProject, UnorderedElementsAre(secret, light));
    const ImagePtr image = mapOf(secret, ColorEncoding::Srgb).image;
    fillOutsidePicture(opened.document, secret, ColorEncoding::Srgb, image);
    EXPECT_EQ(lookOf(opened)->materials.at(0)->baseColorMap.image, image);
    fillOutsideEnvironment(opened.document, light, EnvironmentLayout::Automatic, image);
    EXPECT_EQ(lookOf(opened)->environments.at(0)->fileImage, image);
    EXPECT_THAT(outsidePictures(opened.document).files, IsEmpty());
}

TEST_F(OutsideProjectTest, GrantsAreKeptFileByFile) {
    const fs::path kept = m_folder / "state/grants.json";
    const std::string odd = "/pictures/100%\xff \"a\"\n.png";
    ASSERT_TRUE(grantOutside("/a/one.patina", {odd, "/b.png"}, kept).ok());
    ASSERT_TRUE(grantOutside("/a/two.patina", {"/c.png"}, kept).ok());
    ASSERT_TRUE(grantOutside("/a/x/../one.patina", {"/d.png"}, kept).ok());
    EXPECT_THAT(outsideGrants("/a/one.patina", kept),
                UnorderedElementsAre(odd, "/b.png", "/d.png"));
    EXPECT_THAT(outsideGrants("/a/two.patina", kept), ElementsAre("/c.png"));
    EXPECT_THAT(outsideGrants("/a/three.patina", kept), IsEmpty());
    // Nothing is kept nowhere, and a damaged file grants nothing and does no harm.
    EXPECT_TRUE(grantOutside("/a/one.patina", {"/b.png"}, {}).ok());
    EXPECT_THAT(outsideGrants("/a/one.patina", {}), IsEmpty());
    ASSERT_TRUE(writeFileAtomically(kept, "[{\"project\": 3").ok());
    EXPECT_THAT(outsideGrants("/a/one.patina", kept), IsEmpty());
    EXPECT_TRUE(grantOutside("/a/one.patina", {"/b.png"}, kept).ok());
    EXPECT_THAT(outsideGrants("/a/one.patina", kept), ElementsAre("/b.png"));
    // The oldest of many go.
    for (const char* name : {"/x.patina", "/y.patina", "/x.patina", "/z.patina"})
        ASSERT_TRUE(grantOutside(name, {"/b.png", std::string(name) + ".png"}, kept, 2).ok());
    EXPECT_THAT(outsideGrants("/a/one.patina", kept), IsEmpty());
    EXPECT_THAT(outsideGrants("/x.patina", kept), IsEmpty());
    EXPECT_EQ(outsideGrants("/y.patina", kept).size(), 2u);
    EXPECT_EQ(outsideGrants("/z.patina", kept).size(), 2u);
}

TEST_F(OutsideProjectTest, TwoWhoSaveAtOnceKeepBoth) {
    const fs::path kept = m_folder / "state/grants.json";
    const auto grantMany = [&](const std::string& who) {
        for (int i = 0; i < 20; ++i)
            EXPECT_TRUE(grantOutside("/" + who + ".patina", {"/" + std::to_string(i)}, kept).ok());
    };
    std::thread other([&] { grantMany("a"); });
    grantMany("b");
    other.join();
    EXPECT_EQ(outsideGrants("/a.patina", kept).size(), 20u);
    EXPECT_EQ(outsideGrants("/b.patina", kept).size(), 20u);
}

} // namespace
} // namespace patina
