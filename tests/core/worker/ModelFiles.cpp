#include "tests/core/worker/ModelFiles.h"

#include "core/io/ImageIO.h"
#include "tests/core/worker/FbxWriter.h"

#include <cstring>
#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace patina::test {

using nlohmann::json;

namespace {

template <class T>
std::string raw(const std::vector<T>& values) {
    std::string bytes(values.size() * sizeof(T), '\0');
    if (!values.empty())
        std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

template <class T>
constexpr int componentType() {
    if constexpr (std::is_same_v<T, std::int8_t>)
        return 5120;
    else if constexpr (std::is_same_v<T, std::uint8_t>)
        return 5121;
    else if constexpr (std::is_same_v<T, std::int16_t>)
        return 5122;
    else if constexpr (std::is_same_v<T, std::uint16_t>)
        return 5123;
    else
        return 5125;
}

void word(std::string& out, std::uint32_t value) {
    char bytes[4];
    std::memcpy(bytes, &value, 4);
    out.append(bytes, 4);
}

} // namespace

GltfBuilder::GltfBuilder()
    : root({{"asset", {{"version", "2.0"}}},
            {"scene", 0},
            {"scenes", {{{"nodes", json::array()}}}},
            {"nodes", json::array()},
            {"meshes", json::array()},
            {"accessors", json::array()},
            {"bufferViews", json::array()}}) {}

int GltfBuilder::view(const std::string& bytes) {
    m_binary.resize((m_binary.size() + 3) / 4 * 4);
    root["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", m_binary.size()}, {"byteLength", bytes.size()}});
    m_binary += bytes;
    return static_cast<int>(root["bufferViews"].size()) - 1;
}

int GltfBuilder::accessor(const std::string& bytes, int type, int components, std::size_t count,
                          bool normalized) {
    static const char* const kTypes[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
    json accessor = {{"bufferView", view(bytes)},
                     {"componentType", type},
                     {"count", count},
                     {"type", components == 16 ? "MAT4" : kTypes[components - 1]}};
    if (normalized)
        accessor["normalized"] = true;
    root["accessors"].push_back(accessor);
    return static_cast<int>(root["accessors"].size()) - 1;
}

int GltfBuilder::floats(const std::vector<float>& values, int components) {
    return accessor(raw(values), 5126, components,
                    values.size() / static_cast<std::size_t>(components), false);
}

template <class T>
int GltfBuilder::integers(const std::vector<T>& values, int components, bool normalized) {
    return accessor(raw(values), componentType<T>(), components,
                    values.size() / static_cast<std::size_t>(components), normalized);
}
template int GltfBuilder::integers(const std::vector<std::int8_t>&, int, bool);
template int GltfBuilder::integers(const std::vector<std::uint8_t>&, int, bool);
template int GltfBuilder::integers(const std::vector<std::int16_t>&, int, bool);
template int GltfBuilder::integers(const std::vector<std::uint16_t>&, int, bool);
template int GltfBuilder::integers(const std::vector<std::uint32_t>&, int, bool);

int GltfBuilder::triangle(int material) {
    json primitive = {{"attributes",
                       {{"POSITION", floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, 3)},
                        {"NORMAL", floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, 3)},
                        {"TEXCOORD_0", floats({0, 1, 1, 1, 0, 0}, 2)}}},
                      {"indices", integers<std::uint16_t>({0, 1, 2}, 1)}};
    if (material >= 0)
        primitive["material"] = material;
    root["meshes"].push_back({{"name", "triangle"}, {"primitives", {primitive}}});
    return static_cast<int>(root["meshes"].size()) - 1;
}

int GltfBuilder::node(json node) {
    root["nodes"].push_back(std::move(node));
    const int index = static_cast<int>(root["nodes"].size()) - 1;
    root["scenes"][0]["nodes"].push_back(index);
    return index;
}

