#include "core/light/Light.h"
#include "core/material/Material.h"
#include "tests/core/worker/ModelFiles.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>

namespace patina {
namespace {

using nlohmann::json;
using test::GltfBuilder;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class GltfImport : public test::ImportTest {};

TEST_F(GltfImport, GlbDataUriAndFileHoldTheSame) {
    GltfBuilder builder;
    builder.node({{"mesh", builder.triangle()}, {"name", "one"}});
    folder.write("a b.bin", std::string_view(builder.binary()));
    for (const auto& [name, content] :
         std::vector<std::pair<std::string, std::string>>{{"a.glb", builder.glb()},
                                                          {"b.gltf", builder.gltf()},
                                                          {"c.gltf", builder.gltf("a%20b.bin")},
                                                          {"d.gltf", builder.glb()}}) {
        const ImportedModel model = import(name, content);
        EXPECT_EQ(model.format, "gltf2");
        EXPECT_EQ(model.triangleCount, 1u);
        ASSERT_EQ(model.meshes.size(), 1u);
        const Mesh& mesh = *model.meshes[0];
        EXPECT_THAT(mesh.positions,
                    ElementsAre(glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)));
        EXPECT_THAT(mesh.uvs, ElementsAre(glm::vec2(0, 1), glm::vec2(1, 1), glm::vec2(0, 0)));
        EXPECT_THAT(mesh.normals, testing::Each(glm::vec3(0, 0, 1)));
        EXPECT_EQ(model.instances[0].name, "one");
        EXPECT_THAT(model.missingTextures, IsEmpty());
    }
}

TEST_F(GltfImport, NodeTransformsMultiply) {
    GltfBuilder builder;
    const int mesh = builder.triangle();
    // Child: scaled by 2; parent: turned 90 degrees about +Y, then moved.
    builder.root["nodes"] = {{{"children", {1}},
                              {"translation", {10, 0, 0}},
                              {"rotation", {0, std::sqrt(0.5), 0, std::sqrt(0.5)}}},
                             {{"mesh", mesh}, {"scale", {2, 2, 2}}, {"name", "child"}}};
    builder.root["scenes"] = {{{"nodes", {0}}}};
    const ImportedModel model = import("a.glb", builder.glb());
    const auto points = corners(model);
    ASSERT_EQ(points.size(), 3u);
    expectNear(points[0], {10, 0, 0});
    expectNear(points[1], {10, 0, -2}); // +X turns to -Z
    expectNear(points[2], {10, 2, 0});
}

TEST_F(GltfImport, MatrixNodesAndSharedMeshes) {
    GltfBuilder builder;
    const int mesh = builder.triangle();
    builder.node({{"mesh", mesh}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1}}});
    builder.node({{"mesh", mesh}});
    const ImportedModel model = import("a.glb", builder.glb());
    EXPECT_EQ(model.meshes.size(), 1u);
    ASSERT_EQ(model.instances.size(), 2u);
    expectNear(corners(model, 0)[0], {5, 6, 7});
    EXPECT_EQ(model.triangleCount, 2u);
}

TEST_F(GltfImport, MirroredNodesKeepTheirFront) {
    GltfBuilder builder;
    const int mesh = builder.triangle();
    builder.node({{"mesh", mesh}});
    builder.node({{"mesh", mesh}, {"scale", {-1, 1, 1}}});
    builder.node({{"mesh", mesh}, {"scale", {-1, -1, -1}}});
    const ImportedModel model = import("a.glb", builder.glb());
    ASSERT_EQ(model.instances.size(), 3u);
    EXPECT_EQ(model.meshes.size(), 2u); // the mirrored one is shared
    for (std::size_t i = 0; i < 3; ++i) {
        const ImportedInstance& instance = model.instances[i];
        const glm::mat3 linear(instance.transform);
        EXPECT_GT(glm::determinant(linear), 0.0f);
        // The front follows the normals, which follow the mirror.
        const Mesh& part = *model.meshes[static_cast<std::size_t>(instance.mesh)];
        const glm::vec3 normal =
            glm::normalize(glm::transpose(glm::inverse(linear)) * part.normals[0]);
        expectNear(normal, i == 2 ? glm::vec3(0, 0, -1) : glm::vec3(0, 0, 1));
        expectNear(glm::normalize(areaVector(model, i)), normal);
        // The bitangent of tangent space still points up in the image, that is towards +Y of the
        // original triangle.
        const glm::vec4 t = part.tangents[0];
        const glm::vec3 bitangent = linear * (glm::cross(part.normals[0], glm::vec3(t)) * t.w);
        expectNear(glm::normalize(bitangent), i == 2 ? glm::vec3(0, -1, 0) : glm::vec3(0, 1, 0));
    }
    auto points = corners(model, 1);
    std::sort(points.begin(), points.end(), [](auto a, auto b) { return a.x < b.x; });
    expectNear(points[0], {-1, 0, 0});
    EXPECT_THAT(model.warnings, Contains(HasSubstr("2 mirrored objects")));
}

