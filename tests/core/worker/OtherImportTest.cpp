// COLLADA, PLY and STL.
#include "core/material/Material.h"
#include "core/mesh/MeshSource.h"
#include "tests/core/worker/ModelFiles.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace patina {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

class ColladaImport : public test::ImportTest {};
class PlyImport : public test::ImportTest {};
class StlImport : public test::ImportTest {};

TEST_F(ColladaImport, UnitsAndAxes) {
    // The first corner sits at the node's translation (10, 20, 30).
    const ImportedModel metres = import("a.dae", test::daeQuad("1", "Y_UP"));
    EXPECT_EQ(metres.format, "collada");
    expectNear(corners(metres)[0], {10, 20, 30});
    expectNear(corners(metres)[2], {11, 22, 30});
    expectNear(corners(import("b.dae", test::daeQuad("0.01", "Y_UP")))[0], {0.1f, 0.2f, 0.3f});
    // Z up: (x, y, z) becomes (x, z, -y).
    const ImportedModel zUp = import("c.dae", test::daeQuad("1", "Z_UP"));
    expectNear(corners(zUp)[0], {10, 30, -20});
    expectNear(glm::normalize(areaVector(zUp)), {0, 1, 0});
    expectNear(corners(import("d.dae", test::daeQuad("0.0254", "Z_UP")))[0],
               {0.254f, 0.762f, -0.508f});
}

TEST_F(ColladaImport, SkinsAreNamed) {
    std::string text = test::daeQuad("1", "Y_UP");
    const auto replace = [&](const std::string& what, const std::string& instead) {
        ASSERT_NE(text.find(what), std::string::npos) << what;
        text.replace(text.find(what), what.size(), instead);
    };
    EXPECT_THAT(import("a.dae", text).warnings, testing::Each(testing::Not(HasSubstr("Skins"))));
    replace("<library_visual_scenes>",
            R"(<library_controllers><controller id="ctl"><skin source="#geo">
<source id="joints"><Name_array id="joints-a" count="1">bone</Name_array><technique_common>
<accessor source="#joints-a" count="1" stride="1"><param name="JOINT" type="name"/></accessor></technique_common></source>
<source id="binds"><float_array id="binds-a" count="16">1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</float_array><technique_common>
<accessor source="#binds-a" count="1" stride="16"><param name="TRANSFORM" type="float4x4"/></accessor></technique_common></source>
<source id="weights"><float_array id="weights-a" count="1">1</float_array><technique_common>
<accessor source="#weights-a" count="1" stride="1"><param name="WEIGHT" type="float"/></accessor></technique_common></source>
<joints><input semantic="JOINT" source="#joints"/><input semantic="INV_BIND_MATRIX" source="#binds"/></joints>
<vertex_weights count="4"><input semantic="JOINT" source="#joints" offset="0"/><input semantic="WEIGHT" source="#weights" offset="1"/>
<vcount>1 1 1 1</vcount><v>0 0 0 0 0 0 0 0</v></vertex_weights></skin></controller></library_controllers>
<library_visual_scenes>)");
    replace("<instance_geometry url=\"#geo\">", "<instance_controller url=\"#ctl\">");
    replace("</instance_geometry>\n</node>",
            "</instance_controller>\n</node><node id=\"bone\" sid=\"bone\" type=\"JOINT\"/>");
    const ImportedModel model = import("b.dae", text);
    EXPECT_EQ(model.triangleCount, 2u);
    EXPECT_THAT(model.warnings, Contains(HasSubstr("Skins are read from glTF alone")));
}

// daeQuad() with other nodes beside its own.
std::string withNodes(const std::string& library, const std::string& scene) {
    std::string text = test::daeQuad("1", "Y_UP");
    const std::string where = "<library_visual_scenes>";
    text.insert(text.find(where), "<library_nodes>" + library + "</library_nodes>");
    text.insert(text.find("</visual_scene>"), scene);
    return text;
}

std::string showing(const std::string& id, const std::string& content) {
    return "<node id=\"" + id + "\">" + content + "</node>";
}

std::string copies(const std::string& of, int count) {
    std::string text;
    for (int i = 0; i < count; ++i)
        text += "<instance_node url=\"#" + of + "\"/>";
    return text;
}

