#include "ExportScene.h"
#include "core/base/Id.h"
#include "core/document/Document.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/mesh/Mesh.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gmock/gmock.h>
#include <map>
#include <string_view>

using namespace patina;
using namespace patina::test;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

TEST(GltfWriter, WritesGeometryExactly) {
    Document document;
    addSquare(document, 0);
    ReadGltf gltf = write(document);
    EXPECT_EQ(gltf.json["asset"]["version"], "2.0");
    EXPECT_THAT(gltf.json["asset"]["generator"].get<std::string>(), HasSubstr("Patina "));
    EXPECT_EQ(gltf.attribute<glm::vec3>(0, "POSITION"), squareMesh()->positions);
    EXPECT_EQ(gltf.attribute<glm::vec3>(0, "NORMAL"), squareMesh()->normals);
    EXPECT_EQ(gltf.attribute<glm::vec2>(0, "TEXCOORD_0"), squareMesh()->uvs);
    Json& primitive = gltf.json["meshes"][0]["primitives"][0];
    EXPECT_FALSE(primitive["attributes"].contains("TANGENT")); // no normal map wants it
    EXPECT_FALSE(primitive.contains("material"));
    EXPECT_THAT(gltf.values<std::uint16_t>(primitive["indices"].get<int>()),
                ElementsAre(0, 1, 2, 0, 2, 3));
    Json& position = gltf.json["accessors"][primitive["attributes"]["POSITION"].get<int>()];
    EXPECT_EQ(position["min"], Json({0, 0, 0}));
    EXPECT_EQ(position["max"], Json({1, 1, 0}));
    EXPECT_EQ(gltf.json["buffers"][0]["byteLength"], gltf.buffer.size());
    EXPECT_FALSE(gltf.json.contains("materials")); // empty arrays are not allowed
    EXPECT_FALSE(gltf.json.contains("textures"));
    EXPECT_FALSE(gltf.json.contains("extensionsUsed"));
}

TEST(GltfWriter, BoundsAreThoseOfTheStoredFloats) {
    Mesh mesh = *squareMesh();
    mesh.positions[1].x = 0.1f;
    mesh.positions.push_back({9.3f, 0, -7.7f}); // used by no triangle, but part of the accessor
    mesh.normals.push_back({0, 0, 1});
    mesh.tangents.push_back({1, 0, 0, 1});
    mesh.uvs.push_back({0, 0});
    Document document;
    addSquare(document, 0, std::make_shared<const Mesh>(mesh));
    Json position = write(document).json["accessors"][0];
    EXPECT_EQ(position["max"][0].get<double>(), static_cast<double>(9.3f));
    EXPECT_EQ(position["min"][2].get<double>(), static_cast<double>(-7.7f));
}

TEST(GltfWriter, IndicesAreAsWideAsTheyMustBe) {
    for (const std::size_t count : {65535u, 65536u}) {
        Mesh mesh = *squareMesh();
        mesh.positions.resize(count);
        mesh.normals.resize(count, {0, 0, 1});
        mesh.tangents.resize(count, {1, 0, 0, 1});
        mesh.uvs.resize(count);
        mesh.indices[5] = static_cast<std::uint32_t>(count - 1);
        Document document;
        addSquare(document, 0, std::make_shared<const Mesh>(mesh));
        ReadGltf gltf = write(document);
        const int indices = gltf.json["meshes"][0]["primitives"][0]["indices"].get<int>();
        const bool narrow = count == 65535;
        EXPECT_EQ(gltf.json["accessors"][indices]["componentType"], narrow ? 5123 : 5125);
        if (narrow)
            EXPECT_EQ(gltf.values<std::uint16_t>(indices).back(), 65534);
        else
            EXPECT_EQ(gltf.values<std::uint32_t>(indices).back(), 65535u);
    }
}

TEST(GltfWriter, MeshesAreSharedAndTheirNumbersWrittenOnce) {
    Document document;
    const Id red = addMaterial(document, "Red").id, blue = addMaterial(document, "Blue").id;
    const MeshPtr mesh = squareMesh();
    addSquare(document, red, mesh);
    addSquare(document, red, mesh);
    addSquare(document, blue, mesh);
    addSquare(document, blue, squareMesh()); // equal, but another mesh
    ReadGltf gltf = write(document);
    EXPECT_THAT(gltf.json["nodes"], SizeIs(4));
    ASSERT_THAT(gltf.json["meshes"], SizeIs(3)); // mesh × material
    EXPECT_EQ(gltf.json["nodes"][0]["mesh"], gltf.json["nodes"][1]["mesh"]);
    EXPECT_EQ(gltf.json["meshes"][0]["primitives"][0]["attributes"],
              gltf.json["meshes"][1]["primitives"][0]["attributes"]);
    EXPECT_NE(gltf.json["meshes"][0]["primitives"][0]["material"],
              gltf.json["meshes"][1]["primitives"][0]["material"]);
    EXPECT_THAT(gltf.json["accessors"], SizeIs(8)); // position, normal, uv, indices of two meshes
    EXPECT_EQ(gltf.json["nodes"][1]["name"], "square_2");
}

