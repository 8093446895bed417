// patina bake radiosity --reexpose of files whose light is in a light map.
#include "CommandsFixture.h"

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <regex>
#include <set>

using namespace patina;
using namespace patina::test;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* kExr = "_light-map.exr";

class ReexposedLightMaps : public Commands {
  protected:
    [[nodiscard]] std::string path(const std::string& name) const {
        const fs::path file = m_folder / name;
        fs::create_directories(file.parent_path());
        return file.string();
    }
    // The Cornell box.
    Outcome bake(const std::string& output, const char* exposure) const {
        const Outcome outcome = runPatina({"bake",
                                           "radiosity",
                                           "builtin:cornell-reference",
                                           "-o",
                                           path(output),
                                           "--set",
                                           "environment.enabled=false",
                                           "--subdivide",
                                           "0.1",
                                           "--resolution",
                                           "32",
                                           "--samples",
                                           "8",
                                           "--target",
                                           "texel",
                                           "--size",
                                           "64",
                                           "--exposure",
                                           exposure,
                                           "--json"});
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return outcome;
    }
    Outcome reexpose(const std::string& solved, const std::string& output,
                     const char* exposure) const {
        return runPatina({"bake", "radiosity", "--reexpose", path(solved), "-o", path(output),
                          "--exposure", exposure, "--json"});
    }
    [[nodiscard]] std::string bytes(const std::string& name) const {
        return readBytes(m_folder / name);
    }
    [[nodiscard]] bool exists(const std::string& name) const {
        return fs::exists(m_folder.path() / name);
    }
    // Names of a folder's files.
    [[nodiscard]] std::set<std::string> filesOf(const std::string& folder) const {
        std::set<std::string> names;
        for (const fs::directory_entry& entry : fs::directory_iterator(m_folder.path() / folder))
            names.insert(entry.path().filename().string());
        return names;
    }
    // As patina writes it, but with other attributes or none.
    void saveExr(const std::string& name, Image image,
                 const std::map<std::string, std::string>& attributes, bool half = false) {
        std::vector<ImagePart> parts(1);
        parts[0].image = std::move(image);
        parts[0].attributes = attributes;
        const Result<Bytes> encoded =
            encodeImage(m_worker, std::move(parts), ImageFileFormat::Exr, {.half = half});
        ASSERT_TRUE(encoded.ok());
        writeBytes(path(name),
                   std::string(reinterpret_cast<const char*>(encoded->data()), encoded->size()));
    }
};

// All but the date of a document.
std::string withoutDate(const std::string& collada) {
    static const std::regex kDate("<(created|modified)>[^<]*</");
    return std::regex_replace(collada, kDate, "<$1></");
}

struct Glb {
    Json json;
    std::string binary, rest; // of its binary chunk, and what follows that
};

std::uint32_t wordAt(const std::string& file, std::size_t offset) {
    std::uint32_t word = 0;
    std::memcpy(&word, file.data() + offset, 4);
    return word;
}

// Of a file that keeps the rules of the format.
Glb unpacked(const std::string& file) {
    EXPECT_EQ(wordAt(file, 8), file.size());
    const std::size_t json = wordAt(file, 12), binary = wordAt(file, 20 + json);
    EXPECT_EQ(json % 4, 0u);
    EXPECT_EQ(binary % 4, 0u);
    Glb glb{Json::parse(file.substr(20, json)), file.substr(28 + json, binary),
            file.substr(28 + json + binary)};
    const std::size_t length = glb.json["buffers"][0]["byteLength"];
    EXPECT_LE(length, binary);
    EXPECT_LT(binary - length, 4u);
    for (const Json& view : glb.json["bufferViews"]) {
        const std::size_t offset = view.value("byteOffset", 0u);
        EXPECT_EQ(offset % 4, 0u);
        EXPECT_LE(offset + view["byteLength"].get<std::size_t>(), length);
    }
    return glb;
}