TEST_F(GltfImport, ObjectsScaledToNothingAreLeftOut) {
    GltfBuilder builder;
    const int mesh = builder.triangle();
    builder.node({{"mesh", mesh}, {"scale", {1, 0, 1}}});
    builder.node({{"mesh", mesh}});
    const ImportedModel model = import("a.glb", builder.glb());
    EXPECT_EQ(model.instances.size(), 1u);
    EXPECT_THAT(model.warnings, Contains(HasSubstr("1 objects scaled to nothing")));
}

TEST_F(GltfImport, MaterialsInFull) {
    GltfBuilder builder;
    builder.root["images"] = {{{"uri", "orm.png"}}, {{"uri", "folder%20one/color.png"}}};
    builder.root["textures"] = {{{"source", 0}}, {{"source", 1}}};
    builder.root["materials"] = json::parse(R"([{
        "name": "steel", "doubleSided": true, "alphaMode": "MASK", "alphaCutoff": 0.25,
        "pbrMetallicRoughness": {
            "baseColorFactor": [0.1, 0.2, 0.3, 0.4], "metallicFactor": 0.9, "roughnessFactor": 0.35,
            "metallicRoughnessTexture": {"index": 0},
            "baseColorTexture": {"index": 1, "extensions": {"KHR_texture_transform":
                {"offset": [0.25, 0.5], "scale": [2, 3], "rotation": 0.5}}}},
        "normalTexture": {"index": 1, "scale": 0.7},
        "occlusionTexture": {"index": 0, "strength": 0.6},
        "emissiveFactor": [1, 0.5, 0], "emissiveTexture": {"index": 1},
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 4}}
    }, {"alphaMode": "BLEND"}])");
    builder.root["extensionsRequired"] = {"KHR_texture_transform"};
    builder.node({{"mesh", builder.triangle(0)}});
    builder.node({{"mesh", builder.triangle(1)}});
    builder.node({{"mesh", builder.triangle()}});
    folder.write("folder one/color.png", std::string_view("any"));
    folder.write("orm.png", std::string_view()); // empty: as good as missing
    const ImportedModel model = import("a.gltf", builder.gltf());

    ASSERT_EQ(model.materials.size(), 3u);
    const ImportedMaterial& steel = model.materials[0];
    EXPECT_EQ(steel.name, "steel");
    EXPECT_EQ(steel.baseColor, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
    EXPECT_FLOAT_EQ(steel.numbers[MaterialInput::Metallic], 0.9f);
    EXPECT_FLOAT_EQ(steel.numbers[MaterialInput::PerceptualRoughness], 0.35f);
    EXPECT_FLOAT_EQ(steel.numbers[MaterialInput::Normal], 0.7f);
    EXPECT_FLOAT_EQ(steel.numbers[MaterialInput::Occlusion], 0.6f);
    EXPECT_EQ(steel.emissive, glm::vec3(4, 2, 0));
    EXPECT_TRUE(steel.doubleSided);
    EXPECT_TRUE(steel.alphaMask);
    EXPECT_FALSE(steel.alphaBlend);
    EXPECT_FLOAT_EQ(steel.alphaCutoff, 0.25f);
    ASSERT_TRUE(steel.maps[MaterialInput::Metallic] &&
                steel.maps[MaterialInput::PerceptualRoughness] &&
                steel.maps[MaterialInput::Occlusion] && steel.maps[MaterialInput::BaseColor]);
    EXPECT_EQ(steel.maps[MaterialInput::Metallic]->channel, 'b');
    EXPECT_EQ(steel.maps[MaterialInput::PerceptualRoughness]->channel, 'g');
    EXPECT_EQ(steel.maps[MaterialInput::Occlusion]->channel, 'r');
    EXPECT_EQ(steel.maps[MaterialInput::BaseColor]->channel, 0);
    EXPECT_EQ(steel.maps[MaterialInput::BaseColor]->file,
              folder.path() / "folder one" / "color.png");
    EXPECT_EQ(steel.maps[MaterialInput::BaseColor]->uvScale, glm::vec2(2, 3));
    EXPECT_EQ(steel.maps[MaterialInput::BaseColor]->uvOffset, glm::vec2(0.25f, 0.5f));
    EXPECT_NEAR(steel.maps[MaterialInput::BaseColor]->uvRotationDeg, 28.64789f, 1e-4f);
    EXPECT_EQ(steel.maps[MaterialInput::Normal]->uvScale, glm::vec2(1));
    EXPECT_THAT(model.missingTextures, ElementsAre("orm.png"));
    EXPECT_EQ(steel.maps[MaterialInput::PerceptualRoughness]->file,
              folder.path() / "orm.png"); // where it is expected

    const ImportedMaterial& glass = model.materials[1];
    EXPECT_TRUE(glass.alphaBlend);
    EXPECT_FLOAT_EQ(glass.numbers[MaterialInput::Metallic], 1.0f); // glTF's defaults
    EXPECT_FLOAT_EQ(glass.numbers[MaterialInput::PerceptualRoughness], 1.0f);
    EXPECT_EQ(glass.baseColor, glm::vec4(1.0f));
    const ImportedMaterial& none = model.materials[2]; // the same
    EXPECT_EQ(none.name, "default");
    EXPECT_FLOAT_EQ(none.numbers[MaterialInput::Metallic], 1.0f);
    EXPECT_FLOAT_EQ(none.numbers[MaterialInput::PerceptualRoughness], 1.0f);
    EXPECT_EQ(none.baseColor, glm::vec4(1.0f));
    EXPECT_EQ(model.instances[2].material, 2);
}