TEST(GltfWriter, TangentsComeWithANormalMapAndAreUnit) {
    Mesh mesh = *squareMesh();
    mesh.tangents = {{2, 0, 0, -0.5f}, {0, 0, 0, 1}, {0, 1, 0, 1}, {1, 0, 0, -1}};
    mesh.normals[3] = {0, 0, 0};
    Document document;
    Material& material = addMaterial(document, "M");
    material.normalMap = map(codes(1, 1, 3, {128, 128, 255}));
    material.normalStrength = 0.5f;
    addSquare(document, material.id, std::make_shared<const Mesh>(mesh));
    ReadGltf gltf = write(document);
    const auto tangents = gltf.attribute<glm::vec4>(0, "TANGENT");
    ASSERT_THAT(tangents, SizeIs(4));
    EXPECT_EQ(tangents[0], glm::vec4(1, 0, 0, -1));
    for (const glm::vec4& tangent : tangents) {
        EXPECT_NEAR(glm::length(glm::vec3(tangent)), 1.0f, 1e-6f);
        EXPECT_EQ(std::abs(tangent.w), 1.0f);
    }
    EXPECT_NEAR(tangents[1].z, 0.0f, 1e-6f); // at a right angle to the normal
    EXPECT_EQ(gltf.attribute<glm::vec3>(0, "NORMAL")[3], glm::vec3(0, 1, 0));
    EXPECT_EQ(gltf.json["materials"][0]["normalTexture"]["scale"], 0.5);
}

TEST(GltfWriter, MaterialValuesArriveUnchanged) {
    Document document;
    addMaterial(document, "Unused");
    Material& m = addMaterial(document, "Kupfer ☉");
    m.baseColor = {0.25f, 0.5f, 0.75f};
    m.opacity = 0.5f;
    m.metallic = 0.125f;
    m.perceptualRoughness = 0.375f;
    m.alphaMode = AlphaMode::Mask;
    m.alphaCutoff = 0.25f;
    m.doubleSided = true;
    addSquare(document, m.id);
    Json materials = write(document).json["materials"];
    ASSERT_THAT(materials, SizeIs(1));
    Json expected = {{"name", "Kupfer ☉"},
                     {"pbrMetallicRoughness",
                      {{"baseColorFactor", {0.25, 0.5, 0.75, 0.5}},
                       {"metallicFactor", 0.125},
                       {"roughnessFactor", 0.375}}},
                     {"alphaMode", "MASK"},
                     {"alphaCutoff", 0.25},
                     {"doubleSided", true}};
    EXPECT_EQ(materials[0], expected);
}

TEST(GltfWriter, AlphaCutoffBelongsToMaskAlone) {
    Document document;
    Material& m = addMaterial(document, "M");
    m.alphaMode = AlphaMode::Blend;
    addSquare(document, m.id);
    EXPECT_EQ(write(document).json["materials"][0]["alphaMode"], "BLEND");
    EXPECT_FALSE(write(document).json["materials"][0].contains("alphaCutoff"));
    document.materials[0].alphaMode = AlphaMode::Opaque;
    EXPECT_FALSE(write(document).json["materials"][0].contains("alphaMode"));
}

TEST(GltfWriter, EmissionIsAFactorWithinOneTimesAStrength) {
    struct Case {
        glm::vec3 emissive;
        float strength;
    };
    for (const Case& c :
         {Case{{0.5f, 0.25f, 0}, 1}, Case{{1, 0.5f, 0}, 8}, Case{{4, 2, 0}, 1},
          Case{{4, 2, 0}, 0.5f}, Case{{1, 0.5f, 0.25f}, 0.5f}, Case{{2, 1, 0}, 0.25f}}) {
        Document document;
        Material& m = addMaterial(document, "M");
        m.emissive = c.emissive;
        m.emissiveStrength = c.strength;
        addSquare(document, m.id);
        Json material = write(document).json["materials"][0];
        double strength = 1.0;
        if (material.contains("extensions")) {
            strength =
                material["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"];
            EXPECT_GT(strength, 1.0);
        }
        for (int i = 0; i < 3; ++i) {
            const double factor = material["emissiveFactor"][static_cast<std::size_t>(i)];
            EXPECT_LE(factor, 1.0);
            EXPECT_NEAR(factor * strength, c.emissive[i] * c.strength, 1e-6);
        }
    }
    Document dark;
    addSquare(dark, addMaterial(dark, "M").id);
    EXPECT_FALSE(write(dark).json["materials"][0].contains("emissiveFactor"));
    EXPECT_FALSE(write(dark).json.contains("extensionsUsed"));
}

