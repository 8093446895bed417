#include "render/scene/GpuMesh.h"

#include "core/base/Check.h"
#include "core/mesh/CoarseMesh.h"

#include <algorithm>

namespace patina::render {

namespace {

struct Vertex {
    glm::vec3 position, normal;
    glm::vec4 tangent;
    glm::vec2 uv;
};
static_assert(sizeof(Vertex) == 48);

constexpr std::size_t kManyToReduce = 30'000;
constexpr float kCoarseCells = 64.0f; // along the longest side

} // namespace

GpuMesh makeGpuMesh(gl::Context& context, const Mesh& mesh) {
    GpuMesh result;
    result.vertexCount = mesh.vertexCount();
    result.indexCount = static_cast<int>(mesh.indices.size());
    if (mesh.indices.empty())
        return result;
    CHECK_EQ(mesh.normals.size(), mesh.vertexCount());
    CHECK_EQ(mesh.tangents.size(), mesh.vertexCount());
    CHECK_EQ(mesh.uvs.size(), mesh.vertexCount());

    // Interleaved: one vertex is one cache line.
    std::vector<Vertex> vertices(mesh.vertexCount());
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        vertices[i] = {mesh.positions[i], mesh.normals[i], mesh.tangents[i], mesh.uvs[i]};
        result.bounds.add(mesh.positions[i]);
    }
    result.lots.resize((mesh.triangleCount() + GpuMesh::kLot - 1) / GpuMesh::kLot);
    for (std::size_t i = 0; i < mesh.indices.size(); ++i)
        result.lots[i / (3 * std::size_t{GpuMesh::kLot})].add(mesh.positions[mesh.indices[i]]);
    result.vertices = gl::Buffer::of<Vertex>(context, "vertices", vertices);
    std::vector<std::uint32_t> indices = mesh.indices;
    const glm::vec3 size = result.bounds.size();
    const float cell = std::max({size.x, size.y, size.z}) / kCoarseCells;
    if (mesh.triangleCount() >= kManyToReduce && cell > 0.0f) {
        const std::vector<std::uint32_t> coarse = coarseTriangles(mesh, cell);
        if (!coarse.empty() && coarse.size() < indices.size() / 2) {
            indices.insert(indices.end(), coarse.begin(), coarse.end());
            result.coarseCount = static_cast<int>(coarse.size());
            result.coarseCell = cell;
        }
    }
    result.indices = gl::Buffer::of<std::uint32_t>(context, "indices", indices);
    result.array = gl::VertexArray(context, "mesh");
    result.array.setFloats(0, 3, result.vertices, offsetof(Vertex, position), sizeof(Vertex));
    result.array.setFloats(1, 3, result.vertices, offsetof(Vertex, normal), sizeof(Vertex));
    result.array.setFloats(2, 4, result.vertices, offsetof(Vertex, tangent), sizeof(Vertex));
    result.array.setFloats(3, 2, result.vertices, offsetof(Vertex, uv), sizeof(Vertex));
    result.array.setIndices(result.indices);
    return result;
}

} // namespace patina::render
