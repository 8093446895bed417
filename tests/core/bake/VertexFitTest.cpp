// The fit over the surface against what is known in closed form, without a ray.
#include "core/bake/transfer/VertexFit.h"
#include "core/job/Parallel.h"
#include "tests/core/bake/BakeTestScene.h"

#include <functional>
#include <gtest/gtest.h>
#include <random>

using namespace patina;
using namespace patina::test;

namespace {

using Field = std::function<double(const glm::vec3& position, const glm::vec3& normal)>;

// What the samples of the only mesh of a scene would see of a field over its positions in metres.
struct FitCase {
    BakeGeometry geometry;
    VertexSamples samples;
    std::vector<float> seen;

    FitCase(const BakeInputs& inputs, const Field& field)
        : geometry(*makeBakeGeometry(inputs, {}))
        , samples(fittedVertexSamples(geometry, {})) {
        const BakeGeometryMesh& mesh = geometry.meshes.at(0);
        const auto add = [&](const glm::vec3& p, const glm::vec3& n) {
            seen.push_back(float(field(p / float(geometry.unitsPerMetre), glm::normalize(n))));
        };
        for (std::size_t v = 0; v < mesh.positions.size(); ++v)
            add(mesh.positions[v], mesh.normals[v]);
        for (const TrianglePoint& at : samples.onTriangles)
            add(interpolated(mesh.positions, at), interpolated(mesh.normals, at));
    }

    [[nodiscard]] glm::vec3 interpolated(const std::vector<glm::vec3>& of,
                                         const TrianglePoint& at) const {
        const std::uint32_t* i = geometry.meshes[0].mesh->indices.data() + 3 * at.triangle;
        return (1.0f - at.b1 - at.b2) * of[i[0]] + at.b1 * of[i[1]] + at.b2 * of[i[2]];
    }
    [[nodiscard]] VertexFit fit() const {
        return {geometry.meshes[0], samples.onTriangles, std::vector<std::uint8_t>(seen.size())};
    }
    [[nodiscard]] std::vector<float> atVertices() const {
        return {seen.begin(), seen.begin() + static_cast<std::ptrdiff_t>(samples.vertexCount())};
    }

    // The RMS over the surface of what `values` interpolate to, against the field.
    [[nodiscard]] double rms(const std::vector<float>& values, const Field& field) const {
        const BakeGeometryMesh& mesh = geometry.meshes[0];
        constexpr int kCells = 12;
        double squares = 0.0, count = 0.0;
        for (std::uint32_t t = 0; t < mesh.mesh->triangleCount(); ++t)
            for (int i = 0; i < kCells; ++i)
                for (int j = 0; j + i < kCells; ++j) {
                    const TrianglePoint at{0, t, (float(i) + 1.0f / 3) / kCells,
                                           (float(j) + 1.0f / 3) / kCells};
                    const std::uint32_t* index = mesh.mesh->indices.data() + 3 * t;
                    const double value = (1.0 - at.b1 - at.b2) * values[index[0]] +
                                         at.b1 * values[index[1]] + at.b2 * values[index[2]];
                    const double d = value - field(interpolated(mesh.positions, at) /
                                                       float(geometry.unitsPerMetre),
                                                   glm::normalize(interpolated(mesh.normals, at)));
                    squares += d * d;
                    count += 1.0;
                }
        return std::sqrt(squares / count);
    }
};

// Ambient visibility of the floor around the foot of a resting unit sphere.
double restingSphere(const glm::vec3& p, const glm::vec3&) {
    return 1.0 - std::pow(double(p.x) * p.x + double(p.z) * p.z + 1.0, -1.5);
}

} // namespace

// The floor from -4 to 4 in squares of side `edge`, two triangles each.
TEST(VertexFit, IsClearlyCloserThanTheValuesAtTheVertices) {
    struct Case {
        double edge, atVertices, fitted; // RMS
    };
    // The best continuous piecewise linear function has .0438, .0197, .0056, .0011.
    for (const Case& expected : std::initializer_list<Case>{{2.0, 0.0622, 0.0438},
                                                            {1.0, 0.0214, 0.0175},
                                                            {0.5, 0.0093, 0.0057},
                                                            {0.25, 0.0025, 0.0013}}) {
        const FitCase c(sceneOf({planeMesh(4.0, int(8.0 / expected.edge))}), restingSphere);
        const double point = c.rms(c.atVertices(), restingSphere);
        const double fit = c.rms(c.fit().solve(1, c.seen, {}), restingSphere);
        EXPECT_NEAR(point, expected.atVertices, 0.05 * expected.atVertices) << expected.edge;
        EXPECT_LT(fit, expected.fitted) << expected.edge;
        EXPECT_LT(fit, 0.82 * point) << expected.edge;
    }
}