TEST(GltfWriter, TextureReferencesCarryTheirTransform) {
    Document document;
    Material& m = addMaterial(document, "M");
    m.baseColorMap = map(codes(1, 1, 3, {1}, ColorEncoding::Srgb));
    m.baseColorMap.uvScale = {2, 3};
    m.baseColorMap.uvOffset = {0.25f, 0.5f};
    m.baseColorMap.uvRotationDeg = 90;
    m.occlusionMap = map(codes(1, 1, 1, {1}));
    m.occlusionStrength = 0.5f;
    addSquare(document, m.id);
    Json json = write(document).json;
    Json& info = json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
    Json& transform = info["extensions"]["KHR_texture_transform"];
    EXPECT_EQ(transform["scale"], Json({2, 3}));
    EXPECT_EQ(transform["offset"], Json({0.25, 0.5}));
    EXPECT_NEAR(transform["rotation"].get<double>(), 1.5707963, 1e-6);
    Json& occlusion = json["materials"][0]["occlusionTexture"];
    EXPECT_EQ(occlusion["strength"], 0.5);
    EXPECT_FALSE(occlusion.contains("extensions"));
    EXPECT_EQ(json["extensionsUsed"], Json({"KHR_texture_transform"}));
    EXPECT_EQ(json["samplers"][0]["wrapS"], 10497);
    EXPECT_EQ(json["images"][1]["mimeType"], "image/png");
    Json& view = json["bufferViews"][json["images"][1]["bufferView"].get<int>()];
    EXPECT_FALSE(view.contains("target"));
    EXPECT_EQ(view["byteOffset"].get<int>() % 4, 0);
}

// The world matrix of the mesh, however many nodes it took.
static glm::dmat4 worldMatrix(Json& json, int node) {
    Json& n = json["nodes"][static_cast<std::size_t>(node)];
    glm::dmat4 matrix(1.0);
    if (n.contains("translation"))
        matrix = glm::translate(matrix, {n["translation"][0].get<double>(),
                                         n["translation"][1].get<double>(),
                                         n["translation"][2].get<double>()});
    if (n.contains("rotation"))
        matrix *= glm::mat4_cast(
            glm::dquat(n["rotation"][3].get<double>(), n["rotation"][0].get<double>(),
                       n["rotation"][1].get<double>(), n["rotation"][2].get<double>()));
    if (n.contains("scale"))
        matrix = glm::scale(matrix, {n["scale"][0].get<double>(), n["scale"][1].get<double>(),
                                     n["scale"][2].get<double>()});
    return n.contains("children") ? matrix * worldMatrix(json, n["children"][0].get<int>())
                                  : matrix;
}

TEST(GltfWriter, NodesPlaceTheirMeshes) {
    Document document;
    glm::mat4 turned = glm::rotate(glm::mat4(1.0f), 0.7f, {0, 0, 1});
    addSquare(document, 0).placement = glm::translate(turned, {1, 2, 3});
    addSquare(document, 0).placement = glm::scale(turned, {-2, 1, 1});
    addSquare(document, 0).placement = glm::scale(glm::mat4(1.0f), {1, 3, 1}) * turned; // sheared
    addSquare(document, 0);
    Json json = write(document).json;
    ASSERT_THAT(json["scenes"][0]["nodes"], SizeIs(4));
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dmat4 world = worldMatrix(json, json["scenes"][0]["nodes"][i].get<int>());
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 4; ++row)
                EXPECT_NEAR(world[column][row], document.meshes[i].placement.matrix()[column][row],
                            1e-6);
    }
    EXPECT_THAT(json["nodes"], SizeIs(5));
    Json& plain = json["nodes"][4];
    EXPECT_FALSE(plain.contains("translation") || plain.contains("rotation") ||
                 plain.contains("scale"));
}

