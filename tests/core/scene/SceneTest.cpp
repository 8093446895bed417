#include "SceneFixture.h"
#include "core/document/SceneSource.h"
#include "core/document/ViewChoices.h"
#include "core/edit/Edit.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/mix/LightList.h"
#include "core/scene/DocumentIO.h"
#include "core/scene/ImageProblem.h"
#include "core/scene/OutsidePictures.h"

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

// The lamp of a room is all the light; a bare model has the studio's.
TEST_F(SceneFixture, WhatBringsItsOwnLightIsLitByThat) {
    for (const char* room : {"cornell-box", "cornell-reference", "gallery"}) {
        const Document document = open(std::string("builtin:") + room).document;
        ASSERT_EQ(lightNames(document).size(), 1u) << room;
        EXPECT_EQ(lightNames(document)[0].kind, LightKind::Glow) << room;
        EXPECT_EQ(document.view.lighting, LightingMode::Radiosity) << room;
        EXPECT_EQ(document.view.exposureMode, ExposureMode::Automatic) << room;
        EXPECT_EQ(document.view.camera.yawDeg, 0.0f) << "from the front: " << room;
    }
    const Document sphere = open("builtin:sphere").document;
    ASSERT_EQ(lightNames(sphere).size(), 1u);
    EXPECT_EQ(lightNames(sphere)[0].kind, LightKind::Environment);
    EXPECT_EQ(sphere.view.lighting, LightingMode::Ibl);
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

// --- Visual scenes of COLLADA files --------------------------------------------------------------

namespace {

// `titles`: of scenes with as many triangles as their number, from 1; the last one is named. The
// material shows a picture outside of the folder.
std::string scenesDocument(const std::vector<std::string>& titles) {
    std::string scenes;
    for (std::size_t i = 0; i < titles.size(); ++i) {
        scenes += "<visual_scene id=\"s" + std::to_string(i) + "\" name=\"" + titles[i] + "\">";
        for (std::size_t k = 0; k <= i; ++k)
            scenes += "<node name=\"Part " + std::to_string(k) +
                      "\"><instance_geometry url=\"#g\"><bind_material><technique_common>"
                      "<instance_material symbol=\"m\" target=\"#mat\"/></technique_common>"
                      "</bind_material></instance_geometry></node>";
        scenes += "</visual_scene>";
    }
    return R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><created>2020-01-01T00:00:00Z</created><modified>2020-01-01T00:00:00Z</modified></asset>
<library_images><image id="img"><init_from>../elsewhere/wood.png</init_from></image></library_images>
<library_effects><effect id="fx"><profile_COMMON>
<newparam sid="surf"><surface type="2D"><init_from>img</init_from></surface></newparam>
<newparam sid="samp"><sampler2D><source>surf</source></sampler2D></newparam>
<technique sid="common"><lambert><diffuse><texture texture="samp" texcoord="UV"/></diffuse></lambert>
</technique></profile_COMMON></effect></library_effects>
<library_materials><material id="mat" name="Oak"><instance_effect url="#fx"/></material></library_materials>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="9">0 0 0 1 0 0 0 1 0</float_array><technique_common><accessor source="#pa" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1" material="m"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes>)" +
           scenes + R"(</library_visual_scenes><scene><instance_visual_scene url="#s)" +
           std::to_string(titles.size() - 1) + R"("/></scene></COLLADA>)";
}

} // namespace

TEST(SceneSource, IsReadAsItWasWritten) {
    for (const std::string title : {"Attic", "a/b", "50%", "x#scene:y", "..", "#embedded:3", "é"}) {
        const std::string source = formatSceneSource({"/rooms/House.DAE", title});
        EXPECT_EQ(parseSceneSource(source).file, "/rooms/House.DAE") << source;
        EXPECT_EQ(parseSceneSource(source).title, title) << source;
        EXPECT_EQ(normalizeSource(source), source);
        EXPECT_FALSE(parseEmbeddedSource(source)) << source;
    }
    for (const std::string file :
         {"/a#scene:b", "/a.dae", "/a.dae#scene:", "/a.dae#scene:b/c.obj"}) {
        EXPECT_EQ(parseSceneSource(file).file, file);
        EXPECT_TRUE(parseSceneSource(file).title.empty());
    }
}

