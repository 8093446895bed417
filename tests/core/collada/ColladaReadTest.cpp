// What a COLLADA document says about surfaces.
#include "core/export/collada/Polygon.h"
#include "tests/core/collada/Documents.h"

#include <array>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

using namespace patina;
using namespace patina::test;

namespace {

const std::string kVertexOnly = R"(<input semantic="VERTEX" source="#Sq-v" offset="0"/>)";

// Where the square's corner (1, 1, 0) comes to under a node's transforms.
glm::vec3 cornerUnder(const std::string& transform) {
    const ColladaDocument document = parsed(squareDocument(kSquareAsQuad, transform));
    return meshOf(document, 0).mesh.positions.at(2);
}

} // namespace

TEST(ColladaRead, EveryPrimitiveIsTheSameSquare) {
    const std::array<std::string, 6> primitives{
        "<triangles count=\"2\">" + kVertexOnly + "<p>0 1 2 0 2 3</p></triangles>",
        "<polylist count=\"1\">" + kVertexOnly + "<vcount>4</vcount><p>0 1 2 3</p></polylist>",
        "<polygons count=\"1\">" + kVertexOnly + "<p>0 1 2 3</p></polygons>",
        "<trifans count=\"1\">" + kVertexOnly + "<p>0 1 2 3</p></trifans>",
        "<tristrips count=\"1\">" + kVertexOnly + "<p>0 1 3 2</p></tristrips>",
        kSquareAsQuad};
    for (const std::string& primitive : primitives) {
        SCOPED_TRACE(primitive);
        const ColladaDocument document = parsed(squareDocument(primitive));
        ASSERT_EQ(document.instances().size(), 1u);
        const ColladaMesh mesh = meshOf(document, 0);
        EXPECT_EQ(mesh.mesh.positions.size(), 4u);
        ASSERT_EQ(mesh.mesh.triangleCount(), 2u);
        EXPECT_TRUE(near(areaOf(mesh.mesh), {0, 0, 2}));
        for (const glm::vec3& normal : mesh.mesh.normals)
            EXPECT_TRUE(near(normal, {0, 0, 1}));
        EXPECT_EQ(mesh.computedNormals, primitive != kSquareAsQuad);
        EXPECT_EQ(mesh.mesh.uvs.size(), primitive == kSquareAsQuad ? 4u : 0u);
        EXPECT_EQ(mesh.faces.size(), 2u);
        EXPECT_EQ(mesh.faces[1], primitive.starts_with("<triangles") ? 1u : 0u);
    }
}

TEST(ColladaRead, StripsKeepTheirFronts) {
    const std::string strip =
        "<tristrips count=\"2\">" + kVertexOnly + "<p>0 1 3 2</p><p>3 0 2 1</p></tristrips>";
    const ColladaMesh mesh = meshOf(parsed(squareDocument(strip)), 0);
    EXPECT_TRUE(near(areaOf(mesh.mesh), {0, 0, 4}));
    EXPECT_EQ(mesh.faces, (std::vector<std::uint32_t>{0, 0, 1, 1}));
}

TEST(ColladaRead, TextureCoordinatesCountFromTheTop) {
    const ColladaMesh mesh = meshOf(parsed(squareDocument(kSquareAsQuad)), 0);
    EXPECT_EQ(mesh.mesh.uvs[0], glm::vec2(0, 1));
    EXPECT_EQ(mesh.mesh.uvs[2], glm::vec2(1, 0));
}

