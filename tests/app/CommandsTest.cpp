// patina info, refine and export, on built-in scenes.
#include "CommandsFixture.h"

#include <csignal>
#include <filesystem>
#include <sys/resource.h>

using namespace patina;
using namespace patina::test;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

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

// Before the work, not after it; a limit on the size of files is an error, not the end of the
// program.
TEST_F(Commands, OutputsThatCannotBeWrittenAreTold) {
    const std::string longName = std::string(260, 'a') + ".exr";
    const Outcome named = runPatina(
        {"bake", "ao", "builtin:torus-knot", "--samples", "65536", "-o", m_folder / longName});
    EXPECT_EQ(named.status, 73);
    EXPECT_THAT(named.err, HasSubstr("264 bytes"));
    struct rlimit before {};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    struct rlimit small = before;
    small.rlim_cur = 4096;
    std::signal(SIGXFSZ, SIG_DFL);
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0); // for the program that is started
    const Outcome cut =
        runPatina({"render", "builtin:sphere", "--size", "320x240", "-o", m_folder / "large.png"});
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
    EXPECT_EQ(cut.status, 74) << cut.err;
    EXPECT_THAT(cut.err, HasSubstr("larger than may be written here"));
    EXPECT_FALSE(std::filesystem::exists(m_folder / "large.png"));
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