std::string packed(const Glb& glb) {
    std::string file("glTF\2\0\0\0\0\0\0\0", 12), json = glb.json.dump(), binary = glb.binary;
    json.resize((json.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    const auto chunk = [&](const std::string& data, const char* kind) {
        const auto length = static_cast<std::uint32_t>(data.size());
        file.append(reinterpret_cast<const char*>(&length), 4).append(kind, 4).append(data);
    };
    chunk(json, "JSON");
    chunk(binary, "BIN\0");
    file += glb.rest;
    const auto length = static_cast<std::uint32_t>(file.size());
    std::memcpy(file.data() + 8, &length, 4);
    return file;
}

std::string viewOf(const Glb& glb, std::size_t index) {
    const Json& view = glb.json["bufferViews"][index];
    return glb.binary.substr(view.value("byteOffset", 0u), view["byteLength"]);
}

TEST_F(ReexposedLightMaps, AreTheFilesOfABakeWithThatExposure) {
    for (const std::string kind : {".glb", ".gltf", ".dae"}) {
        SCOPED_TRACE(kind);
        const std::string name = "room" + kind;
        bake("solved/" + name, "5");
        const std::string before = bytes("solved/" + name);
        for (const std::string exposure : {"2", "none", "auto"}) {
            SCOPED_TRACE(exposure);
            const Outcome wanted = bake("baked/" + name, exposure.c_str());
            const Outcome outcome = reexpose("solved/" + name, "again/" + name, exposure.c_str());
            ASSERT_EQ(outcome.status, 0) << outcome.err;
            EXPECT_EQ(outcome.json().value("exposure", 0.0),
                      wanted.json().value("exposure", 0.0)); // exactly, also the automatic one
            EXPECT_EQ(outcome.json()["lightMap"]["size"], 64);
            EXPECT_EQ(outcome.json()["outputs"].size(), filesOf("again").size());

            ASSERT_EQ(filesOf("again"), filesOf("baked"));
            for (const std::string& file : filesOf("baked")) {
                if (file == "room.dae")
                    EXPECT_EQ(withoutDate(bytes("again/" + file)),
                              withoutDate(bytes("baked/" + file)));
                else
                    EXPECT_TRUE(bytes("again/" + file) == bytes("baked/" + file)) << file;
            }
            fs::remove_all(m_folder.path() / "again");
            fs::remove_all(m_folder.path() / "baked");
        }
        EXPECT_TRUE(bytes("solved/" + name) == before);
        fs::remove_all(m_folder.path() / "solved");
    }
}

TEST_F(ReexposedLightMaps, TakeTheirPlaceOrAnotherName) {
    for (const std::string kind : {".glb", ".gltf", ".dae"}) {
        SCOPED_TRACE(kind);
        bake("a" + kind, "5");
        const std::string first = bytes("a" + kind), light = bytes(std::string("a") + kExr);

        // Another name: that of a bake, and again a file that can be exposed anew.
        bake("other/b" + kind, "2");
        ASSERT_EQ(reexpose("a" + kind, "b" + kind, "2").status, 0);
        EXPECT_EQ(bytes(std::string("b") + kExr), light);
        if (kind == ".dae") { // ids stay
            EXPECT_THAT(bytes("b.dae"), HasSubstr("<init_from>b_light-map.png</init_from>"));
            EXPECT_THAT(bytes("b.dae"), HasSubstr(">b_light-map.exr</light_map>"));
            EXPECT_THAT(bytes("b.dae"), Not(HasSubstr(">a_light-map")));
        }
        for (const std::string& file : filesOf("other"))
            if (file != "b.dae") {
                EXPECT_TRUE(bytes(file) == bytes("other/" + file)) << file;
            }

        // In place, and back.
        ASSERT_EQ(reexpose("b" + kind, "b" + kind, "5").status, 0);
        ASSERT_EQ(reexpose("a" + kind, "a" + kind, "2").status, 0);
        for (const std::string& file : filesOf("other"))
            if (file.ends_with(".png")) {
                const std::string own = "a" + file.substr(1);
                EXPECT_TRUE(bytes(own) == bytes("other/" + file));
                EXPECT_FALSE(bytes(own) == bytes(file));
            }
        if (kind != ".dae") { // which does not say its exposure
            EXPECT_FALSE(bytes("a" + kind) == first);
        }
        ASSERT_EQ(reexpose("a" + kind, "a" + kind, "5").status, 0);
        EXPECT_TRUE(bytes("a" + kind) == first);
        EXPECT_EQ(bytes(std::string("a") + kExr), light);
        for (const std::string& file : m_folder.files())
            fs::remove_all(m_folder.path() / file);
    }
}

// What belongs to a file is beside it, not beside a link to it.
TEST_F(ReexposedLightMaps, AreReplacedBehindALink) {
    bake("a.gltf", "5");
    bake("b/a.gltf", "2");
    fs::create_symlink("../a.gltf", path("links/a.gltf"));
    ASSERT_EQ(reexpose("a.gltf", "links/a.gltf", "2").status, 0);
    EXPECT_THAT(filesOf("links"), ElementsAre("a.gltf"));
    EXPECT_TRUE(fs::is_symlink(m_folder / "links/a.gltf"));
    for (const std::string& file : filesOf("b"))
        EXPECT_TRUE(bytes(file) == bytes("b/" + file)) << file;
}

TEST_F(ReexposedLightMaps, KeepWhatOtherProgramsHaveAdded) {
    bake("a.glb", "5");
    Glb glb = unpacked(bytes("a.glb"));
    const std::size_t image = 0, map = glb.json["images"][image]["bufferView"];
    const std::string geometry = viewOf(glb, 0);
    // Data behind the picture, an image that nobody shows, notes, and a chunk of somebody else's.
    const std::string added = "seven b";
    glb.binary.resize((glb.json["buffers"][0]["byteLength"].get<std::size_t>() + 3) / 4 * 4);
    glb.json["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", glb.binary.size()}, {"byteLength", added.size()}});
    glb.binary += added;
    glb.json["buffers"][0]["byteLength"] = glb.binary.size();
    const std::size_t own = glb.json["bufferViews"].size() - 1;
    glb.json["images"].push_back({{"bufferView", own}, {"mimeType", "image/png"}});
    glb.json["extras"]["notes"] = {{"by", "hand"}, {"number", 0.1}};
    glb.json["materials"].push_back({{"name", "glow"}, {"emissiveFactor", {1, 0.5, 0.25}}});
    glb.rest = std::string("\4\0\0\0OWN0four", 12);
    writeBytes(path("changed.glb"), packed(glb));

    for (const char* exposure : {"0.2", "50", "none"}) {
        SCOPED_TRACE(exposure);
        bake("b.glb", exposure);
        const Glb wanted = unpacked(bytes("b.glb"));
        ASSERT_EQ(reexpose("changed.glb", "changed.glb", exposure).status, 0);
        const Glb again = unpacked(bytes("changed.glb"));
        EXPECT_TRUE(viewOf(again, map) == viewOf(wanted, map));
        EXPECT_TRUE(viewOf(again, 0) == geometry);
        EXPECT_EQ(viewOf(again, own), added);
        EXPECT_EQ(again.rest, glb.rest);
        Json expected = glb.json;
        for (const char* number : {"byteOffset", "byteLength"})
            for (const std::size_t view : {map, own})
                expected["bufferViews"][view][number] = again.json["bufferViews"][view][number];
        expected["buffers"] = again.json["buffers"];
        expected["extras"]["patinaLightMap"]["exposure"] =
            wanted.json["extras"]["patinaLightMap"]["exposure"];
        EXPECT_EQ(again.json, expected);
    }

    // A .gltf takes its pictures along, and keeps what it has in one folder.
    bake("room.gltf", "5");
    Json gltf = Json::parse(bytes("room.gltf"));
    gltf["images"].push_back({{"uri", "pictures/wood%20dark.png"}});
    gltf["extras"]["notes"] = "kept";
    writeBytes(path("room.gltf"), gltf.dump());
    writeBytes(path("pictures/wood dark.png"), "wood");
    ASSERT_EQ(reexpose("room.gltf", "moved/hall.gltf", "2").status, 0);
    EXPECT_EQ(bytes("moved/pictures/wood dark.png"), "wood");
    Json moved = Json::parse(bytes("moved/hall.gltf"));
    EXPECT_EQ(moved["extras"]["notes"], "kept");
    EXPECT_EQ(moved["images"][0]["uri"], "hall_light-map.png");
    EXPECT_EQ(moved["images"][1], gltf["images"][1]);
    EXPECT_EQ(moved["buffers"][0]["uri"], "hall.bin");
    EXPECT_EQ(moved["extras"]["patinaLightMap"]["radiance"], "hall_light-map.exr");
    EXPECT_EQ(bytes("moved/hall.bin"), bytes("room.bin"));
}

