#include "SceneFixture.h"
#include "core/edit/Edit.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/scene/ImageProblem.h"

#include <gmock/gmock.h>
#include <set>

using namespace patina;
using testing::HasSubstr;

namespace {

void expectResolved(const Document& document) {
    for (const MeshInstance& mesh : document.meshes) {
        ASSERT_NE(mesh.mesh, nullptr) << mesh.name;
        EXPECT_NE(document.material(mesh.material), nullptr) << mesh.name;
        EXPECT_LT(mesh.id, document.nextId);
    }
    ASSERT_NE(document.environment().image, nullptr);
    const Image& environment = *document.environment().image;
    EXPECT_EQ(environment.type(), PixelType::F32);
    EXPECT_EQ(environment.channels(), 3);
    EXPECT_EQ(environment.width(), 2 * environment.height());
}

} // namespace

TEST(StartDocument, IsTheShaderBallUnderTheStudioSky) {
    const Document document = startDocument();
    expectResolved(document);
    EXPECT_GE(document.meshes.size(), 2u);
    EXPECT_GT(document.triangleCount(), 1000u);
    EXPECT_EQ(document.environment().source, "builtin:studio");
    for (const MeshInstance& mesh : document.meshes)
        EXPECT_EQ(mesh.source, "builtin:shader-ball");
    // The ball looks like something: it has maps, and every map that is named is there.
    bool hasMaps = false;
    for (const Material& material : document.materials) {
        hasMaps = hasMaps || material.baseColorMap.image != nullptr;
        EXPECT_TRUE(material.baseColorMap.source.empty() || material.baseColorMap.image);
    }
    EXPECT_TRUE(hasMaps);
    EXPECT_EQ(document.view.camera, frameBounds(Camera{}, document.bounds(), 16.0f / 9.0f));
}

TEST_F(SceneFixture, BuiltinsOpenByName) {
    const OpenedScene opened = open("builtin:sphere");
    expectResolved(opened.document);
    EXPECT_FALSE(opened.isProject);
    EXPECT_TRUE(opened.notices.empty());
    EXPECT_TRUE(opened.missingFiles.empty());
    const Result<OpenedScene> unknown = openScene(m_worker, "builtin:teapot");
    ASSERT_FALSE(unknown.ok());
    EXPECT_THAT(unknown.error().text(), HasSubstr("sphere"));
}

TEST_F(SceneFixture, AModelOpensWithItsMaterialsMapsAndAListOfWhatIsMissing) {
    const std::string file = writeModel();
    const OpenedScene opened = open(file);
    const Document& document = opened.document;
    expectResolved(document);
    ASSERT_EQ(document.meshes.size(), 2u);
    EXPECT_EQ(document.meshes[0].source, file);
    EXPECT_EQ(document.meshes[1].sourceIndex, 1);
    EXPECT_EQ(document.triangleCount(), 2u);
    EXPECT_TRUE(document.lights.empty());

    EXPECT_EQ(materialNamed(document, "Unused"), nullptr);
    const Material* red = materialNamed(document, "Red");
    ASSERT_NE(red, nullptr);
    ASSERT_NE(red->baseColorMap.image, nullptr) << red->baseColorMap.problem;
    EXPECT_EQ(red->baseColorMap.source, (m_folder / "models/red.png").string());
    EXPECT_EQ(red->baseColorMap.image->encoding(), ColorEncoding::Srgb);
    EXPECT_TRUE(red->baseColorMap.problem.empty());

    const Material* lost = materialNamed(document, "Lost");
    ASSERT_NE(lost, nullptr);
    EXPECT_EQ(lost->baseColorMap.image, nullptr);
    EXPECT_EQ(lost->baseColorMap.source, (m_folder / "models/lost.png").string());
    EXPECT_FALSE(lost->baseColorMap.problem.empty());
    EXPECT_EQ(opened.missingFiles,
              (std::vector<std::string>{(m_folder / "models/lost.png").string()}));
    EXPECT_TRUE(mentions(opened.notices, "lost.png"));
}

