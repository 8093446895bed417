#include "core/mesh/RefineMesh.h"

#include "core/base/Check.h"
#include "core/mesh/Weld.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <unordered_map>
#include <unordered_set>

namespace patina {
namespace {

std::uint64_t edgeKey(std::uint32_t a, std::uint32_t b) {
    return (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b);
}

class Refiner {
  public:
    Refiner(const Mesh& mesh, float minEdge)
        : m_mesh(mesh)
        , m_welded(weldPositions(mesh.positions))
        , m_minEdge(minEdge) {}

    // Marks the edges to split, by welded vertices.
    void mark(std::span<const std::uint8_t> split) {
        for (std::size_t t = 0; t < split.size(); ++t)
            for (std::size_t e = 0; e < 3 && split[t] != 0; ++e)
                markEdge(t, e);
        // A triangle with a split edge splits its longest too. Each round reaches a longer edge,
        // so this ends.
        for (bool changed = true; changed;) {
            changed = false;
            for (std::size_t t = 0; t < m_mesh.triangleCount(); ++t)
                if (marked(t, 0) || marked(t, 1) || marked(t, 2))
                    changed |= markEdge(t, longestEdge(t));
        }
    }

    Mesh refined() {
        m_result = m_mesh;
        m_result.indices.clear();
        for (std::size_t t = 0; t < m_mesh.triangleCount(); ++t)
            addTriangle(t);
        return std::move(m_result);
    }

  private:
    // Edge e runs from corner e to corner e + 1.
    [[nodiscard]] std::uint32_t corner(std::size_t triangle, std::size_t e) const {
        return m_mesh.indices[3 * triangle + e % 3];
    }
    [[nodiscard]] std::uint64_t key(std::size_t triangle, std::size_t e) const {
        return edgeKey(m_welded[corner(triangle, e)], m_welded[corner(triangle, e + 1)]);
    }
    [[nodiscard]] float length(std::size_t triangle, std::size_t e) const {
        return glm::distance(m_mesh.positions[corner(triangle, e)],
                             m_mesh.positions[corner(triangle, e + 1)]);
    }
    [[nodiscard]] bool marked(std::size_t triangle, std::size_t e) const {
        return m_marked.contains(key(triangle, e));
    }
    bool markEdge(std::size_t triangle, std::size_t e) {
        const float own = length(triangle, e);
        return own > 0.0f && own >= m_minEdge && m_marked.insert(key(triangle, e)).second;
    }
    // Of edges of one length that of the smallest key, so that neighbours agree.
    [[nodiscard]] std::size_t longestEdge(std::size_t triangle) const {
        std::size_t best = 0;
        for (std::size_t e = 1; e < 3; ++e) {
            const float own = length(triangle, e), longest = length(triangle, best);
            if (own > longest || (own == longest && key(triangle, e) < key(triangle, best)))
                best = e;
        }
        return best;
    }

    // The vertex in the middle of two; the same for both orders.
    std::uint32_t middle(std::uint32_t a, std::uint32_t b) {
        const auto [entry, isNew] = m_middles.try_emplace(
            edgeKey(a, b), static_cast<std::uint32_t>(m_result.positions.size()));
        if (!isNew)
            return entry->second;
        const Mesh& mesh = m_mesh;
        m_result.positions.push_back(0.5f * mesh.positions[a] + 0.5f * mesh.positions[b]);
        const glm::vec3 normal = mesh.normals[a] + mesh.normals[b];
        m_result.normals.push_back(glm::dot(normal, normal) > 1e-12f ? glm::normalize(normal)
                                                                     : mesh.normals[a]);
        if (!mesh.uvs.empty())
            m_result.uvs.push_back(0.5f * mesh.uvs[a] + 0.5f * mesh.uvs[b]);
        if (!mesh.tangents.empty()) {
            // Perpendicular to the normal again.
            const glm::vec3& n = m_result.normals.back();
            glm::vec3 tangent(mesh.tangents[a] + mesh.tangents[b]);
            tangent -= n * glm::dot(n, tangent);
            m_result.tangents.push_back(glm::dot(tangent, tangent) > 1e-12f
                                            ? glm::vec4(glm::normalize(tangent), mesh.tangents[a].w)
                                            : mesh.tangents[a]);
        }
        return entry->second;
    }

    void addTriangle(std::size_t t) {
        const auto add = [this](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            m_result.indices.insert(m_result.indices.end(), {a, b, c});
        };
        const bool split[3] = {marked(t, 0), marked(t, 1), marked(t, 2)};
        if (!split[0] && !split[1] && !split[2]) {
            add(corner(t, 0), corner(t, 1), corner(t, 2));
            return;
        }
        // From the longest edge a b on, which is split where any is; c is opposite.
        const std::size_t first = longestEdge(t);
        CHECK(split[first]);
        const std::uint32_t a = corner(t, first), b = corner(t, first + 1),
                            c = corner(t, first + 2);
        const std::uint32_t ab = middle(a, b);
        // Halves a ab c and ab b c, each split again at its side of the triangle.
        if (split[(first + 2) % 3]) {
            const std::uint32_t ca = middle(c, a);
            add(a, ab, ca);
            add(ca, ab, c);
        } else {
            add(a, ab, c);
        }
        if (split[(first + 1) % 3]) {
            const std::uint32_t bc = middle(b, c);
            add(ab, b, bc);
            add(ab, bc, c);
        } else {
            add(ab, b, c);
        }
    }

    const Mesh& m_mesh;
    std::vector<std::uint32_t> m_welded;
    float m_minEdge;
    std::unordered_set<std::uint64_t> m_marked;
    std::unordered_map<std::uint64_t, std::uint32_t> m_middles; // by the mesh's own vertices
    Mesh m_result;
};

} // namespace

Mesh refineMesh(const Mesh& mesh, std::span<const std::uint8_t> split, float minEdge) {
    CHECK_EQ(split.size(), mesh.triangleCount());
    Refiner refiner(mesh, minEdge);
    refiner.mark(split);
    return refiner.refined();
}

} // namespace patina
