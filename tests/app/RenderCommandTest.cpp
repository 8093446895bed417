// patina render on built-in scenes.
#include "CommandsFixture.h"
#include "core/document/View.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>

using namespace patina;
using namespace patina::test;
using testing::HasSubstr;
using testing::IsEmpty;

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

TEST_F(Commands, RenderFindsRadiosityThatWasSolved) {
    std::filesystem::create_directory(m_folder / "solved");
    const auto render = [&](const std::string& name, const std::string& cache, const char* ev) {
        RunOptions options;
        options.environment = {{"PATINA_RADIOSITY_CACHE", cache}};
        const Outcome outcome = runPatina(
            {"render", "builtin:cornell-reference", "--lighting", "radiosity", "--size", "32x24",
             "--samples", "1", "--environment", "builtin:studio", "--set",
             "view.radiosityArea=0.02", "--set", std::string("environment.exposureEv=") + ev,
             "--json", "-o", m_folder / name},
            options);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return std::pair(readBytes(m_folder / name), outcome.json()["radiosity"]);
    };
    const auto kept = [&] {
        return std::distance(std::filesystem::directory_iterator(m_folder / "solved"),
                             std::filesystem::directory_iterator());
    };
    const auto [solved, without] = render("none.exr", "", "0");
    EXPECT_EQ(without["found"], 0);
    EXPECT_EQ(kept(), 0);
    const auto [stored, first] = render("stored.exr", m_folder / "solved", "0");
    EXPECT_EQ(first, without);
    EXPECT_EQ(stored, solved);
    EXPECT_EQ(kept(), without["sources"]);
    const auto [again, second] = render("found.exr", m_folder / "solved", "0");
    EXPECT_EQ(second["found"], without["sources"]);
    EXPECT_EQ(second["sweeps"], without["sweeps"]) << "that were made then";
    EXPECT_EQ(again, solved);
    // Another exposure of the sky is no other light.
    const auto [brighter, third] = render("brighter.exr", m_folder / "solved", "1");
    EXPECT_EQ(third["found"], without["sources"]);
    EXPECT_NE(brighter, solved);
    EXPECT_EQ(brighter, render("alone.exr", "", "1").first);
    EXPECT_EQ(kept(), without["sources"]);
}

// Where nothing can be kept, the picture is there all the same.
TEST_F(Commands, RenderSaysThatRadiosityIsNotKept) {
    std::ofstream(m_folder / "file") << "no folder";
    RunOptions options;
    options.environment = {{"PATINA_RADIOSITY_CACHE", m_folder / "file"}};
    const Outcome outcome = runPatina({"render", "builtin:cornell-reference", "--lighting",
                                       "radiosity", "--size", "16x12", "--samples", "1", "--set",
                                       "view.radiosityArea=0.1", "-o", m_folder / "picture.png"},
                                      options);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("not kept for the next time"));
    EXPECT_TRUE(std::filesystem::exists(m_folder / "picture.png"));
}

TEST_F(Commands, RadiosityIsKeptWhereTheEditorKeepsIt) {
    const std::string cache = m_folder / "cache";
    RunOptions options;
    options.environment = {{"PATINA_RADIOSITY_CACHE", std::nullopt}, {"XDG_CACHE_HOME", cache}};
    const Outcome outcome = runPatina({"render", "builtin:cornell-reference", "--lighting",
                                       "radiosity", "--size", "16x12", "--samples", "1", "--set",
                                       "view.radiosityArea=0.1", "-o", m_folder / "picture.png"},
                                      options);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    const std::string folder = cache + "/Patina/Patina/radiosity";
    ASSERT_TRUE(std::filesystem::is_directory(folder));
    EXPECT_FALSE(std::filesystem::is_empty(folder));
}

// The background has the radiance it was given: no tone curve, no rounding to 8 bits.
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

