#include "core/material/Material.h"
#include "tests/core/worker/ModelFiles.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace patina {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kQuad = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                              "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\n"
                              "usemtl m\nf 1/1/1 2/2/1 3/3/1 4/4/1\n";

class ObjImport : public test::ImportTest {
  protected:
    ImportedMaterial material(const std::string& properties) {
        folder.write("a.mtl", std::string_view("newmtl m\n" + properties));
        const ImportedModel model = import("a.obj", kQuad);
        const auto index = static_cast<std::size_t>(model.instances[0].material);
        return model.materials[index];
    }
};

TEST_F(ObjImport, GeometryAndTextureCoordinates) {
    const ImportedModel model = import("a.obj", kQuad);
    EXPECT_EQ(model.format, "obj");
    EXPECT_EQ(model.triangleCount, 2u);
    const Mesh& mesh = *model.meshes[0];
    ASSERT_EQ(mesh.vertexCount(), 4u);
    for (std::size_t i = 0; i < 4; ++i) // OBJ's v points up, ours down
        EXPECT_EQ(mesh.uvs[i], glm::vec2(mesh.positions[i].x, 1.0f - mesh.positions[i].y));
    // u to the right and the image upright: w = +1.
    EXPECT_NEAR(mesh.tangents[0].x, 1.0f, 1e-5f);
    EXPECT_EQ(mesh.tangents[0].w, 1.0f);
    EXPECT_GT(areaVector(model).z, 0.0f);
    EXPECT_FALSE(model.repairs.generatedNormals);
}

TEST_F(ObjImport, BothWindingsKeepTheirOrder) {
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    EXPECT_GT(areaVector(import("a.obj", vertices + "f 1 2 3\n")).z, 0.0f);
    const ImportedModel clockwise = import("b.obj", vertices + "f 1 3 2\n");
    EXPECT_LT(areaVector(clockwise).z, 0.0f);
    EXPECT_LT(clockwise.meshes[0]->normals[0].z, 0.0f); // the generated normals agree
}

