#include "core/mesh/Mesh.h"
#include "tests/core/mesh/Shapes.h"

#include <gtest/gtest.h>
#include <limits>
#include <random>

using namespace patina;
using namespace patina::test;

namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

bool finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Every promise of core/mesh/Mesh.h.
void expectPromises(const Mesh& mesh) {
    const std::size_t count = mesh.positions.size();
    ASSERT_EQ(mesh.indices.size() % 3, 0u);
    for (const std::uint32_t index : mesh.indices)
        ASSERT_LT(index, count);
    if (count == 0)
        return;
    ASSERT_EQ(mesh.normals.size(), count);
    ASSERT_EQ(mesh.tangents.size(), count);
    ASSERT_EQ(mesh.uvs.size(), count);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 n = mesh.normals[i], t(mesh.tangents[i]);
        ASSERT_TRUE(finite(mesh.positions[i]) && finite(n) && finite(t)) << i;
        ASSERT_TRUE(std::isfinite(mesh.uvs[i].x) && std::isfinite(mesh.uvs[i].y)) << i;
        ASSERT_NEAR(glm::length(n), 1.0f, 1e-5f) << i;
        ASSERT_NEAR(glm::length(t), 1.0f, 1e-5f) << i;
        ASSERT_EQ(std::abs(mesh.tangents[i].w), 1.0f) << i;
        ASSERT_GT(glm::length(glm::cross(n, t)), 0.01f) << i; // a bitangent exists
    }
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
        const std::uint32_t* index = mesh.indices.data() + 3 * t;
        const glm::dvec3 a(mesh.positions[index[0]]), b(mesh.positions[index[1]]),
            c(mesh.positions[index[2]]);
        ASSERT_GT(glm::length(glm::cross(b - a, c - a)), 0.0) << t;
    }
}

Mesh rightTriangle(float scale = 1.0f) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {scale, 0, 0}, {0, scale, 0}};
    mesh.indices = {0, 1, 2};
    return mesh;
}

} // namespace

TEST(SanitizeMesh, GeneratesWhatIsMissingAndSaysSo) {
    Mesh mesh = cubeMesh();
    const MeshRepairs repairs = sanitizeMesh(mesh);
    expectPromises(mesh);
    EXPECT_TRUE(repairs.generatedNormals && repairs.generatedUvs && repairs.generatedTangents);
    EXPECT_EQ(repairs.droppedTriangles + repairs.invalidTriangles + repairs.repairedNormals, 0u);
    EXPECT_EQ(mesh.triangleCount(), 12u);
}

TEST(SanitizeMesh, LeavesAGoodMeshAlone) {
    for (Mesh mesh : {sanitized(cubeMesh()), sanitized(sphereMesh(2.0)),
                      sanitized(torusMesh(1.0, 0.3, 40, 20))}) {
        const Mesh before = mesh;
        const MeshRepairs repairs = sanitizeMesh(mesh);
        EXPECT_EQ(mesh, before);
        EXPECT_FALSE(repairs.generatedNormals || repairs.generatedUvs || repairs.generatedTangents);
        EXPECT_EQ(repairs.droppedTriangles + repairs.invalidTriangles + repairs.repairedNormals,
                  0u);
    }
}

TEST(SanitizeMesh, CountsEachKindOfBadTriangleAndKeepsTheGoodOne) {
    Mesh mesh = rightTriangle();
    mesh.positions.push_back({kNaN, 0, 0});
    mesh.positions.push_back({0, kInf, 0});
    mesh.positions.push_back({2, 0, 0});
    mesh.indices = {0, 1, 1,  // repeated index
                    0, 1, 5,  // on one line
                    0, 1, 3,  // NaN
                    0, 4, 2,  // infinity
                    0, 1, 99, // out of range
                    0, 1, 2,  // good
                    0, 1};    // unfinished
    const MeshRepairs repairs = sanitizeMesh(mesh);
    EXPECT_EQ(repairs.droppedTriangles, 2u);
    EXPECT_EQ(repairs.invalidTriangles, 4u);
    expectPromises(mesh);
    ASSERT_EQ(mesh.triangleCount(), 1u);
    EXPECT_EQ(mesh.positions, rightTriangle().positions); // unused vertices are gone
    EXPECT_EQ(mesh.indices, rightTriangle().indices);
}