TEST_F(GltfImport, TransmissionIndexAndVolume) {
    GltfBuilder builder;
    builder.root["images"] = {{{"uri", "clear.png"}}};
    builder.root["textures"] = {{{"source", 0}}};
    builder.root["materials"] = json::parse(R"([{
        "extensions": {
            "KHR_materials_transmission": {"transmissionFactor": 0.75,
                                           "transmissionTexture": {"index": 0}},
            "KHR_materials_ior": {"ior": 1.33},
            "KHR_materials_volume": {"thicknessFactor": 0.5, "attenuationDistance": 0.25,
                                     "attenuationColor": [0.1, 0.2, 0.3]}}
    }, {"extensions": {"KHR_materials_transmission": {}, "KHR_materials_ior": {"ior": 0},
                       "KHR_materials_volume": {"thicknessFactor": 0}}}, {}])");
    for (int i = 0; i < 3; ++i)
        builder.node({{"mesh", builder.triangle(i)}});
    const ImportedModel model = import("a.gltf", builder.gltf());

    const ImportedMaterial& water = model.materials[0];
    EXPECT_FLOAT_EQ(water.numbers[MaterialInput::Transmission], 0.75f);
    ASSERT_TRUE(water.maps[MaterialInput::Transmission]);
    EXPECT_EQ(water.maps[MaterialInput::Transmission]->channel, 'r');
    EXPECT_FLOAT_EQ(water.ior, 1.33f);
    EXPECT_FALSE(water.thinWalled);
    EXPECT_FLOAT_EQ(water.attenuationDistance, 0.25f);
    EXPECT_EQ(water.attenuationColor, glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_FLOAT_EQ(model.materials[1].ior, 3.0f) << "0 stands for infinity";
    for (const std::size_t plain : {1u, 2u}) {
        EXPECT_EQ(model.materials[plain].numbers[MaterialInput::Transmission], 0.0f);
        EXPECT_TRUE(model.materials[plain].thinWalled);
        EXPECT_EQ(model.materials[plain].attenuationDistance, 0.0f);
    }
    EXPECT_EQ(model.materials[2].ior, 1.5f);
}