TEST(VertexFit, KeepsLinearFunctions) {
    // Long and short triangles of all sizes; neither the fit nor its smoothness bends a plane.
    const Mesh floor = gridMesh(9, 7, [](double u, double v) {
        return glm::dvec3(3 * u * u * u, 0, -2 * v * v + 0.1 * u);
    });
    const Field linear = [](const glm::vec3& p, const glm::vec3&) {
        return 0.25 + 0.5 * double(p.x) - 0.125 * double(p.z);
    };
    const FitCase c(sceneOf({floor}), linear);
    const std::vector<float> fitted = c.fit().solve(1, c.seen, {});
    for (std::size_t v = 0; v < fitted.size(); ++v)
        EXPECT_NEAR(fitted[v], c.seen[v], 2e-4) << v;
    for (const float difference : c.fit().residual(1, c.seen, fitted))
        EXPECT_LT(difference, 2e-4);
}

TEST(VertexFit, DoesNotAmplifyNoise) {
    const Field open = [](const glm::vec3&, const glm::vec3&) { return 0.5; };
    FitCase c(sceneOf({planeMesh(1.0, 120)}), open);
    ASSERT_LT(c.samples.onTriangles.size(), 1.01 * double(c.samples.vertexCount()));
    std::mt19937 random(5);
    std::normal_distribution<float> noise(0.0f, 0.01f);
    for (float& value : c.seen)
        value += noise(random);
    const double point = c.rms(c.atVertices(), open);
    EXPECT_LT(c.rms(c.fit().solve(1, c.seen, {}), open), 1.05 * point);
}

// A wall of another object stands on half of the floor: nothing is seen of what lies under it, and
// its darkness must not run out from below.
TEST(VertexFit, WhatLiesWithinOtherObjectsDoesNotDarkenTheRest) {
    const Field buried = [](const glm::vec3& p, const glm::vec3&) {
        return p.x < 0.1f ? 0.0 : 1.0;
    };
    const FitCase c(sceneOf({planeMesh(2.0, 8)}), buried);
    std::vector<std::uint8_t> hidden;
    for (const float value : c.seen)
        hidden.push_back(value == 0.0f ? 1 : 0);
    const VertexFit fit(c.geometry.meshes[0], c.samples.onTriangles, hidden);
    const std::vector<float> fitted = fit.solve(1, c.seen, {});
    const std::vector<glm::vec3>& positions = c.geometry.meshes[0].positions;
    const float metre = float(c.geometry.unitsPerMetre);
    for (std::size_t v = 0; v < fitted.size(); ++v) {
        if (positions[v].x / metre > -0.01f) { // at 0 is the border of the lit triangles
            EXPECT_NEAR(fitted[v], 1.0f, 0.03f) << v;
        } else if (positions[v].x / metre < -1.4f) {
            EXPECT_NEAR(fitted[v], 0.0f, 0.25f) << v; // of no consequence
        }
    }
}

TEST(VertexFit, SidesOfASeamShareTheirValues) {
    // Every triangle with corners of its own: the result is that of the welded mesh.
    const Mesh welded = planeMesh(2.0, 6);
    Mesh soup;
    for (const std::uint32_t index : welded.indices) {
        soup.indices.push_back(std::uint32_t(soup.positions.size()));
        soup.positions.push_back(welded.positions[index]);
    }
    const FitCase a(sceneOf({welded}), restingSphere), b(sceneOf({soup}), restingSphere);
    const std::vector<float> one = a.fit().solve(1, a.seen, {}),
                             other = b.fit().solve(1, b.seen, {});
    for (std::size_t i = 0; i < welded.indices.size(); ++i)
        EXPECT_NEAR(other[i], one[welded.indices[i]], 0.02) << i;
    for (std::size_t i = 0; i < soup.positions.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (soup.positions[i] == soup.positions[j]) {
                EXPECT_EQ(other[i], other[j]);
            }
}

TEST(VertexFit, SurvivesBadMeshes) {
    // Not sanitized: a vertex without triangles, one of zero area, three on an edge, two the same,
    // a needle.
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {1, 0, 1},      {5, 0, 5},
                      {2, 0, 0}, {1, 1, 1}, {0, 0, 0}, {100, 1e-6f, 0}};
    mesh.normals.assign(mesh.positions.size(), glm::vec3(0, 1, 0));
    mesh.indices = {0, 2, 1, 1, 2, 3, 0, 1, 5, 1, 2, 6, 7, 2, 1, 1, 1, 3, 0, 8, 1};
    BakeInputs inputs;
    inputs.meshes.push_back({1, 1, std::make_shared<const Mesh>(mesh)});
    const FitCase c(inputs, [](const glm::vec3&, const glm::vec3&) { return 0.25; });
    EXPECT_GT(c.samples.onTriangles.size(), 1000u);
    const std::vector<float> fitted = c.fit().solve(1, c.seen, {});
    for (std::size_t v = 0; v < fitted.size(); ++v)
        EXPECT_NEAR(fitted[v], 0.25f, 1e-4) << v;
    for (const float difference : c.fit().residual(1, c.seen, fitted))
        EXPECT_LT(difference, 1e-4f);
}

