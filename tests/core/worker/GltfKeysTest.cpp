// What `patina info` says of the keys of a glTF file, held against what the importer makes of them.
#include "core/io/ImageIO.h"
#include "core/material/MaterialInputs.h"
#include "core/mesh/MeshSource.h"
#include "tests/core/worker/ModelFiles.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <map>
#include <set>

namespace patina {
namespace {

using nlohmann::json;
using test::GltfBuilder;
using testing::HasSubstr;

class GltfKeys : public test::ImportTest {
  protected:
    std::vector<ModelKey> keysOf(const std::string& content) {
        Result<std::vector<ModelKey>> keys = gltfKeys(worker(), folder.write("keys.glb", content));
        EXPECT_TRUE(keys.ok()) << keys.error().text();
        return keys.ok() ? *std::move(keys) : std::vector<ModelKey>();
    }
    // The uses of a key, with reasons.
    static std::string useOf(const std::vector<ModelKey>& keys, const std::string& key) {
        constexpr const char* kUses[] = {"used", "kept", ""};
        std::string text;
        for (const ModelKey& row : keys)
            if (row.key == key)
                text += (text.empty() ? "" : "; ") + (kUses[static_cast<int>(row.use)] + row.why);
        return text;
    }
};

// How often each key stands in the file, written apart from the list.
void countKeys(const json& value, const std::string& path, std::map<std::string, std::size_t>& to) {
    if (value.is_array())
        for (const json& element : value)
            countKeys(element, path + "[]", to);
    if (value.is_object())
        for (const auto& [key, below] : value.items()) {
            const std::string full = path.empty() ? key : path + "." + key;
            ++to[full];
            countKeys(below, full, to);
        }
}

// A file with something of everything: no value is the one that a reader takes where it is absent.
GltfBuilder everything(WorkerClient& worker) {
    GltfBuilder builder;
    json& root = builder.root;
    const auto png = [&](std::uint8_t code) {
        Image image(1, 1, 4, PixelType::U8, ColorEncoding::Srgb);
        for (std::size_t c = 0; c < 4; ++c)
            image.u8()[c] = static_cast<std::uint8_t>(code + 30 * c);
        return test::bytesOf(encodeImage(worker, image, ImageFileFormat::Png).value());
    };
    const auto inlined = [](const std::string& bytes) {
        return "data:image/png;base64," + test::base64(bytes);
    };
    (void)builder.view("whose place is 0");
    root["images"] = {
        {{"bufferView", builder.view(png(40))}, {"mimeType", "image/png"}, {"name", "i"}},
        {{"uri", inlined(png(70))}},
        {{"uri", "data:image/webp;base64,AAAB"}},
        {{"uri", inlined(png(100))}}};
    root["samplers"] = {{{"wrapS", 33071}, {"magFilter", 9728}, {"name", "s"}}};
    root["textures"] = {{{"source", 0}, {"sampler", 0}, {"name", "t"}},
                        {{"source", 1}},
                        {{"extensions", {{"EXT_texture_webp", {{"source", 2}}}}}},
                        {{"source", 3}, {"extensions", {{"EXT_texture_webp", {{"source", 2}}}}}}};
    const auto texture = [](int index) {
        return json{
            {"index", index},
            {"texCoord", 0},
            {"extensions",
             {{"KHR_texture_transform",
               {{"offset", {0.25, 0.5}}, {"rotation", 0.5}, {"scale", {2, 3}}, {"texCoord", 1}}}}}};
    };
    json metal = {{"name", "Metal"},
                  {"doubleSided", true},
                  {"alphaMode", "MASK"},
                  {"alphaCutoff", 0.25},
                  {"emissiveFactor", {1, 0.5, 0.25}},
                  {"extras", {{"program", {{"version", 3}}}}},
                  {"pbrMetallicRoughness",
                   {{"baseColorFactor", {0.5, 0.25, 0.125, 0.75}},
                    {"baseColorTexture", texture(0)},
                    {"metallicFactor", 0.5},
                    {"roughnessFactor", 0.25},
                    {"metallicRoughnessTexture", texture(1)}}},
                  {"extensions",
                   {{"KHR_materials_ior", {{"ior", 1.25}}},
                    {"KHR_materials_volume",
                     {{"thicknessFactor", 1},
                      {"thicknessTexture", texture(0)},
                      {"attenuationColor", {0.5, 0.5, 0.5}},
                      {"attenuationDistance", 2}}},
                    {"KHR_materials_emissive_strength", {{"emissiveStrength", 4}}},
                    {"KHR_materials_transmission",
                     {{"transmissionFactor", 0.5}, {"transmissionTexture", texture(3)}}},
                    {"KHR_materials_pbrSpecularGlossiness", {{"glossinessFactor", 0.5}}},
                    {"KHR_materials_clearcoat", {{"clearcoatFactor", 1}}}}}};
    metal["normalTexture"] = texture(2);
    metal["normalTexture"]["scale"] = 0.5;
    metal["occlusionTexture"] = texture(1);
    metal["occlusionTexture"]["strength"] = 0.5;
    metal["emissiveTexture"] = {{"index", 0}, {"texCoord", 1}};
    root["materials"] = {metal,
                         {{"extensions",
                           {{"KHR_materials_unlit", json::object()},
                            {"KHR_materials_pbrSpecularGlossiness",
                             {{"diffuseFactor", {0.5, 0.5, 0.5, 1}},
                              {"diffuseTexture", {{"index", 0}}},
                              {"specularFactor", {0.0625, 0.0625, 0.0625}},
                              {"glossinessFactor", 0.25},
                              {"specularGlossinessTexture", {{"index", 1}}}}}}},
                          {"alphaCutoff", 0.25}},
                         {{"name", "Nobody's"}}};

    builder.triangle(0);
    const int indices = builder.integers<std::uint16_t>({2, 0, 1}, 1);
    root["meshes"][0]["primitives"][0]["indices"] = indices;
    json& body = root["meshes"][0]["primitives"][0];
    body["attributes"]["TEXCOORD_1"] =
        builder.integers<std::uint16_t>({0, 0, 65535, 0, 0, 32768}, 2, true);
    body["attributes"]["TANGENT"] = builder.floats({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, 4);
    body["attributes"]["COLOR_0"] = builder.floats({1, 0, 0, 0, 1, 0, 0, 0, 1}, 3);
    body["attributes"]["_MARK"] = builder.floats({1, 2, 3}, 1);
    body["attributes"]["JOINTS_0"] =
        builder.integers<std::uint8_t>({0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, 4);
    body["attributes"]["WEIGHTS_0"] =
        builder.floats({0.5, 0.5, 0, 0, 0.25, 0.75, 0, 0, 1, 0, 0, 0}, 4);
    body["targets"] = {{{"POSITION", builder.floats({0, 0, 0, 1, 0, 0, 0, 0, 0}, 3)},
                        {"NORMAL", builder.floats({1, 0, 0, 1, 0, 0, 1, 0, 0}, 3)},
                        {"TANGENT", builder.floats({0, 1, 0, 0, 1, 0, 0, 1, 0}, 3)},
                        {"TEXCOORD_0", 0}},
                       {{"POSITION", 0}}};
    root["meshes"][0]["weights"] = {0.5, 0};
    // A fan with normals by halves, sparse; then lines.
    std::string moved(16, '\0');
    const float values[] = {7, 3, 3, 0};
    std::memcpy(moved.data(), values, sizeof values);
    const int corners = builder.floats({0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0}, 3);
    root["accessors"][static_cast<std::size_t>(corners)]["min"] = {0, 0, 0};
    root["accessors"][static_cast<std::size_t>(corners)]["max"] = {2, 2, 0};
    root["accessors"][static_cast<std::size_t>(corners)]["sparse"] = {
        {"count", 1},
        {"indices",
         {{"bufferView", builder.view(std::string("\0\2", 2))},
          {"byteOffset", 1},
          {"componentType", 5121}}},
        {"values", {{"bufferView", builder.view(moved)}, {"byteOffset", 4}}}};
    const int normals = builder.integers<std::int8_t>(
        {0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0, 1, 2, 3, 4}, 4);
    json& compact = root["accessors"][static_cast<std::size_t>(normals)];
    compact["type"] = "VEC3";
    compact["count"] = 4;
    compact["byteOffset"] = 4;
    const auto view = compact["bufferView"].get<std::size_t>();
    root["bufferViews"][view]["byteStride"] = 4;
    root["bufferViews"][view]["target"] = 34962;
    root["meshes"].push_back(
        {{"name", "Fan"},
         {"primitives",
          {{{"mode", 6},
            {"material", 1},
            {"attributes", {{"POSITION", corners}, {"NORMAL", normals}, {"JOINTS_0", corners}}}},
           {{"mode", 6}, {"attributes", {{"POSITION", corners}, {"TANGENT", corners}}}},
           {{"mode", 1}, {"attributes", {{"POSITION", corners}}}}}}});
    root["meshes"].push_back({{"primitives", {{{"attributes", {{"POSITION", corners}}}}}}});

    std::vector<float> bind(32, 0.0f);
    for (const std::size_t i : {0u, 5u, 10u, 15u, 16u, 21u, 26u, 31u})
        bind[i] = 1.0f;
    bind[12] = 3.0f;
    root["skins"] = {{{"joints", {1, 2}},
                      {"inverseBindMatrices", builder.floats(bind, 16)},
                      {"skeleton", 1},
                      {"name", "Skin"}}};
    root["cameras"] = {
        {{"type", "perspective"},
         {"name", "Lens"},
         {"perspective", {{"yfov", 0.5}, {"aspectRatio", 2}, {"znear", 0.1}, {"zfar", 10}}}},
        {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}}}}};
    root["extensions"] = {{"KHR_lights_punctual",
                           {{"lights",
                             {{{"type", "spot"},
                               {"name", "Sun"},
                               {"color", {1, 0.5, 0.25}},
                               {"intensity", 3},
                               {"range", 7},
                               {"spot", {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}}}}}}}},
                          {"VENDOR_scene", {{"fog", 1}}}};
    root["extensionsUsed"] = {"KHR_lights_punctual", "VENDOR_scene"};
    root["asset"]["copyright"] = "me";
    root["extras"] = {{"a", 1}};
    root["animations"] = {{{"name", "Walk"}, {"channels", {{{"target", {{"path", "scale"}}}}}}}};