TEST_F(GltfImport, EmbeddedTexturesAreHandedOverCompressed) {
    const std::string png = test::seedFiles(worker()).at("png")[0];
    GltfBuilder builder;
    builder.root["images"] = {{{"bufferView", builder.view(png)}, {"mimeType", "image/png"}},
                              {{"uri", "data:image/png;base64," + test::base64(png)}}};
    builder.root["textures"] = {{{"source", 0}}, {{"source", 1}}};
    builder.root["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}},
                                  {"emissiveTexture", {{"index", 1}}},
                                  {"normalTexture", {{"index", 0}}}}};
    builder.node({{"mesh", builder.triangle(0)}});
    const ImportedModel model = import("a.glb", builder.glb());
    ASSERT_EQ(model.embeddedImages.size(), 2u); // used twice, kept once
    EXPECT_EQ(test::bytesOf(model.embeddedImages[0]), png);
    EXPECT_EQ(test::bytesOf(model.embeddedImages[1]), png);
    const ImportedMaterial& material = model.materials[0];
    EXPECT_EQ(material.maps[MaterialInput::BaseColor]->embedded, 0);
    EXPECT_EQ(material.maps[MaterialInput::Normal]->embedded, 0);
    EXPECT_EQ(material.maps[MaterialInput::Emissive]->embedded, 1);
    EXPECT_TRUE(material.maps[MaterialInput::BaseColor]->file.empty());
    EXPECT_THAT(model.missingTextures, IsEmpty());
}

TEST_F(GltfImport, IntegerAttributesAreScaled) {
    GltfBuilder builder;
    const json primitive = {
        {"attributes",
         {{"POSITION", builder.integers<std::int16_t>({0, 0, 0, 100, 0, 0, 0, 100, 0}, 3)},
          {"NORMAL", builder.integers<std::int8_t>({0, 0, 127, 0, 0, 127, 0, 0, 127}, 3, true)},
          {"TEXCOORD_0",
           builder.integers<std::uint16_t>({0, 65535, 65535, 65535, 0, 0}, 2, true)}}},
        {"indices", builder.integers<std::uint8_t>({0, 1, 2}, 1)}};
    builder.root["meshes"] = {{{"primitives", {primitive}}}};
    builder.root["extensionsRequired"] = {"KHR_mesh_quantization"};
    builder.node({{"mesh", 0}, {"scale", {0.01, 0.01, 0.01}}});
    const ImportedModel model = import("a.glb", builder.glb());
    EXPECT_EQ(model.meshes[0]->uvs[1], glm::vec2(1, 1));
    expectNear(model.meshes[0]->normals[0], {0, 0, 1});
    expectNear(corners(model)[1], {1, 0, 0});
}

TEST_F(GltfImport, SparseAndInterleavedAccessors) {
    GltfBuilder builder;
    // x y z u v per vertex, two accessors into one view.
    const std::vector<float> interleaved{0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    std::string bytes(interleaved.size() * 4, '\0');
    std::memcpy(bytes.data(), interleaved.data(), bytes.size());
    const int view = builder.view(bytes);
    builder.root["bufferViews"][static_cast<std::size_t>(view)]["byteStride"] = 20;
    const int index = builder.view(std::string("\x02\0\0\0", 4));
    const int value = builder.floats({0, 5, 0}, 3);
    const int valueView = builder.root["accessors"][static_cast<std::size_t>(value)]["bufferView"];
    const auto add = [&](json accessor) {
        builder.root["accessors"].push_back(std::move(accessor));
        return builder.root["accessors"].size() - 1;
    };
    const auto position = add({{"bufferView", view},
                               {"componentType", 5126},
                               {"count", 3},
                               {"type", "VEC3"},
                               {"sparse",
                                {{"count", 1},
                                 {"indices", {{"bufferView", index}, {"componentType", 5123}}},
                                 {"values", {{"bufferView", valueView}}}}}});
    const auto uv = add({{"bufferView", view},
                         {"byteOffset", 12},
                         {"componentType", 5126},
                         {"count", 3},
                         {"type", "VEC2"}});
    builder.root["meshes"] = {
        {{"primitives", {{{"attributes", {{"POSITION", position}, {"TEXCOORD_0", uv}}}}}}}};
    builder.node({{"mesh", 0}});
    const ImportedModel model = import("a.glb", builder.glb());
    EXPECT_THAT(model.meshes[0]->positions,
                ElementsAre(glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0, 5, 0)));
    EXPECT_THAT(model.meshes[0]->uvs,
                ElementsAre(glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(0, 1)));
}