// A few words stand for any number of objects: they are counted before anything is made of them.
TEST_F(ColladaImport, CopiesOfCopiesAreCountedFirst) {
    std::string library = showing("n0", "<instance_geometry url=\"#geo\"/>");
    for (int i = 1; i <= 8; ++i)
        library += showing("n" + std::to_string(i), copies("n" + std::to_string(i - 1), 10));
    const Error error = importError("a.dae", withNodes(library, showing("all", copies("n8", 1))));
    EXPECT_THAT(error.message, HasSubstr("more than the supported 100000 objects"));
    EXPECT_THAT(error.detail, HasSubstr("100000001 objects"));
    // What shows nothing is copied, too.
    library = showing("n0", "") + library.substr(library.find("</node>") + 7);
    EXPECT_THAT(importError("b.dae", withNodes(library, showing("all", copies("n8", 1)))).message,
                HasSubstr("more than the supported 100000 objects"));

    const ImportedModel model = import(
        "c.dae", withNodes(showing("n0", "<instance_geometry url=\"#geo\"/>") +
                               showing("n1", copies("n0", 10)) + showing("n2", copies("n1", 10)),
                           showing("all", copies("n2", 3))));
    EXPECT_EQ(model.instances.size(), 301u);
}

// 4:3 and 60° high, two metres up and looking along +X (turned by -90° about Y).
TEST_F(ColladaImport, CamerasAreRead) {
    std::string text = withNodes("", R"(<node id="eye" name="Front">
        <translate>1 2 3</translate><rotate>0 1 0 -90</rotate>
        <instance_camera url="#cam"/></node>)");
    const std::size_t root = text.find("<library_");
    ASSERT_NE(root, std::string::npos);
    text.insert(root, R"(<library_cameras><camera id="cam" name="cam"><optics><technique_common>
        <perspective><yfov>60</yfov><aspect_ratio>1.3333333</aspect_ratio>
        <znear>0.1</znear><zfar>100</zfar></perspective></technique_common></optics></camera>
        </library_cameras>)");
    const ImportedModel model = import("a.dae", text);
    ASSERT_EQ(model.cameras.size(), 1u);
    const ImportedCamera& camera = model.cameras[0];
    EXPECT_EQ(camera.name, "Front");
    expectNear(camera.position, {1, 2, 3});
    expectNear(camera.forward, {1, 0, 0});
    expectNear(camera.up, {0, 1, 0});
    EXPECT_NEAR(camera.fovDeg, 60.0f, 0.01f);
}

TEST_F(ColladaImport, NodesThatContainThemselvesAreNamed) {
    const auto message = [&](const std::string& library, const std::string& scene) {
        return importError("a.dae", withNodes(library, scene)).message;
    };
    EXPECT_THAT(message(showing("Wheel", copies("Wheel", 1)), showing("all", copies("Wheel", 1))),
                HasSubstr("\"Wheel\" contains itself"));
    EXPECT_THAT(message(showing("a", copies("b", 1)) + showing("b", copies("a", 1)),
                        showing("all", copies("a", 1))),
                HasSubstr("contains itself"));
    EXPECT_THAT(message("", showing("outer", showing("inner", copies("outer", 1)))),
                HasSubstr("\"outer\" contains itself"));
    std::string deep;
    for (int i = 0; i < 5000; ++i)
        deep += showing("d" + std::to_string(i), copies("d" + std::to_string(i + 1), 1));
    EXPECT_THAT(message(deep, showing("all", copies("d0", 1))), HasSubstr("levels deep"));
    // Nobody shows these.
    EXPECT_EQ(import("b.dae", withNodes(showing("Wheel", copies("Wheel", 1)), "")).instances.size(),
              1u);
}

// Numbers beyond those that there are: the rest of the scene is shown.
TEST_F(ColladaImport, ObjectsWithoutAPlaceAreLeftOut) {
    const ImportedModel model =
        import("a.dae", withNodes("", "<node id=\"far\"><translate>1e39 0 0</translate>"
                                      "<instance_geometry url=\"#geo\"/><node id=\"child\">"
                                      "<instance_geometry url=\"#geo\"/></node></node>"));
    EXPECT_EQ(model.instances.size(), 1u);
    EXPECT_THAT(model.warnings, Contains(HasSubstr("2 objects whose transforms are not finite")));
}

