// What every command has in common: help, usage errors, exit statuses, the shape of JSON.
#include "CommandRunner.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <gmock/gmock.h>
#include <sstream>

using namespace patina::test;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

namespace fs = std::filesystem;

TEST(CommandLine, HelpListsTheCommandsThatExistAndNoOthers) {
    const Outcome help = runPatina({"--help"});
    EXPECT_EQ(help.status, 0);
    for (const char* command : {"info", "render", "sheet", "rank", "bake", "merge", "export",
                                "refine", "compare", "certificate", "parameters"})
        EXPECT_THAT(help.out, HasSubstr(std::string("\n  ") + command + " "));
    EXPECT_THAT(help.err, IsEmpty());
    const Outcome bake = runPatina({"bake", "--help"});
    for (const char* kind : {"ao", "prt", "light", "radiosity", "ibl"})
        EXPECT_THAT(bake.out, HasSubstr(std::string("\n  ") + kind + " "));
    EXPECT_THAT(bake.out, Not(HasSubstr("shard"))) << "a list, not their options";
    const Outcome render = runPatina({"render", "--help"});
    EXPECT_THAT(render.out, HasSubstr("Usage: patina render [OPTIONS] SCENE"));
    EXPECT_THAT(render.out, HasSubstr("whitted"));
}

// Letters count, not the bytes they take; defaults of flags are not shown as "{false}".
TEST(CommandLine, HelpStandsInTwoColumns) {
    const auto letters = [](const std::string& text) {
        return std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; });
    };
    const std::vector<std::vector<std::string>> commands{
        {"bake", "prt"}, {"bake", "ao"}, {"bake", "ibl"}, {"render"},  {"sheet"},
        {"rank"},        {"merge"},      {"refine"},      {"compare"}, {"certificate"}};
    for (std::vector<std::string> command : commands) {
        SCOPED_TRACE(command.back());
        command.emplace_back("--help");
        std::istringstream help(runPatina(command).out);
        bool options = false;
        int rows = 0;
        for (std::string line; std::getline(help, line);) {
            EXPECT_LE(letters(line), 100) << line;
            EXPECT_THAT(line, Not(HasSubstr("{")));
            options = options || line == "Options:";
            if (!options || line.size() < 3 || line[0] != ' ')
                continue;
            // Names have no two spaces in a row.
            const std::size_t name = line.find_first_not_of(' ');
            const std::size_t gap = name < 10 ? line.find("  ", name) : 0;
            if (gap == std::string::npos) { // a long name, the text stands below
                EXPECT_GE(letters(line), 29) << line;
                continue;
            }
            const std::size_t text = line.find_first_not_of(' ', gap);
            EXPECT_EQ(letters(line.substr(0, text)), 30) << line;
            ++rows;
        }
        EXPECT_GT(rows, 3);
    }
}

// The program is copied beside an editor that only tells how it was called.
TEST(CommandLine, WithoutACommandTheEditorBesideItStarts) {
    const TemporaryFolder folder;
    fs::copy_file(fs::path(std::getenv("PATINA_BIN_DIR")) / "patina", folder.path() / "patina");
    RunOptions options;
    options.program = folder / "patina";
    const Outcome alone = runPatina({"model.glb"}, options);
    EXPECT_EQ(alone.status, 66);
    EXPECT_THAT(alone.err, HasSubstr(folder / "patina-editor"));

    writeBytes(folder.path() / "patina-editor", "#!/bin/sh\necho \"editor:$*\"\nexit 3\n");
    fs::permissions(folder.path() / "patina-editor", fs::perms::owner_all);
    const std::vector<std::pair<std::vector<std::string>, const char*>> calls = {
        {{}, "editor:\n"},
        {{"a.glb", "b c.hdr"}, "editor:a.glb b c.hdr\n"},
        {{"--environment", "sky.hdr", "a.glb"}, "editor:--environment sky.hdr a.glb\n"},
        {{"edit", "info"}, "editor:info\n"},
        {{"builtin:sphere"}, "editor:builtin:sphere\n"}};
    for (const auto& [arguments, expected] : calls) {
        const Outcome outcome = runPatina(arguments, options);
        EXPECT_EQ(outcome.out, expected);
        EXPECT_EQ(outcome.status, 3);
    }
}