// A download that was cut off at once is there, and damaged: it is not called missing.
TEST_F(SceneFixture, EmptyTexturesAreDamagedAndNotMissing) {
    const std::string file = writeModel();
    m_folder.write("models/red.png", "");
    const OpenedScene opened = open(file);
    EXPECT_THAT(opened.missingFiles, testing::ElementsAre((m_folder / "models/lost.png").string()));
    EXPECT_THAT(damagedMaps(opened.document),
                testing::ElementsAre((m_folder / "models/red.png").string()));
    EXPECT_THAT(mapProblems(opened.document, materialNamed(opened.document, "Red")->id),
                testing::ElementsAre("Base colour map is damaged: red.png"));
    EXPECT_THAT(mapProblems(opened.document, materialNamed(opened.document, "Lost")->id),
                testing::ElementsAre("Base colour map is missing: lost.png"));
    EXPECT_EQ(problemWord(materialNamed(opened.document, "Red")->baseColorMap.problem), "damaged");
    EXPECT_EQ(problemWord(materialNamed(opened.document, "Lost")->baseColorMap.problem), "missing");
    const auto concerned = [](const Notice& notice) {
        return notice.message.find("red.png") != std::string::npos ||
               notice.file.filename() == "red.png";
    };
    EXPECT_EQ(std::ranges::count_if(opened.notices, concerned), 1);
}

// Readable but broken textures each have a notice of their own.
TEST_F(SceneFixture, BrokenTexturesAreReportedOneByOne) {
    const std::string file = writeModel();
    m_folder.write("models/red.png", "this is no picture");
    const OpenedScene opened = open(file);
    EXPECT_EQ(opened.missingFiles.size(), 1u);
    EXPECT_EQ(damagedMaps(opened.document).size(), 1u);
    const auto concerned = [](const Notice& notice) { return notice.file.filename() == "red.png"; };
    EXPECT_EQ(std::ranges::count_if(opened.notices, concerned), 1);
}

TEST_F(SceneFixture, AModelAddedTwiceKeepsIdsAndNamesUnique) {
    const std::string file = writeModel();
    Document document = startDocument();
    const Document before = document;
    ASSERT_TRUE(addModel(m_worker, document, file).ok());
    std::vector<std::string> missing;
    ASSERT_TRUE(addModel(m_worker, document, file, {}, &missing).ok());
    EXPECT_EQ(missing.size(), 1u);
    EXPECT_EQ(document.meshes.size(), before.meshes.size() + 4);
    EXPECT_EQ(document.view, before.view);
    std::set<Id> ids;
    std::set<std::string> names;
    for (const Material& material : document.materials) {
        EXPECT_TRUE(ids.insert(material.id).second);
        EXPECT_TRUE(names.insert(material.name).second) << material.name;
    }
    for (const MeshInstance& mesh : document.meshes)
        EXPECT_TRUE(ids.insert(mesh.id).second);
    EXPECT_NE(materialNamed(document, "Red 2"), nullptr);
}

TEST_F(SceneFixture, AModelThatCannotBeReadLeavesTheDocumentAlone) {
    Document document = startDocument();
    const Document before = document;
    const std::string broken = m_folder.write("broken.glb", "glTF is not this").string();
    for (const std::string& file :
         {(m_folder / "none.obj").string(), broken, m_folder.path().string()}) {
        const auto added = addModel(m_worker, document, file);
        ASSERT_FALSE(added.ok()) << file;
        EXPECT_EQ(added.error().file, file);
        EXPECT_TRUE(document == before);
    }
    JobControl control;
    control.cancel();
    const auto cancelled = addModel(m_worker, document, writeModel(), control.context());
    ASSERT_FALSE(cancelled.ok());
    EXPECT_EQ(cancelled.error().kind, ErrorKind::Cancelled);
    EXPECT_TRUE(document == before);
}

