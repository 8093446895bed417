// patina bake radiosity: light exposed anew in the files that hold it, and files with a light map.
#include "ColladaRoom.h"
#include "CommandsFixture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>

using namespace patina;
using namespace patina::test;
using testing::HasSubstr;

// The same as solving again with the other exposure, but for what rounding leaves of COLLADA's
// text.
TEST_F(Commands, RadiosityIsExposedAnewWithoutSolving) {
    const auto bake = [&](const std::string& output, const char* exposure,
                          const char* scene = "builtin:cornell-reference") {
        return runPatina({"bake", "radiosity", scene, "-o", output, "--environment",
                          "builtin:white", "--subdivide", "0.05", "--resolution", "32", "--samples",
                          "8", "--exposure", exposure, "--json"});
    };
    const auto reexpose = [&](const std::string& solved, const std::string& output,
                              const char* exposure) {
        return runPatina({"bake", "radiosity", "--reexpose", solved, "-o", output, "--exposure",
                          exposure, "--json"});
    };
    const auto file = [&](const char* name, const std::string& kind) {
        return m_folder / (name + kind);
    };
    for (const std::string kind : {".glb", ".ply", ".gltf", ".dae"}) {
        SCOPED_TRACE(kind);
        ASSERT_EQ(bake(file("a", kind), "5").status, 0);
        ASSERT_EQ(bake(file("b", kind), "2").status, 0);
        const Outcome again = reexpose(file("a", kind), file("c", kind), "2");
        ASSERT_EQ(again.status, 0) << again.err;
        EXPECT_EQ(again.json()["exposure"], 2.0);
        if (kind == ".gltf") {
            EXPECT_NE(readBytes(file("a", ".bin")), readBytes(file("b", ".bin")));
            EXPECT_EQ(readBytes(file("c", ".bin")), readBytes(file("b", ".bin")));
        } else if (kind == ".dae") {
            std::istringstream wanted(readBytes(file("b", kind))),
                found(readBytes(file("c", kind)));
            std::size_t numbers = 0;
            for (std::string a, b; wanted >> a;) {
                ASSERT_TRUE(found >> b);
                char* end = nullptr;
                const double x = std::strtod(a.c_str(), &end);
                if (end == a.c_str())
                    continue; // a word, or a date
                ++numbers;
                ASSERT_NEAR(x, std::strtod(b.c_str(), nullptr), 2e-6 * std::max(1.0, std::abs(x)))
                    << a << " " << b;
            }
            EXPECT_GT(numbers, 1000u);
        } else {
            EXPECT_NE(readBytes(file("a", kind)), readBytes(file("b", kind)));
            EXPECT_EQ(readBytes(file("c", kind)), readBytes(file("b", kind)));
        }
        // Found again from what the file holds.
        const double automatic = bake(file("b", kind), "auto").json()["exposure"];
        const Outcome found = reexpose(file("a", kind), file("c", kind), "auto");
        EXPECT_NEAR(found.json()["exposure"].get<double>() / automatic, 1.0, 0.15);
    }

    // Below a texture colours show the light of a white surface, which is kept, too.
    ASSERT_EQ(bake(file("a", ".glb"), "5", "builtin:plane").status, 0);
    ASSERT_EQ(bake(file("b", ".glb"), "none", "builtin:plane").status, 0);
    EXPECT_THAT(readBytes(file("a", ".glb")), HasSubstr("_WHITE_RADIANCE"));
    ASSERT_EQ(reexpose(file("a", ".glb"), file("c", ".glb"), "none").status, 0);
    EXPECT_EQ(readBytes(file("c", ".glb")), readBytes(file("b", ".glb")));

    // What is no solved file, or none any more.
    for (const std::string kind : {".glb", ".gltf"}) {
        ASSERT_EQ(runPatina({"export", "builtin:plane", "-o", file("plain", kind)}).status, 0);
        const Outcome none = reexpose(file("plain", kind), file("x", kind), "2");
        EXPECT_EQ(none.status, 65);
        EXPECT_THAT(none.err, HasSubstr("holds no light"));
        EXPECT_THAT(none.err, HasSubstr("plain" + kind));
    }
    for (const std::string kind : {".glb", ".ply", ".dae"}) {
        const std::string whole = readBytes(file("a", kind));
        for (const std::size_t length : {whole.size() / 2, whole.size() / 20, std::size_t{3}}) {
            writeBytes(m_folder.path() / ("cut" + kind), whole.substr(0, length));
            const Outcome cut = reexpose(file("cut", kind), file("x", kind), "2");
            EXPECT_EQ(cut.status, 65) << kind << " " << length << " " << cut.err;
            EXPECT_THAT(cut.err, HasSubstr("cut" + kind));
        }
        EXPECT_FALSE(std::filesystem::exists(file("x", kind)));
    }
    const std::string solved = readBytes(file("a", ".ply"));
    const std::size_t faces = solved.find("element face "), end = solved.find("end_header\n");
    const std::string endless =
        solved.substr(0, faces) + "element face 999999999999999999\n" + solved.substr(end);
    for (const std::string& hostile :
         {std::string("ply\nformat binary_little_endian 1.0\nend_header\n"),
          std::string("ply\nformat binary_little_endian 1.0\nelement vertex 9\nend_header\n"),
          std::string("ply\nformat binary_little_endian 1.0\nproperty list\nend_header\n"),
          solved.substr(0, faces) +
              "element face 99999999\nproperty list uchar uint "
              "vertex_indices\n" +
              solved.substr(end)}) {
        writeBytes(m_folder.path() / "hostile.ply", hostile);
        EXPECT_EQ(reexpose(file("hostile", ".ply"), file("x", ".ply"), "2").status, 65);
    }
    writeBytes(m_folder.path() / "endless.ply", endless); // faces of nothing: none
    EXPECT_EQ(reexpose(file("endless", ".ply"), file("y", ".ply"), "2").status, 0);
    EXPECT_EQ(reexpose(file("a", ".glb"), file("x", ".ply"), "2").status, 2);
    EXPECT_EQ(reexpose(file("missing", ".glb"), file("x", ".glb"), "2").status, 66);
    EXPECT_EQ(reexpose(file("a", ".glb"), file("x", ".glb"), "-2").status, 2);
    const Outcome both = runPatina({"bake", "radiosity", "--reexpose", file("a", ".glb"), "-o",
                                    file("x", ".glb"), "--solver", "jacobi"});
    EXPECT_EQ(both.status, 2);
    EXPECT_THAT(both.err, HasSubstr("--solver"));
    const Outcome neither = runPatina({"bake", "radiosity", "-o", file("x", ".glb")});
    EXPECT_EQ(neither.status, 2);
    EXPECT_THAT(neither.err, HasSubstr("--reexpose"));
}

