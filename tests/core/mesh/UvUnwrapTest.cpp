#include "core/mesh/UvUnwrap.h"
#include "core/mesh/BorderSweep.h"
#include "core/mesh/BoxProjection.h"
#include "core/mesh/OverlapGrid.h"
#include "tests/core/mesh/Shapes.h"

#include <algorithm>
#include <ctime>
#include <gtest/gtest.h>
#include <map>
#include <random>
#include <set>
#include <tuple>

using namespace patina;
using namespace patina::test;

namespace {

Mesh withNormals(Mesh mesh) {
    mesh.uvs.assign(mesh.positions.size(), glm::vec2(0.0f)); // so that none are generated
    mesh = sanitized(std::move(mesh));
    mesh.uvs.clear();
    return mesh;
}

// A sphere whose vertices are pushed about at random: what a scanner without smoothing delivers.
Mesh noisySphere(int columns, int rows, double noise) {
    std::mt19937 random(7);
    Mesh mesh = sphereMesh(1.0, columns, rows);
    std::map<std::tuple<float, float, float>, float> factor;
    for (glm::vec3& p : mesh.positions) {
        const auto [at, isNew] = factor.try_emplace({p.x, p.y, p.z}, 0.0f);
        if (isNew)
            at->second = float(1.0 + noise * (random() / 4294967296.0 - 0.5));
        p *= at->second;
    }
    return mesh;
}

// A ribbon that winds up around the y axis; its turns hide each other in every projection.
Mesh spiralStair(int turns) {
    return gridMesh(2, 32 * turns, [=](double u, double v) {
        const double angle = 2 * kPi * turns * v;
        const double r = 0.5 + 0.5 * u;
        return glm::dvec3(r * std::sin(angle), 0.2 * turns * v, r * std::cos(angle));
    });
}

double signedUvArea(const Mesh& mesh, std::size_t t) {
    const glm::dvec2 a(mesh.uvs[mesh.indices[3 * t]]), b(mesh.uvs[mesh.indices[3 * t + 1]]),
        c(mesh.uvs[mesh.indices[3 * t + 2]]);
    return -0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)); // v points down
}

double area(const Mesh& mesh, std::size_t t) {
    const glm::dvec3 a(mesh.positions[mesh.indices[3 * t]]),
        b(mesh.positions[mesh.indices[3 * t + 1]]), c(mesh.positions[mesh.indices[3 * t + 2]]);
    return 0.5 * glm::length(glm::cross(b - a, c - a));
}

void expectGoodLayout(const Mesh& mesh, int resolution) {
    ASSERT_EQ(mesh.uvs.size(), mesh.positions.size());
    for (const glm::vec2& uv : mesh.uvs)
        ASSERT_TRUE(uv.x >= 0.0f && uv.x <= 1.0f && uv.y >= 0.0f && uv.y <= 1.0f);
    EXPECT_FALSE(hasOverlappingUvs(mesh, resolution));
    EXPECT_FALSE(hasOverlappingUvs(mesh, resolution / 2));
    EXPECT_FALSE(hasOverlappingUvs(mesh, resolution + 37)); // other texel centres

    // One texel density; projection shortens by at most the cosine of the limit (55 degrees:
    // 0.574), and nothing is mirrored.
    double least = 1e300, most = 0.0;
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
        if (area(mesh, t) < 1e-7) // float UVs cannot say more about such a triangle
            continue;
        const double ratio = signedUvArea(mesh, t) / area(mesh, t);
        least = std::min(least, ratio);
        most = std::max(most, ratio);
    }
    EXPECT_GT(least, 0.56 * most);
}

} // namespace

TEST(UnwrapUvs, LayoutsDoNotOverlapKeepDensityAndOrientation) {
    const std::map<std::string, Mesh> meshes = {
        {"cube", cubeMesh()},
        {"plane", planeMesh(1.0, 8)},
        {"sphere", sphereMesh(1.0)},
        {"torus", torusMesh(1.0, 0.35, 96, 48)},
        {"noisy sphere", noisySphere(96, 48, 0.05)},
        {"very noisy sphere", noisySphere(40, 20, 0.5)},
        {"spiral stair", spiralStair(5)},
    };
    for (const auto& [name, given] : meshes) {
        SCOPED_TRACE(name);
        Mesh mesh = withNormals(given);
        const std::size_t triangles = mesh.triangleCount();
        unwrapUvs(mesh);
        EXPECT_EQ(mesh.triangleCount(), triangles);
        expectGoodLayout(mesh, 1024);
    }
}

