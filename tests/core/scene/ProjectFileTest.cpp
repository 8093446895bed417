// Projects on disk: saving and opening again gives the same document, whatever became of its files.
#include "SceneFixture.h"
#include "core/base/AtomicFile.h"
#include "core/edit/Edit.h"
#include "core/edit/Parameters.h"
#include "core/export/Export.h"
#include "core/light/GeneratedEnvironment.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/scene/DocumentIO.h"

#include <gmock/gmock.h>

using namespace patina;
using testing::HasSubstr;

namespace {

// Payloads compare by content here: they were read anew.
void expectSameImage(const ImagePtr& a, const ImagePtr& b, const std::string& what) {
    ASSERT_EQ(a == nullptr, b == nullptr) << what;
    if (a) {
        EXPECT_TRUE(*a == *b) << what;
    }
}

void expectSameDocument(const Document& a, const Document& b) {
    // The values: exactly what the project's text says.
    EXPECT_EQ(documentToJson(a, "/p/x.patina"), documentToJson(b, "/p/x.patina"));
    ASSERT_EQ(a.meshes.size(), b.meshes.size());
    for (std::size_t i = 0; i < a.meshes.size(); ++i)
        EXPECT_TRUE(*a.meshes[i].mesh == *b.meshes[i].mesh) << a.meshes[i].name;
    ASSERT_EQ(a.materials.size(), b.materials.size());
    for (const Material& material : a.materials)
        for (const ParameterInfo& info : parameters())
            if (info.scope == Scope::Material && info.type == ParameterType::Map)
                expectSameImage(std::get<MapSlot>(info.get(a, material.id)).image,
                                std::get<MapSlot>(info.get(b, material.id)).image,
                                material.name + std::string(info.id));
    expectSameImage(a.environment().image, b.environment().image, "environment");
    ASSERT_EQ(a.bakes.size(), b.bakes.size());
    for (std::size_t i = 0; i < a.bakes.size(); ++i) {
        EXPECT_EQ(a.bakes[i]->kind, b.bakes[i]->kind);
        EXPECT_EQ(a.bakes[i]->vertices, b.bakes[i]->vertices);
        EXPECT_EQ(a.bakes[i]->inputs, b.bakes[i]->inputs);
    }
}

class ProjectFile : public SceneFixture {
  protected:
    void saveTo(const Document& document, const std::filesystem::path& file) {
        const Result<void> saved = saveProject(m_worker, document, file);
        ASSERT_TRUE(saved.ok()) << saved.error().text();
    }
};

} // namespace

TEST_F(ProjectFile, TheStartDocumentComesBack) {
    Document document = startDocument();
    addLight(document, {});
    document.view.exposureEv = 1.25f;
    document.view.camera.yawDeg = -77.7f;
    saveTo(document, m_folder / "start.patina");
    const OpenedScene opened = open((m_folder / "start.patina").string());
    EXPECT_TRUE(opened.isProject);
    EXPECT_TRUE(opened.notices.empty()) << opened.notices.front().message;
    expectSameDocument(opened.document, document);
}

TEST_F(ProjectFile, AModelWithMapsComesBackAlsoFromAnotherFolder) {
    Document document = open(writeModel("here/models")).document;
    document.environment().source = writeImage("here/sky.png", 4, 2, {9, 9, 9});
    std::vector<Notice> notices;
    document.environment().image =
        *loadEnvironmentImage(m_worker, document.environment().source, notices);
    saveTo(document, m_folder / "here/p.patina");
    expectSameDocument(open((m_folder / "here/p.patina").string()).document, document);

    std::filesystem::rename(m_folder / "here", m_folder / "there");
    const OpenedScene moved = open((m_folder / "there/p.patina").string());
    EXPECT_EQ(moved.missingFiles.size(), 1u); // lost.png, which never was
    ASSERT_EQ(moved.document.meshes.size(), 2u);
    EXPECT_EQ(moved.document.triangleCount(), 2u);
    EXPECT_EQ(moved.document.environment().source, (m_folder / "there/sky.png").string());
    EXPECT_TRUE(moved.document.environment().problem.empty());
}

