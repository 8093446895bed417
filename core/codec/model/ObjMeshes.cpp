#include "core/codec/model/ObjMeshes.h"

#include <array>
#include <cmath>
#include <functional>
#include <unordered_set>

namespace patina::codec {

namespace {

// Vectors in Assimp's arithmetic, bit for bit.
float dot(const glm::vec3& a, const glm::vec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

glm::vec3 unit(const glm::vec3& v) {
    const float length = std::sqrt(dot(v, v));
    return length == 0.0f ? v : v * (1.0f / length);
}

// std::hash<Vertex> of Assimp's JoinVerticesProcess.cpp.
std::size_t hashOf(const glm::vec3& position) {
    std::size_t seed = 0;
    for (const float x : {position.x, position.y, position.z})
        seed ^= std::hash<float>()(x) + 0x9e3779b9 + (seed << 6) + (seed >> 2);
    return seed;
}

} // namespace

ObjMeshes::ObjMeshes(const ObjText& text)
    : m_text(text) {
    m_hashes.reserve(text.positions.size());
    for (const glm::vec3& position : text.positions)
        m_hashes.push_back(hashOf(position));
}

glm::vec3 ObjMeshes::normal(const ObjText::Corner& corner) const {
    return corner.normal == ObjText::kNone ? glm::vec3(0.0f) : m_text.normals[corner.normal];
}

// What a corner lacks is 0 in the file's orientation.
glm::vec2 ObjMeshes::uv(const ObjText::Corner& corner) const {
    return corner.uv == ObjText::kNone ? glm::vec2(0.0f, 1.0f) : m_text.uvs[corner.uv];
}

// areVerticesEqual() of the same file.
bool ObjMeshes::nearlyEqual(const ObjText::Corner& a, const ObjText::Corner& b) const {
    constexpr float kEpsilon = 1e-5f;
    const auto near = [&](const glm::vec3& difference) {
        return dot(difference, difference) <= kEpsilon * kEpsilon;
    };
    return (a.position == b.position ||
            near(m_text.positions[a.position] - m_text.positions[b.position])) &&
           (a.normal == b.normal || near(normal(a) - normal(b))) &&
           (a.uv == b.uv || near(glm::vec3(uv(a) - uv(b), 0.0f)));
}

// Being nearly equal is not transitive, so it matters which vertices a corner is held against and
// in what order: those of its bucket in Assimp's std::unordered_map, the newest first.
std::uint32_t ObjMeshes::vertexOf(const ObjText::Corner& corner) {
    std::uint32_t& newest = m_buckets[m_hashes[corner.position] % m_buckets.size()];
    for (std::uint32_t v = newest; v != ObjText::kNone; v = m_vertices[v].older)
        if (nearlyEqual(corner, m_vertices[v].corner))
            return v;
    m_vertices.push_back({corner, newest});
    return newest = static_cast<std::uint32_t>(m_vertices.size() - 1);
}

// Where the two triangles of a quad meet: at its concave corner, if there is one (Assimp's
// TriangulateProcess.cpp).
int ObjMeshes::firstCornerOfQuad(const ObjText::Corner* corners) const {
    constexpr float kPi = 3.1415926538f; // as Assimp has it
    const auto at = [&](int corner) { return m_text.positions[corners[corner % 4].position]; };
    for (int i = 0; i < 4; ++i) {
        const glm::vec3 left = unit(at(i + 3) - at(i)), diagonal = unit(at(i + 2) - at(i)),
                        right = unit(at(i + 1) - at(i));
        if (std::acos(dot(left, diagonal)) + std::acos(dot(right, diagonal)) > kPi)
            return i;
    }
    return 0;
}

std::size_t ObjMeshes::endOf(std::size_t run) const {
    return run + 1 < m_text.runs.size() ? m_text.runs[run + 1].firstFace
                                        : m_text.cornerCounts.size();
}

std::size_t ObjMeshes::cornerCount(std::span<const std::size_t> runs) const {
    std::size_t count = 0;
    for (const std::size_t run : runs)
        count += (run + 1 < m_text.runs.size() ? m_text.runs[run + 1].firstCorner
                                               : m_text.corners.size()) -
                 m_text.runs[run].firstCorner;
    return count;
}

Mesh ObjMeshes::join(std::span<const std::size_t> runs) {
    // As many buckets as Assimp's table has.
    const std::size_t corners = cornerCount(runs);
    std::unordered_set<int> table;
    table.reserve(corners);
    m_buckets.assign(table.bucket_count(), ObjText::kNone);
    m_vertices.clear();

    Mesh mesh;
    mesh.indices.reserve(corners); // and more where there are quads
    bool normals = false, uvs = false;
    for (const std::size_t run : runs) {
        auto next =
            m_text.corners.begin() + static_cast<std::ptrdiff_t>(m_text.runs[run].firstCorner);
        for (std::size_t face = m_text.runs[run].firstFace; face < endOf(run); ++face) {
            const int count = m_text.cornerCounts[face];
            std::array<ObjText::Corner, 4> of{};
            std::array<std::uint32_t, 4> vertices{};
            for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k, ++next) {
                of[k] = *next;
                vertices[k] = vertexOf(*next);
            }
            normals = normals || of[0].normal != ObjText::kNone;
            uvs = uvs || of[0].uv != ObjText::kNone;
            const int first = count == 4 ? firstCornerOfQuad(of.data()) : 0;
            for (int triangle = 0; triangle < count - 2; ++triangle)
                for (const int k : {first, first + triangle + 1, first + triangle + 2})
                    mesh.indices.push_back(vertices[static_cast<std::size_t>(k % count)]);
        }
    }

    mesh.positions.reserve(m_vertices.size());
    mesh.normals.reserve(normals ? m_vertices.size() : 0);
    mesh.uvs.reserve(uvs ? m_vertices.size() : 0);
    for (const Vertex& vertex : m_vertices) {
        mesh.positions.push_back(m_text.positions[vertex.corner.position]);
        if (normals)
            mesh.normals.push_back(normal(vertex.corner));
        if (uvs)
            mesh.uvs.push_back(uv(vertex.corner));
    }
    return mesh;
}

} // namespace patina::codec