// A quarter of a disc in the plane, of triangles that all reach from its middle to its border.
Mesh fanOfNeedles(int needles) {
    Mesh mesh;
    mesh.positions.emplace_back(0.0f);
    for (int i = 0; i <= needles; ++i) {
        const double angle = 0.5 * kPi * i / needles;
        mesh.positions.emplace_back(std::cos(angle), 0.0, -std::sin(angle));
    }
    for (int i = 0; i < needles; ++i) {
        const auto k = static_cast<std::uint32_t>(i);
        mesh.indices.insert(mesh.indices.end(), {0, k + 1, k + 2});
    }
    return mesh;
}

TEST(UnwrapUvs, NeedlesInAPlaneAreOneChartBeforeLong) {
    const std::clock_t begin = std::clock();
    Mesh mesh = withNormals(fanOfNeedles(100'000));
    const std::size_t vertices = mesh.vertexCount();
    unwrapUvs(mesh);
    EXPECT_EQ(mesh.vertexCount(), vertices);
    EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, 5.0);
}

// Needles that do overlap, three turns of a fan about its axis: time is bounded, and whatever was
// left out lies elsewhere.
TEST(UnwrapUvs, PilesOfNeedlesAreCutBeforeLong) {
    Mesh mesh = fanOfNeedles(30'000);
    const std::size_t corners = mesh.positions.size();
    for (std::size_t i = 1; i < corners; ++i) {
        const double turn = 6.0 * kPi * static_cast<double>(i) / static_cast<double>(corners);
        mesh.positions[i] =
            glm::vec3(std::cos(turn), 1e-5 * static_cast<double>(i), -std::sin(turn));
    }
    mesh = withNormals(mesh);
    const std::clock_t begin = std::clock();
    unwrapUvs(mesh);
    EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, 10.0);
    expectGoodLayout(mesh, 1024);
}

TEST(BorderSweep, WindingsAreCounted) {
    const auto ring = [](double x, double y, double side, bool forward) {
        std::vector<BorderSegment> segments;
        const glm::dvec2 corners[] = {{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}};
        for (int i = 0; i < 4; ++i) {
            const glm::dvec2 a = corners[i], b = corners[(i + 1) % 4];
            segments.push_back(forward ? BorderSegment{a, b} : BorderSegment{b, a});
        }
        return segments;
    };
    const auto winds = [](std::initializer_list<std::vector<BorderSegment>> rings) {
        std::vector<BorderSegment> all;
        for (const auto& segments : rings)
            all.insert(all.end(), segments.begin(), segments.end());
        return windsAtMostOnce(all);
    };
    EXPECT_TRUE(winds({}));
    EXPECT_TRUE(winds({ring(0, 0, 1, true)}));
    EXPECT_TRUE(winds({ring(0, 0, 1, true), ring(0.25, 0.25, 0.5, false)})); // a hole
    EXPECT_TRUE(winds({ring(0, 0, 1, true), ring(0.25, 0.25, 0.5, false),
                       ring(0.375, 0.375, 0.25, true)}));                   // and an island
    EXPECT_TRUE(winds({ring(0, 0, 0.5, true), ring(0.5, 0.5, 0.5, true)})); // touch at a corner
    EXPECT_FALSE(winds({ring(0, 0, 1, false)}));
    EXPECT_FALSE(winds({ring(0, 0, 1, true), ring(0.25, 0.25, 0.5, true)}));
    EXPECT_FALSE(winds({ring(0, 0, 1, true), ring(0.5, 0.5, 1, true)}));     // cross
    EXPECT_FALSE(winds({ring(0, 0, 1, true), ring(0, 0, 1, true)}));         // twice the same
    EXPECT_FALSE(winds({ring(0, 0, 0.5, true), ring(0.5, 0.1, 0.3, true)})); // share a side
}

// Random triangles, of which brute force says whether any two overlap.
TEST(BorderSweep, NeverSaysThatOverlapsAreNone) {
    std::mt19937 random(5);
    int apart = 0;
    for (int run = 0; run < 20'000; ++run) {
        std::vector<Triangle2> triangles;
        std::vector<BorderSegment> border;
        while (triangles.size() < static_cast<std::size_t>(2 + run % 3)) {
            Triangle2 t;
            for (glm::dvec2& p : t)
                p = {random() % 9 / 8.0, random() % 9 / 8.0};
            const glm::dvec2 u = t[1] - t[0], v = t[2] - t[0];
            if (u.x * v.y - u.y * v.x <= 0.0)
                continue;
            triangles.push_back(t);
            for (std::size_t i = 0; i < 3; ++i)
                border.push_back({t[i], t[(i + 1) % 3]});
        }
        bool overlap = false;
        for (std::size_t i = 0; i < triangles.size(); ++i)
            for (std::size_t k = 0; k < i; ++k)
                overlap = overlap || trianglesOverlap(triangles[i], triangles[k], 1e-9);
        const bool found = windsAtMostOnce(border);
        EXPECT_FALSE(found && overlap) << "run " << run;
        apart += found ? 1 : 0;
    }
    EXPECT_GT(apart, 200);
}

TEST(UnwrapUvs, SplitsVerticesOnlyWhereChartsMeet) {
    const Mesh before = withNormals(torusMesh(1.0, 0.35, 64, 32));
    Mesh after = before;
    unwrapUvs(after);
    ASSERT_EQ(after.normals.size(), after.positions.size());
    ASSERT_EQ(after.tangents.size(), after.positions.size());
    for (std::size_t corner = 0; corner < before.indices.size(); ++corner) {
        ASSERT_EQ(after.positions[after.indices[corner]], before.positions[before.indices[corner]]);
        ASSERT_EQ(after.normals[after.indices[corner]], before.normals[before.indices[corner]]);
    }
    // Copies of one original vertex never have the same UV: then the split was for nothing.
    std::map<std::uint32_t, std::set<std::uint32_t>> copies;
    for (std::size_t corner = 0; corner < before.indices.size(); ++corner)
        copies[before.indices[corner]].insert(after.indices[corner]);
    std::size_t split = 0;
    for (const auto& [original, vertices] : copies) {
        std::set<std::pair<float, float>> uvs;
        for (const std::uint32_t vertex : vertices)
            uvs.insert({after.uvs[vertex].x, after.uvs[vertex].y});
        EXPECT_EQ(uvs.size(), vertices.size());
        split += vertices.size() - 1;
    }
    EXPECT_GT(split, 0u);
    EXPECT_LT(split, before.vertexCount() / 3);
}

TEST(UnwrapUvs, FlatPiecesAreOneChartAndFillTheSquare) {
    Mesh plane = withNormals(planeMesh(1.0, 8));
    const std::size_t vertices = plane.vertexCount();
    unwrapUvs(plane);
    EXPECT_EQ(plane.vertexCount(), vertices);
    double covered = 0.0;
    for (std::size_t t = 0; t < plane.triangleCount(); ++t)
        covered += signedUvArea(plane, t);
    EXPECT_GT(covered, 0.97);
    Mesh cube = withNormals(cubeMesh());
    unwrapUvs(cube);
    EXPECT_LE(cube.vertexCount(), 24u);
    double used = 0.0;
    for (std::size_t t = 0; t < cube.triangleCount(); ++t)
        used += signedUvArea(cube, t);
    EXPECT_GT(used, 0.5);
}

TEST(UnwrapUvs, ChartsKeepTheirMargin) {
    // With a margin of 4 texels no two charts come closer than 8 texels.
    Mesh cube = withNormals(cubeMesh());
    UnwrapSettings settings;
    settings.resolution = 256;
    settings.marginTexels = 4.0f;
    unwrapUvs(cube, settings);
    for (std::size_t i = 0; i < cube.vertexCount(); ++i) {
        EXPECT_GE(std::min(cube.uvs[i].x, cube.uvs[i].y) * 256.0f, 3.99f);
        EXPECT_LE(std::max(cube.uvs[i].x, cube.uvs[i].y) * 256.0f, 252.01f);
        for (std::size_t j = 0; j < i; ++j) {
            if (cube.positions[i] == cube.positions[j]) {
                EXPECT_GE(glm::distance(cube.uvs[i], cube.uvs[j]) * 256.0f, 7.99f);
            }
        }
    }
}

TEST(UnwrapUvs, IsDeterministicAndIndependentOfScale) {
    Mesh a = withNormals(noisySphere(48, 24, 0.1)), b = a, large = a;
    for (glm::vec3& p : large.positions)
        p *= 1024.0f * 1024.0f;
    unwrapUvs(a);
    unwrapUvs(b);
    unwrapUvs(large);
    EXPECT_EQ(a, b);
    EXPECT_EQ(a.uvs, large.uvs);
}

// A light map of several meshes.
TEST(UnwrapUvsTogether, GivesAllMeshesOneSquareAtOneScale) {
    std::vector<Mesh> meshes{withNormals(cubeMesh()), withNormals(sphereMesh(1.0)), Mesh(),
                             withNormals(planeMesh(1.0, 8))};
    for (glm::vec3& p : meshes[3].positions)
        p = p * 3.0f + glm::vec3(100.0f, 0.0f, 0.0f);
    const std::vector<Mesh> before = meshes;
    std::vector<std::vector<std::uint32_t>> origins(meshes.size());
    for (std::size_t m = 0; m < meshes.size(); ++m)
        for (std::uint32_t v = 0; v < meshes[m].vertexCount(); ++v)
            origins[m].push_back(v);
    UnwrapSettings settings;
    settings.resolution = 512;
    EXPECT_EQ(unwrapUvsTogether(meshes, settings, origins), 512);
    Mesh all;
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        ASSERT_EQ(origins[m].size(), meshes[m].vertexCount());
        for (std::size_t v = 0; v < origins[m].size(); ++v)
            ASSERT_EQ(meshes[m].positions[v], before[m].positions[origins[m][v]]);
        for (const std::uint32_t i : meshes[m].indices)
            all.indices.push_back(static_cast<std::uint32_t>(all.positions.size()) + i);
        all.positions.insert(all.positions.end(), meshes[m].positions.begin(),
                             meshes[m].positions.end());
        all.uvs.insert(all.uvs.end(), meshes[m].uvs.begin(), meshes[m].uvs.end());
    }
    expectGoodLayout(all, 512);
    EXPECT_TRUE(meshes[2].uvs.empty());

    // Too many charts for their margins: the side that has room is the answer.
    meshes = before;
    for (std::size_t m = 0; m < meshes.size(); ++m)
        origins[m].resize(before[m].vertexCount());
    settings.resolution = 8;
    EXPECT_GT(unwrapUvsTogether(meshes, settings, origins), 8);
}