TEST(ColladaRead, TransformsAreComposedInTheirOrder) {
    EXPECT_TRUE(near(cornerUnder(""), {1, 1, 0}));
    EXPECT_TRUE(near(cornerUnder("<translate>1 2 3</translate>"), {2, 3, 3}));
    EXPECT_TRUE(near(cornerUnder("<rotate>0 0 1 90</rotate>"), {-1, 1, 0}));
    EXPECT_TRUE(near(cornerUnder("<scale>2 3 4</scale>"), {2, 3, 0}));
    EXPECT_TRUE(near(cornerUnder("<translate>1 0 0</translate><rotate>0 0 2 90</rotate>"
                                 "<scale>2 1 1</scale>"),
                     {0, 2, 0}));
    EXPECT_TRUE(
        near(cornerUnder("<matrix>1 0 0 5  0 0 1 6  0 1 0 7  0 0 0 1</matrix>"), {6, 6, 8}));
    // Points along y are moved along x (COLLADA 1.4.1, <skew>, the example).
    EXPECT_TRUE(near(cornerUnder("<skew>45 0 1 0 1 0 0</skew>"), {2, 1, 0}));
    // At (0, 0, 5), looking along +x: -z of the node is +x of the world.
    EXPECT_TRUE(near(cornerUnder("<lookat>0 0 5 1 0 5 0 1 0</lookat>"), {0, 1, 6}));
}

TEST(ColladaRead, SkewTurnsItsAxisByItsAngle) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    int done = 0;
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 a = glm::normalize(glm::dvec3(any(random), any(random), any(random)));
        const glm::dvec3 b = glm::normalize(glm::dvec3(any(random), any(random), any(random)));
        const double between = std::acos(glm::dot(a, b)), angle = 0.5 * between;
        if (between < 0.2 || between > 2.9)
            continue;
        const auto document = parsed(squareDocument(
            kSquareAsQuad, fmt::format("<skew>{} {} {} {} {} {} {}</skew>", glm::degrees(angle),
                                       a.x, a.y, a.z, b.x, b.y, b.z)));
        const glm::dmat4 m = document.instances()[0].toWorld;
        const glm::dvec3 turned = glm::dmat3(m) * a;
        EXPECT_NEAR(std::acos(glm::dot(glm::normalize(turned), a)), angle, 1e-6) << "seed 3, " << i;
        EXPECT_NEAR(std::acos(glm::dot(glm::normalize(turned), b)), between - angle, 1e-6);
        EXPECT_LT(glm::length(glm::dmat3(m) * b - b), 1e-9);
        EXPECT_NEAR(glm::determinant(m), 1.0, 1e-9);
        ++done;
    }
    EXPECT_GT(done, 100);
}

TEST(ColladaRead, UnitsAndAxesLeadToMetresAndYUp) {
    const auto corners = [](const std::string& asset) {
        const ColladaDocument document = parsed(documentOf(
            "<library_geometries>" + squareGeometry(kSquareAsQuad) + "</library_geometries>",
            "<node><instance_geometry url=\"#Square\"/></node>", asset));
        return meshOf(document, 0).mesh;
    };
    EXPECT_TRUE(near(corners("").positions[2], {1, 1, 0}));
    const Mesh z = corners("<unit meter=\"0.01\"/><up_axis>Z_UP</up_axis>");
    EXPECT_TRUE(near(z.positions[2], {0.01f, 0, -0.01f}));
    EXPECT_TRUE(near(z.normals[0], {0, 1, 0})); // +Z of the file is up
    const Mesh x = corners("<up_axis>X_UP</up_axis>");
    EXPECT_TRUE(near(x.positions[1], {0, 1, 0})); // +X of the file is up
    EXPECT_TRUE(near(x.normals[0], {0, 0, 1}));
}

TEST(ColladaRead, MirroredInstancesKeepTheirFronts) {
    const ColladaMesh mesh =
        meshOf(parsed(squareDocument(kSquareAsQuad, "<scale>-2 1 1</scale>")), 0);
    EXPECT_TRUE(near(areaOf(mesh.mesh), {0, 0, 4}));
    EXPECT_TRUE(near(mesh.mesh.normals[0], {0, 0, 1}));
    const ColladaMesh inner =
        meshOf(parsed(squareDocument(kSquareAsQuad, "<scale>1 1 -1</scale>")), 0);
    EXPECT_TRUE(near(areaOf(inner.mesh), {0, 0, -2}));
    EXPECT_TRUE(near(inner.mesh.normals[0], {0, 0, -1}));
}