TEST_F(ReexposedLightMaps, AreAPictureOfTheMapAlone) {
    const Outcome solved = bake("map.exr", "5");
    for (const char* exposure : {"2", "none", "auto"}) {
        bake("wanted.png", exposure);
        ASSERT_EQ(reexpose("map.exr", "map.png", exposure).status, 0);
        EXPECT_TRUE(bytes("map.png") == bytes("wanted.png")) << exposure;
    }
    EXPECT_EQ(solved.json()["exposure"], 5.0);
    const Outcome wrong = reexpose("map.exr", "map.glb", "2");
    EXPECT_EQ(wrong.status, 2);
    EXPECT_THAT(wrong.err, HasSubstr(".png"));
    EXPECT_FALSE(exists("map.glb"));
}

TEST_F(ReexposedLightMaps, OfOlderVersionsHaveNoAutomaticExposure) {
    bake("a.glb", "5");
    bake("b/a.glb", "2");
    saveExr(std::string("a") + kExr, load(m_folder / (std::string("a") + kExr)), {});
    const Outcome automatic = reexpose("a.glb", "c/a.glb", "auto");
    EXPECT_EQ(automatic.status, 2);
    EXPECT_THAT(automatic.err, HasSubstr("automatic exposure"));
    EXPECT_THAT(automatic.err, HasSubstr("a_light-map.exr"));
    EXPECT_FALSE(exists("c/a.glb"));
    ASSERT_EQ(reexpose("a.glb", "c/a.glb", "2").status, 0);
    EXPECT_TRUE(bytes("c/a.glb") == bytes("b/a.glb"));
}