// A mesh has one set of texture coordinates: that of all its material's textures.
TEST_F(GltfImport, ALightMapHasItsOwnTextureCoordinates) {
    const json second = {{"index", 0}, {"texCoord", 1}}, first = {{"index", 0}};
    for (const bool alone : {true, false}) {
        GltfBuilder builder;
        builder.root["images"] = {{{"uri", "light.png"}}};
        builder.root["textures"] = {{{"source", 0}}};
        builder.root["materials"] = {{{"emissiveTexture", second}}};
        if (!alone)
            builder.root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = first;
        builder.triangle(0);
        builder.root["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] =
            builder.floats({0.5f, 0.25f, 0.75f, 0.25f, 0.5f, 0.5f}, 2);
        builder.node({{"mesh", 0}});
        const ImportedModel model = import("a.glb", builder.glb());
        EXPECT_EQ(model.meshes[0]->uvs[0], alone ? glm::vec2(0.5f, 0.25f) : glm::vec2(0, 1));
        const auto warned = [](const std::string& text) {
            return text.find("several sets") != std::string::npos;
        };
        EXPECT_EQ(std::ranges::count_if(model.warnings, warned), alone ? 0 : 1);
    }
}

TEST_F(GltfImport, StripsAndFansKeepTheirFront) {
    for (const int mode : {5, 6}) {
        GltfBuilder builder;
        const std::vector<float> strip{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
        const std::vector<float> fan{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
        builder.root["meshes"] = {
            {{"primitives",
              {{{"mode", mode},
                {"attributes", {{"POSITION", builder.floats(mode == 5 ? strip : fan, 3)}}}}}}}};
        builder.node({{"mesh", 0}});
        const ImportedModel model = import("a.glb", builder.glb());
        EXPECT_EQ(model.triangleCount, 2u);
        expectNear(areaVector(model), {0, 0, 2});
    }
}

TEST_F(GltfImport, WithoutNormalsItIsFlat) {
    GltfBuilder builder;
    // Two triangles sharing an edge, at a right angle.
    builder.root["meshes"] = {
        {{"primitives",
          {{{"attributes",
             {{"POSITION", builder.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, -1}, 3)}}},
            {"indices", builder.integers<std::uint32_t>({0, 1, 2, 0, 3, 1}, 1)}}}}}};
    builder.node({{"mesh", 0}});
    const ImportedModel model = import("a.glb", builder.glb());
    EXPECT_TRUE(model.repairs.generatedNormals);
    const Mesh& mesh = *model.meshes[0];
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const auto at = [&](std::size_t k) { return mesh.positions[mesh.indices[i + k]]; };
        const glm::vec3 face = glm::normalize(glm::cross(at(1) - at(0), at(2) - at(0)));
        for (std::size_t k = 0; k < 3; ++k)
            expectNear(mesh.normals[mesh.indices[i + k]], face);
    }
}

TEST_F(GltfImport, TangentsOfTheFilePass) {
    GltfBuilder builder;
    const int mesh = builder.triangle();
    builder.root["meshes"][0]["primitives"][0]["attributes"]["TANGENT"] =
        builder.floats({0, 1, 0, -1, 0, 1, 0, -1, 0, 1, 0, -1}, 4);
    builder.node({{"mesh", mesh}});
    const ImportedModel model = import("a.glb", builder.glb());
    EXPECT_FALSE(model.repairs.generatedTangents);
    EXPECT_EQ(model.meshes[0]->tangents[0], glm::vec4(0, 1, 0, -1));
}

TEST_F(GltfImport, BadTrianglesAreDroppedAndCounted) {
    GltfBuilder builder;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    builder.root["meshes"] = {
        {{"primitives",
          {{{"attributes",
             {{"POSITION", builder.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, nan, 0, 0}, 3)},
              {"NORMAL", builder.floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, 3)}}},
            {"indices",
             builder.integers<std::uint16_t>({0, 1, 2, 0, 0, 1, 0, 1, 3, 0, 1, 9999}, 1)}}}}}};
    builder.node({{"mesh", 0}});
    const ImportedModel model = import("a.glb", builder.glb());
    EXPECT_EQ(model.triangleCount, 1u);
    EXPECT_EQ(model.repairs.droppedTriangles, 1u);
    EXPECT_EQ(model.repairs.invalidTriangles, 2u);
    EXPECT_THAT(model.warnings, Contains(HasSubstr("1 degenerate triangles")));
    EXPECT_THAT(model.warnings, Contains(HasSubstr("2 triangles with invalid vertices")));
}