TEST_F(ProjectFile, EmbeddedImagesAreReadFromTheirModel) {
    // A GLB with one texture inside, by our own writer.
    Document document = open(writeModel()).document;
    ExportSettings settings;
    settings.output = m_folder / "pair.glb";
    const auto written = runExport(m_worker, planExport(document, settings), {});
    ASSERT_TRUE(written.ok()) << written.error().text();

    const OpenedScene glb = open(settings.output.string());
    const Material* red = materialNamed(glb.document, "Red");
    ASSERT_NE(red, nullptr);
    ASSERT_NE(red->baseColorMap.image, nullptr) << red->baseColorMap.problem;
    EXPECT_TRUE(red->baseColorMap.source.starts_with(settings.output.string() + "#embedded:"));
    const auto alone = loadMapImage(m_worker, red->baseColorMap.source, ColorEncoding::Srgb);
    ASSERT_TRUE(alone.ok()) << alone.error().text();
    EXPECT_TRUE(**alone == *red->baseColorMap.image);

    saveTo(glb.document, m_folder / "p.patina");
    expectSameDocument(open((m_folder / "p.patina").string()).document, glb.document);
}

TEST_F(ProjectFile, AMissingModelLosesNothing) {
    const Document document = open(writeModel()).document;
    const std::filesystem::path file = m_folder / "p.patina";
    saveTo(document, file);
    std::filesystem::rename(m_folder / "models", m_folder / "away");

    const OpenedScene without = open(file.string());
    ASSERT_EQ(without.document.meshes.size(), 2u);
    for (const MeshInstance& mesh : without.document.meshes) {
        ASSERT_NE(mesh.mesh, nullptr);
        EXPECT_EQ(mesh.mesh->triangleCount(), 0u);
    }
    EXPECT_TRUE(mentions(without.notices, "pair.obj"));
    EXPECT_EQ(without.missingFiles.size(), 3u); // the model and both textures
    const std::string before = *readTextFile(file, 1 << 20);
    saveTo(without.document, file);
    EXPECT_EQ(*readTextFile(file, 1 << 20), before);

    std::filesystem::rename(m_folder / "away", m_folder / "models");
    expectSameDocument(open(file.string()).document, document);
}

TEST_F(ProjectFile, AModelThatLostPartsKeepsTheirPlaces) {
    Document document = open(writeModel()).document;
    document.meshes[1].sourceIndex = 17;
    saveTo(document, m_folder / "p.patina");
    const OpenedScene opened = open((m_folder / "p.patina").string());
    EXPECT_TRUE(mentions(opened.notices, "fewer parts"));
    EXPECT_EQ(opened.document.meshes[1].mesh->triangleCount(), 0u);
    EXPECT_EQ(opened.document.meshes[1].sourceIndex, 17);
}

TEST_F(ProjectFile, AMissingEnvironmentIsReplacedByGreyAndKept) {
    Document document = startDocument();
    document.environment().source = (m_folder / "gone.hdr").string();
    saveTo(document, m_folder / "p.patina");
    const OpenedScene opened = open((m_folder / "p.patina").string());
    EXPECT_EQ(opened.document.environment().source, document.environment().source);
    EXPECT_FALSE(opened.document.environment().problem.empty());
    ASSERT_NE(opened.document.environment().image, nullptr);
    EXPECT_EQ(opened.document.environment().image->linear(3, 3), glm::vec4(0.5f, 0.5f, 0.5f, 1.0f));
    EXPECT_EQ(opened.missingFiles, (std::vector<std::string>{document.environment().source}));
}

TEST_F(ProjectFile, GeneratedEnvironmentsAreMadeAgain) {
    Document document = startDocument();
    document.environment().kind = EnvironmentKind::Sky;
    document.environment().sky.sunElevationDeg = 12.5f;
    resolveEnvironment(document.environment());
    const std::filesystem::path file = m_folder / "p.patina";
    saveTo(document, file);
    Document opened = open(file.string()).document;
    expectSameDocument(opened, document);
    expectSameImage(opened.environment().fileImage, document.environment().fileImage, "studio");

    opened.environment().kind = EnvironmentKind::Softboxes;
    Softbox key;
    key.azimuthDeg = -30.0f;
    key.color = {1.0f, 0.5f, 0.25f};
    addSoftbox(opened, key);
    resolveEnvironment(opened.environment());
    saveTo(opened, file);
    const std::string before = *readTextFile(file, 1 << 20);
    const Document again = open(file.string()).document;
    expectSameDocument(again, opened);
    EXPECT_FALSE(*again.environment().image == *document.environment().image);
    saveTo(again, file);
    EXPECT_EQ(*readTextFile(file, 1 << 20), before);
}