std::string GltfBuilder::glb() const {
    json document = root;
    document["buffers"] = {{{"byteLength", m_binary.size()}}};
    std::string text = document.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string binary = m_binary;
    binary.resize((binary.size() + 3) / 4 * 4);
    std::string out;
    word(out, 0x46546C67);
    word(out, 2);
    word(out, static_cast<std::uint32_t>(28 + text.size() + binary.size()));
    word(out, static_cast<std::uint32_t>(text.size()));
    word(out, 0x4E4F534A);
    out += text;
    word(out, static_cast<std::uint32_t>(binary.size()));
    word(out, 0x004E4942);
    return out + binary;
}

std::string GltfBuilder::gltf(const std::string& bufferUri) const {
    json document = root;
    document["buffers"] = {
        {{"byteLength", m_binary.size()},
         {"uri", bufferUri.empty() ? "data:application/octet-stream;base64," + base64(m_binary)
                                   : bufferUri}}};
    return document.dump();
}

std::string base64(const std::string& bytes) {
    static const char* const kAlphabet =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = (group << 8) |
                    (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            out += i + k > bytes.size() ? '=' : kAlphabet[(group >> (18 - 6 * k)) & 63];
    }
    return out;
}

std::string bytesOf(const Bytes& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

const char* const kObjMaterials = R"(newmtl red
Kd 0.8 0.1 0.05
Ks 0.5 0.5 0.5
Ns 48
Ke 0 0 0
newmtl wood
Kd 0.5 0.5 0.5
Ns 10
map_Kd wood.png
map_Bump wood_normal.png
)";

std::string daeQuad(const std::string& unit, const std::string& upAxis) {
    return fmt::format(R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><created>2020-01-01T00:00:00</created><modified>2020-01-01T00:00:00</modified>
<unit name="u" meter="{}"/><up_axis>{}</up_axis></asset>
<library_images><image id="img" name="img"><init_from>wood%20panel.png</init_from></image></library_images>
<library_effects><effect id="fx"><profile_COMMON>
<newparam sid="surf"><surface type="2D"><init_from>img</init_from></surface></newparam>
<newparam sid="samp"><sampler2D><source>surf</source></sampler2D></newparam>
<technique sid="common"><phong>
<emission><color>0 0 0 1</color></emission>
<diffuse><texture texture="samp" texcoord="UVMap"/></diffuse>
<shininess><float>30</float></shininess></phong></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="mat" name="oak"><instance_effect url="#fx"/></material></library_materials>
<library_geometries><geometry id="geo" name="board"><mesh>
<source id="pos"><float_array id="pos-a" count="12">0 0 0 1 0 0 1 2 0 0 2 0</float_array>
<technique_common><accessor source="#pos-a" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<source id="uv"><float_array id="uv-a" count="8">0 0 1 0 1 1 0 1</float_array>
<technique_common><accessor source="#uv-a" count="4" stride="2"><param name="S" type="float"/><param name="T" type="float"/></accessor></technique_common></source>
<vertices id="vtx"><input semantic="POSITION" source="#pos"/></vertices>
<triangles count="2" material="m"><input semantic="VERTEX" source="#vtx" offset="0"/>
<input semantic="TEXCOORD" source="#uv" offset="1" set="0"/>
<p>0 0 1 1 2 2 0 0 2 2 3 3</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="scene"><node id="n" name="plank">
<translate>10 20 30</translate>
<instance_geometry url="#geo"><bind_material><technique_common>
<instance_material symbol="m" target="#mat"/></technique_common></bind_material></instance_geometry>
</node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#scene"/></scene></COLLADA>)",
                       unit, upAxis);
}