TEST_F(GltfImport, Lights) {
    GltfBuilder builder;
    builder.root["extensions"]["KHR_lights_punctual"]["lights"] = json::parse(
        R"([{"type": "directional", "name": "sun", "color": [1, 0.5, 0.25], "intensity": 2},
            {"type": "point", "intensity": 10, "range": 7},
            {"type": "spot", "intensity": 3,
             "spot": {"innerConeAngle": 0.2, "outerConeAngle": 0.6}},
            {"type": "spot"}, {"type": "disc", "name": "odd"}])");
    builder.node({{"mesh", builder.triangle()}});
    builder.node({{"rotation", {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)}},
                  {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    builder.node({{"translation", {1, 2, 3}},
                  {"name", "bulb"},
                  {"extensions", {{"KHR_lights_punctual", {{"light", 1}}}}}});
    // Half a turn about Y, scaled: it emits along +Z, and the scale does not touch its range.
    builder.node({{"rotation", {0, 1, 0, 0}},
                  {"scale", {2, 2, 2}},
                  {"translation", {0, 0, -5}},
                  {"extensions", {{"KHR_lights_punctual", {{"light", 2}}}}}});
    for (const int index : {3, 4})
        builder.node({{"extensions", {{"KHR_lights_punctual", {{"light", index}}}}}});
    const ImportedModel model = import("a.glb", builder.glb());
    ASSERT_EQ(model.lights.size(), 4u);
    EXPECT_EQ(model.lights[0].type, ImportedLight::Type::Directional);
    EXPECT_EQ(model.lights[0].name, "sun");
    expectNear(model.lights[0].color, {2, 1, 0.5f});
    expectNear(model.lights[0].direction, {0, -1, 0}); // -Z turned -90 degrees about X
    EXPECT_EQ(model.lights[1].type, ImportedLight::Type::Point);
    EXPECT_EQ(model.lights[1].range, 7.0f);
    const ImportedLight& spot = model.lights[2];
    EXPECT_EQ(spot.type, ImportedLight::Type::Spot);
    expectNear(spot.position, {0, 0, -5});
    expectNear(spot.direction, {0, 0, 1});
    EXPECT_NEAR(spot.innerConeDeg, glm::degrees(0.2f), 1e-4f);
    EXPECT_NEAR(spot.outerConeDeg, glm::degrees(0.6f), 1e-4f);
    EXPECT_EQ(spot.range, 0.0f);
    EXPECT_EQ(model.lights[3].innerConeDeg, 0.0f); // what the extension says when nothing is said
    EXPECT_NEAR(model.lights[3].outerConeDeg, 45.0f, 1e-4f);
    EXPECT_THAT(model.warnings, Contains(HasSubstr("\"odd\" is of an unknown type")));
    EXPECT_EQ(model.lights[1].name, "bulb");
    expectNear(model.lights[1].position, {1, 2, 3});
}

TEST_F(GltfImport, WhatIsNotSupportedSaysSo) {
    GltfBuilder builder;
    builder.node({{"mesh", builder.triangle()}});
    GltfBuilder compressed = builder;
    compressed.root["extensionsRequired"] = {"EXT_unheard_of"};
    EXPECT_THAT(importError("a.glb", compressed.glb()).message, HasSubstr("EXT_unheard_of"));
    GltfBuilder old = builder;
    old.root["asset"]["version"] = "1.0";
    EXPECT_THAT(importError("a.glb", old.glb()).message, HasSubstr("version 2"));
    EXPECT_THAT(importError("a.gltf", builder.gltf("gone.bin")).message, HasSubstr("\"gone.bin\""));
    // Not outside the model's folder.
    EXPECT_THAT(importError("sub/a.gltf", builder.gltf("../gone.bin")).message,
                HasSubstr("missing"));
    folder.write("gone.bin", std::string_view(builder.binary()));
    EXPECT_THAT(importError("sub/a.gltf", builder.gltf("../gone.bin")).message,
                HasSubstr("missing"));
}

TEST_F(GltfImport, ExtensionsThatAreNotReadAreNamedOnce) {
    GltfBuilder builder;
    builder.root["materials"] = json::parse(R"([
        {"name": "flat", "extensions": {"KHR_materials_unlit": {}}},
        {"name": "felt", "extensions": {"KHR_materials_sheen": {"sheenColorFactor": [1, 1, 1]}}},
        {"extensions": {"KHR_materials_sheen": {"sheenColorFactor": [1, 1, 1]},
                        "KHR_materials_clearcoat": {},
                        "KHR_materials_ior": {"ior": 1.4},
                        "KHR_materials_emissive_strength": {"emissiveStrength": 2}}},
        {"name": "toon", "extensions": {"VRMC_materials_mtoon": {}}},
        {"name": "a", "extensions": {"KHR_materials_anisotropy": {"anisotropyStrength": 1}}},
        {"name": "b", "extensions": {"KHR_materials_anisotropy": {"anisotropyStrength": 1}}},
        {"name": "c", "extensions": {"KHR_materials_anisotropy": {"anisotropyStrength": 1}}},
        {"name": "d", "extensions": {"KHR_materials_anisotropy": {"anisotropyStrength": 1}}}])");
    builder.root["extensionsUsed"] = {"KHR_materials_unlit",      "KHR_materials_sheen",
                                      "KHR_materials_clearcoat",  "KHR_materials_ior",
                                      "KHR_materials_variants",   "KHR_materials_transmission",
                                      "EXT_lights_image_based",   "MSFT_lod",
                                      "EXT_mesh_gpu_instancing",  "KHR_materials_emissive_strength",
                                      "KHR_materials_anisotropy", "KHR_xmp_json_ld"};
    builder.root["extensionsRequired"] = {"KHR_materials_unlit"};
    builder.node({{"mesh", builder.triangle(0)}});
    EXPECT_THAT(
        import("a.glb", builder.glb()).warnings,
        testing::UnorderedElementsAre(
            "The glTF extension KHR_materials_unlit is not supported: material \"flat\" is shown "
            "shaded.",
            "The glTF extension KHR_materials_sheen is not supported: materials \"felt\", "
            "\"material 3\" are shown without it.",
            "The glTF extension VRMC_materials_mtoon is not supported: material \"toon\" is shown "
            "without it.",
            "The glTF extension KHR_materials_anisotropy is not supported: materials \"a\", "
            "\"b\", \"c\" and 1 others are shown without it.",
            "Of this file's glTF extensions these are not supported and were left out: "
            "KHR_materials_variants, MSFT_lod."));
}

