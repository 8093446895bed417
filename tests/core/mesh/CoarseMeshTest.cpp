// Fewer triangles, the same surface.
#include "core/mesh/CoarseMesh.h"

#include "core/library/Library.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <map>
#include <utility>

using namespace patina;

namespace {

using Point = std::array<float, 3>;

Point point(const Mesh& mesh, std::uint32_t vertex) {
    const glm::vec3& p = mesh.positions[vertex];
    return {p.x, p.y, p.z};
}

// Edges without a neighbour in the other direction, wherever the mesh has vertices twice.
int openEdges(const Mesh& mesh, const std::vector<std::uint32_t>& indices) {
    std::map<std::pair<Point, Point>, int> edges;
    for (std::size_t i = 0; i < indices.size(); i += 3)
        for (std::size_t k = 0; k < 3; ++k) {
            const Point a = point(mesh, indices[i + k]);
            const Point b = point(mesh, indices[i + (k + 1) % 3]);
            if (a < b)
                ++edges[{a, b}];
            else
                --edges[{b, a}];
        }
    return static_cast<int>(
        std::ranges::count_if(edges, [](const auto& edge) { return edge.second != 0; }));
}

double area(const Mesh& mesh, const std::vector<std::uint32_t>& indices) {
    double sum = 0.0;
    for (std::size_t i = 0; i < indices.size(); i += 3)
        sum += 0.5 *
               glm::length(glm::cross(mesh.positions[indices[i + 1]] - mesh.positions[indices[i]],
                                      mesh.positions[indices[i + 2]] - mesh.positions[indices[i]]));
    return sum;
}

float longestSide(const Mesh& mesh) {
    const glm::vec3 extent = mesh.bounds().max - mesh.bounds().min;
    return std::max({extent.x, extent.y, extent.z});
}

} // namespace

// Their positions are finite, their size or a part of it is not what floats hold.
TEST(CoarseMesh, ExtremeSizesKeepTheirTriangles) {
    for (const float scale : {3e38f, 1e-45f}) {
        Mesh mesh = *library::model("sphere").value().front().mesh;
        for (glm::vec3& p : mesh.positions)
            p = glm::clamp(2.0f * p, -1.0f, 1.0f) * scale;
        EXPECT_TRUE(coarseTriangles(mesh, longestSide(mesh) / 64.0f).empty()) << scale;
    }
    const Mesh mesh = *library::model("sphere").value().front().mesh;
    EXPECT_TRUE(coarseTriangles(mesh, longestSide(mesh) / 5000.0f).empty());
}

TEST(CoarseMesh, AClosedSurfaceStaysClosedAndWhereItWas) {
    for (const auto& [name, cells] : {std::pair("torus-knot", 64.0f), std::pair("sphere", 24.0f)}) {
        const Mesh mesh = *library::model(name).value().front().mesh;
        const float cell = longestSide(mesh) / cells;
        const std::vector<std::uint32_t> coarse = coarseTriangles(mesh, cell);
        ASSERT_EQ(openEdges(mesh, mesh.indices), 0) << name;
        EXPECT_EQ(openEdges(mesh, coarse), 0) << name;
        EXPECT_GT(coarse.size(), 300u) << name;
        EXPECT_LT(coarse.size(), mesh.indices.size() / 2) << name;
        EXPECT_NEAR(area(mesh, coarse), area(mesh, mesh.indices), 0.06 * area(mesh, mesh.indices))
            << name;
    }
}

TEST(CoarseMesh, SeamsOfTheTextureStaySeams) {
    const Mesh mesh = *library::model("torus-knot").value().front().mesh;
    const std::vector<std::uint32_t> coarse = coarseTriangles(mesh, longestSide(mesh) / 64.0f);
    const auto widest = [&](const std::vector<std::uint32_t>& indices) {
        float span = 0.0f;
        for (std::size_t i = 0; i < indices.size(); i += 3)
            for (std::size_t k = 0; k < 3; ++k) {
                const glm::vec2 d = mesh.uvs[indices[i + k]] - mesh.uvs[indices[i + (k + 1) % 3]];
                span = std::max({span, std::abs(d.x), std::abs(d.y)});
            }
        return span;
    };
    ASSERT_LT(widest(mesh.indices), 0.1f);
    EXPECT_LT(widest(coarse), 0.4f) << "no triangle stretches over the whole texture";
}

TEST(CoarseMesh, KeepsEitherSideOfAnEdge) {
    // Two squares that meet at a right angle along z, vertices twice: the normals differ.
    Mesh mesh;
    const auto square = [&](const glm::vec3& along, const glm::vec3& normal) {
        constexpr std::uint32_t kSide = 9;
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (std::uint32_t j = 0; j < kSide; ++j)
            for (std::uint32_t i = 0; i < kSide; ++i) {
                mesh.positions.push_back(along * static_cast<float>(i) +
                                         glm::vec3(0.0f, 0.0f, static_cast<float>(j)));
                mesh.normals.push_back(normal);
                mesh.tangents.emplace_back(along, 1.0f);
                mesh.uvs.emplace_back(0.5f);
            }
        for (std::uint32_t j = 0; j + 1 < kSide; ++j)
            for (std::uint32_t i = 0; i + 1 < kSide; ++i) {
                const std::uint32_t a = first + j * kSide + i;
                for (const std::uint32_t k : {a, a + 1, a + kSide, a + 1, a + kSide + 1, a + kSide})
                    mesh.indices.push_back(k);
            }
    };
    square({1, 0, 0}, {0, 1, 0});
    square({0, -1, 0}, {-1, 0, 0});
    const std::vector<std::uint32_t> coarse = coarseTriangles(mesh, 2.5f);
    ASSERT_FALSE(coarse.empty());
    EXPECT_LT(coarse.size(), mesh.indices.size() / 3);
    bool both[2] = {false, false};
    for (std::size_t i = 0; i < coarse.size(); i += 3) {
        const bool up = mesh.normals[coarse[i]].y > 0.5f;
        both[up] = true;
        for (std::size_t k = 1; k < 3; ++k)
            EXPECT_EQ(mesh.normals[coarse[i + k]], mesh.normals[coarse[i]]) << i;
    }
    EXPECT_TRUE(both[0] && both[1]);
    EXPECT_NEAR(area(mesh, coarse), 128.0, 128.0 * 0.5);
}

TEST(CoarseMesh, OfOneCellNothingIsLeft) {
    const Mesh mesh = *library::model("sphere").value().front().mesh;
    EXPECT_TRUE(coarseTriangles(mesh, 2.0f * longestSide(mesh)).empty());
    EXPECT_TRUE(coarseTriangles(Mesh{}, 1.0f).empty());
}