TEST(VertexFit, SamplesFollowTheGeometryOnly) {
    const BakeInputs inputs = sceneOf({torusMesh(1.0, 0.4, 60, 40), planeMesh(5.0)});
    const BakeGeometry geometry = *makeBakeGeometry(inputs, {});
    const VertexSamples samples = fittedVertexSamples(geometry, {});
    EXPECT_EQ(samples.points.size(), samples.vertexCount() + samples.onTriangles.size());
    EXPECT_GE(samples.onTriangles.size(), 4000u);
    EXPECT_LE(samples.onTriangles.size(), 8193u);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> counts;
    for (const TrianglePoint& at : samples.onTriangles) {
        ++counts[{at.mesh, at.triangle}];
        EXPECT_GE(std::min({at.b1, at.b2, 1.0f - at.b1 - at.b2}), 0.0f);
    }
    EXPECT_GT(counts.size(), 4500u); // half of all are shared evenly: .85 each
    EXPECT_EQ((counts[{1, 0}]), 256);
    EXPECT_EQ((counts[{1, 1}]), 256);
    std::size_t next = 0; // ranges cover all points in order
    for (const PointRange& range : samples.ranges) {
        EXPECT_EQ(range.first, next);
        EXPECT_GT(range.count, 0u);
        next += range.count;
    }
    EXPECT_EQ(next, samples.points.size());
}

// The whole bake: rays from all samples, fitted; the sphere's shadow on a coarse floor.
TEST(VertexTransfer, FittedBakesSmearLessThanThoseAtVertices) {
    const BakeInputs inputs = sceneOf({planeMesh(4.0, 8), sphereMesh(1.0, 64, 32, {0, 1, 0})});
    const FitCase floor(sceneOf({planeMesh(4.0, 8)}), restingSphere);
    const auto visibility = [&](bool fitted) {
        const BakeArtifact artifact = prtOf(inputs, 2, 512, fitted);
        EXPECT_EQ(artifact.settings.at("fitted"), fitted ? "true" : "false");
        const VertexBake& bake = artifact.vertices.at(0);
        EXPECT_EQ(bake.sky.size() * 4, bake.values.size());
        EXPECT_EQ(bake.error.size() * 4, bake.values.size());
        std::vector<float> values;
        for (std::size_t i = 0; i < bake.values.size(); i += 4)
            values.push_back(bake.values[i] * 3.5449077f);
        return values;
    };
    const double point = floor.rms(visibility(false), restingSphere);
    const double fit = floor.rms(visibility(true), restingSphere);
    EXPECT_NEAR(point, 0.0214, 0.002);
    EXPECT_LT(fit, 0.0182);
}

TEST(VertexTransfer, FittedBakesHoldAtAnyScaleAndThreadCount) {
    std::vector<std::vector<float>> results;
    for (const float scale : {1.0f, 0x1p-20f, 0x1p20f})
        for (const int threads : {1, 2, 7}) {
            const ThreadLimit limit(threads);
            const BakeArtifact artifact =
                prtOf(sceneOf({planeMesh(2.0, 4), torusMesh(0.5, 0.2, 12, 8)},
                              glm::scale(glm::mat4(1.0f), glm::vec3(scale))),
                      3, 32, true);
            std::vector<float>& result = results.emplace_back();
            for (const VertexBake& bake : artifact.vertices)
                for (const auto* part : {&bake.values, &bake.sky, &bake.error})
                    result.insert(result.end(), part->begin(), part->end());
            EXPECT_EQ(result, results.front()) << scale << ' ' << threads;
        }
}

TEST(VertexTransfer, ErrorTellsWhereTheMeshIsTooCoarse) {
    const BakeInputs inputs = sceneOf({planeMesh(4.0, 8), sphereMesh(0.5, 32, 16, {0, 0.5, 0})});
    const BakeArtifact artifact = prtOf(inputs, 2, 256, true);
    const Mesh& floor = *inputs.meshes[0].mesh;
    const std::vector<float>& error = artifact.vertices.at(0).error;
    EXPECT_GT(error[vertexAt(floor, {0, 0, 0})], 5.0f * error[vertexAt(floor, {4, 0, 4})]);
}