TEST_F(GltfImport, CyclesAndDeepTreesEnd) {
    GltfBuilder builder;
    builder.node({{"mesh", builder.triangle()}, {"children", {1}}});
    builder.root["nodes"].push_back({{"children", {0}}});
    EXPECT_THAT(importError("a.glb", builder.glb()).message, HasSubstr("two parents"));

    GltfBuilder deep;
    const int mesh = deep.triangle();
    constexpr int kDepth = 20000;
    for (int i = 0; i < kDepth; ++i)
        deep.root["nodes"].push_back({{"children", {i + 1}}});
    deep.root["nodes"].push_back({{"mesh", mesh}});
    deep.root["scenes"] = {{{"nodes", {0}}}};
    EXPECT_EQ(import("a.glb", deep.glb()).instances.size(), 1u);
}

TEST_F(GltfImport, LyingAccessorsAreRefused) {
    GltfBuilder builder;
    builder.node({{"mesh", builder.triangle()}});
    const auto refused = [&](const char* key, const json& value) {
        GltfBuilder lying = builder;
        lying.root["accessors"][0][key] = value;
        EXPECT_EQ(importError("a.glb", lying.glb()).kind, ErrorKind::InputBroken) << key << value;
    };
    refused("count", 4);
    refused("count", 100000000);
    refused("count", 1000000000000);
    refused("count", -1);
    refused("byteOffset", 100000);
    refused("byteOffset", -4);
    refused("bufferView", 77);
    refused("componentType", 5124);
    refused("type", "MAT9");
    refused("type", 3);
    GltfBuilder lying = builder;
    lying.root["bufferViews"][0]["byteLength"] = 1u << 31;
    EXPECT_EQ(importError("a.glb", lying.glb()).kind, ErrorKind::InputBroken);
}