TEST(SanitizeMesh, EmptyMeshesStayEmpty) {
    Mesh nothing;
    sanitizeMesh(nothing);
    EXPECT_EQ(nothing, Mesh{});

    Mesh points;
    points.positions = {{1, 2, 3}, {kNaN, 0, 0}};
    sanitizeMesh(points);
    expectPromises(points);
    EXPECT_EQ(points.vertexCount(), 0u);
    EXPECT_TRUE(points.bounds().empty());
}

TEST(SanitizeMesh, AnyScaleIsFine) {
    // 2e-45 is the smallest float but one.
    for (const float scale : {1e30f, 1e18f, 1e-20f, 1e-38f, 1e-43f}) {
        Mesh mesh = rightTriangle(scale);
        const MeshRepairs repairs = sanitizeMesh(mesh);
        EXPECT_EQ(mesh.triangleCount(), 1u) << scale;
        EXPECT_EQ(repairs.droppedTriangles, 0u) << scale;
        expectPromises(mesh);
        for (const glm::vec3& normal : mesh.normals)
            EXPECT_NEAR(normal.z, 1.0f, 1e-6f) << scale;
    }
}

TEST(SanitizeMesh, RepairsNormalsOneByOne) {
    Mesh mesh = sanitized(planeMesh(1.0, 4));
    const std::vector<glm::vec3> good = mesh.normals;
    mesh.normals[3] = {kNaN, 0, 0};
    mesh.normals[4] = {0, 0, 0};
    mesh.normals[5] = {0, kInf, 0};
    mesh.normals[6] = {0, 3, 0};          // only not unit: not a repair
    mesh.normals[7] = {0.6f, 0.8f, 0.0f}; // the author's choice
    const MeshRepairs repairs = sanitizeMesh(mesh);
    EXPECT_EQ(repairs.repairedNormals, 3u);
    EXPECT_FALSE(repairs.generatedNormals);
    expectPromises(mesh);
    for (const std::size_t i : {3u, 4u, 5u, 6u})
        EXPECT_NEAR(glm::distance(mesh.normals[i], good[i]), 0.0f, 1e-6f) << i;
    EXPECT_EQ(mesh.normals[7], glm::vec3(0.6f, 0.8f, 0.0f));
}

TEST(SanitizeMesh, AttributesOfTheWrongLengthAreGeneratedAnew) {
    Mesh mesh = sanitized(cubeMesh());
    mesh.normals.pop_back();
    mesh.tangents.push_back(glm::vec4(1));
    mesh.uvs.pop_back();
    const MeshRepairs repairs = sanitizeMesh(mesh);
    EXPECT_TRUE(repairs.generatedNormals && repairs.generatedUvs && repairs.generatedTangents);
    expectPromises(mesh);
}

TEST(SanitizeMesh, RepairsTangentsAndUvs) {
    Mesh mesh = sanitized(planeMesh(1.0, 4));
    const std::vector<glm::vec4> good = mesh.tangents;
    mesh.tangents[0] = glm::vec4(kNaN);
    mesh.tangents[1] = glm::vec4(0, 0, 0, 1);
    mesh.tangents[2] = glm::vec4(mesh.normals[2], 1); // along the normal
    mesh.tangents[3] = glm::vec4(5.0f * glm::vec3(good[3]), 0.25f * good[3].w);
    mesh.uvs[20] = {kNaN, 0.5f};
    sanitizeMesh(mesh);
    expectPromises(mesh);
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(glm::distance(mesh.tangents[i], good[i]), 0.0f, 1e-5f) << i;
    EXPECT_EQ(mesh.uvs[20], glm::vec2(0.0f));
}

