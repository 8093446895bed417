// Transfer of meshes that nobody should make and everybody has: every one bakes, to finite values.
#include "tests/core/bake/BakeTestScene.h"

#include <gtest/gtest.h>

using namespace patina;
using namespace patina::test;

namespace {

Mesh triangles(std::vector<glm::vec3> positions, std::vector<std::uint32_t> indices) {
    Mesh mesh;
    mesh.positions = std::move(positions);
    mesh.indices = std::move(indices);
    return mesh;
}

Mesh insideOut(Mesh mesh) {
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
    return mesh;
}

Mesh joined(Mesh a, const Mesh& b) {
    const auto first = static_cast<std::uint32_t>(a.positions.size());
    a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
    a.normals.clear();
    a.uvs.clear();
    for (const std::uint32_t index : b.indices)
        a.indices.push_back(first + index);
    return a;
}

std::vector<std::pair<const char*, Mesh>> badMeshes() {
    std::vector<std::pair<const char*, Mesh>> meshes;
    meshes.emplace_back("open", gridMesh(6, 6, [](double u, double v) {
                            return glm::dvec3(u, 0.2 * std::sin(6 * u), v);
                        }));
    // Three triangles at one edge.
    meshes.emplace_back("non-manifold",
                        triangles({{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 0, 1}},
                                  {0, 1, 2, 0, 3, 1, 0, 1, 4}));
    meshes.emplace_back("self-intersecting", joined(sphereMesh(1.0, 16, 8), cubeMesh()));
    meshes.emplace_back("inside-out", insideOut(sphereMesh(1.0, 16, 8)));
    meshes.emplace_back("zero-area", triangles({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}},
                                               {0, 1, 2, 0, 0, 1, 3, 3, 3, 0, 1, 3}));
    meshes.emplace_back(
        "duplicate vertices",
        triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                  {0, 1, 2, 3, 4, 5, 0, 1, 5}));
    meshes.emplace_back("two triangles", triangles({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                                                   {0, 1, 2, 0, 2, 3}));
    meshes.emplace_back("vertex without faces",
                        triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {50, 50, 50}}, {0, 1, 2}));
    return meshes;
}

} // namespace

TEST(BadGeometry, BakesToFiniteValuesAtAnyScale) {
    TileSink sink;
    for (const auto& [name, mesh] : badMeshes())
        for (const float scale : {1e-6f, 1.0f, 1e6f})
            for (const bool fitted : {false, true}) {
                PrtSettings settings;
                settings.order = 4;
                settings.samples = 64;
                settings.fitted = fitted;
                const Result<BakeArtifact> artifact =
                    bakePrtVertex(sceneOf({mesh}, glm::scale(glm::mat4(1.0f), glm::vec3(scale))),
                                  settings, sink, {});
                ASSERT_TRUE(artifact.ok()) << name << " " << artifact.error().message;
                for (const VertexBake& bake : artifact->vertices)
                    for (const float value : bake.values)
                        EXPECT_LT(std::abs(value), 2.0f) << name << " scale " << scale;
            }
}

// A power of two as scale changes nothing at all; other scales only what rounding does.
TEST(BadGeometry, TinyAndHugeScenesBakeAlike) {
    const auto bakeAt = [](float scale) {
        return prtOf(sceneOf({planeMesh(4.0, 8), sphereMesh(1.0, 16, 8, {0, 1.2, 0})},
                             glm::scale(glm::mat4(1.0f), glm::vec3(scale))),
                     4, 64);
    };
    const BakeArtifact one = bakeAt(1.0f);
    EXPECT_EQ(bakeAt(0x1p-20f).vertices, one.vertices);
    EXPECT_EQ(bakeAt(0x1p20f).vertices, one.vertices);
    for (const float scale : {1e-6f, 1e6f}) {
        const BakeArtifact other = bakeAt(scale);
        double difference = 0.0, count = 0.0;
        for (std::size_t m = 0; m < one.vertices.size(); ++m)
            for (std::size_t i = 0; i < one.vertices[m].values.size(); ++i, ++count)
                difference += std::abs(one.vertices[m].values[i] - other.vertices[m].values[i]);
        EXPECT_LT(difference / count, 1e-3) << scale;
    }
}