TEST_F(ColladaImport, MaterialAndTexture) {
    folder.write("wood panel.png", std::string_view("any"));
    const ImportedModel model = import("a.dae", test::daeQuad("1", "Y_UP"));
    const auto index = static_cast<std::size_t>(model.instances[0].material);
    const ImportedMaterial& material = model.materials[index];
    EXPECT_EQ(material.name, "oak");
    ASSERT_TRUE(material.maps[MaterialInput::BaseColor]);
    EXPECT_EQ(material.maps[MaterialInput::BaseColor]->file, folder.path() / "wood panel.png");
    EXPECT_EQ(material.baseColor, glm::vec4(1.0f));
    EXPECT_NEAR(material.numbers[MaterialInput::PerceptualRoughness], std::sqrt(0.25f),
                1e-5f); // exponent 30
    EXPECT_EQ(model.instances[0].name, "plank");
    for (std::size_t i = 0; i < 4; ++i) {
        const Mesh& mesh = *model.meshes[0];
        EXPECT_EQ(mesh.uvs[i], glm::vec2(mesh.positions[i].x, 1.0f - mesh.positions[i].y / 2.0f));
    }
}

// XML lists may have white space anywhere.
TEST_F(ColladaImport, NumbersMayBeginOnTheNextLine) {
    std::string text = test::daeQuad("1", "Y_UP");
    const std::string texture = R"(<texture texture="samp" texcoord="UVMap"/>)";
    text.replace(text.find(texture), texture.size(),
                 "<color sid=\"c\">\r\n\t .5 0.25 0.125\n1\n</color>");
    const ImportedModel model = import("a.dae", text);
    const auto index = static_cast<std::size_t>(model.instances[0].material);
    EXPECT_EQ(model.materials[index].baseColor, glm::vec4(0.5f, 0.25f, 0.125f, 1.0f));
}

TEST_F(ColladaImport, OtherEncodingsAreRead) {
    // Text of ASCII letters alone, so that a letter is a unit of each encoding.
    std::string text = test::daeQuad("1", "Y_UP");
    text.replace(text.find("utf-8"), 5, "utf-16");
    std::string utf16 = "\xff\xfe";
    for (const char letter : text)
        utf16 += {letter, '\0'};
    const ImportedModel model = import("a.dae", utf16);
    EXPECT_EQ(model.triangleCount, 2u);
    expectNear(corners(model)[0], {10, 20, 30});

    std::string latin1 = test::daeQuad("1", "Y_UP");
    latin1.replace(latin1.find("utf-8"), 5, "ISO-8859-1");
    latin1.replace(latin1.find("plank"), 5, "B\xfchne");
    EXPECT_EQ(import("b.dae", latin1).instances[0].name, "B\xc3\xbchne");
}

// Assimp alone would show whatever lies in memory beyond the array.
TEST_F(ColladaImport, ArraysThatAreTooShortAreRefused) {
    const std::string whole = test::daeQuad("1", "Y_UP");
    const auto refused = [&](const std::string& old, const std::string& replacement) {
        std::string text = whole;
        text.replace(text.find(old), old.size(), replacement);
        return importError("a.dae", text);
    };
    const Error array = refused(R"(id="pos-a" count="12")", R"(id="pos-a" count="3")");
    EXPECT_EQ(array.kind, ErrorKind::InputBroken);
    EXPECT_THAT(
        array.text(),
        testing::AllOf(testing::HasSubstr("a.dae"),
                       testing::HasSubstr("12 numbers of the array \"pos-a\", which has 3")));
    for (const char* accessor :
         {R"(count="5" stride="3")", R"(count="4" stride="4")",
          R"(count="4" offset="1" stride="3")", R"(count="18446744073709551615" stride="3")",
          R"(count="4" offset="18446744073709551615" stride="3")",
          R"(count="4" stride="18446744073709551615")"})
        EXPECT_EQ(refused(R"(count="4" stride="3")", accessor).kind, ErrorKind::InputBroken)
            << accessor;
}

TEST_F(PlyImport, TextAndBinary) {
    const auto seeds = test::seedFiles(worker());
    for (const std::string& seed : seeds.at("ply")) {
        const ImportedModel model = import("a.ply", seed);
        EXPECT_EQ(model.format, "ply");
        EXPECT_EQ(model.triangleCount, 2u);
        expectNear(areaVector(model), {0, 0, 2});
        expectNear(corners(model)[1], {1, 0, 0});
    }
}