TEST(SanitizeMesh, RandomRubbishAlwaysEndsInPromises) {
    for (std::uint32_t seed = 0; seed < 300; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        const auto upTo = [&](std::uint32_t n) { return random() % n; };
        const auto number = [&]() -> float {
            switch (upTo(12)) {
            case 0:
                return kNaN;
            case 1:
                return kInf;
            case 2:
                return 1e30f;
            case 3:
                return 1e-44f;
            case 4:
                return -0.0f;
            default:
                return static_cast<float>(upTo(5)) - 2.0f;
            }
        };
        Mesh mesh;
        const std::uint32_t vertices = 1 + upTo(30);
        for (std::uint32_t i = 0; i < vertices; ++i)
            mesh.positions.push_back({number(), number(), number()});
        if (upTo(2) == 0)
            for (std::uint32_t i = 0; i < vertices; ++i)
                mesh.normals.push_back({number(), number(), number()});
        if (upTo(2) == 0)
            for (std::uint32_t i = 0; i < vertices; ++i)
                mesh.uvs.push_back({number(), number()});
        if (upTo(2) == 0)
            for (std::uint32_t i = 0; i < vertices; ++i)
                mesh.tangents.push_back({number(), number(), number(), number()});
        for (std::uint32_t i = 0, n = upTo(200); i < n; ++i)
            mesh.indices.push_back(upTo(vertices + 1));
        sanitizeMesh(mesh);
        expectPromises(mesh);
        const Mesh once = mesh;
        sanitizeMesh(mesh);
        EXPECT_EQ(mesh, once); // nothing is left to repair
    }
}

TEST(ComputeNormals, SphereNormalsPointOutwardsAlsoAcrossTheSeam) {
    Mesh mesh = sanitized(sphereMesh(3.0, 48, 24));
    for (std::size_t i = 0; i < mesh.vertexCount(); ++i)
        EXPECT_GT(glm::dot(mesh.normals[i], glm::normalize(mesh.positions[i])), 0.998f) << i;
}

TEST(ComputeNormals, WeightsByAreaAndAngleNotByTriangleCount) {
    // Angle: a corner of a cube has the diagonal as its normal, although some of its faces are cut
    // into two triangles there and some are not.
    Mesh cube = cubeMesh();
    computeNormals(cube);
    for (std::size_t i = 0; i < 8; ++i)
        EXPECT_NEAR(glm::distance(cube.normals[i], glm::normalize(cube.positions[i])), 0.0f, 1e-5f);
    // Area: a big and a small quad at a right angle share an edge.
    Mesh fold;
    fold.positions = {{0, 0, 0}, {0, 0, -1}, {3, 0, -1}, {3, 0, 0}, {0, 1, 0}, {0, 1, -1}};
    fold.indices = {0, 3, 2, 0, 2, 1, 0, 1, 5, 0, 5, 4};
    computeNormals(fold);
    // At vertex 0 both quads span 90 degrees: up with area 3/2 per triangle, +x with 1/2.
    EXPECT_NEAR(fold.normals[0].y / fold.normals[0].x, 3.0f, 1e-4f);
}

TEST(ComputeNormals, UnusedAndDegenerateVerticesGetUp) {
    Mesh mesh = rightTriangle();
    mesh.positions.push_back({5, 5, 5});
    mesh.positions.push_back({1, 0, 0}); // at vertex 1's place: shares its normal
    mesh.positions.push_back({6, 5, 5});
    mesh.positions.push_back({7, 5, 5});
    mesh.indices.insert(mesh.indices.end(), {3, 5, 6});
    computeNormals(mesh);
    EXPECT_EQ(mesh.normals[3], glm::vec3(0, 1, 0));
    EXPECT_EQ(mesh.normals[5], glm::vec3(0, 1, 0));
    EXPECT_EQ(mesh.normals[4], mesh.normals[1]);
    EXPECT_NEAR(mesh.normals[1].z, 1.0f, 1e-6f);
}

