#include "core/material/Material.h"
#include "tests/core/worker/FbxWriter.h"
#include "tests/core/worker/ModelFiles.h"

#include <cmath>
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

} // namespace
} // namespace patina
