// The commands themselves, on built-in scenes.
#include "CommandRunner.h"
#include "core/document/View.h"
#include "core/io/ImageIO.h"
#include "core/worker/WorkerClient.h"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <gmock/gmock.h>
#include <set>

using namespace patina;
using namespace patina::test;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

namespace {

// The program's own decoder, beside it in $PATINA_BIN_DIR.
class Commands : public testing::Test {
  protected:
    Image load(const std::string& file) {
        Result<LoadedImage> image = loadImage(m_worker, file);
        EXPECT_TRUE(image.ok()) << image.error().text();
        return image->image();
    }
    void save(const std::string& file, int width, int height, int channels,
              const std::vector<int>& values) {
        Image image(width, height, channels, PixelType::U8, ColorEncoding::Srgb);
        for (std::size_t i = 0; i < image.u8().size(); ++i)
            image.u8()[i] = static_cast<std::uint8_t>(values[i % values.size()]);
        const Result<void> saved = saveImage(m_worker, image, file);
        EXPECT_TRUE(saved.ok());
    }

    TemporaryFolder m_folder;
    WorkerClient m_worker;
};

} // namespace

TEST_F(Commands, CompareGivesExactNumbers) {
    save(m_folder / "a.png", 2, 1, 3, {255, 0, 0, 10, 20, 30});
    save(m_folder / "b.png", 2, 1, 3, {0, 0, 0, 10, 20, 30});
    const Outcome outcome = runPatina(
        {"compare", m_folder / "a.png", m_folder / "b.png", "--json", "-o", m_folder / "d.png"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    nlohmann::json json = outcome.json();
    EXPECT_EQ(json["command"], "compare");
    EXPECT_NEAR(json["rmse"].get<double>(), std::sqrt(1.0 / 6), 1e-9);
    EXPECT_NEAR(json["psnr"].get<double>(), 10 * std::log10(6.0), 1e-9);
    EXPECT_NEAR(json["relmse"].get<double>(), 1 / 0.01 / 6, 1e-9);
    EXPECT_EQ(json["max"], 1.0);
    EXPECT_EQ(json["samples"], 6);
    EXPECT_EQ(json["different"], 1);
    EXPECT_EQ(json["identical"], false);
    const Image difference = load(m_folder / "d.png");
    EXPECT_THAT(difference.u8(), ElementsAre(255, 0, 0, 0, 0, 0));
}

TEST_F(Commands, CompareSaysThatImagesAreIdentical) {
    save(m_folder / "a.png", 2, 2, 3, {1, 2, 3, 4});
    const Outcome human = runPatina({"compare", m_folder / "a.png", m_folder / "a.png"});
    EXPECT_EQ(human.status, 0);
    EXPECT_THAT(human.out, HasSubstr("rmse    0\n"));
    EXPECT_THAT(human.out, HasSubstr("identical"));
    nlohmann::json json =
        runPatina({"compare", m_folder / "a.png", m_folder / "a.png", "--json"}).json();
    EXPECT_EQ(json["identical"], true);
    EXPECT_TRUE(json["psnr"].is_null());
    save(m_folder / "b.png", 1, 2, 3, {1});
    EXPECT_EQ(runPatina({"compare", m_folder / "a.png", m_folder / "b.png"}).status, 2);
}

TEST_F(Commands, InfoListsTheBuiltins) {
    const Outcome human = runPatina({"info", "builtin:list"});
    EXPECT_THAT(human.out, HasSubstr("\n  builtin:shader-ball  "));
    nlohmann::json json = runPatina({"info", "builtin:list", "--json"}).json();
    for (const char* kind : {"models", "environments", "materials"})
        EXPECT_GE(json["builtin"][kind].size(), 6u) << kind;
}

TEST_F(Commands, InfoTellsWhatAnImageHolds) {
    save(m_folder / "a.png", 3, 2, 4, {1, 2, 3, 4});
    nlohmann::json json = runPatina({"info", m_folder / "a.png", "--json"}).json();
    EXPECT_EQ(json["kind"], "image");
    EXPECT_EQ(json["format"], "png");
    EXPECT_EQ(json["width"], 3);
    EXPECT_EQ(json["height"], 2);
    EXPECT_EQ(json["channels"], 4);
    EXPECT_EQ(json["pixelType"], "uint8");
    EXPECT_GT(json["peakMemoryBytes"].get<double>(), 1e6);
    EXPECT_THAT(runPatina({"info", m_folder / "a.png"}).out, HasSubstr("3 × 2 pixels"));
}

TEST_F(Commands, WhatIsSetInVainIsTold) {
    const auto warnings = [&](const std::vector<std::string>& sets) {
        std::vector<std::string> arguments{"export", "builtin:sphere", "-o", m_folder / "ball.glb",
                                           "--json"};
        for (const std::string& set : sets)
            arguments.insert(arguments.end(), {"--set", set});
        const Outcome exported = runPatina(arguments);
        EXPECT_EQ(exported.status, 0) << exported.err;
        const nlohmann::json json = exported.json();
        return json.contains("warnings") ? json["warnings"].dump() : std::string();
    };
    EXPECT_THAT(warnings({"material.alphaCutoff=0.3"}),
                HasSubstr("material.alphaCutoff has no effect: only cut-out materials have it"));
    EXPECT_THAT(warnings({"material.alphaCutoff=0.3", "material.alphaMode=mask"}),
                testing::Not(HasSubstr("no effect")));
    EXPECT_THAT(warnings({"environment.fade=0.5"}), HasSubstr("environment.second"));
}

TEST_F(Commands, ASecondEnvironmentIsSetByNameOrAsTheSecond) {
    const auto environmentOf = [&](const std::vector<std::string>& sets) {
        std::vector<std::string> arguments{
            "environment", "builtin:studio", "-o",    m_folder / "mixed.exr",
            "--layout",    "lat-long",       "--json"};
        for (const std::string& set : sets)
            arguments.insert(arguments.end(), {"--set", set});
        const Outcome written = runPatina(arguments);
        EXPECT_EQ(written.status, 0) << written.err;
        EXPECT_FALSE(written.json().contains("warnings")) << written.out;
    };
    environmentOf({"environment.secondRotationDeg=30", "environment.fade=0.25",
                   "environment.secondImage=builtin:night", "environment[Night].tint=1,0,0"});
    environmentOf({"environment.secondImage=builtin:night", "environment.first=Night"});
    for (const char* wrong :
         {"environment[Nowhere].tint=1,0,0", "environment.first=Nowhere", "environment.first=0",
          "environment[Studio].fade=1", "environment.secondTint=1,0,0"}) {
        const Outcome refused = runPatina(
            {"environment", "builtin:studio", "-o", m_folder / "none.exr", "--set", wrong});
        EXPECT_EQ(refused.status, 2) << wrong;
        EXPECT_FALSE(std::filesystem::exists(m_folder / "none.exr"));
    }
}

TEST_F(Commands, InfoReadsTheExportedModelBack) {
    const Outcome exported =
        runPatina({"export", "builtin:sphere", "-o", m_folder / "ball.glb", "--json", "--set",
                   "material.metallic=0.25", "--set", "material.baseColor=0.5,0.25,0.125"});
    ASSERT_EQ(exported.status, 0) << exported.err;
    EXPECT_THAT(exported.json()["outputs"], ElementsAre(m_folder / "ball.glb"));
    EXPECT_EQ(exported.json()["settings"]["set"]["material.metallic"], "0.25");

    nlohmann::json built = runPatina({"info", "builtin:sphere", "--json"}).json();
    nlohmann::json read = runPatina({"info", m_folder / "ball.glb", "--json"}).json();
    EXPECT_EQ(read["kind"], "model");
    EXPECT_EQ(read["counts"]["triangles"], built["counts"]["triangles"]);
    EXPECT_EQ(read["bounds"], built["bounds"]);
    EXPECT_EQ(read["meshes"][0]["name"], built["meshes"][0]["name"]);
    EXPECT_EQ(read["materials"][0]["metallic"], 0.25);
    EXPECT_EQ(read["materials"][0]["baseColor"], nlohmann::json({0.5, 0.25, 0.125}));
    EXPECT_THAT(runPatina({"info", m_folder / "ball.glb"}).out, HasSubstr("\nMeshes (1)\n"));
}

TEST_F(Commands, RefineWritesAModelThatIsFinerWhereItsShadowsAre) {
    const Outcome refined = runPatina({"refine", "builtin:cornell-box", "-o", m_folder / "fine.glb",
                                       "--rounds", "2", "--samples", "32", "--json"});
    ASSERT_EQ(refined.status, 0) << refined.err;
    nlohmann::json json = refined.json();
    EXPECT_EQ(json["counts"]["rounds"], 2);
    EXPECT_LT(json["error"]["after"], json["error"]["before"]);
    nlohmann::json built = runPatina({"info", "builtin:cornell-box", "--json"}).json();
    nlohmann::json read = runPatina({"info", m_folder / "fine.glb", "--json"}).json();
    EXPECT_EQ(json["counts"]["trianglesBefore"], built["counts"]["triangles"]);
    EXPECT_EQ(json["counts"]["triangles"], read["counts"]["triangles"]);
    EXPECT_GT(read["counts"]["triangles"], built["counts"]["triangles"]);
    EXPECT_EQ(read["bounds"], built["bounds"]);
    EXPECT_EQ(read["counts"]["meshes"], built["counts"]["meshes"]);
    EXPECT_EQ(runPatina({"refine", "builtin:sphere", "-o", m_folder / "fine.obj"}).status, 2);
    // Where nothing is done, it says why.
    const Outcome nothing = runPatina({"refine", "builtin:sphere", "-o", m_folder / "same.glb",
                                       "--tolerance", "0.5", "--samples", "32", "--json"});
    EXPECT_EQ(nothing.json()["counts"]["rounds"], 0);
    EXPECT_THAT(nothing.json()["warnings"].dump(), HasSubstr("a smaller --tolerance"));
}

TEST_F(Commands, ExportPlansWithoutWriting) {
    const Outcome outcome = runPatina(
        {"export", "builtin:sphere", "-o", m_folder / "ball.gltf", "--dry-run", "--json"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(m_folder.files(), IsEmpty());
    EXPECT_EQ(outcome.json()["files"][1]["path"], m_folder / "ball.bin");
}

TEST_F(Commands, ExportTakesHiddenMeshesAlongWhenAsked) {
    const auto plan = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments = {
            "export", "builtin:sphere",     "-o",     m_folder / "ball.glb",
            "--set",  "mesh.visible=false", "--json", "--dry-run"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runPatina(arguments);
    };
    const Outcome nothing = plan({});
    EXPECT_EQ(nothing.status, 2);
    EXPECT_THAT(nothing.err, HasSubstr("make at least one mesh visible"));
    const Outcome hidden = plan({"--hidden"});
    EXPECT_EQ(hidden.status, 0) << hidden.err;
    EXPECT_EQ(hidden.json()["settings"]["hidden"], true);
}

TEST_F(Commands, ExportTakesTheEnvironmentAlongWhenAsked) {
    const auto plan = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments = {
            "export", "builtin:plane", "-o", m_folder / "plane.glb", "--json", "--dry-run"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runPatina(arguments).json();
    };
    const auto holdsIt = [&](const nlohmann::json& json) {
        return json["files"].back()["path"] == (m_folder / "plane.glb") + "#environment";
    };
    EXPECT_FALSE(holdsIt(plan({})));
    EXPECT_TRUE(holdsIt(plan({"--environment-light"})));
    const nlohmann::json other = plan({"--environment", "builtin:night"});
    EXPECT_TRUE(holdsIt(other));
    EXPECT_EQ(other["settings"]["environmentLight"], true);
    EXPECT_EQ(runPatina({"export", "builtin:plane", "-o", m_folder / "plane.glb", "--environment",
                         m_folder / "missing.hdr"})
                  .status,
              66);
    EXPECT_THAT(m_folder.files(), IsEmpty());
}

TEST_F(Commands, RenderDrawsTheSphereOnTransparency) {
    const Outcome outcome =
        runPatina({"render", "builtin:sphere", "-o", m_folder / "ball.png", "--size", "96x64",
                   "--background", "transparent", "--environment", "builtin:white", "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    nlohmann::json json = outcome.json();
    EXPECT_EQ(json["settings"]["size"], nlohmann::json({96, 64}));
    EXPECT_EQ(json["settings"]["environment"], "builtin:white");
    EXPECT_GT(json["counts"]["triangles"], 100);
    EXPECT_GT(json["seconds"], 0.0);
    const Image image = load(m_folder / "ball.png");
    ASSERT_EQ(image.width(), 96);
    ASSERT_EQ(image.height(), 64);
    ASSERT_EQ(image.channels(), 4);
    EXPECT_EQ(image.sample(48, 32, 3), 1.0f); // the ball
    EXPECT_GT(image.sample(48, 32, 1), 0.2f);
    for (const auto& [x, y] : {std::pair{0, 0}, {95, 0}, {0, 63}, {95, 63}})
        EXPECT_EQ(image.sample(x, y, 3), 0.0f);
}

TEST_F(Commands, RenderLightsWithAGeneratedEnvironment) {
    const auto render = [&](const char* name, std::initializer_list<std::string> sets) {
        std::vector<std::string> arguments{"render", "builtin:sphere", "-o",    m_folder / name,
                                           "--size", "32x32",          "--json"};
        for (const std::string& set : sets)
            arguments.insert(arguments.end(), {"--set", set});
        const Outcome outcome = runPatina(arguments);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return outcome.json()["settings"]["environment"].get<std::string>();
    };
    EXPECT_EQ(render("left.exr", {"environment.kind=sky", "environment.skySunAzimuthDeg=-60",
                                  "environment.background=off"}),
              "sky");
    EXPECT_EQ(render("right.exr", {"environment.skySunAzimuthDeg=120", "environment.kind=sky",
                                   "environment.background=off"}),
              "sky");
    // The camera stands at azimuth 30°: the suns are 90° to its left and to its right.
    const Image left = load(m_folder / "left.exr"), right = load(m_folder / "right.exr");
    EXPECT_GT(left.linear(10, 14).g, 1.5f * left.linear(21, 14).g);
    EXPECT_GT(right.linear(21, 14).g, 1.5f * right.linear(10, 14).g);
    EXPECT_EQ(left.linear(0, 0).a, 0.0f);
    // An image given by name ends the sky's reign.
    EXPECT_EQ(render("white.exr", {"environment.kind=sky", "environment.image=builtin:white"}),
              "builtin:white");
    EXPECT_EQ(load(m_folder / "white.exr").linear(0, 0).r, 1.0f);
}

TEST_F(Commands, RenderExplainsAPixel) {
    const std::vector<std::string> scene{
        "render",        "builtin:sphere", "--size",   "48x32",     "--environment",
        "builtin:white", "--tone-map",     "reinhard", "--samples", "1"};
    const auto with = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments = scene;
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runPatina(arguments);
    };
    const Outcome text = with({"--inspect", "24,16"});
    ASSERT_EQ(text.status, 0) << text.err;
    EXPECT_THAT(text.out, HasSubstr("Pixel 24, 16 of 48 × 32"));
    EXPECT_THAT(text.out, HasSubstr("Lₚ · ρs · SO"));
    EXPECT_THAT(text.out, HasSubstr("Tone Curve: Reinhard"));
    EXPECT_THAT(text.out, HasSubstr("these numbers recombine to it within 0."));

    // The same as JSON, with the picture beside it: its pixel is the explained one.
    const Outcome outcome = with({"--inspect", "24,16", "--json", "-o", m_folder / "picture.png"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const nlohmann::json json = outcome.json()["inspection"];
    EXPECT_EQ(json["agrees"], true);
    const nlohmann::json& metallic = json["sections"]["maps"]["steps"]["metallic"]["factors"];
    EXPECT_THAT(metallic["file"].get<std::string>(), HasSubstr("/metallic"));
    // Even light of radiance 1 from everywhere: irradiance pi, and nothing brighter than 1.
    const nlohmann::json& light = json["sections"]["environment"]["values"];
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(light["irradiance"][c].get<float>(), 3.14159f, 0.01f);
        EXPECT_NEAR(light["prefiltered"][c].get<float>(), 1.0f, 0.003f);
        EXPECT_LT(json["sum"][c].get<float>(), 1.0f);
    }
    const Image picture = load(m_folder / "picture.png");
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(json["displayed"][c].get<float>(), picture.sample(24, 16, c), 0.6f / 255.0f);

    const Outcome beside = with({"--inspect", "0,0"});
    ASSERT_EQ(beside.status, 0) << beside.err;
    EXPECT_THAT(beside.out, HasSubstr("Pixel 0, 0 of 48 × 32: background"));
    EXPECT_THAT(beside.out, HasSubstr("Radiance in the Picture"));
}

// The background has the radiance it was given: no tone curve, no rounding to 8 bits.
TEST_F(Commands, RenderFindsLightThatWasKept) {
    std::filesystem::create_directory(m_folder / "light");
    const auto render = [&](const std::string& name, const std::string& cache) {
        RunOptions options;
        options.environment = {{"PATINA_LIGHT_CACHE", cache}};
        const Outcome outcome = runPatina(
            {"render", "builtin:plane", "--size", "24x24", "--samples", "1", "-o", m_folder / name},
            options);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return readBytes(m_folder / name);
    };
    const auto kept = [&] {
        std::set<std::string> files;
        for (const auto& entry : std::filesystem::directory_iterator(m_folder / "light"))
            files.insert(entry.path().filename().string());
        return files;
    };
    const std::string computed = render("none.exr", "");
    EXPECT_THAT(kept(), IsEmpty());
    EXPECT_EQ(render("stored.exr", m_folder / "light"), computed);
    const auto files = kept();
    EXPECT_EQ(files.size(), 1u);
    EXPECT_EQ(render("found.exr", m_folder / "light"), computed);
    EXPECT_EQ(kept(), files);
}

TEST_F(Commands, LightIsKeptWhereTheEditorKeepsIt) {
    const std::string home = m_folder / "home", cache = m_folder / "cache";
    for (const auto& [xdg, folder] :
         {std::pair(std::optional<std::string>(cache), cache + "/Patina/Patina/ibl"),
          std::pair(std::optional<std::string>(), home + "/.cache/Patina/Patina/ibl")}) {
        RunOptions options;
        options.environment = {
            {"PATINA_LIGHT_CACHE", std::nullopt}, {"XDG_CACHE_HOME", xdg}, {"HOME", home}};
        const Outcome outcome = runPatina({"info", "builtin:studio", "--light"}, options);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        ASSERT_TRUE(std::filesystem::is_directory(folder)) << folder;
        EXPECT_FALSE(std::filesystem::is_empty(folder));
    }
}

TEST_F(Commands, RenderWritesLinearFloats) {
    const Outcome outcome =
        runPatina({"render", "builtin:sphere", "-o", m_folder / "a.exr", "--size", "32x32",
                   "--environment", "builtin:white", "--background", "0.5,0.25,1", "--tone-map",
                   "reinhard", "--camera", "180,20,5", "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    nlohmann::json camera = outcome.json()["settings"]["camera"];
    EXPECT_EQ(camera["yawDeg"], 180.0);
    EXPECT_EQ(camera["pitchDeg"], 20.0);
    EXPECT_EQ(camera["distance"], 5.0);
    const Image image = load(m_folder / "a.exr");
    EXPECT_EQ(image.type(), PixelType::F32);
    ASSERT_EQ(image.channels(), 3);
    EXPECT_NEAR(image.sample(0, 0, 0), 0.5f, 1e-3f);
    EXPECT_NEAR(image.sample(0, 0, 1), 0.25f, 1e-3f);
    EXPECT_NEAR(image.sample(0, 0, 2), 1.0f, 1e-3f);
}

TEST_F(Commands, BakesDoNotDependOnTheThreadCount) {
    for (const char* threads : {"1", "2"})
        ASSERT_EQ(runPatina({"bake", "prt", "builtin:rounded-cube", "-o",
                             m_folder / (std::string(threads) + ".exr"), "--samples", "32",
                             "--threads", threads})
                      .status,
                  0);
    EXPECT_EQ(readBytes(m_folder / "1.exr"), readBytes(m_folder / "2.exr"));
}

TEST_F(Commands, BakeReportsItsWorkAndInfoReadsIt) {
    const Outcome outcome = runPatina({"bake", "prt", "builtin:sphere", "-o", m_folder / "p.exr",
                                       "--order", "2", "--samples", "64", "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    nlohmann::json json = outcome.json();
    EXPECT_EQ(json["command"], "bake prt");
    EXPECT_EQ(json["settings"]["order"], 2);
    EXPECT_EQ(json["samplesDone"], 64);
    EXPECT_EQ(json["partial"], false);
    EXPECT_GE(json["rays"].get<double>(), 64.0);
    EXPECT_GT(json["counts"]["vertices"], 100);
    nlohmann::json info = runPatina({"info", m_folder / "p.exr", "--json"}).json();
    EXPECT_EQ(info["kind"], "bake");
    EXPECT_EQ(info["bake"]["kind"], "radiance transfer per vertex");
    EXPECT_EQ(info["bake"]["order"], 2);
    EXPECT_EQ(info["bake"]["transfer"], "shadowed");
    EXPECT_EQ(info["bake"]["storage"], "float");
    EXPECT_EQ(info["bake"]["settings"]["samples"], "64");
    EXPECT_EQ(info["bake"]["parts"][0]["vertices"], json["counts"]["vertices"]);
    EXPECT_EQ(info["bake"]["parts"][0]["bounced"], "none");

    // The bake lights the scene it was made from, and no other.
    EXPECT_EQ(runPatina({"render", "builtin:sphere", "-o", m_folder / "p.png", "--size", "32x32",
                         "--lighting", "prt", "--bake", m_folder / "p.exr"})
                  .status,
              0);
    EXPECT_EQ(runPatina({"render", "builtin:torus-knot", "-o", m_folder / "q.png", "--size",
                         "32x32", "--lighting", "prt", "--bake", m_folder / "p.exr"})
                  .status,
              65);
}

TEST_F(Commands, TexelBakesBecomeOnePictureForEachMaterial) {
    const Outcome one = runPatina({"bake", "ao", "builtin:sphere", "-o", m_folder / "one.png",
                                   "--size", "32", "--samples", "32"});
    ASSERT_EQ(one.status, 0) << one.err;
    EXPECT_THAT(m_folder.files(), ElementsAre("one.png"));
    const Image image = load(m_folder / "one.png");
    EXPECT_EQ(image.width(), 32);
    EXPECT_EQ(image.channels(), 1);

    const Outcome several =
        runPatina({"bake", "ao", "builtin:shader-ball", "-o", m_folder / "ball.png", "--size", "16",
                   "--samples", "32", "--json"});
    ASSERT_EQ(several.status, 0) << several.err;
    EXPECT_GE(several.json()["outputs"].size(), 2u);
    for (const nlohmann::json& file : several.json()["outputs"]) {
        EXPECT_THAT(file.get<std::string>(), HasSubstr("/ball-"));
        EXPECT_THAT(several.err, HasSubstr(file.get<std::string>()));
    }
}

// The light that bounces off a wall has the colour that the wall has in the picture.
TEST_F(Commands, RenderFollowsBouncesOffOtherColors) {
    const std::string repaint = "material[Red].baseColor=0.05,0.08,0.6";
    const auto bake = [&](const std::string& name, std::vector<std::string> more) {
        std::vector<std::string> arguments{
            "bake",      "prt", "builtin:cornell-box", "-o", m_folder / name, "--order", "2",
            "--samples", "32",  "--bounces",           "2"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = runPatina(arguments);
        ASSERT_EQ(outcome.status, 0) << outcome.err;
    };
    const auto render = [&](const std::string& bakeName, const std::string& name) {
        const Outcome outcome = runPatina(
            {"render", "builtin:cornell-box", "-o", m_folder / name, "--size", "64x64", "--samples",
             "1", "--lighting", "prt", "--bake", m_folder / bakeName, "--set", repaint, "--json"});
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return outcome;
    };
    bake("before.exr", {"--bounce-samples", "16"});
    bake("after.exr", {"--bounce-samples", "16", "--set", repaint});
    EXPECT_FALSE(render("after.exr", "wanted.exr").json().contains("warnings"));
    EXPECT_FALSE(render("before.exr", "found.exr").json().contains("warnings"));
    EXPECT_EQ(readBytes(m_folder / "found.exr"), readBytes(m_folder / "wanted.exr"));

    // Between texels light is not followed again: then the picture says so.
    bake("texels.exr", {"--bounce-samples", "16", "--target", "texel", "--size", "16"});
    const Outcome texels = render("texels.exr", "texels-picture.exr");
    EXPECT_THAT(texels.json()["warnings"].dump(), HasSubstr("other colours"));
}

TEST_F(Commands, ABakesPresetSetsWhatIsNotGiven) {
    const auto rays = [&](std::vector<std::string> more) {
        std::vector<std::string> command{"bake",   "ao", "builtin:plane",     "--target",
                                         "vertex", "-o", m_folder / "ao.exr", "--json"};
        command.insert(command.end(), more.begin(), more.end());
        const Outcome run = runPatina(command);
        EXPECT_EQ(run.status, 0) << run.err;
        return run.json().at("samplesDone").get<int>();
    };
    EXPECT_EQ(rays({"--preset", "draft"}), 64);
    EXPECT_EQ(rays({"--preset", "draft", "--samples", "32"}), 32);
    EXPECT_EQ(rays({"--samples", "32", "--preset", "draft"}), 32) << "in any order";
    EXPECT_EQ(rays({}), 256);
    EXPECT_EQ(rays({"--preset", "good"}), 256);
}

// A bake of a scene that was changed since says so.
TEST_F(Commands, RenderWarnsOfStaleBakes) {
    ASSERT_EQ(runPatina({"bake", "ao", "builtin:shader-ball", "--target", "vertex", "-o",
                         m_folder / "ao.exr", "--samples", "32"})
                  .status,
              0);
    nlohmann::json scene = runPatina({"info", "builtin:shader-ball", "--json"}).json();
    const std::string mesh = scene["meshes"][0]["name"];
    const Outcome stale =
        runPatina({"render", "builtin:shader-ball", "-o", m_folder / "x.png", "--size", "32x32",
                   "--samples", "1", "--bake", m_folder / "ao.exr", "--set",
                   "mesh[" + mesh + "].visible=false", "--set", "environment.enabled=false"});
    EXPECT_EQ(stale.status, 0) << stale.err;
    EXPECT_THAT(stale.err, HasSubstr("a bake is stale: “" + mesh + "” was hidden"));
}

// Textures that do not fit into memory together are baked a few at a time: to the same pictures.
TEST_F(Commands, TexturesAreBakedAsMemoryAllows) {
    const std::vector<std::string> common{
        "bake", "ao", "builtin:shader-ball", "--size", "256", "--samples", "32", "--json"};
    const auto bake = [&](const std::string& name, const std::vector<std::string>& more) {
        std::vector<std::string> arguments = common;
        arguments.insert(arguments.end(), {"-o", m_folder / name});
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runPatina(arguments);
    };
    const Outcome whole = bake("a.png", {});
    ASSERT_EQ(whole.status, 0) << whole.err;
    EXPECT_GT(whole.json()["plan"]["outputBytes"], 0);
    const std::size_t count = whole.json()["outputs"].size();
    ASSERT_GE(count, 2u);
    const std::string memory =
        std::to_string(whole.json()["plan"]["memoryBytes"].get<std::uint64_t>() - 1'000'000);
    const Outcome groups = bake("b.png", {"--max-memory", memory});
    ASSERT_EQ(groups.status, 0) << groups.err;
    EXPECT_LT(groups.json()["plan"]["texturesAtOnce"], count);
    EXPECT_THAT(groups.json()["warnings"].dump(), HasSubstr("written as they are finished"));
    ASSERT_EQ(groups.json()["outputs"].size(), count);
    EXPECT_EQ(groups.json()["counts"], whole.json()["counts"]);
    for (std::size_t i = 0; i < count; ++i) {
        const std::string a = whole.json()["outputs"][i], b = groups.json()["outputs"][i];
        EXPECT_EQ(readBytes(a), readBytes(b)) << b;
        EXPECT_NE(a, b);
    }
    // Not even one fits, or a checkpoint is to hold all.
    EXPECT_EQ(bake("c.png", {"--max-memory", "1MiB"}).status, 2);
    EXPECT_EQ(bake("c.png", {"--max-memory", memory, "--resume"}).status, 2);
}

TEST_F(Commands, SignalsStopABakeAndLeaveNothing) {
    for (const auto& [signal, status] : {std::pair{SIGINT, 130}, std::pair{SIGTERM, 143}}) {
        RunOptions options;
        options.signal = signal;
        options.signalWhen = "%";
        const Outcome outcome =
            runPatina({"bake", "ao", "builtin:torus-knot", "--target", "vertex", "-o",
                       m_folder / "x.exr", "--samples", "65536", "--json"},
                      options);
        EXPECT_EQ(outcome.status, status) << outcome.err;
        EXPECT_EQ(outcome.json()["error"]["kind"], "cancelled");
        EXPECT_EQ(outcome.json()["error"]["exitStatus"], status);
        EXPECT_THAT(m_folder.files(), IsEmpty());
    }
}

TEST_F(Commands, KeepPartialWritesWhatHasConverged) {
    RunOptions options;
    options.signal = SIGINT;
    options.signalWhen = "%";
    const Outcome outcome =
        runPatina({"bake", "ao", "builtin:torus-knot", "--target", "vertex", "-o",
                   m_folder / "x.exr", "--samples", "65536", "--keep-partial", "--json"},
                  options);
    EXPECT_EQ(outcome.status, 130) << outcome.err;
    EXPECT_EQ(outcome.json()["partial"], true);
    EXPECT_LT(outcome.json()["samplesDone"], 65536);
    EXPECT_THAT(m_folder.files(), ElementsAre("x.exr"));
    EXPECT_EQ(runPatina({"info", m_folder / "x.exr"}).status, 0);
}

TEST_F(Commands, RenderToneMapsByName) {
    std::set<std::string> pictures;
    for (const char* name : {"clamp", "reinhardPhotographic", "pbrNeutral", "agx"}) {
        const std::string file = m_folder / (std::string(name) + ".png");
        const Outcome outcome = runPatina({"render", "builtin:sphere", "--size", "48x32", "--json",
                                           "--tone-map", name, "-o", file});
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_EQ(outcome.json()["settings"]["toneMap"], name);
        const Image image = load(file);
        pictures.emplace(image.u8().begin(), image.u8().end()); // its bytes
    }
    EXPECT_EQ(pictures.size(), 4u);
}

// The eye is used to the picture: a brighter environment comes out the same.
TEST_F(Commands, RenderExposesAutomatically) {
    const auto mean = [&](const char* ev, const char* exposure) {
        const std::string file = m_folder / "exposed.png";
        const Outcome outcome =
            runPatina({"render", "builtin:sphere", "--size", "48x32", "--json", "--exposure",
                       exposure, "--set", std::string("environment.exposureEv=") + ev, "-o", file});
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        double sum = 0.0;
        const Image image = load(file);
        for (const std::uint8_t value : image.u8())
            sum += value;
        return std::pair(sum / static_cast<double>(image.u8().size()), outcome.json());
    };
    const auto [dark, darkJson] = mean("-3", "auto");
    const auto [bright, brightJson] = mean("3", "auto");
    EXPECT_NEAR(dark, bright, 1.5);
    EXPECT_EQ(darkJson["settings"]["exposure"]["mode"], "automatic");
    EXPECT_NEAR(std::log2(brightJson["logAverageLuminance"].get<double>() /
                          darkJson["logAverageLuminance"].get<double>()),
                6.0, 0.1);
    EXPECT_GT(mean("3", "0").first, mean("-3", "0").first + 40.0) << "fixed exposure stays";
    const Outcome wrong =
        runPatina({"render", "builtin:sphere", "--exposure", "bright", "-o", m_folder / "x.png"});
    EXPECT_EQ(wrong.status, 2);
    EXPECT_THAT(wrong.err, HasSubstr("auto"));
}

TEST_F(Commands, RenderThroughOpenColorIo) {
    ::unsetenv("OCIO");
    const std::string config = m_folder / "studio.ocio";
    writeBytes(config, R"(ocio_profile_version: 1
strictparsing: false
roles: {scene_linear: light, default: light}
displays:
  Monitor:
    - !<View> {name: White, colorspace: white}
colorspaces:
  - !<ColorSpace> {name: light}
  - !<ColorSpace>
    name: white
    from_reference: !<MatrixTransform> {offset: [9, 9, 9, 0]}
)");
    const auto render = [&](std::vector<std::string> more, const std::string& file = "x.png") {
        std::vector<std::string> arguments{"render", "builtin:sphere", "--size", "32x32", "--json",
                                           "-o",     m_folder / file};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runPatina(arguments);
    };
    const Outcome shown =
        render({"--tone-map", "openColorIo", "--set", "view.ocioConfig=" + config});
    ASSERT_EQ(shown.status, 0) << shown.err;
    EXPECT_EQ(shown.json()["settings"]["openColorIo"]["view"], "White");
    EXPECT_THAT(shown.json()["settings"]["openColorIo"]["workingSpace"].get<std::string>(),
                HasSubstr("scene_linear"));
    const Image white = load(m_folder / "x.png");
    EXPECT_EQ(*std::min_element(white.u8().begin(), white.u8().end()), 255);

    const Outcome none = render({"--tone-map", "openColorIo"}, "none.png");
    EXPECT_EQ(none.status, 2);
    EXPECT_THAT(none.err, HasSubstr("view.ocioConfig"));
    const Outcome missing = render(
        {"--tone-map", "openColorIo", "--set", "view.ocioConfig=/none/config.ocio"}, "none.png");
    EXPECT_EQ(missing.status, 66);
    EXPECT_THAT(missing.err, HasSubstr("/none/config.ocio"));
    const Outcome unknown = render({"--tone-map", "openColorIo", "--set",
                                    "view.ocioConfig=" + config, "--set", "view.ocioView=Noir"},
                                   "none.png");
    EXPECT_EQ(unknown.status, 65);
    EXPECT_THAT(unknown.err, HasSubstr("it has White"));
    EXPECT_FALSE(std::filesystem::exists(m_folder / "none.png"));
    // Linear pictures need no display.
    EXPECT_EQ(render({"--tone-map", "openColorIo", "--set", "view.ocioConfig=" + config, "--set",
                      "view.ocioView=Noir"},
                     "x.exr")
                  .status,
              0);
}