TEST_F(Commands, RenderTurnsTheCameraOrTheEnvironment) {
    const std::vector<std::string> scene{"render", "builtin:shader-ball", "--size",
                                         "48x32",  "--environment",       "builtin:sunset"};
    const auto with = [&](std::vector<std::string> more, const RunOptions& options = {}) {
        std::vector<std::string> arguments = scene;
        if (std::ranges::count(more, "--camera") == 0)
            more.insert(more.end(), {"--camera", "10,5,3"});
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runPatina(arguments, options);
    };
    const Outcome turn = with({"-o", m_folder / "turn.png", "--turntable", "3", "--json"});
    ASSERT_EQ(turn.status, 0) << turn.err;
    EXPECT_EQ(turn.json()["outputs"],
              nlohmann::json({m_folder / "turn-0001.png", m_folder / "turn-0002.png",
                              m_folder / "turn-0003.png"}));
    EXPECT_EQ(with({"-o", m_folder / "light.png", "--light-turn", "4"}).status, 0);
    // Each is the picture that the command draws alone.
    ASSERT_EQ(with({"-o", m_folder / "one.png"}).status, 0);
    EXPECT_EQ(readBytes(m_folder / "turn-0001.png"), readBytes(m_folder / "one.png"));
    EXPECT_EQ(readBytes(m_folder / "light-0001.png"), readBytes(m_folder / "one.png"));
    ASSERT_EQ(with({"-o", m_folder / "two.png", "--camera", "130,5,3"}).status, 0);
    EXPECT_EQ(readBytes(m_folder / "turn-0002.png"), readBytes(m_folder / "two.png"));
    ASSERT_EQ(with({"-o", m_folder / "lit.png", "--set", "environment.rotationDeg=90"}).status, 0);
    EXPECT_EQ(readBytes(m_folder / "light-0002.png"), readBytes(m_folder / "lit.png"));

    // A video, by a program of ours that keeps what it is sent.
    writeBytes(m_folder / "ffmpeg", "#!/bin/sh\nfor last in \"$@\"; do :; done\ncat > \"$last\"\n");
    std::filesystem::permissions(m_folder / "ffmpeg", std::filesystem::perms::owner_all);
    RunOptions ours;
    ours.environment["PATH"] = m_folder.path().string() + ":/usr/bin:/bin";
    const Outcome video = with({"-o", m_folder / "turn.mp4", "--turntable", "3"}, ours);
    ASSERT_EQ(video.status, 0) << video.err;
    EXPECT_EQ(readBytes(m_folder / "turn.mp4").size(), 3u * 48 * 32 * 3);
    EXPECT_THAT(video.err, HasSubstr("video of 3 pictures"));

    for (const auto& [more, said] : std::vector<std::pair<std::vector<std::string>, const char*>>{
             {{"-o", m_folder / "no.mp4"}, "--turntable N"},
             {{"-o", m_folder / "no.png", "--turntable", "3", "--light-turn", "3"}, "exclude"},
             {{"-o", m_folder / "no.png", "--turntable", "1"}, "--turntable"},
             {{"-o", m_folder / "no.png", "--turntable", "3", "--inspect", "1,1"}, "--inspect"}}) {
        const Outcome outcome = with(more);
        EXPECT_EQ(outcome.status, 2) << said;
        EXPECT_THAT(outcome.err, HasSubstr(said));
    }
    RunOptions none;
    none.environment["PATH"] = m_folder.path().string() + "/nothing";
    const Outcome missing = with({"-o", m_folder / "no.mp4", "--turntable", "3"}, none);
    EXPECT_NE(missing.status, 0);
    EXPECT_THAT(missing.err, HasSubstr("ffmpeg, which is not installed"));
    EXPECT_FALSE(std::filesystem::exists(m_folder / "no.mp4"));
}

TEST_F(Commands, RenderTracesPaths) {
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"render", "builtin:sphere", "--size", "40x30", "--environment",
                                   "builtin:white", "--json"});
        return runPatina(more);
    };
    // In light from all sides a ball shows its albedo, and nothing of it is noise.
    std::vector<std::string> white{"--renderer", "path"};
    for (const char* set : {"baseColor=1,1,1", "metallic=0", "baseColor.map=", "metallic.map=",
                            "perceptualRoughness.map=", "normalStrength.map="})
        white.insert(white.end(), {"--set", std::string("material.") + set});
    const auto traced = [&](std::vector<std::string> more) {
        more.insert(more.begin(), white.begin(), white.end());
        return with(std::move(more));
    };
    const Outcome ball = traced({"--samples", "64", "-o", m_folder / "ball.exr"});
    ASSERT_EQ(ball.status, 0) << ball.err;
    EXPECT_EQ(ball.json()["settings"]["renderer"], "path");
    EXPECT_EQ(ball.json()["settings"]["samples"], 64);
    EXPECT_LT(ball.json()["noisePercent"], 5.0);
    const Image picture = load(m_folder / "ball.exr");
    ASSERT_EQ(picture.channels(), 3);
    EXPECT_NEAR(picture.sample(20, 15, 1), 1.0f, 0.05f);
    EXPECT_NEAR(picture.sample(0, 0, 1), 1.0f, 1e-3f) << "the environment behind it";

    // The same numbers for any threads; others for another seed; an end by certainty.
    EXPECT_EQ(traced({"--samples", "64", "--threads", "1", "-o", m_folder / "one.exr"}).status, 0);
    EXPECT_EQ(load(m_folder / "one.exr"), picture);
    EXPECT_EQ(traced({"--samples", "64", "--seed", "9", "-o", m_folder / "seed.exr"}).status, 0);
    EXPECT_NE(load(m_folder / "seed.exr"), picture);
    const Outcome certain = traced({"--noise", "3", "-o", m_folder / "certain.png"});
    ASSERT_EQ(certain.status, 0) << certain.err;
    EXPECT_LE(certain.json()["noisePercent"], 3.0);
    EXPECT_EQ(load(m_folder / "certain.png").channels(), 3);
    const Outcome open = traced({"--samples", "4", "--background", "transparent", "-o",
                                 m_folder / "open.png", "--max-bounces", "0"});
    ASSERT_EQ(open.status, 0) << open.err;
    EXPECT_EQ(load(m_folder / "open.png").sample(0, 0, 3), 0.0f);
    EXPECT_EQ(load(m_folder / "open.png").sample(20, 15, 3), 1.0f);

    for (const auto& [more, said] : std::vector<std::pair<std::vector<std::string>, const char*>>{
             {{"--renderer", "path", "--view", "albedo"}, "--view"},
             {{"--renderer", "path", "--inspect", "1,1"}, "--inspect"},
             {{"--renderer", "path", "--turntable", "3"}, "--turntable"},
             {{"--renderer", "path", "--lighting", "ibl"}, "--lighting"},
             {{"--renderer", "path", "--samples", "0"}, "--samples"},
             {{"--renderer", "rays"}, "--renderer"},
             {{"--noise", "1"}, "--renderer path"},
             {{"--max-bounces", "1"}, "--renderer path"},
             {{"--samples", "3"}, "1, 2, 4, 8 or 16"}}) {
        std::vector<std::string> arguments = more;
        arguments.insert(arguments.end(), {"-o", m_folder / "no.png"});
        const Outcome outcome = with(arguments);
        EXPECT_EQ(outcome.status, 2) << said << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr(said));
        EXPECT_FALSE(std::filesystem::exists(m_folder / "no.png"));
    }
}