TEST_F(SceneFixture, EnvironmentsBecomeLinearLatLongFloats) {
    Image hdr(8, 4, 3, PixelType::F32, ColorEncoding::Linear);
    for (std::size_t i = 0; i < hdr.f32().size(); ++i)
        hdr.f32()[i] = static_cast<float>(i);
    std::vector<Notice> notices;
    const auto same = loadEnvironmentImage(m_worker, save(hdr, "sky.exr"), notices);
    ASSERT_TRUE(same.ok()) << same.error().text();
    EXPECT_TRUE(notices.empty());
    EXPECT_TRUE(std::ranges::equal((*same)->f32(), hdr.f32()));
    EXPECT_EQ((*same)->encoding(), ColorEncoding::Linear);
}

TEST_F(SceneFixture, PicturesOfLowRangeAndOddSizeLightTheSceneWithANotice) {
    // Left half and right half differ: the picture is stretched, not cropped.
    Image picture(6, 6, 3, PixelType::U8, ColorEncoding::Srgb);
    for (int y = 0; y < 6; ++y)
        for (int x = 0; x < 6; ++x)
            for (int c = 0; c < 3; ++c)
                picture.u8()[static_cast<std::size_t>((y * 6 + x) * 3 + c)] = x < 3 ? 255 : 0;
    std::vector<Notice> notices;
    const auto loaded = loadEnvironmentImage(m_worker, save(picture, "sky.png"), notices);
    ASSERT_TRUE(loaded.ok()) << loaded.error().text();
    EXPECT_TRUE(mentions(notices, "high dynamic range"));
    EXPECT_TRUE(mentions(notices, "stretched"));
    const Image& image = **loaded;
    EXPECT_EQ(image.width(), 12);
    EXPECT_EQ(image.height(), 6);
    EXPECT_EQ(image.linear(2, 3).r, 1.0f);
    EXPECT_EQ(image.linear(9, 3).r, 0.0f);
}

TEST_F(SceneFixture, DamagedPixelsOfAnEnvironmentAreRepairedAndCounted) {
    Image hdr(4, 2, 3, PixelType::F32, ColorEncoding::Linear);
    hdr.f32()[0] = std::numeric_limits<float>::quiet_NaN();
    hdr.f32()[1] = -5.0f;
    hdr.f32()[2] = std::numeric_limits<float>::infinity();
    std::vector<Notice> notices;
    const auto loaded = loadEnvironmentImage(m_worker, save(hdr, "sky.exr"), notices);
    ASSERT_TRUE(loaded.ok()) << loaded.error().text();
    EXPECT_TRUE(mentions(notices, "3 samples"));
    EXPECT_EQ((*loaded)->f32()[0], 0.0f);
    EXPECT_EQ((*loaded)->f32()[1], 0.0f);
    EXPECT_EQ((*loaded)->f32()[2], 65504.0f);
}

TEST_F(SceneFixture, MapsLoadFromFilesAndTheLibrary) {
    const std::string file = writeImage("a.png", 2, 2, {1, 2, 3});
    const auto image = loadMapImage(m_worker, file, ColorEncoding::Data);
    ASSERT_TRUE(image.ok()) << image.error().text();
    EXPECT_EQ((*image)->encoding(), ColorEncoding::Data);
    EXPECT_EQ((*image)->u8()[2], 3);
    EXPECT_TRUE(loadMapImage(m_worker, "builtin:wood/baseColor", ColorEncoding::Srgb).ok());
    EXPECT_FALSE(loadMapImage(m_worker, "builtin:wood/nothing", ColorEncoding::Srgb).ok());
    EXPECT_FALSE(loadMapImage(m_worker, file + "#embedded:0", ColorEncoding::Data).ok());
    const auto none = loadMapImage(m_worker, (m_folder / "none.png").string(), ColorEncoding::Data);
    ASSERT_FALSE(none.ok());
    EXPECT_EQ(none.error().kind, ErrorKind::InputMissing);
}