TEST_F(SceneFixture, ColladaWithLightsIsLitByThem) {
    std::string text = scenesDocument({"Hall"});
    const auto insert = [&text](const std::string& before, const std::string& what) {
        text.insert(text.find(before), what);
    };
    const std::string dark = m_folder.write("rooms/dark.dae", text).string();
    EXPECT_TRUE(open(dark).document.environment().enabled);
    insert("<library_visual_scenes>",
           "<library_lights><light id=\"l\" name=\"Lamp\"><technique_common><point><color>1 1 1"
           "</color></point></technique_common></light></library_lights>");
    insert("</visual_scene>", "<node name=\"Lamp\"><instance_light url=\"#l\"/></node>");
    const Document lit = open(m_folder.write("rooms/lit.dae", text).string()).document;
    EXPECT_FALSE(lit.environment().enabled);
    ASSERT_EQ(lightNames(lit).size(), 1u);
    EXPECT_EQ(lightNames(lit)[0].kind, LightKind::Light);
    EXPECT_EQ(lit.view.lighting, LightingMode::Ibl) << "lights need no radiosity to be seen";
}

TEST_F(SceneFixture, AProjectKeepsTheVisualSceneThatWasChosen) {
    writeImage("elsewhere/wood.png", 2, 2, {90, 60, 30});
    const std::string file =
        m_folder.write("rooms/house.dae", scenesDocument({"Attic/50%", "Hall", "House"})).string();
    const OpenedScene named = open(file);
    EXPECT_EQ(named.document.meshes.size(), 3u);
    ASSERT_EQ(named.scenes.size(), 1u);
    EXPECT_EQ(named.scenes[0].scene, 2u);
    EXPECT_FALSE(named.scenes[0].asked);

    const OpenedScene attic = open(formatSceneSource({file, "Attic/50%"}));
    EXPECT_EQ(attic.document.meshes.size(), 1u);
    ASSERT_EQ(attic.scenes.size(), 1u);
    EXPECT_EQ(attic.scenes[0].scenes, (std::vector<std::string>{"Attic/50%", "Hall", "House"}));
    EXPECT_EQ(attic.scenes[0].scene, 0u);
    EXPECT_TRUE(attic.scenes[0].asked);
    const auto tells = [](const OpenedScene& opened, const std::string& text) {
        return std::ranges::any_of(opened.notices, [&](const Notice& notice) {
            return notice.message.find(text) != std::string::npos;
        });
    };
    EXPECT_TRUE(tells(attic, "\"Attic/50%\" is shown, not \"Hall\" and \"House\""));
    // Pictures outside the folder are asked for by the file, whichever of its scenes is shown.
    EXPECT_EQ(outsidePictures(attic.document).models, std::vector<std::string>{file});

    const std::filesystem::path project = m_folder / "attic.patina";
    ASSERT_TRUE(saveProject(m_worker, attic.document, project).ok());
    const OpenedScene again = open(project.string());
    ASSERT_EQ(again.document.meshes.size(), 1u);
    EXPECT_EQ(again.document.meshes[0].source, attic.document.meshes[0].source);
    EXPECT_EQ(again.document.meshes[0].mesh->triangleCount(), 1u);

    // The file has lost that scene: the project says so, and opens.
    m_folder.write("rooms/house.dae", scenesDocument({"Hall", "House"}));
    EXPECT_TRUE(tells(open(project.string()), "no visual scene \"Attic/50%\""));
    const Result<OpenedScene> gone = openScene(m_worker, attic.document.meshes[0].source);
    ASSERT_FALSE(gone.ok());
    EXPECT_EQ(gone.error().kind, ErrorKind::Usage);
}

TEST_F(SceneFixture, VisualScenesWithoutNamesOfTheirOwnHaveTitles) {
    std::string text = scenesDocument({"Room", "Room", "Room"});
    const std::string id = "<visual_scene id=\"s1\" ";
    text.replace(text.find(id), id.size(), "<visual_scene ");
    const std::string file = m_folder.write("rooms/rooms.dae", text).string();
    const OpenedScene opened = open(file);
    ASSERT_EQ(opened.scenes.size(), 1u);
    EXPECT_EQ(opened.scenes[0].scenes, (std::vector<std::string>{"s0", "scene 2", "s2"}));
    EXPECT_EQ(open(formatSceneSource({file, "scene 2"})).document.meshes.size(), 2u);
}