// Models may be made of very many.
TEST(HasOverlappingUvs, SmallMeshesTakeLittle) {
    Mesh plane = withNormals(planeMesh(1.0, 4));
    unwrapUvs(plane);
    const std::clock_t begin = std::clock();
    for (int i = 0; i < 1000; ++i)
        EXPECT_FALSE(hasOverlappingUvs(plane));
    EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, 0.5);
    // Mirrored, side by side: triangles of both orientations.
    for (glm::vec2& uv : plane.uvs)
        uv.x = 0.5f * uv.x;
    Mesh both = plane;
    for (std::size_t i = 0; i < plane.vertexCount(); ++i) {
        both.positions.push_back(plane.positions[i]);
        both.normals.push_back(plane.normals[i]);
        both.tangents.push_back(plane.tangents[i]);
        both.uvs.emplace_back(1.0f - plane.uvs[i].x, plane.uvs[i].y);
    }
    for (const std::uint32_t i : plane.indices)
        both.indices.push_back(i + static_cast<std::uint32_t>(plane.vertexCount()));
    EXPECT_FALSE(hasOverlappingUvs(both));
    for (std::size_t i = plane.vertexCount(); i < both.uvs.size(); ++i)
        both.uvs[i].x -= 0.25f;
    EXPECT_TRUE(hasOverlappingUvs(both));
}