namespace {

// A triangle in copies, morphed, skinned and with converted maps.
std::string posedTriangle(const std::string& png) {
    GltfBuilder gltf;
    gltf.root["images"] = {{{"bufferView", gltf.view(png)}, {"mimeType", "image/png"}}};
    gltf.root["textures"] = {{{"source", 0}}};
    gltf.root["materials"] = {{{"extensions",
                                {{"KHR_materials_pbrSpecularGlossiness",
                                  {{"diffuseTexture", {{"index", 0}}},
                                   {"specularGlossinessTexture", {{"index", 0}}}}}}}}};
    gltf.triangle(0);
    json& primitive = gltf.root["meshes"][0]["primitives"][0];
    primitive["targets"] = {{{"POSITION", gltf.floats({0, 0, 0, 4, 0, 0, 0, 0, 0}, 3)},
                             {"NORMAL", gltf.floats({0, 0, 0, 1, 0, 0, 0, 0, 0}, 3)}}};
    primitive["attributes"]["JOINTS_0"] =
        gltf.integers<std::uint8_t>({0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}, 4);
    primitive["attributes"]["WEIGHTS_0"] =
        gltf.floats({0.5f, 0.5f, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, 4);
    gltf.root["meshes"][0]["weights"] = {0.5};
    std::vector<float> bind(32, 0.0f);
    for (const std::size_t i : {0u, 5u, 10u, 15u, 16u, 21u, 26u, 31u})
        bind[i] = 1.0f;
    gltf.root["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", gltf.floats(bind, 16)}}};
    const json copies = {{"EXT_mesh_gpu_instancing",
                          {{"attributes", {{"TRANSLATION", gltf.floats({0, 0, 0, 5, 0, 0}, 3)}}}}}};
    gltf.node({{"mesh", 0}, {"skin", 0}});
    gltf.node({{"translation", {1, 0, 0}}, {"children", {2}}});
    gltf.root["nodes"].push_back({{"scale", {2, 2, 2}}});
    gltf.node({{"mesh", 0}, {"weights", {1}}, {"extensions", copies}});
    gltf.root["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    return gltf.glb();
}

} // namespace

