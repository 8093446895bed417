// Pictures outside the model's folder: left out, listed and never exported, until somebody agrees.
#include "core/scene/OutsidePictures.h"
#include "core/material/Material.h"

#include "core/export/Export.h"
#include "core/io/MeshImport.h"
#include "core/scene/DocumentIO.h"
#include "tests/core/scene/SceneFixture.h"

#include <gmock/gmock.h>

namespace patina {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class OutsidePicturesTest : public SceneFixture {
  protected:
    // A triangle that shows `picture`, spelled like that.
    std::string writeModelWith(const std::string& picture) {
        m_folder.write("model/a.mtl", "newmtl Skin\nKd 1 1 1\nmap_Kd " + picture + "\n");
        return m_folder
            .write("model/a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\n"
                                  "vt 0 1\nvn 0 0 1\nusemtl Skin\nf 1/1/1 2/2/1 3/3/1\n")
            .string();
    }
    static const MapSlot& slotOf(const OpenedScene& scene) {
        return scene.document.materials.at(0).baseColorMap;
    }
    // A client whose user has agreed to nothing yet.
    OpenedScene openFresh(const std::string& scene, WorkerClient& worker) {
        Result<OpenedScene> opened = openScene(worker, scene);
        EXPECT_TRUE(opened.ok());
        return opened.ok() ? *std::move(opened) : OpenedScene{};
    }
};

TEST_F(OutsidePicturesTest, AreLeftOutHoweverTheyAreSpelled) {
    const std::string secret = writeImage("private/secret.png", 4, 4, {200, 10, 20});
    std::filesystem::create_directories(m_folder / "model");
    std::filesystem::create_symlink(secret, m_folder / "model/link.png");
    for (const std::string& picture :
         {secret, std::string("../private/secret.png"), std::string("..\\private\\secret.png"),
          std::string("x/../../private/secret.png"), std::string("link.png")}) {
        SCOPED_TRACE(picture);
        const std::string model = writeModelWith(picture);
        WorkerClient worker;
        const OpenedScene closed = openFresh(model, worker);
        EXPECT_EQ(slotOf(closed).image, nullptr);
        EXPECT_EQ(slotOf(closed).problem, kOutsideProblem);
        EXPECT_TRUE(mentions(closed.notices, "outside the model's folder"));
        EXPECT_THAT(closed.missingFiles, IsEmpty());
        const OutsidePictures outside = outsidePictures(closed.document);
        EXPECT_THAT(outside.models, ElementsAre(model));
        EXPECT_THAT(outside.files, ElementsAre(slotOf(closed).source));

        worker.allowOutside(m_folder / "model" / "other.obj"); // another model's permission
        EXPECT_EQ(slotOf(openFresh(model, worker)).image, nullptr);
        worker.allowOutside(m_folder / "model" / "." / "a.obj");
        const OpenedScene open = openFresh(model, worker);
        EXPECT_NE(slotOf(open).image, nullptr);
        EXPECT_THAT(outsidePictures(open.document).files, IsEmpty());
    }
}

TEST_F(OutsidePicturesTest, WhatLiesInTheFolderIsPreferredAndNeedsNoPermission) {
    writeImage("private/skin.png", 4, 4, {200, 10, 20});
    writeImage("model/textures/skin.png", 2, 2, {0, 0, 0});
    const OpenedScene scene = open(writeModelWith("../private/skin.png"));
    ASSERT_NE(slotOf(scene).image, nullptr);
    EXPECT_EQ(slotOf(scene).image->width(), 2);
}

TEST_F(OutsidePicturesTest, StayLeftOutOfProjectsAndAreKeptAsReferences) {
    const std::string secret = writeImage("private/secret.png", 4, 4, {200, 10, 20});
    const OpenedScene closed = open(writeModelWith("../private/secret.png"));
    const auto project = m_folder / "scene.patina";
    ASSERT_TRUE(saveProject(m_worker, closed.document, project).ok());
    const OpenedScene again = open(project.string());
    EXPECT_EQ(slotOf(again).image, nullptr);
    EXPECT_EQ(slotOf(again).source, secret);
    EXPECT_EQ(slotOf(again).problem, kOutsideProblem);
}

TEST_F(OutsidePicturesTest, AreNotExported) {
    writeImage("private/secret.png", 4, 4, {200, 10, 20});
    const OpenedScene closed = open(writeModelWith("../private/secret.png"));
    ExportSettings settings;
    settings.output = m_folder / "out.gltf";
    settings.format = ExportFormat::Gltf;
    for (const PlannedFile& file : planExport(closed.document, settings).files)
        EXPECT_NE(file.path.extension(), ".png") << file.path;
}

TEST_F(OutsidePicturesTest, FillOnlyTheSlotsThatWereLeftOut) {
    const std::string secret = writeImage("private/secret.png", 4, 4, {200, 10, 20});
    OpenedScene closed = open(writeModelWith("../private/secret.png"));
    auto image = std::make_shared<const Image>(4, 4, 3, PixelType::U8, ColorEncoding::Srgb);
    fillOutsidePicture(closed.document, "/other.png", ColorEncoding::Srgb, image);
    fillOutsidePicture(closed.document, secret, ColorEncoding::Data, image);
    EXPECT_EQ(slotOf(closed).image, nullptr);
    fillOutsidePicture(closed.document, secret, ColorEncoding::Srgb, image);
    EXPECT_EQ(slotOf(closed).image, image);
    EXPECT_TRUE(slotOf(closed).problem.empty());
}

} // namespace
} // namespace patina
