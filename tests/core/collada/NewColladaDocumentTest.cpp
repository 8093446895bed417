// Scenes from elsewhere as COLLADA documents.
#include "core/export/collada/NewColladaDocument.h"

#include "tests/core/collada/Documents.h"

#include <gmock/gmock.h>
#include <pugixml.hpp>

using namespace patina;
using namespace patina::test;

namespace {

constexpr std::chrono::sys_seconds kNewYear{std::chrono::sys_days{std::chrono::year{2027} / 1 / 1}};

NewColladaScene twoSquares() {
    NewColladaScene scene;
    scene.name = "Two squares";
    ColladaMaterial wood;
    wood.name = "Wood & more";
    wood.diffuseTexture = "textures/wood floor.png";
    ColladaMaterial glow;
    glow.name = "Glow";
    glow.diffuse = {0.25f, 0.5f, 0.75f};
    glow.emission = {1.0f, 0.5f, 0.0f};
    glow.opacity = 0.5f;
    glow.doubleSided = true;
    scene.materials = {wood, glow};
    for (int i = 0; i < 2; ++i) {
        NewColladaMesh lit;
        lit.name = i == 0 ? "Gr\xc3\xbcner Boden" : "";
        lit.material = i;
        const auto z = static_cast<float>(i);
        lit.mesh.positions = {{0, 0, z}, {1, 0, z}, {1, 1, z}, {0, 1, z}};
        lit.mesh.normals.assign(4, {0, 0, 1});
        if (i == 0)
            lit.mesh.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
        lit.mesh.indices = {0, 1, 2, 0, 2, 3};
        lit.colors.assign(4, {0.1f, 0.2f, 0.3f, 1.0f});
        lit.radiosity.assign(4, {1.0f, 2.0f, 3.0f});
        scene.meshes.push_back(lit);
    }
    return scene;
}

} // namespace

TEST(NewColladaDocument, ReadsBackAsItWas) {
    const NewColladaScene scene = twoSquares();
    Result<ColladaDocument> made = newColladaDocument(scene, kNewYear);
    ASSERT_TRUE(made.ok()) << made.error().text();
    const ColladaDocument document = parsed(made->text());
    ASSERT_EQ(document.instances().size(), 2u);
    ASSERT_EQ(document.materials().size(), 2u);
    EXPECT_EQ(document.scenes()[0].name, "Two_squares");
    for (std::size_t i = 0; i < 2; ++i) {
        const Mesh mesh = meshOf(document, i).mesh;
        EXPECT_EQ(mesh.positions, scene.meshes[i].mesh.positions);
        EXPECT_EQ(mesh.normals, scene.meshes[i].mesh.normals);
        EXPECT_EQ(mesh.uvs, scene.meshes[i].mesh.uvs);
        EXPECT_EQ(mesh.indices, scene.meshes[i].mesh.indices);
        const ColladaMaterial& a = document.materials()[i];
        const ColladaMaterial& b = scene.materials[i];
        EXPECT_EQ(document.instances()[i].material, static_cast<int>(i));
        EXPECT_EQ(a.name, i == 0 ? "Wood___more" : "Glow");
        EXPECT_EQ(a.diffuse, b.diffuse);
        EXPECT_EQ(a.diffuseTexture, b.diffuseTexture);
        EXPECT_EQ(a.emission, b.emission);
        EXPECT_EQ(a.opacity, b.opacity);
        EXPECT_EQ(a.doubleSided, b.doubleSided);
    }
    EXPECT_EQ(document.instances()[0].path, "Gr\xc3\xbcner_Boden");
    pugi::xml_document tree;
    ASSERT_TRUE(tree.load_string(made->text().c_str()));
    EXPECT_STREQ(tree.child("COLLADA").child("asset").child_value("modified"),
                 "2027-01-01T00:00:00Z");
    for (const pugi::xpath_node& id : tree.select_nodes("//@id"))
        for (const char* c = id.attribute().value(); *c != '\0'; ++c)
            EXPECT_GT(*c, ' ') << id.attribute().value();
}