TEST_F(Commands, RadiosityIsWrittenPerTexel) {
    const auto bake = [&](const std::string& scene, const std::string& output,
                          std::vector<std::string> more) {
        std::vector<std::string> arguments{"bake",
                                           "radiosity",
                                           scene,
                                           "-o",
                                           output,
                                           "--set",
                                           "environment.enabled=false",
                                           "--subdivide",
                                           "0.05",
                                           "--resolution",
                                           "32",
                                           "--target",
                                           "texel",
                                           "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runPatina(arguments);
    };
    const std::string cornell = "builtin:cornell-reference";
    const Outcome outcome = bake(cornell, m_folder / "a.glb", {"--size", "128"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.json()["lightMap"]["size"], 128);
    EXPECT_GT(outcome.json()["lightMap"]["texels"], 128 * 128 / 4);
    EXPECT_EQ(load(m_folder / "a_light-map.exr").width(), 128);

    // The file, as glTF has it.
    const std::string file = readBytes(m_folder / "a.glb");
    std::uint32_t length = 0;
    std::memcpy(&length, file.data() + 12, 4);
    const nlohmann::json gltf = nlohmann::json::parse(file.substr(20, length));
    EXPECT_EQ(gltf["extras"]["patinaLightMap"]["radiance"], "a_light-map.exr");
    EXPECT_EQ(gltf["extras"]["patinaLightMap"]["exposure"], outcome.json()["exposure"]);
    ASSERT_EQ(gltf["textures"].size(), 1u) << "one of all materials";
    for (const nlohmann::json& material : gltf["materials"]) {
        EXPECT_EQ(material["emissiveTexture"]["index"], 0);
        EXPECT_EQ(material["emissiveTexture"]["texCoord"], 1);
        EXPECT_EQ(material["pbrMetallicRoughness"]["baseColorFactor"][0], 0.0);
        EXPECT_EQ(material["extensions"]["KHR_materials_specular"]["specularFactor"], 0.0);
        EXPECT_FALSE(material["extensions"].contains("KHR_materials_unlit"));
    }
    for (const nlohmann::json& mesh : gltf["meshes"]) {
        const nlohmann::json& attributes = mesh["primitives"][0]["attributes"];
        EXPECT_TRUE(attributes.contains("TEXCOORD_0"));
        EXPECT_TRUE(attributes.contains("TEXCOORD_1"));
        EXPECT_FALSE(attributes.contains("COLOR_0"));
    }

    // Meshes stay as they are, and open here with the light map where it belongs.
    const auto triangles = [&](const std::string& scene) {
        return runPatina({"info", scene, "--json"}).json()["counts"]["triangles"].get<int>();
    };
    EXPECT_EQ(triangles(m_folder / "a.glb"), triangles(cornell));
    ASSERT_EQ(bake(cornell, m_folder / "picture.exr", {"--size", "128"}).status, 0);
    EXPECT_EQ(readBytes(m_folder / "picture.exr"), readBytes(m_folder / "a_light-map.exr"));

    // As COLLADA: new, and into the document that it came from.
    ASSERT_EQ(bake(cornell, m_folder / "new.dae", {"--size", "128"}).status, 0);
    EXPECT_EQ(triangles(m_folder / "new.dae"), triangles(cornell));
    EXPECT_EQ(readBytes(m_folder / "new_light-map.exr"), readBytes(m_folder / "a_light-map.exr"));
    EXPECT_EQ(load(m_folder / "new_light-map.png").width(), 128);
    writeBytes(m_folder / "room.dae", kColladaRoom);
    const Outcome room =
        bake(m_folder / "room.dae", m_folder / "lit.dae", {"--size", "64", "--look", "gathered"});
    ASSERT_EQ(room.status, 0) << room.err;
    const std::string text = readBytes(m_folder / "lit.dae");
    EXPECT_THAT(text, HasSubstr("<!-- kept -->"));
    EXPECT_THAT(text, HasSubstr("<init_from>lit_light-map.png</init_from>"));
    EXPECT_EQ(triangles(m_folder / "lit.dae"), 6);
    const Outcome again = bake(m_folder / "lit.dae", m_folder / "twice.dae", {"--size", "64"});
    EXPECT_EQ(again.status, 2);
    EXPECT_THAT(again.err, HasSubstr("light map already"));

    // The same bytes for any number of threads.
    for (const char* threads : {"1", "7"}) {
        ASSERT_EQ(bake(cornell, m_folder / "b.gltf", {"--size", "64", "--threads", threads}).status,
                  0);
        for (const char* part : {"b.gltf", "b.bin", "b_light-map.png", "b_light-map.exr"}) {
            const std::string bytes = readBytes(m_folder / part);
            EXPECT_FALSE(bytes.empty()) << part;
            if (threads == std::string("1"))
                writeBytes(m_folder / (std::string("one-") + part), bytes);
            else
                EXPECT_TRUE(bytes == readBytes(m_folder / (std::string("one-") + part))) << part;
        }
    }

    // All files or none: where one of them cannot be, the others are not left.
    std::filesystem::create_directory(m_folder.path() / "c_light-map.exr");
    EXPECT_NE(bake(cornell, m_folder / "c.dae", {"--size", "64"}).status, 0);
    EXPECT_FALSE(std::filesystem::exists(m_folder / "c.dae"));
    EXPECT_FALSE(std::filesystem::exists(m_folder / "c_light-map.png"));

    const auto refused = [&](const std::string& output, std::vector<std::string> more,
                             const char* reason) {
        const Outcome wrong = bake(cornell, output, std::move(more));
        EXPECT_EQ(wrong.status, 2);
        EXPECT_THAT(wrong.err, HasSubstr(reason));
        EXPECT_FALSE(std::filesystem::exists(output));
    };
    for (const char* size : {"0", "-3", "4097", "64x64", "1.5", "nan", "big"})
        refused(m_folder / "x.glb", {"--size", size}, "from 1 to 4096");
    refused(m_folder / "x.glb", {"--size", "2"}, "use --size ");
    refused(m_folder / "x.ply", {}, "PLY has no textures");
    refused(m_folder / "x.png", {"--camera", "0,0"}, "--camera is for pictures");
}
