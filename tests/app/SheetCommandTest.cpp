// patina sheet on built-in scenes.
#include "CommandsFixture.h"
#include "core/base/AtomicFile.h"
#include "core/edit/EditSession.h"
#include "core/light/Light.h"
#include "core/scene/DocumentIO.h"
#include "core/scene/Scene.h"

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <set>

using namespace patina;
using namespace patina::test;
using testing::AnyOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

namespace {

class Sheets : public Commands {
  protected:
    Outcome sheet(const std::string& scene, const std::vector<std::string>& more,
                  const std::string& name = "sheet.png", const RunOptions& options = {}) {
        std::vector<std::string> arguments{"sheet", scene, "-o", m_folder / name, "--json"};
        const auto has = [&](const char* option) { return std::ranges::count(more, option) > 0; };
        if (!has("--samples") && !has("whitted"))
            arguments.insert(arguments.end(), {"--samples", "1"});
        if (!has("--size"))
            arguments.insert(arguments.end(), {"--size", "40x30"});
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runPatina(arguments, options);
    }
    Image picture(const std::string& scene, const std::vector<std::string>& more,
                  const std::string& name = "single.png") {
        std::vector<std::string> arguments{"render",        scene,    "-o",
                                           m_folder / name, "--size", "40x30"};
        const auto has = [&](const char* option) { return std::ranges::count(more, option) > 0; };
        if (!has("--samples") && !has("whitted"))
            arguments.insert(arguments.end(), {"--samples", "1"});
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = runPatina(arguments);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return load(m_folder / name);
    }
    // What stands in a cell's rectangle.
    static Image cellOf(const Image& sheet, const nlohmann::json& cell) {
        const std::vector<int> place = cell["rectangle"];
        Image result(place[2], place[3], 3, PixelType::U8, ColorEncoding::Srgb);
        for (int y = 0; y < place[3]; ++y)
            for (int x = 0; x < place[2]; ++x)
                for (int c = 0; c < 3; ++c)
                    result.u8()[static_cast<std::size_t>((y * place[2] + x) * 3 + c)] =
                        sheet.u8()[static_cast<std::size_t>(
                            ((y + place[1]) * sheet.width() + x + place[0]) * sheet.channels() +
                            c)];
        return result;
    }
    static std::vector<std::uint8_t> bytes(const Image& image) {
        return {image.u8().begin(), image.u8().end()};
    }
    // A lat-long of one colour.
    std::string skyFile(const std::string& name, float red) {
        Image image(32, 16, 3, PixelType::F32, ColorEncoding::Linear);
        for (std::size_t i = 0; i < image.f32().size(); ++i)
            image.f32()[i] = i % 3 == 0 ? red : 0.4f;
        const Result<void> saved = saveImage(m_worker, image, m_folder / name);
        EXPECT_TRUE(saved.ok());
        return m_folder / name;
    }
};

TEST_F(Sheets, EachCellIsWhatRenderDraws) {
    const std::string warm = skyFile("warm.exr", 1.0f);
    const std::vector<std::string> shared{
        "--tone-map", "agx",      "--exposure", "0.5",   "--background",
        "blurred",    "--camera", "40,25",      "--set", "environment.rotationDeg=30"};
    std::vector<std::string> arguments{"--environments", "builtin:studio", warm, "--wedge",
                                       "material.perceptualRoughness=0.1:0.7:2"};
    arguments.insert(arguments.end(), shared.begin(), shared.end());
    const Outcome outcome = sheet("builtin:shader-ball", arguments);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const nlohmann::json json = outcome.json();
    EXPECT_EQ(json["columns"]["title"], "Environment");
    EXPECT_EQ(json["columns"]["captions"], nlohmann::json({"Studio", "warm"}));
    EXPECT_EQ(json["rows"]["title"], "Roughness of all materials");
    EXPECT_EQ(json["rows"]["captions"], nlohmann::json({"0.1", "0.7"}));
    EXPECT_THAT(json["outputs"], ElementsAre(m_folder / "sheet.png"));
    ASSERT_EQ(json["cells"].size(), 4u);
    const Image whole = load(m_folder / "sheet.png");
    const std::string environments[] = {"builtin:studio", warm};
    const char* roughness[] = {"0.1", "0.7"};
    for (const nlohmann::json& cell : json["cells"]) {
        const std::size_t column = cell["column"], row = cell["row"];
        EXPECT_GE(cell["seconds"], 0.0);
        std::vector<std::string> single = shared;
        single.insert(single.end(),
                      {"--environment", environments[column], "--set",
                       std::string("material.perceptualRoughness=") + roughness[row]});
        EXPECT_EQ(bytes(cellOf(whole, cell)), bytes(picture("builtin:shader-ball", single)))
            << cell.dump();
    }
}

TEST_F(Sheets, MaterialsLightingModesAndAFieldOfView) {
    const auto check = [&](const std::vector<std::string>& arguments,
                           const std::vector<std::vector<std::string>>& singles) {
        const Outcome outcome = sheet("builtin:shader-ball", arguments);
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        const nlohmann::json cells = outcome.json()["cells"];
        ASSERT_EQ(cells.size(), singles.size());
        const Image whole = load(m_folder / "sheet.png");
        for (std::size_t i = 0; i < singles.size(); ++i)
            EXPECT_EQ(bytes(cellOf(whole, cells[i])),
                      bytes(picture("builtin:shader-ball", singles[i])))
                << i;
    };
    const nlohmann::json info = runPatina({"info", "builtin:shader-ball", "--json"}).json();
    const std::string material = info["materials"][0]["name"], other = info["materials"][1]["name"];
    check({"--materials", material, other, "--lightings", "ibl", "cosine"},
          {{"--set", "mesh.material=" + material},
           {"--set", "mesh.material=" + other},
           {"--set", "mesh.material=" + material, "--lighting", "cosine"},
           {"--set", "mesh.material=" + other, "--lighting", "cosine"}});
    // The scene fills the picture whatever the camera's field of view.
    check({"--wedge", "view.fovDeg=20:60:2", "--environment", "builtin:sunset"},
          {{"--fov", "20", "--environment", "builtin:sunset"},
           {"--fov", "60", "--environment", "builtin:sunset"}});
    // A sky for each cell.
    check({"--wedge", "environment.skySunElevationDeg=10:70:2", "--set", "environment.kind=sky"},
          {{"--set", "environment.kind=sky", "--set", "environment.skySunElevationDeg=10"},
           {"--set", "environment.kind=sky", "--set", "environment.skySunElevationDeg=70"}});
}

TEST_F(Sheets, RadiosityIsSolvedForEachCell) {
    const std::vector<std::string> lit{"--lighting", "radiosity",
                                       "--set",      "view.radiosityArea=0.05",
                                       "--set",      "environment.enabled=true"};
    std::vector<std::string> arguments{"--wedge", "environment.exposureEv=0:1:2"};
    arguments.insert(arguments.end(), lit.begin(), lit.end());
    const Outcome outcome = sheet("builtin:cornell-reference", arguments);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const nlohmann::json cells = outcome.json()["cells"];
    ASSERT_EQ(cells.size(), 2u);
    const Image whole = load(m_folder / "sheet.png");
    for (int ev = 0; ev < 2; ++ev) {
        std::vector<std::string> alone = lit;
        alone.insert(alone.end(), {"--set", "environment.exposureEv=" + std::to_string(ev)});
        EXPECT_EQ(bytes(cellOf(whole, cells[static_cast<std::size_t>(ev)])),
                  bytes(picture("builtin:cornell-reference", alone)))
            << ev;
    }
    EXPECT_NE(bytes(cellOf(whole, cells[0])), bytes(cellOf(whole, cells[1])));
}

TEST_F(Sheets, BuiltInMaterialsAreEachTheirOwn) {
    const Outcome outcome = sheet("builtin:sphere", {"--materials", "gold", "builtin:ceramic",
                                                     "wood", "--no-captions", "--columns", "2"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const nlohmann::json cells = outcome.json()["cells"];
    const Image whole = load(m_folder / "sheet.png");
    EXPECT_EQ(whole.width(), 2 * 40 + 3) << "pictures and the gap between them";
    EXPECT_EQ(whole.height(), 2 * 30 + 3);
    EXPECT_EQ(cells[0]["rectangle"], nlohmann::json({0, 0, 40, 30}));
    EXPECT_EQ(cells[2]["rectangle"], nlohmann::json({0, 33, 40, 30}));
    std::set<std::vector<std::uint8_t>> pictures;
    for (const nlohmann::json& cell : cells)
        pictures.insert(bytes(cellOf(whole, cell)));
    EXPECT_EQ(pictures.size(), 3u);
}

TEST_F(Sheets, AnExrHasALinearPartForEachCell) {
    const Outcome outcome = sheet("builtin:sphere",
                                  {"--environments", "builtin:studio", "builtin:studio", "--wedge",
                                   "material.metallic=0:1:2", "--tone-map", "reinhard"},
                                  "sheet.exr");
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const nlohmann::json cells = outcome.json()["cells"];
    ASSERT_EQ(cells.size(), 4u);
    EXPECT_EQ(cells[0]["part"], "Studio, 0");
    EXPECT_EQ(cells[1]["part"], "Studio (2), 0");
    ImageLoadOptions all;
    all.allParts = true;
    const Result<LoadedImage> file = loadImage(m_worker, m_folder / "sheet.exr", all);
    ASSERT_TRUE(file.ok());
    ASSERT_EQ(file->parts.size(), 4u);
    const Image single = picture("builtin:sphere",
                                 {"--environment", "builtin:studio", "--set", "material.metallic=1",
                                  "--tone-map", "reinhard"},
                                 "single.exr");
    for (const ImagePart& part : file->parts)
        if (part.name == "Studio, 1") {
            ASSERT_EQ(part.image.f32().size(), single.f32().size());
            EXPECT_TRUE(std::ranges::equal(part.image.f32(), single.f32()));
        }
}

TEST_F(Sheets, BrokenEnvironmentsAreNamedOrSkipped) {
    const std::string good = skyFile("good.exr", 0.8f), broken = m_folder / "broken.hdr",
                      missing = m_folder / "missing.hdr";
    writeBytes(broken, "#?RADIANCE\nnothing that is a picture");
    const std::vector<std::string> three{"--environments", good, broken, missing};
    const Outcome refused = sheet("builtin:sphere", three);
    EXPECT_EQ(refused.status, 66);
    EXPECT_THAT(refused.json()["error"]["file"].get<std::string>(), HasSubstr("missing.hdr"));
    EXPECT_THAT(refused.err + refused.out, HasSubstr("--skip-broken"));
    const Outcome damaged = sheet("builtin:sphere", {"--environments", good, broken});
    EXPECT_THAT(damaged.status, AnyOf(65, 66));
    EXPECT_THAT(damaged.out, HasSubstr("broken.hdr"));
    EXPECT_FALSE(std::filesystem::exists(m_folder / "sheet.png"));

    std::vector<std::string> skipping = three;
    skipping.emplace_back("--skip-broken");
    const Outcome outcome = sheet("builtin:sphere", skipping);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const nlohmann::json json = outcome.json();
    ASSERT_EQ(json["broken"].size(), 2u);
    EXPECT_EQ(json["broken"][0]["file"], broken);
    EXPECT_EQ(json["warnings"].size(), 2u);
    EXPECT_FALSE(json["cells"][0].contains("problem"));
    EXPECT_TRUE(json["cells"][1].contains("problem"));
    const Image whole = load(m_folder / "sheet.png");
    EXPECT_EQ(bytes(cellOf(whole, json["cells"][0])),
              bytes(picture("builtin:sphere", {"--environment", good})));

    const Outcome none = sheet("builtin:sphere", {"--environments", missing, "--skip-broken"});
    EXPECT_EQ(none.status, 65);
    EXPECT_THAT(none.out, HasSubstr("none of the environments"));
}

TEST_F(Sheets, WrongOnesAreRefusedBeforeAnythingIsDrawn) {
    const std::vector<std::pair<std::vector<std::string>, const char*>> cases{
        {{"--materials", "gold", "marzipan"}, "there is no material \\\"marzipan\\\""},
        {{"--materials", "gold", "--meshes", "Nobody"}, "Nobody"},
        {{"--meshes", "Sphere", "--wedge", "view.exposureEv=0:1:2"}, "--materials"},
        {{"--lightings", "ibl", "sunny"}, "shIrradiance"},
        {{"--lightings", "ibl", "prt"}, "patina bake prt"},
        {{"--wedge", "material.roughness"}, "NAME=FROM:TO:COUNT"},
        {{"--wedge", "material.baseColor=0:1:3"}, "a wedge is of numbers"},
        {{"--wedge", "material.metallic=0:3:3"}, "from 0 to 1"},
        {{"--wedge", "light[Sun].intensity=0:3:3"}, "the scene has no light"},
        {{"--wedge", "material[Nobody].metallic=0:1:3"}, "Nobody"},
        {{"--wedge", "view.exposureEv=0:1:9", "--wedge", "material.metallic=0:1:2"}, "9 × 2"},
        {{"--wedge", "view.exposureEv=0:1:2", "--wedge", "view.exposureEv=0:1:3"}, "both set"},
        {{"--wedge", "view.exposureEv=0:1:2", "--wedge", "material.metallic=0:1:2", "--materials",
          "gold"},
         "one or two things"},
        {{"--wedge", "view.exposureEv=0:1:8", "--size", "8000x100"}, "at most 16384"},
        {{"--wedge", "view.exposureEv=0:1:2", "--columns", "9"}, "--columns"},
        {{"--wedge", "view.exposureEv=0:1:2", "--wedge", "material.metallic=0:1:2", "--columns",
          "2"},
         "--columns"},
        {{"--environments", "builtin:studio", "--environment", "builtin:sunset"},
         "--environment has no effect"},
        {{"--lightings", "ibl", "--lighting", "ibl"}, "--lighting has no effect"},
        {{"--wedge", "view.exposureEv=0:1:2", "--skip-broken"}, "--environments"}};
    for (const auto& [arguments, hint] : cases) {
        const Outcome outcome = sheet("builtin:sphere", arguments);
        EXPECT_EQ(outcome.status, 2) << testing::PrintToString(arguments);
        EXPECT_THAT(outcome.out, HasSubstr(hint)) << testing::PrintToString(arguments);
    }
    const std::vector<std::string> wedge{"--wedge", "view.exposureEv=0:1:2"};
    EXPECT_EQ(sheet("builtin:sphere", wedge, "sheet.hdr").status, 2);
    EXPECT_EQ(sheet("builtin:sphere", wedge, "sheet.pdf").status, 2);
    EXPECT_EQ(sheet("builtin:sphere", wedge, "none/sheet.png").status, 73);
    EXPECT_THAT(m_folder.files(), IsEmpty());
    const Outcome idle = sheet("builtin:sphere", {"--wedge", "view.displayGamma=1:3:2"});
    EXPECT_EQ(idle.status, 0) << idle.err;
    EXPECT_THAT(idle.json()["warnings"][0].get<std::string>(),
                HasSubstr("--wedge view.displayGamma has no effect"));
}

// A project with two looks, its own being a third.
TEST_F(Sheets, SnapshotsAreWhatTheProjectLookedLike) {
    EditSession session;
    session.replace(startDocument());
    const Target material{Scope::Material, session.document().meshes.front().material};
    const auto project = [&](const std::string& name) {
        const std::string file = m_folder / name;
        EXPECT_TRUE(writeFileAtomically(file, documentToJson(session.document(), file)).ok());
        return file;
    };
    session.setParameter(parameter("material.metallic"), material, 1.0f);
    session.setParameter(parameter("view.toneMap"), {Scope::View, 0}, 6);
    const std::string metal = project("metal.patina");
    session.keepSnapshot("Metal", nullptr);
    session.setParameter(parameter("environment.rotationDeg"), {Scope::Environment, 0}, 90.0f);
    session.setParameter(parameter("view.exposureEv"), {Scope::View, 0}, -1.0f);
    session.addLight(LightType::Directional);
    const std::string dark = project("dark.patina");
    session.keepSnapshot("Dark", nullptr);
    session.setParameter(parameter("material.baseColor"), material, glm::vec3(0.1f, 0.2f, 0.9f));
    session.setParameter(parameter("environment.image"), {Scope::Environment, 0}, [] {
        MapSlot slot;
        slot.source = "builtin:sunset";
        return slot;
    }());
    const std::string file = project("looks.patina");

    const Outcome outcome = sheet(file, {"--snapshots", "Dark", "Metal"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.json()["columns"]["title"], "Snapshot");
    EXPECT_EQ(outcome.json()["columns"]["captions"], nlohmann::json({"Dark", "Metal"}));
    const Image whole = load(m_folder / "sheet.png");
    for (const nlohmann::json& cell : outcome.json()["cells"]) {
        SCOPED_TRACE(cell.dump());
        const Image single = picture(cell["column"] == 0 ? dark : metal, {});
        EXPECT_EQ(bytes(cellOf(whole, cell)), bytes(single));
    }

    const Outcome unknown = sheet(file, {"--snapshots", "Bright"});
    EXPECT_EQ(unknown.status, 2);
    EXPECT_THAT(unknown.out, HasSubstr("\\\"Metal\\\", \\\"Dark\\\""));
    EXPECT_EQ(sheet("builtin:sphere", {"--snapshots", "Metal"}).status, 2);
    EXPECT_EQ(sheet(file, {"--snapshots"}).status, 2);
}

// A sheet of all renderers, in two environments: what `patina render` writes of each cell, without
// OpenGL.
TEST_F(Sheets, TracedCellsAreWhatRenderTraces) {
    const std::string warm = skyFile("warm.exr", 1.0f);
    const std::vector<std::vector<std::string>> renderers{
        {"--renderer", "path", "--samples", "3", "--seed", "7", "--max-bounces", "2"},
        {"--renderer", "whitted"},
        {"--renderer", "whitted", "--soft-shadows", "--samples", "2"}};
    for (const std::vector<std::string>& renderer : renderers) {
        SCOPED_TRACE(testing::PrintToString(renderer));
        std::vector<std::string> shared = renderer;
        shared.insert(shared.end(), {"--exposure", "0.5", "--background", "blurred"});
        std::vector<std::string> arguments = shared;
        arguments.insert(arguments.end(), {"--environments", "builtin:studio", warm, "--wedge",
                                           "material.perceptualRoughness=0.1:0.7:2"});
        RunOptions noOpenGl;
        noOpenGl.environment = {{"__EGL_VENDOR_LIBRARY_FILENAMES", "/nowhere/egl.json"}};
        const Outcome outcome = sheet("builtin:shader-ball", arguments, "sheet.png", noOpenGl);
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        const nlohmann::json json = outcome.json();
        EXPECT_EQ(json["settings"]["renderer"], renderer[1]);
        ASSERT_EQ(json["cells"].size(), 4u);
        const Image whole = load(m_folder / "sheet.png");
        const std::string environments[] = {"builtin:studio", warm};
        const char* roughness[] = {"0.1", "0.7"};
        for (const nlohmann::json& cell : json["cells"]) {
            const std::size_t column = cell["column"], row = cell["row"];
            EXPECT_EQ(cell["samples"], json["settings"]["samples"]);
            std::vector<std::string> single = shared;
            single.insert(single.end(),
                          {"--environment", environments[column], "--set",
                           std::string("material.perceptualRoughness=") + roughness[row]});
            EXPECT_EQ(bytes(cellOf(whole, cell)), bytes(picture("builtin:shader-ball", single)))
                << cell.dump();
        }
    }
}

TEST_F(Sheets, TracedOnesAreTheSameForAnyNumberOfThreads) {
    const auto traced = [&](const char* threads, const std::string& name) {
        const Outcome outcome = sheet("builtin:sphere",
                                      {"--wedge", "material.metallic=0:1:3", "--renderer", "path",
                                       "--samples", "4", "--threads", threads},
                                      name);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return *readFile(m_folder / name, std::size_t{1} << 24);
    };
    for (const char* ending : {".png", ".exr"}) {
        const Bytes one = traced("1", std::string("one") + ending);
        EXPECT_EQ(one, traced("3", std::string("three") + ending)) << ending;
    }
    ImageLoadOptions all;
    all.allParts = true;
    const Result<LoadedImage> file = loadImage(m_worker, m_folder / "one.exr", all);
    ASSERT_TRUE(file.ok());
    ASSERT_EQ(file->parts.size(), 3u);
    for (const ImagePart& part : file->parts) {
        EXPECT_EQ(part.attributes.at("patina:renderer"), "path");
        EXPECT_EQ(part.attributes.at("patina:render.samplesDone"), "4");
    }
}

// The caption is pixels: sheets that differ in it alone differ above their cells.
TEST_F(Sheets, TheCaptionSaysHowCellsAreTraced) {
    const auto head = [&](const std::vector<std::string>& renderer) {
        std::vector<std::string> arguments{"--wedge", "view.exposureEv=0:1:2", "--size", "320x24"};
        arguments.insert(arguments.end(), renderer.begin(), renderer.end());
        const Outcome outcome = sheet("builtin:plane", arguments);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        const Image whole = load(m_folder / "sheet.png");
        const int rows = outcome.json()["cells"][0]["rectangle"][1];
        const auto width = static_cast<std::size_t>(whole.width() * whole.channels());
        return std::vector<std::uint8_t>(
            whole.u8().begin(),
            whole.u8().begin() + static_cast<std::ptrdiff_t>(width * std::size_t(rows)));
    };
    const auto drawn = head({}), one = head({"--renderer", "path", "--samples", "1"}),
               two = head({"--renderer", "path", "--samples", "2"}),
               whitted = head({"--renderer", "whitted"});
    EXPECT_NE(drawn, one);
    EXPECT_NE(one, two);
    EXPECT_NE(one, whitted);
    EXPECT_NE(drawn, whitted);
}

TEST_F(Sheets, NoiseEndsACellEarlyOrIsWarnedOf) {
    const std::vector<std::string> wedge{"--wedge", "material.metallic=0:1:2", "--renderer",
                                         "path"};
    std::vector<std::string> easy = wedge, hard = wedge;
    easy.insert(easy.end(), {"--noise", "50", "--samples", "512"});
    hard.insert(hard.end(), {"--noise", "0.001", "--samples", "2"});
    const Outcome early = sheet("builtin:sphere", easy);
    ASSERT_EQ(early.status, 0) << early.err;
    for (const nlohmann::json& cell : early.json()["cells"]) {
        EXPECT_LT(cell["samples"], 512);
        EXPECT_LE(cell["noisePercent"], 50.0);
    }
    const Outcome late = sheet("builtin:sphere", hard);
    ASSERT_EQ(late.status, 0) << late.err;
    EXPECT_EQ(late.json()["warnings"].size(), 2u);
    EXPECT_THAT(late.json()["warnings"][0].get<std::string>(), HasSubstr("not yet the 0.001 %"));
}

TEST_F(Sheets, WhatRaysDoNotHaveIsRefused) {
    const std::vector<std::pair<std::vector<std::string>, const char*>> cases{
        {{"--samples", "3"}, "--samples wants 1, 2, 4, 8 or 16"},
        {{"--seed", "1"}, "--seed is for --renderer path and whitted"},
        {{"--noise", "1"}, "--noise is for --renderer path and whitted"},
        {{"--keep-partial"}, "--keep-partial is for --renderer path and whitted"},
        {{"--gloss"}, "--gloss is for --renderer whitted"},
        {{"--renderer", "path", "--gloss"}, "--gloss is for --renderer whitted"},
        {{"--renderer", "path", "--lighting", "cosine"}, "--lighting is for --renderer raster"},
        {{"--renderer", "path", "--lightings", "ibl"}, "--lightings is for --renderer raster"},
        {{"--renderer", "whitted", "--samples", "4"}, "--samples is for --soft-shadows"},
        {{"--renderer", "whitted", "--seed", "4"}, "--seed is for --soft-shadows"},
        {{"--renderer", "path", "--tone-map", "openColorIo"}, "OpenColorIO"},
        {{"--renderer", "radiosity"}, "raster"}};
    for (const auto& [arguments, hint] : cases) {
        std::vector<std::string> all = arguments;
        if (std::ranges::count(all, "--lightings") == 0)
            all.insert(all.end(), {"--wedge", "view.exposureEv=0:1:2"});
        const Outcome outcome = sheet("builtin:sphere", all);
        EXPECT_EQ(outcome.status, 2) << testing::PrintToString(arguments);
        EXPECT_THAT(outcome.out, HasSubstr(hint)) << testing::PrintToString(arguments);
    }
    EXPECT_THAT(m_folder.files(), IsEmpty());
}

TEST_F(Sheets, ASignalKeepsWhatIsTracedWhereThatIsAskedFor) {
    const auto interrupted = [&](bool keeps) {
        RunOptions options;
        options.signal = SIGINT;
        options.signalWhen = "[1-9]\\d? %"; // the first cell is done then
        std::vector<std::string> arguments{"sheet",
                                           "builtin:shader-ball",
                                           "-o",
                                           m_folder / "x.png",
                                           "--json",
                                           "--size",
                                           "64x48",
                                           "--wedge",
                                           "material.metallic=0:1:8",
                                           "--wedge",
                                           "material.perceptualRoughness=0:1:8",
                                           "--renderer",
                                           "path",
                                           "--samples",
                                           "64"};
        if (keeps)
            arguments.emplace_back("--keep-partial");
        return runPatina(arguments, options);
    };
    const Outcome nothing = interrupted(false);
    EXPECT_EQ(nothing.status, 130) << nothing.err;
    EXPECT_THAT(m_folder.files(), IsEmpty());
    const Outcome some = interrupted(true);
    EXPECT_EQ(some.status, 130) << some.err;
    EXPECT_THAT(some.out, HasSubstr("what had converged was written"));
    EXPECT_EQ(m_folder.files().size(), 1u);
    const nlohmann::json cells = some.json()["cells"];
    ASSERT_EQ(cells.size(), 64u);
    EXPECT_GT(cells.front()["samples"], 0);
    EXPECT_EQ(cells.back()["problem"], "stopped before it was traced");
}

TEST_F(Sheets, ASignalLeavesNothing) {
    RunOptions options;
    options.signal = SIGINT;
    options.signalWhen = "%";
    const Outcome outcome = runPatina(
        {"sheet", "builtin:shader-ball", "-o", m_folder / "x.png", "--json", "--size", "640x480",
         "--wedge", "material.metallic=0:1:8", "--wedge", "material.perceptualRoughness=0:1:8"},
        options);
    EXPECT_EQ(outcome.status, 130) << outcome.err;
    EXPECT_EQ(outcome.json()["error"]["kind"], "cancelled");
    EXPECT_THAT(m_folder.files(), IsEmpty());
}

} // namespace