TEST(CommandLine, VersionIsOneLine) {
    const Outcome version = runPatina({"--version"});
    EXPECT_EQ(version.status, 0);
    EXPECT_THAT(version.out, testing::MatchesRegex("patina [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

TEST(CommandLine, WrongUsageIsStatus2WithAHint) {
    const std::vector<std::pair<std::vector<std::string>, const char*>> cases = {
        {{"rendr"}, "no command or file \"rendr\""},
        {{"bake"}, "patina bake --help"},
        {{"bake", "lightmap"}, "patina bake --help"},
        {{"info"}, "FILE"},
        {{"render", "builtin:sphere"}, "--output"},
        {{"render", "builtin:sphere", "-o", "x.png", "--samples", "3"}, "--samples"},
        {{"render", "builtin:sphere", "-o", "x.png", "--size", "10"}, "WIDTHxHEIGHT"},
        {{"render", "builtin:sphere", "-o", "x.png", "--size", "10x0"}, "WIDTHxHEIGHT"},
        // Larger than any picture, and than numbers that are computed from it.
        {{"render", "builtin:sphere", "-o", "x.png", "--renderer", "path", "--size", "40000x10"},
         "32768 pixels a side"},
        {{"render", "builtin:sphere", "-o", "x.exr", "--view", "all", "--size", "32768x32768"},
         "too many pixels"},
        {{"sheet", "builtin:sphere", "-o", "x.png", "--wedge", "view.exposureEv=0:1:2", "--size",
          "2000000000x2"},
         "32768 pixels a side"},
        {{"render", "builtin:sphere", "-o", "x.png", "--size", "10x10", "--camera", "1"},
         "YAW,PITCH"},
        {{"render", "builtin:sphere", "-o", "x.png", "--camera", "1,95"}, "YAW,PITCH"},
        {{"render", "builtin:sphere", "-o", "x.png", "--background", "pink"}, "--background"},
        {{"render", "builtin:sphere", "-o", "x.png", "--background", "4,0,0"}, "--background"},
        {{"render", "builtin:sphere", "-o", "x.png", "--lighting", "prt"}, "patina bake prt"},
        {{"render", "builtin:sphere", "-o", "x.pdf"}, ".png"},
        {{"render", "builtin:sphere", "--inspect", "640"}, "--inspect wants X,Y"},
        {{"render", "builtin:sphere", "--size", "8x6", "--inspect", "8,0"}, "to 7,5"},
        {{"render", "builtin:sphere", "--size", "8x6", "--inspect", "0,6"}, "to 7,5"},
        {{"render", "builtin:sphere", "--inspect", "-1,0"}, "--inspect"},
        {{"render", "builtin:sphere", "--inspect", "1,2,3"}, "--inspect"},
        {{"render", "builtin:nonsense", "-o", "x.png"}, "shader-ball"},
        {{"sheet", "builtin:sphere", "-o", "x.png"}, "one or two things: --environments"},
        {{"sheet", "builtin:sphere", "--wedge", "view.exposureEv=0:1:2"}, "--output"},
        {{"sheet", "-o", "x.png", "--environments", "builtin:studio"}, "SCENE"},
        {{"rank", "builtin:sphere", "-o", "x.json"}, "--environments"},
        {{"rank", "builtin:sphere", "--environments", "builtin:studio"}, "--output"},
        {{"rank", "builtin:sphere", "-o", "x.csv", "--environments", "builtin:studio"}, ".json"},
        {{"rank", "builtin:sphere", "-o", "x.json", "--environments", "builtin:studio", "--by",
          "beauty"},
         "--by"},
        {{"rank", "builtin:sphere", "-o", "x.json", "--environments", "builtin:studio",
          "--rotations", "0"},
         "--rotations"},
        {{"rank", "builtin:sphere", "-o", "x.json", "--environments", "builtin:studio", "--size",
          "4000x3"},
         "1024 pixels a side"},
        {{"rank", "builtin:sphere", "-o", "x.json", "--environments", "builtin:studio",
          "--sensitivity", "x.hdr"},
         "--sensitivity"},
        {{"rank", "builtin:sphere", "-o", "x.json", "--environments", "builtin:studio", "--bake",
          "x.exr", "--unshadowed"},
         "exclude each other"},
        {{"rank", "builtin:sphere", "-o", "x.json", "--environments", "builtin:studio",
          "--reference", "moon@30"},
         "moon@30"},
        // No number is NaN or infinite, whether an option has a range of its own or a list.
        {{"compare", "x.png", "y.png", "--difference", "absolute", "--range", "nan"}, "--range"},
        {{"compare", "x.png", "y.png", "-o", "d.png", "--difference", "absolute", "--range",
          "1e-50"}, // 0 as a float
         "--range"},
        {{"bake", "ao", "builtin:sphere", "-o", "x.png", "--distance", "nan"}, "--distance"},
        {{"refine", "builtin:sphere", "-o", "x.glb", "--tolerance", "inf"}, "olerance"},
        {{"render", "builtin:sphere", "-o", "x.png", "--camera", "nan,1,2"}, "--camera"},
        {{"render", "builtin:sphere", "-o", "x.png", "--view", "depth", "--view-range", "-inf,inf"},
         "--view-range"},
        {{"compare", "x.png", "y.png", "--fail-above", "rmse=nan"}, "--fail-above"},
        {{"certificate", "-o", "x.txt"}, ".json"},
        {{"certificate", "--hemicube", "7"}, "--hemicube is even"},
        {{"certificate", "--edge", "0"}, "--edge"},
        {{"bake", "ao", "builtin:sphere", "-o", "x.jpg"}, ".png or .exr"},
        {{"bake", "ao", "builtin:sphere", "-o", "x.png", "--target", "vertex"}, ".exr"},
        {{"bake", "ao", "builtin:sphere", "-o", "x.png", "--preset", "best"}, "draft,good,final"},
        {{"bake", "prt", "builtin:sphere", "-o", "x.exr", "--order", "9"}, "--order"},
        {{"bake", "prt", "builtin:sphere", "-o", "x.png"}, ".exr"},
        {{"export", "builtin:sphere", "-o", "x.obj"}, ".glb or .gltf"},
        {{"info", "x.png", "--threads", "2"}, "--threads"}};
    for (const auto& [arguments, hint] : cases) {
        const Outcome outcome = runPatina(arguments);
        EXPECT_EQ(outcome.status, 2) << testing::PrintToString(arguments);
        EXPECT_THAT(outcome.err, HasSubstr(hint)) << testing::PrintToString(arguments);
        EXPECT_THAT(outcome.out, IsEmpty()) << testing::PrintToString(arguments);
    }
}

TEST(CommandLine, UnknownParametersAreRefusedWithASuggestion) {
    const TemporaryFolder folder;
    for (const auto& [set, hint] : std::vector<std::pair<std::string, std::string>>{
             {"material.metalic=1", "material.metallic"},
             {"material[Nobody].metallic=1", "Nobody"},
             {"material.metallic", "NAME=VALUE"},
             {"=1", "NAME=VALUE"},
             {"material.metallic=very", "number"},
             {"view.toneMap=filmic", "reinhard"}}) {
        const Outcome outcome =
            runPatina({"export", "builtin:sphere", "-o", folder / "x.glb", "--set", set});
        EXPECT_EQ(outcome.status, 2) << set;
        EXPECT_THAT(outcome.err, HasSubstr(hint)) << set;
    }
    EXPECT_THAT(folder.files(), IsEmpty());
}

TEST(CommandLine, MissingInputsAre66) {
    const TemporaryFolder folder;
    fs::create_directory(folder.path() / "folder.glb");
    for (const std::string& file : {folder / "none.glb", folder / "none.png",
                                    folder / "none.patina", folder / "folder.glb"}) {
        const Outcome outcome = runPatina({"info", file, "--json"});
        EXPECT_EQ(outcome.status, 66) << file << outcome.err;
        EXPECT_EQ(outcome.json()["error"]["kind"], "inputMissing");
        EXPECT_EQ(outcome.json()["error"]["file"], file);
        EXPECT_EQ(outcome.json()["error"]["exitStatus"], 66);
        EXPECT_FALSE(outcome.json()["error"]["message"].get<std::string>().empty());
        EXPECT_THAT(outcome.err, HasSubstr(file));
    }
    EXPECT_EQ(runPatina({"export", "builtin:sphere", "-o", folder / "x.glb", "--set",
                         "material.baseColor.map=" + (folder / "none.png")})
                  .status,
              66);
    EXPECT_EQ(runPatina({"render", "builtin:sphere", "-o", folder / "x.png", "--environment",
                         folder / "none.hdr"})
                  .status,
              66);
}

TEST(CommandLine, BrokenInputsAre65) {
    const TemporaryFolder folder;
    const std::string garbage(2000, 'x');
    for (const char* name : {"a.glb", "a.obj", "a.png", "a.exr", "a.patina", "empty.gltf"}) {
        writeBytes(folder.path() / name, std::string(name) == "empty.gltf" ? "" : garbage);
        const Outcome outcome = runPatina({"info", folder / name, "--json"});
        EXPECT_EQ(outcome.status, 65) << name << outcome.err;
        EXPECT_EQ(outcome.json()["error"]["kind"], "inputBroken") << name;
        EXPECT_EQ(outcome.json()["error"]["file"], folder / name);
    }
}

TEST(CommandLine, OutputsThatCannotBeCreatedAre73BeforeAnyWork) {
    const TemporaryFolder folder;
    fs::create_directory(folder.path() / "taken.exr");
    for (const std::string& output : {folder / "no/such/folder.exr", folder / "taken.exr"}) {
        // A bake of 65536 rays per vertex would not end before the test does.
        const Outcome outcome = runPatina(
            {"bake", "prt", "builtin:torus-knot", "-o", output, "--samples", "65536", "--json"});
        EXPECT_EQ(outcome.status, 73) << outcome.err;
        EXPECT_EQ(outcome.json()["error"]["kind"], "cannotCreate");
    }
    EXPECT_THAT(folder.files(), ElementsAre("taken.exr"));
}

TEST(CommandLine, AFullDiskIs74) {
    const TemporaryFolder folder;
    fs::create_symlink("/dev/full", folder.path() / "full.glb");
    const Outcome outcome = runPatina({"export", "builtin:plane", "-o", folder / "full.glb"});
    EXPECT_EQ(outcome.status, 74);
    EXPECT_THAT(outcome.err, HasSubstr("disk is full"));
}

TEST(CommandLine, NoOpenGlIs69) {
    const TemporaryFolder folder;
    RunOptions options;
    options.environment = {{"__EGL_VENDOR_LIBRARY_FILENAMES", "/nowhere/egl.json"}};
    const Outcome outcome =
        runPatina({"render", "builtin:plane", "-o", folder / "x.png", "--json"}, options);
    EXPECT_EQ(outcome.status, 69);
    EXPECT_EQ(outcome.json()["error"]["kind"], "noOpenGl");
    EXPECT_THAT(folder.files(), IsEmpty());
}

TEST(CommandLine, ErrorsAndUsageAreJsonToo) {
    const Outcome usage = runPatina({"render", "--json"});
    EXPECT_EQ(usage.status, 2);
    EXPECT_EQ(usage.json()["error"]["kind"], "usage");
    EXPECT_EQ(usage.json()["error"]["exitStatus"], 2);
    EXPECT_FALSE(usage.err.empty());
}

TEST(CommandLine, QuietSaysNothingButTheResult) {
    const TemporaryFolder folder;
    const Outcome outcome =
        runPatina({"export", "builtin:plane", "-o", folder / "x.glb", "--quiet", "--json"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.err, IsEmpty());
    EXPECT_THAT(outcome.json()["outputs"], ElementsAre(folder / "x.glb"));
}

TEST(CommandLine, ParametersPrintTheTable) {
    const Outcome human = runPatina({"parameters"});
    EXPECT_THAT(human.out, HasSubstr("\nmaterial.metallic  "));
    const Outcome markdown = runPatina({"parameters", "--markdown"});
    EXPECT_THAT(markdown.out, HasSubstr("# Parameters\n"));
    EXPECT_THAT(markdown.out, HasSubstr("`material.metallic`"));
    nlohmann::json json = runPatina({"parameters", "--json"}).json();
    EXPECT_THAT(
        json["parameters"],
        testing::Contains(testing::ResultOf(
            [](const nlohmann::json& p) { return p["id"].get<std::string>(); }, "view.fovDeg")));
}