TEST(GltfWriter, LightsBecomePunctualLights) {
    Document document;
    addSquare(document, 0);
    Light sun;
    sun.name = "Sun";
    sun.color = {1, 0.5f, 0.25f};
    sun.intensity = 3;
    sun.azimuthDeg = 0;
    sun.elevationDeg = 90; // from above
    Light lamp;
    lamp.name = "Sun";
    lamp.type = LightType::Point;
    lamp.color = {2, 1, 0.5f}; // brighter than the extension allows
    lamp.intensity = 10;
    lamp.position = {1, 2, 3};
    Light off;
    off.enabled = false;
    document.lights = {sun, lamp, off};
    Json json = write(document).json;
    Json& lights = json["extensions"]["KHR_lights_punctual"]["lights"];
    ASSERT_THAT(lights, SizeIs(2));
    EXPECT_EQ(lights[0], Json({{"name", "Sun"},
                               {"type", "directional"},
                               {"color", {1, 0.5, 0.25}},
                               {"intensity", 3}}));
    EXPECT_EQ(
        lights[1],
        Json({{"name", "Sun_2"}, {"type", "point"}, {"color", {1, 0.5, 0.25}}, {"intensity", 20}}));
    const glm::dvec4 shines = worldMatrix(json, 1) * glm::dvec4(0, 0, -1, 0);
    EXPECT_NEAR(shines.y, -1.0, 1e-6);
    EXPECT_EQ(json["nodes"][2]["translation"], Json({1, 2, 3}));
    EXPECT_EQ(json["nodes"][2]["extensions"]["KHR_lights_punctual"]["light"], 1);
    EXPECT_EQ(json["extensionsUsed"], Json({"KHR_lights_punctual"}));

    ExportSettings settings = glbSettings();
    settings.includeLights = false;
    EXPECT_FALSE(write(document, settings).json.contains("extensions"));
}

TEST(GltfWriter, SpotsHaveConesWithinWhatTheExtensionAllows) {
    Document document;
    addSquare(document, 0);
    Light spot;
    spot.name = "Spot";
    spot.type = LightType::Spot;
    spot.position = {1, 2, 3};
    spot.range = 4.0f;
    spot.innerConeDeg = 60.0f; // wider than the outer one
    spot.outerConeDeg = 30.0f;
    document.lights = {spot};
    Json json = write(document).json;
    Json& light = json["extensions"]["KHR_lights_punctual"]["lights"][0];
    EXPECT_EQ(light["type"], "spot");
    EXPECT_EQ(light["range"], 4.0);
    EXPECT_NEAR(light["spot"]["outerConeAngle"], 0.5235988, 1e-6);
    EXPECT_LT(light["spot"]["innerConeAngle"], light["spot"]["outerConeAngle"]);
    const glm::dvec4 shines = worldMatrix(json, 1) * glm::dvec4(0, 0, -1, 0);
    const glm::vec3 d = spot.directionToLight();
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(shines[i], -d[i], 1e-6);
    EXPECT_EQ(json["nodes"][1]["translation"], Json({1, 2, 3}));
}

TEST(GltfWriter, SeparateFilesAreReferredToByName) {
    Document document;
    Material& m = addMaterial(document, "M");
    m.baseColorMap = map(codes(1, 1, 3, {1}, ColorEncoding::Srgb));
    addSquare(document, m.id);
    ExportSettings settings;
    settings.format = ExportFormat::Gltf;
    settings.output = "/nowhere/my scene.gltf";
    ReadGltf gltf = write(document, settings);
    EXPECT_EQ(gltf.json["buffers"][0]["uri"], "my_scene.bin");
    EXPECT_EQ(gltf.json["images"][0]["uri"], "my_scene_M_baseColor.png");
    EXPECT_FALSE(gltf.json["images"][0].contains("bufferView"));
}

TEST(GltfWriter, GlbHasTwoPaddedChunks) {
    const std::string_view text = "{\"a\":1}"; // 7 bytes
    const GltfOutput gltf{std::string(text), Bytes(5, std::byte{9})};
    const Bytes glb = packGlb(gltf);
    const auto word = [&](std::size_t offset) {
        std::uint32_t value = 0;
        std::memcpy(&value, glb.data() + offset, 4);
        return value;
    };
    EXPECT_EQ(std::memcmp(glb.data(), "glTF", 4), 0);
    EXPECT_EQ(word(4), 2u);
    EXPECT_EQ(word(8), glb.size());
    EXPECT_EQ(word(12), 8u);
    EXPECT_EQ(std::memcmp(glb.data() + 16, "JSON{\"a\":1} ", 12), 0);
    EXPECT_EQ(word(28), 8u);
    EXPECT_EQ(std::memcmp(glb.data() + 32, "BIN\0\x09\x09\x09\x09\x09\0\0\0", 12), 0);
    EXPECT_EQ(glb.size(), 44u);
}