std::map<std::string, std::vector<std::string>> seedFiles(WorkerClient& worker) {
    std::map<std::string, std::vector<std::string>> seeds;

    Image colors(24, 16, 3, PixelType::U8, ColorEncoding::Srgb);
    for (std::size_t i = 0; i < colors.u8().size(); ++i)
        colors.u8()[i] = static_cast<std::uint8_t>(i * 37 % 251);
    const Image floats = convertImage(colors, PixelType::F32, ColorEncoding::Linear);
    const auto add = [&](const char* kind, const Image& image, ImageFileFormat format,
                         bool half = false) {
        ImageSaveOptions options;
        options.half = half;
        const auto bytes = encodeImage(worker, image, format, options);
        EXPECT_TRUE(bytes.ok()) << bytes.error().text();
        if (bytes.ok())
            seeds[kind].push_back(bytesOf(*bytes));
    };
    add("png", colors, ImageFileFormat::Png);
    add("png", convertImage(colors, PixelType::U16, ColorEncoding::Srgb), ImageFileFormat::Png);
    add("jpg", colors, ImageFileFormat::Jpeg);
    add("exr", floats, ImageFileFormat::Exr);
    add("exr", floats, ImageFileFormat::Exr, true);
    add("hdr", floats, ImageFileFormat::Hdr);
    seeds["hdr"].push_back("#?RADIANCE\nFORMAT=32-bit_rle_xyze\nEXPOSURE=2\n\n+X 3 -Y 9\n" +
                           std::string("\x80\x70\x60\x81\x01\x01\x01\x08") +
                           std::string("\x90\x70\x60\x82\x01\x01\x01\x08") +
                           std::string("\xa0\x70\x60\x83\x01\x01\x01\x08"));

    GltfBuilder gltf;
    gltf.root["images"] = {{{"bufferView", gltf.view(seeds["png"].empty() ? "" : seeds["png"][0])},
                            {"mimeType", "image/png"}}};
    gltf.root["textures"] = {{{"source", 0}}};
    gltf.root["materials"] = {{{"name", "paint"},
                               {"pbrMetallicRoughness",
                                {{"baseColorTexture", {{"index", 0}}}, {"metallicFactor", 0.5}}}}};
    gltf.node({{"mesh", gltf.triangle(0)}, {"translation", {1, 2, 3}}});
    gltf.node({{"mesh", 0}, {"scale", {-1, 1, 1}}, {"name", "mirrored"}});
    seeds["glb"] = {gltf.glb(), posedTriangle(seeds["png"].empty() ? "" : seeds["png"][0])};
    seeds["gltf"] = {gltf.gltf()};

    seeds["obj"] = {"mtllib seed.mtl\no plank\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 0.5 1\n"
                    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\nusemtl wood\nf 1/1/1 2/2/1 3/3/1 "
                    "4/4/1\nusemtl red\ng top\nf 1 2 5\nf 2 3 5\nf -1 -3 -2\n"};
    seeds["obj"].emplace_back("mtllib seed.mtl\nv 2 2 0\nv 1 2 0\nv 0 2 0\nv 0 1 0\nv 1 1 0\n"
                              "v 1 0 0\nv 2 0 0\nusemtl red\nf 1 2 3 4 5 6 7\nf 1 2 3\n");
    seeds["fbx"] = {writeFbxText(fbxQuad()), writeFbxBinary(fbxQuad())};
    seeds["dae"] = {daeQuad("0.01", "Z_UP")};

    const std::string plyHeader = "element vertex 4\nproperty float x\nproperty float y\nproperty "
                                  "float z\nelement face 2\nproperty list uchar int "
                                  "vertex_indices\nend_header\n";
    seeds["ply"] = {"ply\nformat ascii 1.0\n" + plyHeader +
                        "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n",
                    "ply\nformat binary_little_endian 1.0\n" + plyHeader +
                        raw(std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}) + "\x03" +
                        raw(std::vector<std::int32_t>{0, 1, 2}) + "\x03" +
                        raw(std::vector<std::int32_t>{0, 2, 3})};
    const std::string plyVertices = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
                                    "property float y\nproperty float z\n";
    const std::string plyCorners = "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
    seeds["ply"].push_back(plyVertices +
                           "element face 1\nproperty list uchar int vertex_indices\n"
                           "property list uchar float texcoord\n" +
                           plyCorners + "4 0 1 2 3 8 0 0 1 0 1 1 0 1\n");
    seeds["ply"].push_back(plyVertices +
                           "element tristrips 1\nproperty list int int "
                           "vertex_indices\n" +
                           plyCorners + "4 0 1 3 2\n");
    std::string stl(80, ' ');
    word(stl, 2);
    for (int i = 0; i < 2; ++i)
        stl += raw(std::vector<float>{0, 0, 1, 0, 0, 0, 1, static_cast<float>(i), 0,
                                      1.0f - static_cast<float>(i), 1, 0}) +
               std::string(2, '\0');
    seeds["stl"] = {"solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 "
                    "1 0\nendloop\nendfacet\nendsolid s\n",
                    stl};
    return seeds;
}

std::vector<glm::vec3> ImportTest::corners(const ImportedModel& model, std::size_t index) {
    std::vector<glm::vec3> result;
    const ImportedInstance& instance = model.instances.at(index);
    const Mesh& mesh = *model.meshes.at(static_cast<std::size_t>(instance.mesh));
    for (const std::uint32_t i : mesh.indices)
        result.emplace_back(instance.transform * glm::vec4(mesh.positions.at(i), 1.0f));
    return result;
}

glm::vec3 ImportTest::areaVector(const ImportedModel& model, std::size_t index) {
    const auto points = corners(model, index);
    glm::vec3 sum(0.0f);
    for (std::size_t i = 0; i + 2 < points.size(); i += 3)
        sum += glm::cross(points[i + 1] - points[i], points[i + 2] - points[i]);
    return sum;
}

} // namespace patina::test
