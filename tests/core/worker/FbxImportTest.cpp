#include "core/material/Material.h"
#include "tests/core/worker/FbxWriter.h"
#include "tests/core/worker/ModelFiles.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <glm/geometric.hpp>

namespace patina {
namespace {

class FbxImport : public test::ImportTest {};

TEST_F(FbxImport, TextAndBinaryHoldTheSame) {
    folder.write("textures/wood.png", std::string_view("any"));
    for (const std::string& content :
         {test::writeFbxText(test::fbxQuad()), test::writeFbxBinary(test::fbxQuad())}) {
        const ImportedModel model = import("a.fbx", content);
        EXPECT_EQ(model.format, "fbx");
        EXPECT_EQ(model.triangleCount, 2u);
        EXPECT_EQ(model.instances[0].name, "plank");
        const auto index = static_cast<std::size_t>(model.instances[0].material);
        const ImportedMaterial& material = model.materials[index];
        EXPECT_EQ(material.name, "oak");
        // Blender, the most common writer, stores (10 (1 - r))² as the exponent.
        EXPECT_NEAR(material.numbers[MaterialInput::PerceptualRoughness],
                    1.0f - std::sqrt(30.0f) / 10.0f, 1e-5f);
        // "C:\art\Wood.PNG" was elsewhere; here it is in the folder of textures.
        ASSERT_TRUE(material.maps[MaterialInput::BaseColor]);
        EXPECT_EQ(material.maps[MaterialInput::BaseColor]->file,
                  folder.path() / "textures" / "wood.png");
        EXPECT_EQ(material.maps[MaterialInput::BaseColor]->uvScale, glm::vec2(2, 2));
        EXPECT_EQ(material.maps[MaterialInput::BaseColor]->uvOffset,
                  glm::vec2(0, -1)); // 1 - scale: v points down
        EXPECT_EQ(material.baseColor, glm::vec4(1.0f));
        EXPECT_TRUE(model.missingTextures.empty());
        expectNear(glm::normalize(areaVector(model)), {0, 0, 1});
    }
}

TEST_F(FbxImport, Units) {
    test::FbxScene scene;
    scene.size = 100;
    scene.translation[0] = 50;
    const auto centimetres = corners(import("a.fbx", test::writeFbxText(test::fbxQuad(scene))));
    expectNear(centimetres[0], {0.5f, 0, 0});
    expectNear(centimetres[2], {1.5f, 1, 0});
    scene.unitScaleFactor = 100; // metres
    expectNear(corners(import("b.fbx", test::writeFbxBinary(test::fbxQuad(scene))))[2],
               {150, 100, 0});
}

TEST_F(FbxImport, ZUp) {
    // As Blender and 3ds Max write it: right +X, up +Z, front -Y.
    test::FbxScene scene;
    scene.unitScaleFactor = 100;
    scene.upAxis = 2;
    scene.frontAxis = 1;
    scene.frontSign = -1;
    scene.translation[2] = 3;
    const ImportedModel model = import("a.fbx", test::writeFbxText(test::fbxQuad(scene)));
    expectNear(corners(model)[0], {0, 3, 0});
    expectNear(corners(model)[2], {1, 3, -1}); // (x, y, z) becomes (x, z, -y)
    expectNear(glm::normalize(areaVector(model)), {0, 1, 0});
}

TEST_F(FbxImport, OldFilesAreNotCalledDamaged) {
    for (const bool binary : {false, true}) {
        std::string file =
            binary ? test::writeFbxBinary(test::fbxQuad()) : test::writeFbxText(test::fbxQuad());
        // The binary one states it as a number behind its first 23 bytes.
        const std::uint32_t old = 6100;
        if (binary)
            std::memcpy(file.data() + 23, &old, sizeof old);
        else
            file.replace(file.find("7400"), 4, "6100");
        const Error error = importError("a.fbx", file);
        EXPECT_THAT(error.message, testing::HasSubstr("this is FBX 6.1, which is too old"));
        EXPECT_THAT(error.message, testing::HasSubstr("FBX Converter"));
        EXPECT_THAT(error.message, testing::Not(testing::HasSubstr("damaged")));
    }
    EXPECT_THAT(importError("b.fbx", "Kaydara FBX Binary").message, testing::HasSubstr("damaged"));
}

TEST_F(FbxImport, AnimationIsNamed) {
    std::vector<test::FbxNode> document = test::fbxQuad();
    EXPECT_THAT(import("a.fbx", test::writeFbxBinary(document)).warnings,
                testing::Each(testing::Not(testing::HasSubstr("Animation"))));
    for (test::FbxNode& node : document)
        if (node.name == "Objects")
            node.children.push_back({"AnimationCurve",
                                     {std::int64_t{77}, std::string("c::AnimCurve"), std::string()},
                                     {}});
    EXPECT_THAT(import("b.fbx", test::writeFbxBinary(document)).warnings,
                testing::Contains(testing::HasSubstr("Animation is not read")));
}

// A T with points on its edges.
TEST_F(FbxImport, ConcavePolygonsKeepTheirNotches) {
    std::vector<test::FbxNode> document = test::fbxQuad();
    test::FbxNode* geometry = nullptr;
    for (test::FbxNode& node : document)
        for (test::FbxNode& child : node.children)
            if (child.name == "Geometry")
                geometry = &child;
    ASSERT_NE(geometry, nullptr);
    for (test::FbxNode& part : geometry->children) {
        if (part.name == "Vertices")
            part.properties = {std::vector<double>{6, 4, 0, 4, 4, 0, 2, 4, 0, 0, 4, 0,
                                                   0, 2, 0, 2, 2, 0, 2, 1, 0, 2, 0, 0,
                                                   4, 0, 0, 4, 1, 0, 4, 2, 0, 6, 2, 0}};
        if (part.name == "PolygonVertexIndex") // the last one is negated
            part.properties = {std::vector<std::int32_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, -12}};
    }
    std::erase_if(geometry->children,
                  [](const test::FbxNode& part) { return part.name.starts_with("Layer"); });
    const auto points = corners(import("a.fbx", test::writeFbxText(document)));
    double area = 0.0;
    for (std::size_t i = 0; i + 2 < points.size(); i += 3)
        area += 0.5 * static_cast<double>(glm::length(
                          glm::cross(points[i + 1] - points[i], points[i + 2] - points[i])));
    EXPECT_NEAR(area, 16e-4, 1e-8); // centimetres
}

} // namespace
} // namespace patina