TEST_F(PlyImport, NormalsAndTextureCoordinates) {
    const ImportedModel model =
        import("a.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float "
                        "y\nproperty float z\nproperty float nx\nproperty float ny\nproperty float "
                        "nz\nproperty float s\nproperty float t\nelement face 1\nproperty list "
                        "uchar int vertex_indices\nend_header\n0 0 0 0 0 1 0 0\n1 0 0 0 0 1 1 0\n0 "
                        "1 0 0 0 1 0 1\n3 0 1 2\n");
    EXPECT_FALSE(model.repairs.generatedNormals);
    EXPECT_FALSE(model.repairs.generatedUvs);
    EXPECT_THAT(model.meshes[0]->uvs,
                ElementsAre(glm::vec2(0, 1), glm::vec2(1, 1), glm::vec2(0, 0)));
}

TEST_F(PlyImport, BigEndianPolygonsExtrasAndTexture) {
    folder.write("skin.png", std::string_view("any"));
    std::string file = "ply\r\nformat binary_big_endian 1.0\r\ncomment TextureFile skin.png\r\n"
                       "element camera 1\r\nproperty double angle\r\nelement vertex 5\r\n"
                       "property short x\r\nproperty uchar red\r\nproperty short y\r\n"
                       "property short z\r\nelement face 1\r\nproperty list ushort float "
                       "weights\r\nproperty list uchar ushort vertex_indices\r\nend_header\r\n";
    file += std::string(8, '\1');
    const char corners[5][2] = {{0, 0}, {2, 0}, {2, 2}, {1, 3}, {0, 2}};
    for (const auto& c : corners)
        file += std::string{0, c[0], 99, 0, c[1], 0, 0};
    file += std::string("\0\1\1\1\1\1", 6) + std::string{5, 0, 0, 0, 1, 0, 2, 0, 3, 0, 4};
    const ImportedModel model = import("a.ply", file);
    EXPECT_EQ(model.triangleCount, 3u);
    expectNear(areaVector(model), {0, 0, 10});
    ASSERT_TRUE(model.materials[0].maps[MaterialInput::BaseColor]);
    EXPECT_EQ(model.materials[0].maps[MaterialInput::BaseColor]->file, folder.path() / "skin.png");
}

// As MeshLab writes them. A vertex on a seam becomes several, which know whose copies they are.
TEST_F(PlyImport, FacesWithTextureCoordinatesOfTheirOwn) {
    folder.write("tex.png", std::string_view("any"));
    const std::string head =
        "ply\nformat ascii 1.0\ncomment TextureFile tex.png\nelement vertex 4\nproperty float x\n"
        "property float y\nproperty float z\n";
    const std::string vertices = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
    const std::string faces =
        "element face 2\nproperty list uchar int vertex_indices\nproperty list "
        "uchar float texcoord\nproperty int texnumber\n";
    const ImportedModel model =
        import("a.ply", head + faces + "end_header\n" + vertices +
                            "3 0 1 2 6 0 0 0 1 1 1 0\n3 0 2 3 6 0 0 0.5 1 1 0 0\n");
    EXPECT_FALSE(model.repairs.generatedUvs);
    const Mesh& mesh = *model.meshes[0];
    ASSERT_EQ(mesh.indices.size(), 6u);
    std::vector<glm::vec2> uvs;
    for (const std::uint32_t i : mesh.indices)
        uvs.push_back(mesh.uvs[i]);
    EXPECT_THAT(uvs, ElementsAre(glm::vec2(0, 1), glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(0, 1),
                                 glm::vec2(0.5f, 0), glm::vec2(1, 1)));
    EXPECT_EQ(mesh.vertexCount(), 5u) << "the first corner is shared";
    ASSERT_NE(meshSource(model.meshes[0]), nullptr);
    EXPECT_THAT(meshSource(model.meshes[0])->vertices, ElementsAre(0u, 1u, 2u, 2u, 3u));

    // Faces before vertices, and one of them without.
    const ImportedModel half =
        import("b.ply", head.substr(0, head.find("element vertex")) + faces +
                            head.substr(head.find("element vertex")) + "end_header\n" +
                            "3 0 1 2 6 0 0 0 1 1 1 0\n3 0 2 3 0 0\n" + vertices);
    EXPECT_EQ(half.triangleCount, 2u);
    EXPECT_THAT(half.warnings, Contains(HasSubstr("1 faces do not have texture coordinates")));
}

TEST_F(PlyImport, TriangleStrips) {
    // Two strips in one list, of two triangles and of one.
    const ImportedModel model =
        import("a.ply", "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float "
                        "y\nproperty float z\nelement tristrips 1\nproperty list int int "
                        "vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0 0\n"
                        "8 0 1 3 2 -1 1 4 2\n");
    EXPECT_EQ(model.triangleCount, 3u);
    expectNear(areaVector(model), {0, 0, 3});
}