TEST(ColladaRead, RoomHasItsInstancesAndMaterials) {
    for (const char* version : {"1.4.1", "1.5.0"}) {
        SCOPED_TRACE(version);
        const ColladaDocument document = parsed(roomDocument(version));
        // Left and right chair, alone, person: two primitives each.
        ASSERT_EQ(document.instances().size(), 8u);
        EXPECT_EQ(document.instances()[0].path, "Left/Chair");
        EXPECT_EQ(document.instances()[0].nodeId, "Chair");
        EXPECT_EQ(document.instances()[3].path, "Right/Chair");
        EXPECT_EQ(document.instances()[3].primitive, 1);
        EXPECT_EQ(document.instances()[4].path, "Alone");
        EXPECT_EQ(document.instances()[4].geometryId, "Square");
        EXPECT_EQ(document.instances()[4].material, -1);
        EXPECT_FALSE(document.instances()[5].controlled);
        EXPECT_TRUE(document.instances()[6].controlled);
        ASSERT_EQ(document.notices().size(), 1u);
        EXPECT_NE(document.notices()[0].find("lines"), std::string::npos);

        ASSERT_EQ(document.materials().size(), 2u);
        const ColladaMaterial& floor = document.materials()[0];
        EXPECT_EQ(document.instances()[0].material, 0);
        EXPECT_EQ(floor.name, "Floor");
        EXPECT_EQ(floor.diffuseTexture, "wood floor.png");
        EXPECT_EQ(floor.diffuse, glm::vec3(1));
        EXPECT_EQ(floor.emission, glm::vec3(0.5f, 0.25f, 0));
        EXPECT_TRUE(floor.doubleSided);
        const ColladaMaterial& red = document.materials()[1];
        EXPECT_EQ(document.instances()[1].material, 1);
        EXPECT_EQ(red.diffuse, glm::vec3(0.8f, 0.1f, 0.2f));
        EXPECT_FLOAT_EQ(red.opacity, 0.75f);
        EXPECT_FALSE(red.doubleSided);

        // Right: (3, 0, 0) + turned about y by 90° and doubled (x y z + 2) = (3 + 2 (z + 2), 2 y,
        // -2 x), half metres, z up.
        EXPECT_TRUE(near(meshOf(document, 2).mesh.positions[2], {3.5f, -1, -1}));
    }
}

TEST(ColladaRead, TheSceneThatIsNamedOrChosenIsTaken) {
    std::string text = squareDocument(kSquareAsQuad);
    text.insert(text.find("<visual_scene id=\"Scene\""),
                "<visual_scene id=\"Empty\" name=\"Nothing\"/>");
    ColladaDocument document = parsed(text);
    ASSERT_EQ(document.scenes().size(), 2u);
    EXPECT_EQ(document.scene(), 1u);
    EXPECT_EQ(document.instances().size(), 1u);
    ASSERT_TRUE(document.takeScene(0).ok());
    EXPECT_EQ(document.instances().size(), 0u);
    EXPECT_EQ(document.takeScene(2).error().kind, ErrorKind::Usage);
    ASSERT_TRUE(document.takeScene("Scene").ok());
    EXPECT_EQ(document.scene(), 1u);
    ASSERT_TRUE(document.takeScene("").ok());
    EXPECT_EQ(document.scene(), 1u);
    ASSERT_TRUE(document.takeScene("Nothing").ok());
    EXPECT_EQ(document.takeScene("Attic").error().kind, ErrorKind::Usage);
    EXPECT_THAT(document.takeScene("Attic").error().message,
                ::testing::HasSubstr("\"Nothing\" and \"Scene\""));
    EXPECT_EQ(document.scene(), 0u);
    const std::string scene = "<scene><instance_visual_scene url=\"#Scene\"/></scene>";
    text.erase(text.find(scene), scene.size());
    EXPECT_EQ(parsed(text).scene(), 0u);
}