TEST_F(GltfImport, TexturesThatAreNotReadChooseNoCoordinates) {
    GltfBuilder builder;
    builder.root["images"] = {{{"uri", "a.png"}}};
    builder.root["textures"] = {{{"source", 0}}};
    const json second = {{"index", 0}, {"texCoord", 1}}, first = {{"index", 0}};
    builder.root["materials"] = {
        {{"pbrMetallicRoughness", {{"baseColorTexture", second}}},
         {"extensions",
          {{"KHR_materials_clearcoat", {{"clearcoatTexture", first}}},
           {"KHR_materials_volume", {{"thicknessTexture", first}, {"thicknessFactor", 1}}}}}}};
    builder.node({{"mesh", builder.triangle(0)}});
    builder.root["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] =
        builder.floats({0.25f, 0, 0.5f, 0, 0.75f, 1}, 2);
    const ImportedModel model = import("a.glb", builder.glb());
    EXPECT_THAT(model.meshes[0]->uvs,
                ElementsAre(glm::vec2(0.25f, 0), glm::vec2(0.5f, 0), glm::vec2(0.75f, 1)));
    EXPECT_THAT(model.warnings, testing::Each(testing::Not(HasSubstr("several sets"))));
}

TEST_F(GltfImport, VertexColoursAreNamedOnce) {
    GltfBuilder builder;
    for (int i = 0; i < 2; ++i) {
        builder.node({{"mesh", builder.triangle()}});
        EXPECT_THAT(import("a.glb", builder.glb()).warnings,
                    testing::Each(testing::Not(HasSubstr("Vertex colours"))));
    }
    for (json& mesh : builder.root["meshes"])
        mesh["primitives"][0]["attributes"]["COLOR_0"] =
            builder.floats({1, 0, 0, 0, 1, 0, 0, 0, 1}, 3);
    const std::vector<std::string> warnings = import("b.glb", builder.glb()).warnings;
    EXPECT_EQ(std::count_if(warnings.begin(), warnings.end(),
                            [](const std::string& text) {
                                return text.find("Vertex colours") != std::string::npos;
                            }),
              1);
}

TEST_F(GltfImport, CamerasStandAndLookAsTheirNodesDo) {
    GltfBuilder builder;
    builder.node({{"mesh", builder.triangle()}});
    builder.root["cameras"] = {
        {{"type", "perspective"}, {"name", "Lens"}, {"perspective", {{"yfov", 0.5}}}},
        {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}}}},
        {{"type", "perspective"}, {"perspective", {{"yfov", 4.0}}}}};
    const float half = std::sqrt(0.5f);
    builder.node({{"translation", {1, 2, 3}}, {"scale", {2, 2, 2}}, {"children", {2}}});
    builder.root["nodes"].push_back({{"camera", 0},
                                     {"name", "Hero"},
                                     {"translation", {1, 0, 0}},
                                     {"rotation", {0, half, 0, half}}}); // a quarter turn left
    builder.node({{"camera", 0}});
    builder.node({{"camera", 1}, {"name", "Plan"}});
    builder.node({{"camera", 2}});
    const ImportedModel model = import("a.glb", builder.glb());
    ASSERT_EQ(model.cameras.size(), 2u);
    EXPECT_EQ(model.cameras[0].name, "Hero");
    expectNear(model.cameras[0].position, {3, 2, 3});
    expectNear(model.cameras[0].forward, {-1, 0, 0});
    expectNear(model.cameras[0].up, {0, 1, 0});
    EXPECT_NEAR(model.cameras[0].fovDeg, 28.6479f, 1e-3f); // 0.5 rad
    EXPECT_EQ(model.cameras[1].name, "Lens");
    expectNear(model.cameras[1].forward, {0, 0, -1});
    EXPECT_THAT(model.warnings, Contains(HasSubstr("\"Plan\" has no perspective")));
    EXPECT_THAT(model.warnings, Contains(HasSubstr("1 objects whose transforms")));
}

} // namespace
} // namespace patina
