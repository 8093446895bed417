// What files that somebody else made may not do to whoever runs a command on them.
#include "CommandRunner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

using namespace patina::test;
using testing::HasSubstr;
using testing::Not;

namespace {

// Ends with 124 when the command hangs.
Outcome runInTime(std::vector<std::string> arguments) {
    const std::string program = std::string(std::getenv("PATINA_BIN_DIR")) + "/patina";
    arguments.insert(arguments.begin(), {"60", program});
    RunOptions options;
    options.program = "/usr/bin/timeout";
    return runPatina(arguments, options);
}

// Sets the clipboard, colours, moves the cursor up, and an eight-bit form of the first.
const std::string kEvil = "\x1b]52;c;ZXZpbA==\x07\x1b[31m\r\n\x1b[A\xc2\x9b"
                          "2J";

bool steersATerminal(const std::string& text) {
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto c = static_cast<unsigned char>(text[i]);
        if ((c < 32 && c != '\n') || c == 127 ||
            (c == 0xc2 && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xa0))
            return true;
    }
    return false;
}

nlohmann::json evilTriangle() {
    // Three corners of a triangle, and normals up.
    const std::string data = "data:application/octet-stream;base64,"
                             "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
    return {{"asset", {{"version", "2.0"}}},
            {"scenes", {{{"nodes", nlohmann::json::array({0})}}}},
            {"nodes", {{{"name", "node" + kEvil}, {"mesh", 0}}}},
            {"materials",
             {{{"name", "material" + kEvil},
               {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}}},
            {"textures", {{{"source", 0}}}},
            {"images", {{{"uri", "missing" + kEvil + ".png"}}}},
            {"meshes",
             {{{"name", "mesh" + kEvil},
               {"primitives", {{{"attributes", {{"POSITION", 0}}}, {"material", 0}}}}}}},
            {"accessors",
             {{{"bufferView", 0}, {"count", 3}, {"type", "VEC3"}, {"componentType", 5126}}}},
            {"bufferViews", {{{"buffer", 0}, {"byteLength", 36}}}},
            {"buffers", {{{"uri", data}, {"byteLength", 36}}}}};
}

// A 1 × 1 PNG.
std::string smallPng() {
    constexpr unsigned char kPng[] = {
        137, 80,  78,  71, 13, 10,  26,  10, 0,   0,   0,   13,  73,  72, 68,  82, 0, 0,
        0,   1,   0,   0,  0,  1,   8,   2,  0,   0,   0,   144, 119, 83, 222, 0,  0, 0,
        12,  73,  68,  65, 84, 120, 156, 99, 248, 207, 192, 0,   0,   3,  1,   1,  0, 201,
        254, 146, 239, 0,  0,  0,   0,   73, 69,  78,  68,  174, 66,  96, 130};
    return {reinterpret_cast<const char*>(kPng), sizeof kPng};
}

} // namespace

TEST(HostileFiles, NamesDoNotSteerTheTerminal) {
    const TemporaryFolder folder;
    const std::string model = folder / "triangle.gltf";
    writeBytes(model, evilTriangle().dump());
    nlohmann::json unknown = evilTriangle();
    unknown["extensionsRequired"] = {"EXT" + kEvil};
    writeBytes(folder / "unknown.gltf", unknown.dump());
    const std::string named = folder / ("file" + std::string("\x1b[2J") + ".gltf");
    writeBytes(named, evilTriangle().dump());
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"info", model},
          {"info", model, "--json"},
          {"info", named},
          {"info", folder / "unknown.gltf"},
          {"info", folder / "unknown.gltf", "--json"},
          {"export", model, "-o", folder / "out.glb"},
          {"render", model, "--set", "material[" + kEvil + "].metallic=1", "-o", folder / "a.png"},
          {"no" + kEvil}}) {
        const Outcome outcome = runPatina(command);
        EXPECT_FALSE(steersATerminal(outcome.out)) << command[0] << ": " << outcome.out;
        EXPECT_FALSE(steersATerminal(outcome.err)) << command[0] << ": " << outcome.err;
    }
    // What is meant for programs says it all.
    const nlohmann::json json = runPatina({"info", model, "--json"}).json();
    EXPECT_EQ(json["meshes"][0]["name"], "node" + kEvil);
}

TEST(HostileFiles, PipesAreRefusedByEveryCommandThatReads) {
    const TemporaryFolder folder;
    for (const char* name : {"pipe", "pipe.glb", "pipe.obj", "pipe.exr", "pipe.png", "pipe.hdr",
                             "pipe.patina", "pipe.part"})
        ASSERT_EQ(::mkfifo((folder / name).c_str(), 0600), 0);
    const std::string out = folder / "out.png";
    const std::vector<std::vector<std::string>> commands = {
        {"info", folder / "pipe"},
        {"info", folder / "pipe.glb"},
        {"info", folder / "pipe.exr"},
        {"info", folder / "pipe.patina"},
        {"info", "/dev/zero"},
        {"render", folder / "pipe.patina", "-o", out},
        {"render", folder / "pipe.obj", "-o", out},
        {"render", "builtin:plane", "--bake", folder / "pipe.exr", "-o", out},
        {"render", "builtin:plane", "--environment", folder / "pipe.hdr", "-o", out},
        {"render", "builtin:plane", "--set", "material.baseColor.map=" + (folder / "pipe.png"),
         "-o", out},
        {"merge", folder / "pipe.part", folder / "pipe.part", "-o", folder / "out.exr"},
        {"compare", folder / "pipe.png", folder / "pipe.png"},
        {"bake", "ao", folder / "pipe.glb", "-o", out},
        {"bake", "ibl", folder / "pipe.hdr", "-o", folder / "ibl"},
        {"export", folder / "pipe.patina", "-o", folder / "out.glb"},
        {"refine", folder / "pipe.obj", "-o", folder / "out.glb"}};
    for (const auto& command : commands) {
        const Outcome outcome = runInTime(command);
        EXPECT_EQ(outcome.status, 66) << command[0] << " " << command[1] << ": " << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr("a pipe or a device"));
    }
}

