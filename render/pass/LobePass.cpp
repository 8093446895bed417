#include "render/pass/LobePass.h"

#include "core/base/Check.h"

#include <algorithm>
#include <epoxy/gl.h>
#include <glm/geometric.hpp>

namespace patina::render {

namespace {

struct LobeVertex {
    glm::vec3 position, normal, color;
};

} // namespace

void LobePass::upload(const LobeMesh& mesh) {
    CHECK_EQ(mesh.normals.size(), mesh.positions.size());
    CHECK_EQ(mesh.colors.size(), mesh.positions.size());
    std::vector<LobeVertex> vertices;
    vertices.reserve(mesh.positions.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        vertices.push_back({mesh.positions[i], mesh.normals[i], mesh.colors[i]});
    m_vertices = gl::Buffer::of<LobeVertex>(m_context, "lobe", vertices);
    m_indices = gl::Buffer(m_context, "lobe", mesh.triangles.size() * sizeof(std::uint32_t));
    m_array = gl::VertexArray(m_context, "lobe");
    m_array.setFloats(0, 3, m_vertices, offsetof(LobeVertex, position), sizeof(LobeVertex));
    m_array.setFloats(1, 3, m_vertices, offsetof(LobeVertex, normal), sizeof(LobeVertex));
    m_array.setFloats(2, 3, m_vertices, offsetof(LobeVertex, color), sizeof(LobeVertex));
    m_array.setIndices(m_indices);
}

void LobePass::sort(const SurfaceLobe& lobe, const glm::vec3& toCamera) {
    const LobeMesh& mesh = *lobe.mesh;
    // Into the lobe's own frame, where the mesh is.
    const glm::vec3 side(glm::dot(toCamera, lobe.tangent), glm::dot(toCamera, lobe.bitangent),
                         glm::dot(toCamera, lobe.normal));
    m_order.clear();
    for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
        float distance = 0.0f;
        for (std::size_t corner = 0; corner < 3; ++corner)
            distance += glm::dot(mesh.positions[mesh.triangles[i + corner]], side);
        m_order.emplace_back(distance, static_cast<std::uint32_t>(i));
    }
    std::sort(m_order.begin(), m_order.end());
    m_sorted.clear();
    for (const auto& [distance, first] : m_order)
        for (std::uint32_t corner = 0; corner < 3; ++corner)
            m_sorted.push_back(mesh.triangles[first + corner]);
}

Result<void> LobePass::draw(const Canvas& canvas, const Targets& targets, const SurfaceLobe& lobe,
                            const glm::vec3& cameraPosition, float reach) {
    if (!lobe.mesh || lobe.mesh->triangles.empty())
        return {};
    const auto shader = m_shaders.program({{"lobe.vert", "lobe.frag"}, {}});
    if (!shader)
        return shader.error();
    if (m_mesh != lobe.mesh)
        upload(*lobe.mesh);
    m_mesh = lobe.mesh;
    sort(lobe, cameraPosition - lobe.position);
    m_indices.write(0, std::as_bytes(std::span(m_sorted)));

    (*shader)->use();
    (*shader)->set("u_position", lobe.position);
    (*shader)->set("u_tangent", lobe.tangent);
    (*shader)->set("u_bitangent", lobe.bitangent);
    (*shader)->set("u_normal", lobe.normal);
    (*shader)->set("u_reach", reach);
    (*shader)->set("u_color", lobe.color);
    targets.depth().bind(0);
    canvas.bind();
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    m_array.bind();
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(m_sorted.size()), GL_UNSIGNED_INT, nullptr);
    return {};
}

} // namespace patina::render