TEST(ColladaRead, ATextureChoosesItsSetOfCoordinates) {
    std::string text = roomDocument();
    const std::string set = "offset=\"2\" set=\"0\"/>";
    text.replace(text.find(set), set.size(),
                 "offset=\"2\" set=\"0\"/><input semantic=\"TEXCOORD\" source=\"#Sq-n2\" "
                 "offset=\"1\" set=\"5\"/>");
    text.insert(text.find("<source id=\"Sq-t\">"),
                "<source id=\"Sq-n2\"><float_array id=\"Sq-n2-a\" count=\"2\">0.25 0.25"
                "</float_array><technique_common><accessor source=\"#Sq-n2-a\" count=\"1\" "
                "stride=\"2\"><param name=\"S\" type=\"float\"/><param name=\"T\" type=\"float\"/>"
                "</accessor></technique_common></source>");
    EXPECT_EQ(meshOf(parsed(text), 0).mesh.uvs[0], glm::vec2(0, 1));
    text.replace(text.find("input_set=\"0\""), 13, "input_set=\"5\"");
    EXPECT_EQ(meshOf(parsed(text), 0).mesh.uvs[0], glm::vec2(0.25f, 0.75f));
}

TEST(ColladaRead, DocumentsAreWrittenAsTheyWere) {
    for (const std::string& text : {roomDocument(), roomDocument("1.5.0")})
        EXPECT_EQ(parsed(text).text(), text);
}

TEST(ColladaRead, OtherEncodingsBecomeUtf8) {
    std::string text = squareDocument(kSquareAsQuad);
    text.replace(text.find("utf-8"), 5, "iso-8859-1");
    text.replace(text.find("Square-mesh"), 11,
                 "Fl\xe4"
                 "che");
    const ColladaDocument document = parsed(text);
    EXPECT_EQ(document.instances()[0].geometryName, "Fl\xc3\xa4"
                                                    "che");
    EXPECT_NE(document.text().find("encoding=\"utf-8\""), std::string::npos);
}

// The triangles of any polygon cover it once: their areas are of one sign and sum up to its own.
TEST(ColladaRead, PolygonsAreCutIntoTriangles) {
    const std::vector<std::vector<glm::dvec3>> polygons{
        {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 1, 0}, {0, 4, 0}}, // a dent
        {{0, 0, 0}, {2, 1, 0}, {4, 0, 0}, {2, 4, 0}},            // an arrow
        {{0, 0, 0}, {0, 3, 0}, {0, 3, 3}, {0, 2, 3}, {0, 2, 1}, {0, 1, 1}, {0, 1, 3}, {0, 0, 3}},
        {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 0, 2}, {1, 0, 0.5}, {0, 0, 2}}, // one in line
    };
    for (const std::vector<glm::dvec3>& corners : polygons)
        for (std::size_t start = 0; start < corners.size(); ++start) {
            std::vector<glm::dvec3> rotated;
            for (std::size_t i = 0; i < corners.size(); ++i)
                rotated.push_back(corners[(start + i) % corners.size()]);
            glm::dvec3 whole(0.0);
            for (std::size_t i = 0; i < rotated.size(); ++i)
                whole += glm::cross(rotated[i], rotated[(i + 1) % rotated.size()]);
            const auto triangles = collada::trianglesOf(rotated);
            ASSERT_TRUE(triangles.has_value());
            EXPECT_EQ(triangles->size(), corners.size() - 2);
            glm::dvec3 sum(0.0);
            double sizes = 0.0;
            for (const auto& [a, b, c] : *triangles) {
                const glm::dvec3 area =
                    glm::cross(rotated[b] - rotated[a], rotated[c] - rotated[a]);
                EXPECT_GE(glm::dot(area, whole), 0.0);
                sum += area;
                sizes += glm::length(area);
            }
            EXPECT_LT(glm::length(sum - whole), 1e-12);
            EXPECT_NEAR(sizes, glm::length(whole), 1e-12);
        }
}