    builder.node({{"mesh", 0}, {"skin", 0}, {"name", "Body"}});
    builder.node({{"translation", {1, 0, 0}}, {"name", "Bone"}});
    builder.node({{"rotation", {0, 0, 0.5, 0.5}}});
    builder.node({{"mesh", 1}, {"name", "Fans"}, {"scale", {2, 2, 2}}, {"children", {4}}});
    root["nodes"].push_back({{"mesh", 1},
                             {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1}},
                             {"translation", {9, 9, 9}},
                             {"weights", {1}}});
    root["nodes"].back()["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", builder.floats({0, 0, 0, 3, 0, 0}, 3)},
        {"ROTATION", builder.floats({0, 0, 0, 1, 0, 0, 0.5, 0.5}, 4)},
        {"SCALE", builder.floats({1, 1, 1, 2, 2, 2}, 3)},
        {"_ID", builder.floats({0, 1}, 1)}};
    builder.node({{"camera", 0}, {"translation", {0, 0, 9}}});
    builder.node({{"camera", 1}, {"name", "Flat"}});
    builder.node({{"name", "Light"}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    root["nodes"].push_back({{"mesh", 2}, {"name", "Elsewhere"}});
    const json other = {{"nodes", {8}}, {"name", "Other"}};
    root["scenes"].insert(root["scenes"].begin(), other);
    root["scene"] = 1;
    return builder;
}

// All that comes of a file but its notes.
json describe(const ImportedModel& model) {
    json all;
    for (const std::shared_ptr<Mesh>& mesh : model.meshes)
        all["meshes"].push_back({mesh->name, hashMesh(*mesh).hex()});
    const auto map = [](const std::optional<ImportedTexture>& t) {
        return t ? json{t->file.string(), t->embedded,   t->channel,    t->uvScale.x,
                        t->uvScale.y,     t->uvOffset.x, t->uvOffset.y, t->uvRotationDeg}
                 : json();
    };
    const auto color = [](const auto& c) { return json{c[0], c[1], c[2]}; };
    std::vector<json> materials; // those that nothing uses do not come into the document
    for (const ImportedMaterial& m : model.materials) {
        json material = {m.name,
                         color(m.baseColor),
                         m.baseColor.a,
                         color(m.emissive),
                         m.doubleSided,
                         m.alphaMask,
                         m.alphaBlend,
                         m.alphaCutoff,
                         m.ior,
                         m.thinWalled,
                         color(m.attenuationColor),
                         m.attenuationDistance};
        for (const MaterialInputInfo& info : kMaterialInputs) {
            material.push_back(m.numbers[info.input]);
            material.push_back(map(m.maps[info.input]));
        }
        materials.push_back(material);
    }
    for (const ImportedInstance& i : model.instances) {
        json instance = {i.name, i.mesh, materials[static_cast<std::size_t>(i.material)], i.node};
        for (int k = 0; k < 16; ++k)
            instance.push_back(i.transform[k / 4][k % 4]);
        all["instances"].push_back(instance);
    }
    for (const ImportedLight& l : model.lights)
        all["lights"].push_back({l.name, static_cast<int>(l.type), color(l.position),
                                 color(l.direction), color(l.color), l.range, l.innerConeDeg,
                                 l.outerConeDeg});
    for (const ImportedCamera& c : model.cameras)
        all["cameras"].push_back(
            {c.name, color(c.position), color(c.forward), color(c.up), c.fovDeg});
    for (const Bytes& image : model.embeddedImages)
        all["images"].push_back(test::bytesOf(image));
    return all;
}

// The file without one key of all elements of one row's arrays, one occurrence at a time.
void forEachOccurrence(json& value, const std::string& path, const std::string& wanted,
                       const std::function<void(json&, const std::string&)>& f) {
    if (value.is_array())
        for (json& element : value)
            forEachOccurrence(element, path + "[]", wanted, f);
    if (!value.is_object())
        return;
    std::vector<std::string> keys;
    for (const auto& item : value.items())
        keys.push_back(item.key());
    for (const std::string& key : keys) {
        const std::string full = path.empty() ? key : path + "." + key;
        if (full == wanted)
            f(value, key);
        else if (wanted.starts_with(full))
            forEachOccurrence(value[key], full, wanted, f);
    }
}

TEST_F(GltfKeys, EachKeyOfTheFileIsListed) {
    const GltfBuilder builder = everything(worker());
    std::map<std::string, std::size_t> listed, there;
    const std::string glb = builder.glb();
    const std::vector<ModelKey> keys = keysOf(glb);
    for (const ModelKey& key : keys) {
        listed[key.key] += key.count;
        EXPECT_EQ(key.why.empty(), key.use != KeyUse::LeftOut) << key.key;
    }
    std::uint32_t length = 0; // of the JSON that was written
    std::memcpy(&length, glb.data() + 12, sizeof length);
    countKeys(json::parse(glb.substr(20, length)), "", there);
    EXPECT_EQ(listed, there);

    EXPECT_THAT(useOf(keys, "materials[].extensions.KHR_materials_unlit"), HasSubstr("shaded"));
    EXPECT_THAT(useOf(keys, "meshes[].primitives[].attributes.COLOR_0"),
                HasSubstr("vertex colours are not shown"));
    EXPECT_THAT(useOf(keys, "animations"), HasSubstr("animation is not read"));
    EXPECT_EQ(useOf(keys, "materials[].pbrMetallicRoughness.metallicFactor"), "used");
    EXPECT_EQ(useOf(keys, "materials[].name"), "kept; nothing that is shown uses it");
    EXPECT_THAT(useOf(keys, "extensions.VENDOR_scene.fog"), HasSubstr("not supported"));
    EXPECT_THAT(useOf(keys, "nodes[].mesh"), "used; nothing that is shown uses it");
}

// Taking out a key that is used changes what is imported, or the file is refused; one that is left
// out changes nothing.
TEST_F(GltfKeys, UseIsWhatTheImporterMakesOfThem) {
    const GltfBuilder builder = everything(worker());
    const std::vector<ModelKey> keys = keysOf(builder.glb());
    const json whole = describe(import("whole.glb", builder.glb()));
    std::map<std::string, std::size_t> changes, refusals, counts;
    std::set<std::string> paths;
    for (const ModelKey& key : keys) {
        paths.insert(key.key);
        if (key.use != KeyUse::LeftOut)
            counts[key.key] += key.count;
    }
    for (const std::string& path : paths) {
        GltfBuilder copy = builder;
        std::size_t number = 0;
        forEachOccurrence(copy.root, "", path, [&](json&, const std::string&) { ++number; });
        for (std::size_t wanted = 0; wanted < number; ++wanted) {
            copy = builder;
            std::size_t at = 0;
            forEachOccurrence(copy.root, "", path, [&](json& object, const std::string& key) {
                if (at++ == wanted)
                    object.erase(key);
            });
            const Result<ImportedModel> model =
                importModel(worker(), folder.write("less.glb", copy.glb()));
            changes[path] += model.ok() && describe(*model) != whole ? 1 : 0;
            refusals[path] += model.ok() ? 0 : 1;
        }
    }
    for (const std::string& path : paths)
        if (path != "extensionsUsed" && path != "buffers") { // notes; written by the builder
            EXPECT_LE(changes[path], counts[path]) << path << ": " << useOf(keys, path);
            EXPECT_GE(changes[path] + refusals[path], counts[path])
                << path << ": " << useOf(keys, path);
        }
}

TEST_F(GltfKeys, DamagedFilesAreRefused) {
    for (const char* text : {"[]", "{", R"({"nodes":[{"children":["a"]}]})"}) {
        const Result<std::vector<ModelKey>> keys =
            gltfKeys(worker(), folder.write("broken.gltf", std::string_view(text)));
        EXPECT_FALSE(keys.ok()) << text;
    }
    std::string deep;
    for (int i = 0; i < 5000; ++i)
        deep += R"({"a":)";
    deep += "1" + std::string(5000, '}');
    const Result<std::vector<ModelKey>> keys =
        gltfKeys(worker(), folder.write("deep.gltf", std::string_view(deep)));
    ASSERT_FALSE(keys.ok());
    EXPECT_THAT(keys.error().message, HasSubstr("nested too deeply"));
}

} // namespace
} // namespace patina