TEST_F(ObjImport, WithoutNormalsAndTextureCoordinatesTheyAreGenerated) {
    const ImportedModel model = import("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    EXPECT_TRUE(model.repairs.generatedNormals);
    EXPECT_TRUE(model.repairs.generatedUvs);
    EXPECT_TRUE(model.repairs.generatedTangents);
    EXPECT_THAT(model.warnings, Contains(HasSubstr("Normals were generated")));
    EXPECT_THAT(model.warnings, Contains(HasSubstr("Texture coordinates were generated")));
    EXPECT_EQ(model.materials[0].name, "default");
}

TEST_F(ObjImport, WhatHasNoNameIsCalledByTheFile) {
    const std::string face = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    const ImportedModel unnamed = import("Cow.obj", face);
    ASSERT_EQ(unnamed.instances.size(), 1u);
    EXPECT_EQ(unnamed.instances[0].name, "Cow");
    EXPECT_EQ(unnamed.meshes[0]->name, "Cow");
    const ImportedModel named = import("Cow.obj", "o Spot\n" + face);
    EXPECT_EQ(named.instances[0].name, "Spot");
}

// Numbers without a digit before the point, by the reader of plain files and by Assimp's (a face of
// five corners).
TEST_F(ObjImport, NumbersMayBeginWithTheirPoint) {
    const std::string vertices =
        "v -.5 -.5 0\nv .5 -.5 +.25\n v .5\t.5 0\nv 0. .75 0\nv -.5 .5 0\n";
    for (const char* faces : {"f 1 2 3\nf 3 4 5\n", "f 1 2 3 4 5\n"}) {
        const ImportedModel model = import("a.obj", vertices + faces);
        glm::vec3 least(9.0f), most(-9.0f);
        for (const glm::vec3& p : model.meshes[0]->positions) {
            least = glm::min(least, p);
            most = glm::max(most, p);
        }
        EXPECT_EQ(least, glm::vec3(-0.5f, -0.5f, 0.0f)) << faces;
        EXPECT_EQ(most, glm::vec3(0.5f, 0.75f, 0.25f)) << faces;
    }
}

// As Windows' editor saves "Unicode" and "Unicode, big endian", the materials likewise.
TEST_F(ObjImport, Utf16IsRead) {
    for (const bool bigEndian : {false, true}) {
        const auto utf16 = [&](const std::string& ascii) {
            std::string text = bigEndian ? "\xfe\xff" : "\xff\xfe";
            for (const char c : ascii) {
                const char unit[] = {c, '\0'};
                text += bigEndian ? unit[1] : unit[0];
                text += bigEndian ? unit[0] : unit[1];
            }
            return text;
        };
        folder.write("a.mtl", utf16("newmtl paint\r\nKd 0.25 0.5 0.75\r\n"));
        const ImportedModel model =
            import("a.obj", utf16("mtllib a.mtl\r\nv 0 0 0\r\nv .5 0 0\r\nv 0 1 0\r\n"
                                  "usemtl paint\r\nf 1 2 3\r\n"));
        ASSERT_EQ(model.meshes.size(), 1u) << bigEndian;
        EXPECT_EQ(model.meshes[0]->positions[1].x, 0.5f);
        EXPECT_EQ(model.materials.back().name, "paint");
        EXPECT_FLOAT_EQ(model.materials.back().baseColor.g, 0.5f);
    }
}

TEST_F(ObjImport, AnisotropyAsBlenderWritesItIsNoDamage) {
    const ImportedMaterial read =
        material("Kd 0.5 0.5 0.5\naniso 0.5\n anisor 0.1\nPr 0.25\naniso 1");
    EXPECT_FLOAT_EQ(read.numbers[MaterialInput::PerceptualRoughness], 0.25f);
    EXPECT_FLOAT_EQ(read.baseColor.r, 0.5f);
}

TEST_F(ObjImport, SeveralMaterialsBecomeSeveralMeshes) {
    folder.write("seed.mtl", std::string_view(test::kObjMaterials));
    folder.write("wood.png", std::string_view("any"));
    const ImportedModel model = import("seed.obj", test::seedFiles(worker()).at("obj")[0]);
    EXPECT_EQ(model.meshes.size(), 2u);
    EXPECT_EQ(model.triangleCount, 5u);
    std::vector<std::string> names;
    for (const ImportedInstance& instance : model.instances)
        names.push_back(model.materials[static_cast<std::size_t>(instance.material)].name);
    EXPECT_THAT(names, testing::UnorderedElementsAre("wood", "red"));
    EXPECT_THAT(model.missingTextures, ElementsAre("wood_normal.png"));
}

TEST_F(ObjImport, BlinnPhongBecomesRoughness) {
    const ImportedMaterial m = material("Kd 0.8 0.1 0.05\nKs 1 1 1\nNs 48\n");
    EXPECT_EQ(m.name, "m");
    EXPECT_FLOAT_EQ(m.baseColor.r, 0.8f);
    EXPECT_FLOAT_EQ(m.baseColor.b, 0.05f);
    EXPECT_FLOAT_EQ(m.numbers[MaterialInput::Metallic], 0.0f);
    // alpha = sqrt(2 / (48 + 2)) = 0.2; perceptual roughness is its root.
    EXPECT_NEAR(m.numbers[MaterialInput::PerceptualRoughness], std::sqrt(0.2f), 1e-5f);
    EXPECT_NEAR(material("Kd 1 1 1\nNs 0\n").numbers[MaterialInput::PerceptualRoughness], 0.5f,
                1e-6f);
}

TEST_F(ObjImport, PhysicallyBasedExtensionWins) {
    const ImportedMaterial m = material("Kd 1 1 1\nNs 48\nPr 0.3\nPm 0.8\n");
    EXPECT_FLOAT_EQ(m.numbers[MaterialInput::PerceptualRoughness], 0.3f);
    EXPECT_FLOAT_EQ(m.numbers[MaterialInput::Metallic], 0.8f);
}

TEST_F(ObjImport, Maps) {
    for (const char* name : {"c.png", "n.png", "r.png", "m.png", "e.png"})
        folder.write(name, std::string_view("any"));
    const ImportedMaterial m = material("Kd 0.2 0.2 0.2\nPr 0.1\nmap_Kd c.png\nnorm n.png\n"
                                        "map_Pr r.png\nmap_Pm m.png\nmap_Ke e.png\n");
    ASSERT_TRUE(m.maps[MaterialInput::BaseColor] && m.maps[MaterialInput::Normal] &&
                m.maps[MaterialInput::PerceptualRoughness] && m.maps[MaterialInput::Metallic] &&
                m.maps[MaterialInput::Emissive]);
    EXPECT_EQ(m.maps[MaterialInput::BaseColor]->file, folder.path() / "c.png");
    EXPECT_EQ(m.maps[MaterialInput::Normal]->file, folder.path() / "n.png");
    EXPECT_EQ(m.maps[MaterialInput::PerceptualRoughness]->file, folder.path() / "r.png");
    EXPECT_EQ(m.maps[MaterialInput::Metallic]->file, folder.path() / "m.png");
    EXPECT_EQ(m.maps[MaterialInput::Emissive]->file, folder.path() / "e.png");
    EXPECT_EQ(m.baseColor, glm::vec4(1.0f)); // the map replaces the colour
    EXPECT_FLOAT_EQ(m.numbers[MaterialInput::Metallic], 1.0f);
    EXPECT_FLOAT_EQ(m.numbers[MaterialInput::PerceptualRoughness], 1.0f);
    EXPECT_EQ(m.emissive, glm::vec3(1.0f));
    const ImportedMaterial bump = material("Kd 1 1 1\nmap_Bump n.png\n");
    ASSERT_TRUE(bump.maps[MaterialInput::Normal]);
    EXPECT_EQ(bump.maps[MaterialInput::Normal]->file, folder.path() / "n.png");
}

// As artists' programs write them: quotes, blanks and comments at the end, options, Latin-1.
TEST_F(ObjImport, NamesOfTexturesInAllTheirSpellings) {
    for (const char* name :
         {"wood oak.png", "plain.png", "-s.png", "no #1.png", "na\u00efve \u00e9.png"})
        folder.write(name, std::string_view("any"));
    for (const auto& [spelled, name] : std::vector<std::pair<std::string, std::string>>{
             {"map_Kd \"wood oak.png\"", "wood oak.png"},
             {"map_Kd -clamp on \"wood oak.png\" # the best", "wood oak.png"},
             {"map_Kd wood oak.png", "wood oak.png"},
             {"\tMAP_KD plain.png  \t", "plain.png"},
             {"map_Kd plain.png   \r", "plain.png"},
             {"map_Kd plain.png # comment", "plain.png"},
             {"map_Kd no #1.png", "no #1.png"},
             {"map_Kd -s.png", "-s.png"},
             {"map_Kd -mm 0 1 -boost 2 -texres 4 -o 0 -blendu on plain.png", "plain.png"},
             {"map_Kd na\xefve \xe9.png", "na\u00efve \u00e9.png"}}) {
        const ImportedMaterial m = material(spelled + "\n");
        ASSERT_TRUE(m.maps[MaterialInput::BaseColor]) << spelled;
        EXPECT_EQ(m.maps[MaterialInput::BaseColor]->file, folder.path() / name) << spelled;
    }
}

TEST_F(ObjImport, OptionsOfTextures) {
    const ImportedMaterial m = material("map_Kd -s 2 3 1 -o 0.5 0.25 0 c.png\n"
                                        "map_Bump -bm 0.5 n.png\nmap_Pr -imfchan G orm.png\n");
    ASSERT_TRUE(m.maps[MaterialInput::BaseColor] && m.maps[MaterialInput::PerceptualRoughness]);
    EXPECT_EQ(m.maps[MaterialInput::BaseColor]->uvScale, glm::vec2(2, 3));
    // The lower left corner, (0, 1) in ours, shows (.5, .25) of the file's: (.5, .75).
    EXPECT_EQ(m.maps[MaterialInput::BaseColor]->uvOffset, glm::vec2(0.5f, 0.75f - 3.0f));
    EXPECT_FLOAT_EQ(m.numbers[MaterialInput::Normal], 0.5f);
    EXPECT_EQ(m.maps[MaterialInput::PerceptualRoughness]->channel, 'g');
    EXPECT_FLOAT_EQ(material("norm -bm 2 n.png\n").numbers[MaterialInput::Normal], 2.0f);
    EXPECT_FLOAT_EQ(material("bump -bm inf n.png\n").numbers[MaterialInput::Normal], 0.0f);
}

TEST_F(ObjImport, AmbientTexturesAreWhatTheirNameSays) {
    const ImportedMaterial ao = material("map_Kd c.png\nmap_Ka maps/Wall_AO.png\n");
    ASSERT_TRUE(ao.maps[MaterialInput::Occlusion]);
    EXPECT_EQ(ao.maps[MaterialInput::Occlusion]->file, folder.path() / "maps/Wall_AO.png");
    EXPECT_EQ(ao.maps[MaterialInput::Occlusion]->channel, 'r');
    folder.write("a.mtl", std::string_view("newmtl m\nmap_Kd c.png\nmap_Ka chaos.png\n"));
    EXPECT_THAT(import("a.obj", kQuad).warnings,
                Contains(HasSubstr("\"chaos.png\" of material \"m\" is not used")));
    folder.write("a.mtl", std::string_view("newmtl m\nmap_Kd c.png\nmap_Ka \"c.png\"\n"));
    EXPECT_THAT(import("a.obj", kQuad).warnings, IsEmpty());
}

TEST_F(ObjImport, StatementsWithoutAPlaceAreNamed) {
    folder.write("a.mtl", std::string_view("newmtl m\nmap_Ks s.png\nPc 1\nPs 0\naniso 0.5\n"
                                           "refl -type sphere sky.png\nnewmtl n\nmap_Ks t.png\n"));
    EXPECT_THAT(import("a.obj", kQuad).warnings,
                ElementsAre(HasSubstr("left out: Pc, aniso, map_Ks, refl.")));
}

TEST_F(ObjImport, TheMaterialFileMayBeQuoted) {
    folder.write("my m.mtl", std::string_view("newmtl m\nKd 0.25 0 0\n"));
    for (const char* name : {"my m.mtl", "\"my m.mtl\"", "my m.mtl  \t", "my m.mtl \r"}) {
        std::string text = kQuad;
        text.replace(0, text.find('\n'), std::string("mtllib ") + name);
        const ImportedModel model = import("a.obj", text);
        const auto index = static_cast<std::size_t>(model.instances[0].material);
        EXPECT_FLOAT_EQ(model.materials[index].baseColor.r, 0.25f) << name;
    }
}

TEST_F(ObjImport, EmissionAndOpacity) {
    const ImportedMaterial m = material("Kd 1 1 1\nKe 3 2 1\nd 0.25\n");
    EXPECT_EQ(m.emissive, glm::vec3(3, 2, 1));
    EXPECT_FLOAT_EQ(m.baseColor.a, 0.25f);
    EXPECT_TRUE(m.alphaBlend);
    EXPECT_FALSE(material("Kd 1 1 1\n").alphaBlend);
}

TEST_F(ObjImport, TheMaterialFileMayBeMissing) {
    const ImportedModel model = import("a.obj", kQuad);
    EXPECT_EQ(model.triangleCount, 2u);
    EXPECT_FALSE(model.materials.empty());
}

TEST_F(ObjImport, NamesAreBytes) {
    folder.write("a.mtl", std::string_view("newmtl m\nKd 1 1 1\nmap_Kd h\xf6lz e.png\n"));
    folder.write("h\xf6lz e.png", std::string_view("any"));
    for (const char* name : {"with space.obj", "\xff\xfe \xe9.obj", "日本語.OBJ"}) {
        const ImportedModel model = import(name, kQuad);
        EXPECT_EQ(model.triangleCount, 2u) << name;
        EXPECT_THAT(model.missingTextures, IsEmpty()) << name;
        const auto index = static_cast<std::size_t>(model.instances[0].material);
        ASSERT_TRUE(model.materials[index].maps[MaterialInput::BaseColor]);
        EXPECT_EQ(model.materials[index].maps[MaterialInput::BaseColor]->file,
                  folder.path() / "h\xf6lz e.png");
    }
}

TEST_F(ObjImport, PolygonsAreTriangulated) {
    const ImportedModel model =
        import("a.obj", "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 3 0\nv 0 2 0\nf 1 2 3 4 5\n"); // area 5
    EXPECT_EQ(model.triangleCount, 3u);
    EXPECT_NEAR(areaVector(model).z, 10.0f, 1e-4f);
}

// A T with points on its edges, as exports of joined walls have them: Assimp filled its notch. The
// triangles beside it go through Assimp as well.
TEST_F(ObjImport, ConcavePolygonsKeepTheirNotches) {
    const ImportedModel model =
        import("a.obj", "v 6 4 0\nv 4 4 0\nv 2 4 0\nv 0 4 0\nv 0 2 0\nv 2 2 0\nv 2 1 0\nv 2 0 0\n"
                        "v 4 0 0\nv 4 1 0\nv 4 2 0\nv 6 2 0\nv 9 0 0\nv 9 1 0\nv 8 0 0\nv 8 1 0\n"
                        "f 1 2 3 4 5 6 7 8 9 10 11 12\nf 13 14 15\nf 14 16 15 13\n");
    const auto points = corners(model);
    double area = 0.0;
    for (std::size_t i = 0; i + 2 < points.size(); i += 3) {
        const float part = glm::cross(points[i + 1] - points[i], points[i + 2] - points[i]).z;
        area += points[i].x > 7.0f ? 0.0 : std::abs(0.5 * static_cast<double>(part));
    }
    EXPECT_DOUBLE_EQ(area, 16.0);
    EXPECT_EQ(model.triangleCount, 10u + 1u + 2u);
    EXPECT_THAT(model.warnings, testing::Each(testing::Not(HasSubstr("degenerate"))));
}

} // namespace
} // namespace patina
