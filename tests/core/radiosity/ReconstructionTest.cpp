// Light that runs smoothly over surfaces: no gaps, creases kept, means kept.
#include "core/radiosity/Reconstruction.h"
#include "tests/core/radiosity/RadiosityScenes.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <utility>

namespace patina::test {

using namespace radiosity;

namespace {

// Edges of triangles that no other triangle has, but for those on the rim of the unit square.
int gaps(const LitMesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const LitMesh::Triangle& triangle : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = mesh.vertices[triangle.vertices[k]].light,
                                b = mesh.vertices[triangle.vertices[(k + 1) % 3]].light;
            ++edges[{std::min(a, b), std::max(a, b)}];
        }
    std::vector<glm::vec3> positions(mesh.lights);
    for (const LitMesh::Vertex& vertex : mesh.vertices)
        positions[vertex.light] = vertex.position;
    int open = 0;
    for (const auto& [edge, count] : edges) {
        const glm::vec3 middle = 0.5f * (positions[edge.first] + positions[edge.second]);
        const bool rim = std::min({middle.x, middle.y, 1.0f - middle.x, 1.0f - middle.y}) < 1e-5f;
        open += count != 2 && !rim ? 1 : 0;
    }
    return open;
}

std::unique_ptr<DividedScene> square(double edge) {
    return divided(sceneOf({{{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}}}), {edge});
}

// Mean over each element of a function of the place.
template <class Function>
std::vector<glm::dvec3> means(const ElementMesh& elements, const Function& f) {
    std::vector<glm::dvec3> result;
    for (std::uint32_t e = 0; e < elements.size(); ++e) {
        double sum = 0.0;
        constexpr int kSide = 8;
        for (int i = 0; i < kSide * kSide; ++i) {
            const glm::vec2 u((static_cast<float>(i % kSide) + 0.5f) / kSide,
                              (static_cast<float>(i / kSide) + 0.5f) / kSide);
            const glm::dvec3 p = elements.samplePosition(e, u) * elements.metresPerUnit() +
                                 glm::dvec3(0.5, 0.5, 0.0);
            sum += f(p.x, p.y) / (kSide * kSide);
        }
        result.emplace_back(sum, 2.0 * sum, 0.0);
    }
    return result;
}

TEST(LitMesh, HasNoGapsHoweverElementsAreDivided) {
    const auto scene = square(0.26);
    ElementMesh& elements = scene->elements;
    elements.divide(std::vector<std::uint32_t>{5, 6});
    elements.divide(std::vector<std::uint32_t>{0, static_cast<std::uint32_t>(elements.size() - 1)});
    elements.divide(std::vector<std::uint32_t>{static_cast<std::uint32_t>(elements.size() - 2)});
    const LitMesh mesh = litMesh(elements, *scene->scene.geometry(), *scene->scene.rays());
    EXPECT_EQ(gaps(mesh), 0);
    double area = 0.0;
    for (const LitMesh::Triangle& triangle : mesh.triangles)
        area += mesh.area(triangle);
    EXPECT_NEAR(area, 1.0, 1e-5);
}

TEST(LitMesh, OfFacesThatAreDividedDifferentlyHasNoGapsBetweenThem) {
    // Three faces of one mesh that share edges, and have other numbers of columns each.
    TraceInputs inputs = sceneOf({{{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}}});
    Mesh mesh = *inputs.meshes[0].mesh;
    mesh.positions = {{0, 0, 0},    {1, 0, 0}, {1, 0.4f, 0}, {0, 0.4f, 0},
                      {0.3f, 1, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.indices = {0, 1, 2, 0, 2, 3, 3, 2, 4, 2, 5, 4, 3, 4, 6};
    mesh.normals.assign(7, {0, 0, 1});
    mesh.tangents.assign(7, {1, 0, 0, 1});
    mesh.uvs.clear();
    for (const glm::vec3& p : mesh.positions)
        mesh.uvs.emplace_back(p.x, p.y);
    inputs.meshes[0].mesh = std::make_shared<const Mesh>(std::move(mesh));
    const auto scene = divided(inputs, {0.21});
    EXPECT_EQ(gaps(litMesh(scene->elements, *scene->scene.geometry(), *scene->scene.rays())), 0);
}

TEST(LitMesh, EndsAtCreases) {
    const auto cube = divided(sceneOf(unitCube(0.5f)), {0.5});
    const LitMesh mesh = litMesh(cube->elements, *cube->scene.geometry(), *cube->scene.rays());
    EXPECT_EQ(mesh.lights, 6u * 9u) << "nine a side, none shared";
    const auto ball = divided(
        [] {
            TraceInputs inputs = sceneOf(unitCube(0.5f));
            inputs.meshes = {facetedBall(8, 1.0f, false, 0)};
            return inputs;
        }(),
        {});
    const LitMesh smooth = litMesh(ball->elements, *ball->scene.geometry(), *ball->scene.rays());
    EXPECT_EQ(smooth.lights, 16u * 7u + 2u) << "one at each corner of the ball";
    EXPECT_GT(smooth.vertices.size(), smooth.lights) << "its seam has two texture coordinates";
}

TEST(VertexLight, FindsAGradientAgainUpToTheRim) {
    for (const bool adaptive : {false, true}) {
        const auto scene = square(0.126);
        if (adaptive)
            scene->elements.divide(std::vector<std::uint32_t>{0, 9, 20, 21, 36});
        const auto f = [](double x, double y) { return 1.0 + 2.0 * x - 0.5 * y; };
        const LitMesh mesh =
            litMesh(scene->elements, *scene->scene.geometry(), *scene->scene.rays());
        const std::vector<glm::dvec3> light =
            vertexLight(mesh, scene->elements, means(scene->elements, f));
        for (const LitMesh::Vertex& vertex : mesh.vertices) {
            const double truth = f(vertex.position.x, vertex.position.y);
            EXPECT_NEAR(light[vertex.light].x, truth, adaptive ? 0.02 : 0.002);
            EXPECT_NEAR(light[vertex.light].y, 2.0 * light[vertex.light].x, 1e-6);
        }
    }
}

TEST(VertexLight, IsNearerToTheTruthThanTheMeansOfNeighbours) {
    const auto scene = square(0.1001);
    const auto f = [](double x, double y) { return std::exp(-3.0 * x) + y * y; };
    const LitMesh mesh = litMesh(scene->elements, *scene->scene.geometry(), *scene->scene.rays());
    const std::vector<glm::dvec3> values = means(scene->elements, f);
    const std::vector<glm::dvec3> light = vertexLight(mesh, scene->elements, values);
    std::vector<double> sums(mesh.lights, 0.0), counts(mesh.lights, 0.0);
    for (const LitMesh::Triangle& triangle : mesh.triangles)
        for (const std::uint32_t v : triangle.vertices) {
            sums[mesh.vertices[v].light] += values[triangle.element].x;
            counts[mesh.vertices[v].light] += 1.0;
        }
    double squares = 0.0, averaged = 0.0;
    for (const LitMesh::Vertex& vertex : mesh.vertices) {
        const double truth = f(vertex.position.x, vertex.position.y);
        squares += std::pow(light[vertex.light].x - truth, 2.0);
        averaged += std::pow(sums[vertex.light] / counts[vertex.light] - truth, 2.0);
    }
    EXPECT_LT(squares, 0.05 * averaged);
}

TEST(VertexLight, IsNeverBelowNothing) {
    const auto scene = square(0.126);
    const LitMesh mesh = litMesh(scene->elements, *scene->scene.geometry(), *scene->scene.rays());
    const std::vector<glm::dvec3> light =
        vertexLight(mesh, scene->elements,
                    means(scene->elements, [](double x, double) { return x < 0.5 ? 0.0 : 10.0; }));
    for (const glm::dvec3& value : light)
        EXPECT_GE(value.x, 0.0);
}

} // namespace
} // namespace patina::test
