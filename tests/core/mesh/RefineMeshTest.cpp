#include "core/mesh/RefineMesh.h"
#include "core/mesh/Weld.h"
#include "tests/core/mesh/Shapes.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <random>

using namespace patina;
using namespace patina::test;

namespace {

double area(const Mesh& mesh) {
    double sum = 0.0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        sum +=
            0.5 *
            glm::length(glm::cross(
                glm::dvec3(mesh.positions[mesh.indices[i + 1]] - mesh.positions[mesh.indices[i]]),
                glm::dvec3(mesh.positions[mesh.indices[i + 2]] - mesh.positions[mesh.indices[i]])));
    return sum;
}

// How many triangles use each edge, by welded vertices.
std::map<int, int> edgeUses(const Mesh& mesh) {
    const std::vector<std::uint32_t> welded = weldPositions(mesh.positions);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        for (std::size_t e = 0; e < 3; ++e) {
            const auto ends =
                std::minmax(welded[mesh.indices[i + e]], welded[mesh.indices[i + (e + 1) % 3]]);
            ++uses[{ends.first, ends.second}];
        }
    std::map<int, int> counts;
    for (const auto& [edge, count] : uses)
        ++counts[count];
    return counts;
}

double smallestAngle(const Mesh& mesh) {
    double smallest = kPi;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        for (std::size_t e = 0; e < 3; ++e) {
            const glm::dvec3 p(mesh.positions[mesh.indices[i + e]]),
                q(mesh.positions[mesh.indices[i + (e + 1) % 3]]),
                r(mesh.positions[mesh.indices[i + (e + 2) % 3]]);
            smallest = std::min(smallest,
                                std::acos(glm::dot(glm::normalize(q - p), glm::normalize(r - p))));
        }
    return smallest;
}

} // namespace

TEST(RefineMesh, SplitsATriangleIntoFour) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {4, 0, 0}, {0, 0, -2}};
    mesh.uvs = {{0, 0}, {1, 0}, {0, 1}};
    mesh.indices = {0, 1, 2};
    mesh = sanitized(mesh);
    const Mesh fine = refineMesh(mesh, std::vector<std::uint8_t>{1});
    EXPECT_EQ(fine.triangleCount(), 4u);
    ASSERT_EQ(fine.vertexCount(), 6u);
    EXPECT_NEAR(area(fine), 4.0, 1e-6);
    for (std::size_t v = 0; v < 3; ++v)
        EXPECT_EQ(fine.positions[v], mesh.positions[v]);
    EXPECT_EQ(fine.uvs.size(), 6u);
    EXPECT_EQ(fine.normals.size(), 6u);
    EXPECT_EQ(fine.tangents.size(), 6u);
    // UVs follow positions: (x / 4, -z / 2).
    for (std::size_t v = 0; v < 6; ++v) {
        EXPECT_NEAR(fine.uvs[v].x, fine.positions[v].x / 4, 1e-6);
        EXPECT_NEAR(fine.uvs[v].y, -fine.positions[v].z / 2, 1e-6);
        EXPECT_NEAR(fine.normals[v].y, 1.0f, 1e-6);
    }
    EXPECT_EQ(refineMesh(mesh, std::vector<std::uint8_t>{0}), mesh);
    EXPECT_EQ(refineMesh(mesh, std::vector<std::uint8_t>{1}, 5.0f), mesh);
    // Only the long edge, of 4.47 m.
    EXPECT_EQ(refineMesh(mesh, std::vector<std::uint8_t>{1}, 4.2f).triangleCount(), 2u);
}

TEST(RefineMesh, LeavesNoVertexOnAnEdge) {
    // Closed surfaces with seams of the UVs stay closed: every edge has two triangles.
    std::mt19937 random(3);
    Mesh mesh = sanitized(torusMesh(1.0, 0.4, 16, 12));
    const double before = area(mesh);
    for (int round = 0; round < 4; ++round) {
        std::vector<std::uint8_t> split(mesh.triangleCount());
        for (std::uint8_t& one : split)
            one = random() % 11 == 0 ? 1 : 0;
        const std::size_t asked =
            static_cast<std::size_t>(std::count(split.begin(), split.end(), 1));
        const Mesh fine = refineMesh(mesh, split);
        EXPECT_GE(fine.triangleCount(), mesh.triangleCount() + 3 * asked);
        mesh = fine;
        const std::map<int, int> uses = edgeUses(mesh);
        ASSERT_EQ(uses.size(), 1u) << round;
        EXPECT_EQ(uses.begin()->first, 2);
        EXPECT_NEAR(area(mesh), before, 1e-4 * before);
        for (const glm::vec3& normal : mesh.normals)
            EXPECT_NEAR(glm::length(normal), 1.0f, 1e-5);
    }
}

TEST(RefineMesh, KeepsAnglesHoweverOften) {
    // Always the triangle at one corner.
    Mesh mesh = sanitized(planeMesh(1.0, 1));
    const double before = smallestAngle(mesh);
    for (int round = 0; round < 12; ++round) {
        std::vector<std::uint8_t> split(mesh.triangleCount());
        for (std::size_t t = 0; t < split.size(); ++t)
            for (std::size_t c = 0; c < 3; ++c)
                if (mesh.indices[3 * t + c] == 0)
                    split[t] = 1;
        mesh = refineMesh(mesh, split);
    }
    EXPECT_GT(smallestAngle(mesh), 0.49 * before);
    EXPECT_LT(mesh.triangleCount(), 400u);
    EXPECT_NEAR(area(mesh), 4.0, 1e-5);
}
