// Vertices within solids are found and named; what is merely dark, open, two-sided or touching is
// not.
#include "core/library/Library.h"
#include "tests/core/bake/BakeTestScene.h"

#include <gtest/gtest.h>

using namespace patina;
using namespace patina::test;

namespace {

Mesh scaledBox(const glm::vec3& half, const glm::vec3& centre) {
    Mesh mesh = cubeMesh();
    for (glm::vec3& position : mesh.positions)
        position = centre + half * position;
    return mesh;
}

Mesh turnedInwards(Mesh mesh) {
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
    for (glm::vec3& normal : mesh.normals)
        normal = -normal;
    return mesh;
}

std::string noteOf(const BakeInputs& inputs, bool fitted = false) {
    PrtSettings settings;
    settings.order = 2;
    settings.samples = 64;
    settings.fitted = fitted;
    TileSink sink;
    const Result<BakeArtifact> transfer = bakePrtVertex(inputs, settings, sink, {});
    const Result<BakeArtifact> visibility = bakeAoVertex(inputs, {.samples = 64}, sink, {});
    EXPECT_EQ(transfer->note, visibility->note);
    return transfer->note;
}

BakeInputs named(BakeInputs inputs, const std::vector<std::string>& names) {
    for (std::size_t m = 0; m < names.size(); ++m) {
        Mesh mesh = *inputs.meshes[m].mesh;
        mesh.name = names[m];
        inputs.meshes[m].mesh = std::make_shared<const Mesh>(std::move(mesh));
    }
    return inputs;
}

} // namespace

TEST(InsideGeometry, ABallInAWallIsNamed) {
    const Mesh ball = sanitized(sphereMesh(0.2, 16, 8));
    const std::size_t vertices = ball.positions.size();
    const BakeInputs inputs =
        named(sceneOf({scaledBox({2.0f, 2.0f, 0.5f}, {}), ball, sphereMesh(0.2, 16, 8, {0, 0, 2})}),
              {"Wall", "Ball", "Free"});
    const std::string expected = std::to_string(vertices) + " of the " + std::to_string(vertices) +
                                 " vertices of “Ball” lie inside geometry";
    for (const bool fitted : {false, true})
        EXPECT_EQ(noteOf(inputs, fitted).substr(0, expected.size()), expected);
    // Whatever the size of the scene.
    BakeInputs tiny = inputs;
    for (BakeMesh& mesh : tiny.meshes)
        mesh.transform = glm::scale(glm::mat4(1.0f), glm::vec3(1e-6f));
    EXPECT_EQ(noteOf(tiny), noteOf(inputs));
    // And wound the wrong way round: normals tell what is out.
    BakeInputs wound = inputs;
    Mesh wall = *wound.meshes[0].mesh;
    for (std::size_t i = 0; i < wall.indices.size(); i += 3)
        std::swap(wall.indices[i + 1], wall.indices[i + 2]);
    wound.meshes[0].mesh = std::make_shared<const Mesh>(std::move(wall));
    EXPECT_EQ(noteOf(wound), noteOf(inputs));
}

TEST(InsideGeometry, HalfSunkModelsAreCountedToTheSurface) {
    const Mesh ball = sanitized(sphereMesh(1.0, 24, 13, {0, 0.05, 0}));
    const auto below = std::count_if(ball.positions.begin(), ball.positions.end(),
                                     [](const glm::vec3& p) { return p.y < 0.0f; });
    ASSERT_GT(below, 100);
    const std::string note =
        noteOf(sceneOf({scaledBox({4.0f, 1.5f, 4.0f}, {0.0f, -1.5f, 0.0f}), ball}));
    const std::string expected = std::to_string(below) + " of the " +
                                 std::to_string(ball.positions.size()) + " vertices of mesh 2 lie";
    EXPECT_EQ(note.substr(0, expected.size()), expected);
    // A plane is no solid: one may look at its lower side. Its own middle lies within the ball.
    const std::string middle = "1 of the 81 vertices of mesh 1 lie inside geometry";
    EXPECT_EQ(noteOf(sceneOf({planeMesh(4.0, 8), ball})).substr(0, middle.size()), middle);
    // A part of the same mesh is.
    Mesh joined = scaledBox({4.0f, 1.5f, 4.0f}, {0.0f, -1.5f, 0.0f});
    const auto first = std::uint32_t(joined.positions.size());
    joined.positions.insert(joined.positions.end(), ball.positions.begin(), ball.positions.end());
    joined.normals.insert(joined.normals.end(), ball.normals.begin(), ball.normals.end());
    joined.uvs.resize(joined.positions.size());
    joined.tangents.clear();
    for (const std::uint32_t index : ball.indices)
        joined.indices.push_back(first + index);
    EXPECT_EQ(noteOf(sceneOf({joined})).substr(0, 6), std::to_string(below) + " of");
    // Two meshes.
    const Mesh second = sanitized(sphereMesh(0.3, 8, 4, {2, -1, 0}));
    EXPECT_NE(noteOf(sceneOf({scaledBox({4.0f, 1.5f, 4.0f}, {0.0f, -1.5f, 0.0f}), ball, second}))
                  .find(", " + std::to_string(second.positions.size()) + " of the "),
              std::string::npos);
}

TEST(InsideGeometry, NothingIsSaidOfWhatMayBeDark) {
    // Things on the floor of a box that is open to one side.
    BakeInputs cornell;
    const Result<std::vector<library::ModelPart>> parts = library::model("cornell-box");
    for (const library::ModelPart& part : *parts) {
        BakeMesh& mesh = cornell.meshes.emplace_back();
        mesh.id = mesh.material = Id(cornell.meshes.size());
        mesh.mesh = part.mesh;
    }
    EXPECT_EQ(noteOf(cornell), "");
    const Mesh ball = sphereMesh(0.3, 16, 8);
    // A closed room: dark, but a room.
    EXPECT_EQ(noteOf(sceneOf({turnedInwards(cubeMesh()), ball})), "");
    // A closed box of a two-sided material may be one, too.
    BakeInputs twoSided = sceneOf({cubeMesh(), ball});
    EXPECT_NE(noteOf(twoSided), "");
    twoSided.meshes[0].doubleSided = true;
    EXPECT_EQ(noteOf(twoSided), "");
    // Open meshes: a ball in a bowl, and under half a sphere.
    EXPECT_EQ(noteOf(sceneOf({bowlMesh(32, 16), sphereMesh(0.1, 16, 8, {0, -0.5, 0})})), "");
    EXPECT_EQ(noteOf(sceneOf({turnedInwards(bowlMesh(32, 16)), sphereMesh(0.1, 16, 8)})), "");
    // Boxes that touch: the lower side of the upper one is dark, but lies in nothing.
    EXPECT_EQ(noteOf(sceneOf({scaledBox({2.0f, 0.5f, 2.0f}, {0.0f, -0.5f, 0.0f}),
                              scaledBox({0.5f, 0.5f, 0.5f}, {0.0f, 0.5f, 0.0f})})),
              "");
}