TEST_F(ReexposedLightMaps, SayWhatIsWrongWithThemAndWriteNothing) {
    bake("a.glb", "5");
    bake("a.dae", "5");
    const std::string map = std::string("a") + kExr, light = bytes(map), glb = bytes("a.glb");
    const Image radiance = load(m_folder / map);
    const auto refused = [&](const std::string& solved, int status, const std::string& reason,
                             const std::string& named) {
        SCOPED_TRACE(reason);
        const std::string output = "x/x" + fs::path(solved).extension().string();
        const Outcome outcome = reexpose(solved, output, "2");
        EXPECT_EQ(outcome.status, status) << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr(reason));
        EXPECT_THAT(outcome.err, HasSubstr(named));
        EXPECT_THAT(filesOf("x"), ElementsAre());
    };
    const std::map<std::string, std::string> kept{{"patina:automaticExposure", "1.5"}};
    Image broken = radiance;
    broken.f32()[7] = std::numeric_limits<float>::quiet_NaN();
    Image endless = radiance;
    endless.f32()[7] = std::numeric_limits<float>::infinity();
    const Image wide(64, 32, 3, PixelType::F32, ColorEncoding::Linear),
        four(64, 64, 4, PixelType::F32, ColorEncoding::Linear),
        small(32, 32, 3, PixelType::F32, ColorEncoding::Linear);

    for (const std::string solved : {"a.glb", "a.dae"}) {
        SCOPED_TRACE(solved);
        fs::remove(m_folder / map);
        refused(solved, 66, "is not beside it", map);
        saveExr(map, small, kept);
        refused(solved, 65, "not of one bake", map);
        saveExr(map, broken, kept);
        refused(solved, 65, "not finite", map);
        saveExr(map, endless, kept);
        refused(solved, 65, "not finite", map);
        saveExr(map, wide, kept);
        refused(solved, 65, "no light map that patina bake radiosity", map);
        saveExr(map, four, kept);
        refused(solved, 65, "no light map that patina bake radiosity", map);
        saveExr(map, radiance, {}, true); // of an export
        refused(solved, 65, "no light map that patina bake radiosity", map);
        saveExr(map, radiance, {{"patina:kind", "ao"}});
        refused(solved, 65, "no light map that patina bake radiosity", map);
        saveExr(map, radiance, {{"patina:automaticExposure", "-1"}});
        refused(solved, 65, "no number above 0", map);
        writeBytes(path(map), "a text");
        refused(solved, 65, "no image", map);
        for (const std::size_t length : {std::size_t{9}, light.size() / 2}) {
            writeBytes(path(map), light.substr(0, length));
            refused(solved, 65, "damaged", map);
        }
        writeBytes(path(map), light);
        EXPECT_EQ(reexpose(solved, solved, "2").status, 0);
    }

    // The file itself.
    for (const std::size_t length : {glb.size() / 2, glb.size() / 20, std::size_t{3}}) {
        writeBytes(path("cut.glb"), glb.substr(0, length));
        refused("cut.glb", 65, "cut.glb", "cut.glb");
    }
    const auto changed = [&](const std::function<void(Json&)>& change, const std::string& reason) {
        Glb parts = unpacked(glb);
        change(parts.json);
        writeBytes(path("changed.glb"), packed(parts));
        refused("changed.glb", 65, reason, "changed.glb");
    };
    changed([](Json& json) { json["extras"]["patinaLightMap"]["radiance"] = "../a_light-map.exr"; },
            "no file beside it");
    changed([](Json& json) { json["extras"]["patinaLightMap"]["radiance"] = "/a_light-map.exr"; },
            "no file beside it");
    changed([](Json& json) { json["extras"]["patinaLightMap"].erase("radiance"); },
            "no file beside it");
    changed([](Json& json) { json["extras"]["patinaLightMap"]["radiance"] = 3; },
            "not as glTF 2.0 has it");
    changed([](Json& json) { json["materials"] = 3; }, "another program has changed it");
    changed([](Json& json) { json.erase("materials"); }, "another program has changed it");
    changed([](Json& json) { json["textures"][0]["extensions"]["EXT_texture_webp"]["source"] = 0; },
            "EXT_texture_webp");
    changed([](Json& json) { json["textures"][0]["source"] = 99; }, "no element 99");
    changed([](Json& json) { json["bufferViews"].back()["byteLength"] = 1 << 30; },
            "not all there");
    changed([](Json& json) { json["buffers"][0]["byteLength"] = 1 << 30; }, "ends before");
    changed(
        [](Json& json) {
            Json overlapping = json["bufferViews"].back();
            overlapping["byteLength"] = 4;
            json["bufferViews"].push_back(overlapping);
        },
        "shares bytes");
    ASSERT_EQ(runPatina({"bake", "radiosity", "builtin:plane", "-o", path("vertices.glb"),
                         "--subdivide", "0.5"})
                  .status,
              0);
    Glb both = unpacked(bytes("vertices.glb"));
    both.json["extras"]["patinaLightMap"] = unpacked(glb).json["extras"]["patinaLightMap"];
    writeBytes(path("both.glb"), packed(both));
    refused("both.glb", 65, "light at vertices and light in a light map", "both.glb");
    std::string collada = bytes("a.dae");
    const std::string named = ">a_light-map.exr<";
    for (std::size_t at = 0; (at = collada.find(named)) != std::string::npos;)
        collada.replace(at, named.size(), ">../a_light-map.exr<");
    writeBytes(path("up.dae"), collada);
    refused("up.dae", 65, "no file beside it", "up.dae");
}

TEST_F(ReexposedLightMaps, LeaveWhatWasThereWhenAFileCannotBeWritten) {
    bake("a.gltf", "5");
    writeBytes(path("b.gltf"), "before");
    writeBytes(path("b_light-map.png"), "picture");
    fs::create_directory(m_folder.path() / "b.bin");
    const Outcome failed = reexpose("a.gltf", "b.gltf", "2");
    EXPECT_EQ(failed.status, 73) << failed.err;
    EXPECT_THAT(failed.err, HasSubstr("b.bin"));
    EXPECT_EQ(bytes("b.gltf"), "before");
    EXPECT_EQ(bytes("b_light-map.png"), "picture");
    EXPECT_FALSE(exists("b_light-map.exr"));
}

} // namespace