TEST_F(Commands, RenderLooksThroughTheCamerasOfTheFile) {
    // A triangle, and a camera that looks at it from behind and one that is tilted.
    const std::string positions =
        "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"; // 0 0 0, 1 0 0, 0 1 0
    writeBytes(m_folder / "scene.gltf", R"({"asset": {"version": "2.0"}, "scene": 0,
        "scenes": [{"nodes": [0, 1, 2]}],
        "nodes": [{"mesh": 0},
                  {"camera": 0, "name": "Hero", "translation": [0, 0, -5], "rotation": [0, 1, 0, 0]},
                  {"camera": 0, "name": "Tilted", "translation": [0, 0, 5],
                   "rotation": [0, 0, 0.3826834, 0.9238795]}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,)" +
                                            positions + R"("}]})");
    const std::string scene = m_folder / "scene.gltf";
    const Outcome info = runPatina({"info", scene, "--json"});
    ASSERT_EQ(info.status, 0) << info.err;
    const nlohmann::json report = info.json();
    const nlohmann::json& cameras = report["cameras"];
    ASSERT_EQ(cameras.size(), 2u);
    EXPECT_EQ(cameras[0]["name"], "Hero");
    EXPECT_EQ(cameras[0]["forward"], nlohmann::json({0.0, 0.0, 1.0}));
    EXPECT_THAT(runPatina({"info", scene}).out, HasSubstr("Tilted"));
    std::size_t listed = 0;
    for (const nlohmann::json& key : report["gltfKeys"])
        listed += key["key"] == "cameras[].perspective.znear" && key["use"] == "left out" ? 1 : 0;
    EXPECT_EQ(listed, 1u);

    const auto draw = [&](const std::string& camera, const std::vector<std::string>& more = {}) {
        std::vector<std::string> arguments{"render",           scene,           "-o",
                                           m_folder / "c.png", "--size",        "16x12",
                                           "--json",           "--environment", "builtin:white",
                                           "--camera",         camera};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runPatina(arguments);
    };
    const Outcome hero = draw("scene:Hero");
    ASSERT_EQ(hero.status, 0) << hero.err;
    const nlohmann::json camera = hero.json()["settings"]["camera"];
    EXPECT_NEAR(std::abs(camera["yawDeg"].get<double>()), 180.0, 1e-3);
    EXPECT_NEAR(camera["pitchDeg"].get<double>(), 0.0, 1e-3);
    EXPECT_NEAR(camera["fovDeg"].get<double>(), 28.6479, 1e-3); // 0.5 rad
    EXPECT_NEAR(camera["distance"].get<double>(), 5.0, 1e-3);   // the triangle lies at z = 0
    EXPECT_NEAR(
        draw("scene:Hero", {"--fov", "50"}).json()["settings"]["camera"]["fovDeg"].get<double>(),
        50.0, 1e-3);
    EXPECT_THAT(draw("scene:Tilted").err, HasSubstr("tilted by 45.0°"));
    const Outcome none = draw("scene:Nobody");
    EXPECT_EQ(none.status, 2);
    EXPECT_THAT(none.err, HasSubstr("\"Hero\", \"Tilted\""));
    EXPECT_THAT(
        runPatina({"render", "builtin:sphere", "-o", m_folder / "d.png", "--camera", "scene:Hero"})
            .err,
        HasSubstr("hold none"));
}