TEST_F(ProjectFile, BakesLieBesideTheProject) {
    Document document = open("builtin:plane").document;
    BakeArtifact bake;
    bake.kind = BakeKind::AoVertex;
    bake.samplesDone = 64;
    bake.settings["samples"] = "64";
    bake.inputs = hashBytes({});
    for (const MeshInstance& mesh : document.meshes) {
        VertexBake& vertices = bake.vertices.emplace_back();
        vertices.mesh = mesh.id;
        for (std::size_t i = 0; i < mesh.mesh->vertexCount(); ++i)
            vertices.values.push_back(static_cast<float>(i % 1024) / 1024.0f);
    }
    attachBake(document, std::make_shared<const BakeArtifact>(bake));
    saveTo(document, m_folder / "p.patina");
    ASSERT_TRUE(std::filesystem::is_directory(m_folder / "p.bakes"));
    const OpenedScene opened = open((m_folder / "p.patina").string());
    EXPECT_TRUE(opened.notices.empty()) << opened.notices.front().message;
    expectSameDocument(opened.document, document);

    // Without the file the project opens, and says what to do.
    std::filesystem::remove_all(m_folder / "p.bakes");
    const OpenedScene without = open((m_folder / "p.patina").string());
    EXPECT_EQ(findBake(without.document, BakeKind::AoVertex), nullptr);
    EXPECT_TRUE(mentions(without.notices, "bake it anew"));
}

TEST_F(ProjectFile, AFailedSaveLeavesTheOldProject) {
    const std::filesystem::path file = m_folder / "p.patina";
    Document document = open("builtin:plane").document;
    saveTo(document, file);
    const std::string before = *readTextFile(file, 1 << 20);
    // The bakes cannot be written: their folder's name is taken by a file.
    m_folder.write("p.bakes", "in the way");
    BakeArtifact bake;
    bake.kind = BakeKind::AoVertex;
    for (const MeshInstance& mesh : document.meshes)
        bake.vertices.push_back({mesh.id, 1, std::vector<float>(mesh.mesh->vertexCount(), 0.5f)});
    document.view.exposureEv = 3.0f;
    attachBake(document, std::make_shared<const BakeArtifact>(bake));
    const Result<void> saved = saveProject(m_worker, document, file);
    ASSERT_FALSE(saved.ok());
    EXPECT_EQ(saved.error().kind, ErrorKind::CannotCreate);
    EXPECT_EQ(*readTextFile(file, 1 << 20), before);
    EXPECT_EQ(saveProject(m_worker, startDocument(), m_folder / "no/such/p.patina").error().kind,
              ErrorKind::CannotCreate);
}

TEST_F(ProjectFile, WhatIsNoProjectIsRefused) {
    const auto kindOf = [&](const std::string& file) {
        const Result<OpenedScene> opened = openScene(m_worker, file);
        EXPECT_FALSE(opened.ok()) << file;
        return opened.ok() ? ErrorKind::Internal : opened.error().kind;
    };
    EXPECT_EQ(kindOf((m_folder / "none.patina").string()), ErrorKind::InputMissing);
    EXPECT_EQ(kindOf(m_folder.write("empty.patina", "").string()), ErrorKind::InputBroken);
    EXPECT_EQ(kindOf(m_folder.write("text.PATINA", "hello").string()), ErrorKind::InputBroken);
    std::filesystem::create_directory(m_folder / "folder.patina");
    EXPECT_EQ(kindOf((m_folder / "folder.patina").string()), ErrorKind::InputMissing);
}

TEST_F(ProjectFile, NamesThatAreNoUtf8Survive) {
    Document document = open("builtin:plane").document;
    const std::string name = "r\xe9sum\xe9 100%.png";
    const std::string source = writeImage(name, 2, 2, {7, 8, 9});
    document.materials[0].baseColorMap.source = source;
    document.materials[0].baseColorMap.image = *loadMapImage(m_worker, source, ColorEncoding::Srgb);
    saveTo(document, m_folder / "p.patina");
    const OpenedScene opened = open((m_folder / "p.patina").string());
    EXPECT_EQ(opened.document.materials[0].baseColorMap.source, source);
    expectSameDocument(opened.document, document);
}
