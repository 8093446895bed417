#include "render/scene/GpuMesh.h"

#include "core/base/Check.h"
#include "core/mesh/CoarseMesh.h"

#include <algorithm>
#include <array>

namespace patina::render {

namespace {

struct Vertex {
    glm::vec3 position, normal;
    glm::vec4 tangent;
    glm::vec2 uv;
};
static_assert(sizeof(Vertex) == 48);

constexpr std::size_t kManyToReduce = 4'000; // triangles
// Along the longest side: each has half the triangles of the one before.
constexpr std::array kCoarseCells{64.0f, 45.0f, 32.0f, 23.0f, 16.0f};

void addCoarse(GpuMesh& result, const Mesh& mesh, std::vector<std::uint32_t>& indices) {
    const glm::vec3 size = result.bounds.size();
    const float side = std::max({size.x, size.y, size.z});
    if (mesh.triangleCount() < kManyToReduce || !(side > 0.0f))
        return;
    std::size_t finer = indices.size();
    for (const float cells : kCoarseCells) {
        const std::vector<std::uint32_t> coarse = coarseTriangles(mesh, side / cells);
        if (coarse.empty())
            return;
        if (coarse.size() > 2 * finer / 3)
            continue; // not worth its memory
        result.coarse.push_back(
            {static_cast<int>(indices.size()), static_cast<int>(coarse.size()), side / cells});
        indices.insert(indices.end(), coarse.begin(), coarse.end());
        finer = coarse.size();
    }
}

} // namespace

GpuMesh makeGpuMesh(gl::Context& context, const Mesh& mesh, bool reduced) {
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
    if (reduced)
        addCoarse(result, mesh, indices);
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