TEST(HostileFiles, PicturesOutsideTheModelsFolderNeedPermission) {
    const TemporaryFolder folder;
    writeBytes(folder / "secret.png", smallPng());
    std::filesystem::create_directories(folder / "model");
    nlohmann::json model = evilTriangle();
    model["images"][0]["uri"] = "../secret.png";
    writeBytes(folder / "model/a.gltf", model.dump());

    const Outcome closed = runPatina({"info", folder / "model/a.gltf", "--json"});
    ASSERT_EQ(closed.status, 0) << closed.err;
    EXPECT_EQ(closed.json()["outside"], nlohmann::json::array({folder / "secret.png"}));
    EXPECT_TRUE(closed.json()["materials"][0]["maps"]["baseColor"].contains("problem"));
    EXPECT_THAT(closed.err, HasSubstr("--allow-outside"));
    const Outcome open = runPatina({"info", folder / "model/a.gltf", "--json", "--allow-outside"});
    ASSERT_EQ(open.status, 0) << open.err;
    EXPECT_FALSE(open.json().contains("outside"));
    EXPECT_EQ(open.json()["materials"][0]["maps"]["baseColor"].value("width", 0), 1)
        << open.out << open.err;

    // An export takes along what was read, and nothing else.
    EXPECT_EQ(runPatina({"export", folder / "model/a.gltf", "-o", folder / "out.glb"}).status, 0);
    EXPECT_THAT(readBytes(folder / "out.glb"), Not(HasSubstr("IHDR")));
    EXPECT_EQ(
        runPatina({"export", folder / "model/a.gltf", "-o", folder / "out.glb", "--allow-outside"})
            .status,
        0);
    EXPECT_THAT(readBytes(folder / "out.glb"), HasSubstr("IHDR"));

    // A bake in parts opens its scene again to join them.
    const std::string part = folder / "1.part";
    ASSERT_EQ(runPatina({"bake", "prt", folder / "model/a.gltf", "-o", part, "--shard", "1/1",
                         "--order", "1", "--samples", "8", "--bounces", "1", "--allow-outside"})
                  .status,
              0);
    const Outcome merged = runPatina({"merge", part, "-o", folder / "bake.exr", "--allow-outside"});
    EXPECT_EQ(merged.status, 0) << merged.err;
}

TEST(HostileFiles, PicturesOutsideTheProjectsFolderNeedPermission) {
    const TemporaryFolder folder;
    writeBytes(folder / "secret.png", smallPng());
    std::filesystem::create_directories(folder / "project");
    const nlohmann::json project = {
        {"format", "patina"},
        {"version", 1},
        {"nextId", 10},
        {"view",
         {{"camera", {{"target", {0, 0, 0}}, {"yawDeg", 0}, {"pitchDeg", 0}, {"distance", 4}}}}},
        {"lights", nlohmann::json::array()},
        {"bakes", nlohmann::json::array()},
        {"environment", {{"image", {{"source", folder / "secret.png"}}}}},
        {"materials",
         {{{"id", 1},
           {"name", "Skin"},
           {"baseColor.map", {{"source", folder / "secret.png"}, {"channel", "rgb"}}}}}},
        {"meshes",
         {{{"id", 2},
           {"name", "Ball"},
           {"material", 1},
           {"source", "builtin:sphere"},
           {"sourceIndex", 0},
           {"transform", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}}}}};
    const std::string scene = folder / "project/theirs.patina";
    writeBytes(scene, project.dump());

    const Outcome closed = runPatina({"info", scene, "--json"});
    ASSERT_EQ(closed.status, 0) << closed.err;
    EXPECT_EQ(closed.json()["outside"], nlohmann::json::array({folder / "secret.png"}));
    EXPECT_THAT(closed.err, HasSubstr("outside the project's folder"));
    EXPECT_THAT(closed.err, HasSubstr("--allow-outside"));

    const std::string output = folder / "out.glb";
    EXPECT_EQ(runPatina({"export", scene, "-o", output}).status, 0);
    EXPECT_THAT(readBytes(output), Not(HasSubstr("IHDR")));
    EXPECT_EQ(runPatina({"export", scene, "-o", output, "--allow-outside"}).status, 0);
    EXPECT_THAT(readBytes(output), HasSubstr("IHDR"));
    // For that one run.
    EXPECT_EQ(runPatina({"export", scene, "-o", output}).status, 0);
    EXPECT_THAT(readBytes(output), Not(HasSubstr("IHDR")));
}
