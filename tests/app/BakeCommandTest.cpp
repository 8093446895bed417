// patina bake on built-in scenes, and pictures of what was baked.
#include "CommandsFixture.h"

#include <csignal>
#include <cstdint>
#include <filesystem>

using namespace patina;
using namespace patina::test;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

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

TEST_F(Commands, ALightMapIsBakedReadAndDrawnWith) {
    const std::string map = m_folder / "map.exr";
    const auto bake = [&](const char* threads, const std::string& output) {
        return runPatina({"bake", "light", "builtin:rounded-cube", "-o", output, "--size", "16",
                          "--samples", "8", "--threads", threads, "--json"});
    };
    const Outcome outcome = bake("2", map);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.json()["samplesDone"], 8);
    ASSERT_EQ(bake("1", m_folder / "one.exr").status, 0);
    EXPECT_EQ(readBytes(map), readBytes(m_folder / "one.exr"));
    EXPECT_EQ(runPatina({"info", map, "--json"}).json()["bake"]["kind"], "light map");
    const auto draw = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{
            "render", "builtin:rounded-cube", "-o",      m_folder / "p.png", "--size",
            "32x32",  "--lighting",           "lightMap"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runPatina(arguments);
    };
    const Outcome lit = draw({"--bake", map});
    EXPECT_EQ(lit.status, 0) << lit.err;
    EXPECT_THAT(lit.err, Not(HasSubstr("stale")));
    EXPECT_THAT(draw({"--bake", map, "--environment", "builtin:white"}).err,
                HasSubstr("the lights, the environment or the materials have changed"));
    EXPECT_NE(draw({}).status, 0) << "there is no map";
    EXPECT_EQ(runPatina({"bake", "light", "builtin:sphere", "-o", m_folder / "x.png"}).status, 2);
    EXPECT_EQ(
        runPatina({"bake", "light", "builtin:sphere", "-o", m_folder / "x.exr", "--size", "9999"})
            .status,
        2);
}

TEST_F(Commands, RenderSolvesRadiosityAndDrawsIt) {
    const auto draw = [&](const char* output, const std::vector<std::string>& more) {
        std::vector<std::string> arguments{
            "render", "builtin:cornell-reference", "-o",    m_folder / output, "--size", "32x32",
            "--set",  "environment.enabled=false", "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runPatina(arguments);
    };
    // As finely as it is divided unless something else is asked for; few rays are enough here.
    const Outcome lit =
        draw("a.exr", {"--lighting", "radiosity", "--set", "view.radiosityRays=64"});
    ASSERT_EQ(lit.status, 0) << lit.err;
    const nlohmann::json solved = lit.json()["radiosity"];
    EXPECT_NEAR(solved["elements"].get<double>(), 4000, 1000);
    EXPECT_LE(solved["residual"].get<double>(), 1e-3);
    const auto coarse = [&](const char* output, const char* threads) {
        return draw(output, {"--lighting", "radiosity", "--set", "view.radiosityArea=0.05",
                             "--threads", threads});
    };
    const Outcome one = coarse("b.exr", "1");
    ASSERT_EQ(one.status, 0) << one.err;
    EXPECT_LT(one.json()["radiosity"]["elements"].get<double>(),
              0.5 * solved["elements"].get<double>());
    ASSERT_EQ(coarse("c.exr", "2").status, 0);
    EXPECT_EQ(readBytes(m_folder / "b.exr"), readBytes(m_folder / "c.exr"));
    EXPECT_FALSE(draw("d.exr", {"--lighting", "ibl"}).json().contains("radiosity"));
    EXPECT_TRUE(draw("f.exr", {}).json().contains("radiosity")) << "a room is shown by it";
    const Outcome fine =
        draw("e.exr", {"--lighting", "radiosity", "--set", "view.radiosityArea=1e-9"});
    EXPECT_EQ(fine.status, 2);
    EXPECT_THAT(fine.err, HasSubstr("elements"));
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
    ASSERT_EQ(runPatina({"bake", "ao", "builtin:cornell-reference", "--target", "vertex", "-o",
                         m_folder / "ao.exr", "--samples", "32"})
                  .status,
              0);
    nlohmann::json scene = runPatina({"info", "builtin:cornell-reference", "--json"}).json();
    const std::string mesh = scene["meshes"][0]["name"];
    const Outcome stale =
        runPatina({"render", "builtin:cornell-reference", "-o", m_folder / "x.png", "--size",
                   "32x32", "--samples", "1", "--bake", m_folder / "ao.exr", "--set",
                   "mesh[" + mesh + "].visible=false", "--set", "environment.enabled=false"});
    EXPECT_EQ(stale.status, 0) << stale.err;
    EXPECT_THAT(stale.err, HasSubstr("a bake is stale: “" + mesh + "” was hidden"));
}

// Textures that do not fit into memory together are baked a few at a time: to the same pictures.
TEST_F(Commands, TexturesAreBakedAsMemoryAllows) {
    const std::vector<std::string> common{
        "bake", "ao", "builtin:shader-ball", "--size", "256", "--samples", "1", "--json"};
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