TEST_F(PlyImport, ConcavePolygonsKeepTheirNotches) {
    // An arrow of four corners, and an L with a point on an edge.
    const std::string text =
        "ply\nformat ascii 1.0\nelement vertex 11\nproperty float x\nproperty float y\nproperty "
        "float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
        "-2 0 0\n-3 1 0\n-2.5 0 0\n-3 -1 0\n0 0 0\n4 0 0\n4 2 0\n2 2 0\n2 4 0\n1 4 0\n0 4 0\n"
        "4 1 2 3 0\n7 4 5 6 7 8 9 10\n";
    const auto points = corners(import("a.ply", text));
    double area = 0.0;
    for (std::size_t i = 0; i + 2 < points.size(); i += 3)
        area += 0.5 * static_cast<double>(glm::length(
                          glm::cross(points[i + 1] - points[i], points[i + 2] - points[i])));
    EXPECT_NEAR(area, 0.5 + 12.0, 1e-6);
}

TEST_F(PlyImport, ColoursAndFurtherTexturesAreNamed) {
    const ImportedModel model = import(
        "a.ply", "ply\nformat ascii 1.0\ncomment TextureFile a.png\ncomment TextureFile b.png\n"
                 "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty "
                 "uchar red\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                 "0 0 0 9\n1 0 0 9\n0 1 0 9\n3 0 1 2\n");
    EXPECT_THAT(model.warnings, Contains(HasSubstr("Colours of vertices and faces")));
    EXPECT_THAT(model.warnings, Contains(HasSubstr("2 textures for parts of its mesh")));
    EXPECT_THAT(model.missingTextures, ElementsAre("a.png"));
}

TEST_F(PlyImport, InvalidIndicesAreCounted) {
    const ImportedModel model =
        import("a.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float "
                        "y\nproperty float z\nelement face 3\nproperty list uchar int "
                        "vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 -1\n3 0 1 "
                        "77\n");
    EXPECT_EQ(model.triangleCount, 1u);
    EXPECT_EQ(model.repairs.invalidTriangles, 2u);
}

TEST_F(PlyImport, LiesAreRefused) {
    const std::string seed = test::seedFiles(worker()).at("ply")[0];
    const auto with = [&](const std::string& what, const std::string& instead) {
        std::string file = seed;
        file.replace(file.find(what), what.size(), instead);
        EXPECT_EQ(importError("a.ply", file).kind, ErrorKind::InputBroken) << instead;
    };
    with("vertex 4", "vertex 400000000000");
    with("vertex 4", "vertex 5");
    with("vertex 4", "vertex -1");
    with("face 2", "face 3");
    with("3 0 1 2", "99999999 0 1 2");
    with("float x", "quaternion x");
    with("float x", "float q");
    with("end_header", "end");
    with("0 0 0", "0 zero 0");
}

TEST_F(StlImport, SolidsAreMeshes) {
    const std::string facet =
        "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 "
        "1 0\nendloop\nendfacet\n";
    const ImportedModel model = import("a.stl", "solid left wing\n" + facet + "endsolid\nsolid\n" +
                                                    facet + facet + "endsolid\n");
    ASSERT_EQ(model.meshes.size(), 2u);
    EXPECT_EQ(model.meshes[0]->name, "left wing");
    EXPECT_EQ(model.triangleCount, 3u);
    expectNear(model.meshes[0]->normals[0], {0, 0, 1}); // not the file's zero
    EXPECT_EQ(importError("b.stl", "solid s\n" + facet).kind, ErrorKind::InputBroken);
    EXPECT_EQ(importError("c.stl", "solid s\nfacet\nvertex 0 0\nendsolid\n").kind,
              ErrorKind::InputBroken);
}

TEST_F(StlImport, TextAndBinary) {
    const auto seeds = test::seedFiles(worker()).at("stl");
    const ImportedModel text = import("a.stl", seeds[0]);
    EXPECT_EQ(text.format, "stl");
    EXPECT_EQ(text.triangleCount, 1u);
    expectNear(areaVector(text), {0, 0, 1});
    expectNear(text.meshes[0]->normals[0], {0, 0, 1});
    const ImportedModel binary = import("b.stl", seeds[1]);
    EXPECT_EQ(binary.triangleCount, 2u);
    expectNear(areaVector(binary), {0, 0, 2});
}

} // namespace
} // namespace patina