TEST(ComputeNormals, SheetsBackToBackKeepTheirOwnSides) {
    Mesh mesh = rightTriangle();
    mesh.positions.insert(mesh.positions.end(), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    mesh.indices = {0, 1, 2, 3, 5, 4};
    computeNormals(mesh);
    EXPECT_NEAR(mesh.normals[0].z, 1.0f, 1e-6f);
    EXPECT_NEAR(mesh.normals[3].z, -1.0f, 1e-6f);
    mesh.indices = {0, 1, 2, 0, 2, 1}; // and even with the same vertices
    computeNormals(mesh);
    EXPECT_NEAR(mesh.normals[0].z, 1.0f, 1e-6f);
}

TEST(ComputeTangents, FollowTheConvention) {
    // A wall that faces +z; u runs to the right, v down the image, as seen from the front.
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    computeNormals(mesh);
    computeTangents(mesh);
    for (const glm::vec4& tangent : mesh.tangents) {
        EXPECT_NEAR(glm::distance(tangent, glm::vec4(1, 0, 0, 1)), 0.0f, 1e-6f);
        EXPECT_NEAR((glm::cross(glm::vec3(0, 0, 1), glm::vec3(tangent)) * tangent.w).y, 1.0f,
                    1e-6f);
    }
    for (glm::vec2& uv : mesh.uvs) // mirrored: u grows to the left, up stays up
        uv.x = 1.0f - uv.x;
    computeTangents(mesh);
    for (const glm::vec4& tangent : mesh.tangents) {
        EXPECT_NEAR(glm::distance(tangent, glm::vec4(-1, 0, 0, -1)), 0.0f, 1e-6f);
        EXPECT_NEAR((glm::cross(glm::vec3(0, 0, 1), glm::vec3(tangent)) * tangent.w).y, 1.0f,
                    1e-6f);
    }
}

TEST(ComputeTangents, ArePerpendicularAndIndependentOfRepeatedVertices) {
    Mesh mesh = sanitized(torusMesh(1.0, 0.4, 24, 12));
    computeTangents(mesh);
    for (std::size_t i = 0; i < mesh.vertexCount(); ++i)
        EXPECT_NEAR(glm::dot(glm::vec3(mesh.tangents[i]), mesh.normals[i]), 0.0f, 1e-5f);

    Mesh soup; // the same triangles without shared vertices
    for (const std::uint32_t index : mesh.indices) {
        soup.indices.push_back(static_cast<std::uint32_t>(soup.positions.size()));
        soup.positions.push_back(mesh.positions[index]);
        soup.normals.push_back(mesh.normals[index]);
        soup.uvs.push_back(mesh.uvs[index]);
    }
    computeTangents(soup);
    for (std::size_t corner = 0; corner < mesh.indices.size(); ++corner)
        EXPECT_NEAR(glm::distance(soup.tangents[corner], mesh.tangents[mesh.indices[corner]]), 0.0f,
                    1e-5f);
}

TEST(ComputeTangents, DegenerateUvsGiveAnyUnitTangent) {
    Mesh mesh = cubeMesh();
    computeNormals(mesh);
    mesh.uvs.assign(mesh.positions.size(), glm::vec2(0.5f));
    computeTangents(mesh);
    expectPromises(mesh);
}

TEST(HashMesh, DependsOnEveryNumberButNotOnTheName) {
    const Mesh mesh = sanitized(cubeMesh());
    Mesh other = mesh;
    other.name = "renamed";
    EXPECT_EQ(hashMesh(mesh), hashMesh(other));
    const auto differs = [&](const auto& edit) {
        Mesh edited = mesh;
        edit(edited);
        return hashMesh(edited) != hashMesh(mesh);
    };
    EXPECT_TRUE(differs([](Mesh& m) { m.positions[5].z += 1e-6f; }));
    EXPECT_TRUE(differs([](Mesh& m) { m.normals[0].x += 1e-6f; }));
    EXPECT_TRUE(differs([](Mesh& m) { m.uvs[1].y += 1e-6f; }));
    EXPECT_TRUE(differs([](Mesh& m) { std::swap(m.indices[0], m.indices[1]); }));
}

TEST(MeshBounds, HoldEveryPosition) {
    const Bounds bounds = sphereMesh(2.0, 16, 8, {1, 2, 3}).bounds();
    EXPECT_NEAR(glm::distance(bounds.center(), glm::vec3(1, 2, 3)), 0.0f, 1e-5f);
    EXPECT_NEAR(bounds.size().y, 4.0f, 1e-5f);
}