TEST(HasOverlappingUvs, FindsMirroredTiledAndStackedUvs) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    mesh.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    EXPECT_FALSE(hasOverlappingUvs(mesh));
    for (glm::vec2& uv : mesh.uvs) // another tile of the same image: each texel is still met once
        uv += glm::vec2(3.0f, -2.0f);
    EXPECT_FALSE(hasOverlappingUvs(mesh));
    for (glm::vec2& uv : mesh.uvs) // tiled
        uv = uv * 1.5f;
    EXPECT_TRUE(hasOverlappingUvs(mesh));
    for (glm::vec2& uv : mesh.uvs) // tiled beyond reason
        uv = uv * 1e6f;
    EXPECT_TRUE(hasOverlappingUvs(mesh));
    mesh.uvs = {{0, 1}, {1, 1}, {1, 0}, {1, 0.9f}}; // folded over the diagonal
    EXPECT_TRUE(hasOverlappingUvs(mesh));
    mesh.uvs.assign(4, glm::vec2(0.5f)); // no area covers no texel
    EXPECT_FALSE(hasOverlappingUvs(mesh));
}

// What meshes of many millions of triangles get.
TEST(BoxProjection, KeepsOrientationAndCellsApart) {
    Mesh mesh = withNormals(noisySphere(48, 24, 0.05));
    const std::size_t triangles = mesh.triangleCount();
    boxProjectUvs(mesh);
    ASSERT_EQ(mesh.triangleCount(), triangles);
    ASSERT_EQ(mesh.uvs.size(), mesh.positions.size());
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    for (std::size_t t = 0; t < triangles; ++t) {
        EXPECT_GT(signedUvArea(mesh, t), 0.0);
        std::set<std::pair<int, int>> cells; // square, in three columns
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const glm::vec2 uv = mesh.uvs[mesh.indices[3 * t + corner]];
            cells.insert({int(uv.x * 3), int(uv.y * 3)});
            ASSERT_TRUE(uv.x > 0 && uv.x < 1 && uv.y > 0 && uv.y < 1);
        }
        EXPECT_EQ(cells.size(), 1u);
    }
}