// What has its light at the vertices is not to be lit by whoever shows it.
TEST(NewColladaDocument, UnlitMaterialsAreConstant) {
    NewColladaScene scene = twoSquares();
    scene.materials[0].unlit = true;
    scene.materials[0].emissionTexture = std::exchange(scene.materials[0].diffuseTexture, {});
    const Result<ColladaDocument> made = newColladaDocument(scene, kNewYear);
    ASSERT_TRUE(made.ok()) << made.error().text();
    const ColladaDocument document = parsed(made->text());
    EXPECT_TRUE(document.materials()[0].unlit);
    EXPECT_EQ(document.materials()[0].emissionTexture, "textures/wood floor.png");
    EXPECT_EQ(document.materials()[0].diffuse, glm::vec3(0.0f));
    EXPECT_FALSE(document.materials()[1].unlit);
    pugi::xml_document tree;
    ASSERT_TRUE(tree.load_string(made->text().c_str()));
    EXPECT_EQ(tree.select_nodes("//constant").size(), 1u);
    EXPECT_EQ(tree.select_nodes("//constant/emission/texture").size(), 1u);
    EXPECT_EQ(tree.select_nodes("//constant/diffuse").size(), 0u) << "the schema has none there";
    EXPECT_EQ(tree.select_nodes("//lambert").size(), 1u);
}

TEST(NewColladaDocument, IsTheSameEachTime) {
    EXPECT_EQ(newColladaDocument(twoSquares(), kNewYear)->text(),
              newColladaDocument(twoSquares(), kNewYear)->text());
}

// What was made can be lit again.
TEST(NewColladaDocument, CanBeLit) {
    Result<ColladaDocument> document = newColladaDocument(twoSquares(), kNewYear);
    ASSERT_TRUE(document->light(std::vector{litMesh(*document, 0)}, kNewYear).ok());
    EXPECT_EQ(document->instances().size(), 2u);
    EXPECT_THAT(document->instances()[0].geometryId, ::testing::EndsWith("-lit"));
}

TEST(NewColladaDocument, WrongMeshesAreRefused) {
    EXPECT_EQ(newColladaDocument({}, kNewYear).error().kind, ErrorKind::Usage);
    NewColladaScene scene = twoSquares();
    scene.meshes[1].colors.pop_back();
    EXPECT_THAT(newColladaDocument(scene, kNewYear).error().message,
                ::testing::HasSubstr("3 colours"));
}

TEST(NewColladaDocument, MayHaveALightMap) {
    NewColladaScene scene = twoSquares();
    scene.lightMap = ColladaLightMap{"light.png", "light.exr"};
    EXPECT_FALSE(newColladaDocument(scene, kNewYear).ok()) << "its vertices have light";
    for (ColladaMaterial& material : scene.materials) {
        material.diffuse = glm::vec3(0.0f);
        material.diffuseTexture.clear();
        material.emissionTexture = "light.png";
    }
    for (NewColladaMesh& mesh : scene.meshes) {
        mesh.colors.clear();
        mesh.radiosity.clear();
        mesh.lightMapUvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    }
    const Result<ColladaDocument> made = newColladaDocument(scene, kNewYear);
    ASSERT_TRUE(made.ok()) << made.error().text();
    const ColladaDocument document = parsed(made->text());
    EXPECT_TRUE(document.showsLightMap());
    for (const ColladaMaterial& material : document.materials())
        EXPECT_EQ(material.emissionTexture, "light.png");
    pugi::xml_document tree;
    tree.load_string(made->text().c_str());
    for (const auto& found : tree.select_nodes("//triangles"))
        EXPECT_TRUE(found.node().find_child([](const pugi::xml_node& input) {
            return std::string(input.attribute("semantic").value()) == "TEXCOORD" &&
                   std::string(input.attribute("set").value()) == "1";
        }));
    EXPECT_EQ(tree.select_nodes("//bind_vertex_input[@semantic='LightMap']").size(), 2u);
}
