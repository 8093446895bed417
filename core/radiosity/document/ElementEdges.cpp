#include "core/radiosity/document/ElementEdges.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

namespace patina {

using namespace radiosity;

double ElementEdge::length() const {
    return glm::length(ends[1] - ends[0]);
}

std::vector<ElementEdge> openEdges(const LitMesh& mesh, const TraceScene& scene) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
    const auto keyOf = [&](const LitMesh::Triangle& triangle, std::size_t k) {
        const std::uint32_t a = mesh.vertices[triangle.vertices[k]].light,
                            b = mesh.vertices[triangle.vertices[(k + 1) % 3]].light;
        return std::pair(std::min(a, b), std::max(a, b));
    };
    for (const LitMesh::Triangle& triangle : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k)
            ++uses[keyOf(triangle, k)];
    std::vector<ElementEdge> edges;
    for (const LitMesh::Triangle& triangle : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            if (uses.at(keyOf(triangle, k)) != 1)
                continue;
            const auto at = [&](std::size_t i) {
                return glm::dvec3(scene.toScene(
                    glm::dvec3(mesh.vertices[triangle.vertices[(k + i) % 3]].position)));
            };
            ElementEdge edge;
            edge.element = triangle.element;
            edge.ends = {at(0), at(1)};
            edge.lights = {mesh.vertices[triangle.vertices[k]].light,
                           mesh.vertices[triangle.vertices[(k + 1) % 3]].light};
            const glm::dvec3 along = edge.ends[1] - edge.ends[0];
            const double length = glm::length(along);
            if (!(length > 10.0 * double{kRayOffset}))
                continue;
            // Towards the inside, less what lies along the edge.
            const glm::dvec3 inside = at(2) - edge.ends[0];
            const glm::dvec3 away = glm::dot(inside, along) / (length * length) * along - inside;
            if (!(glm::length(away) > double{kRayOffset}))
                continue; // a triangle of no area
            edge.outward = glm::normalize(away);
            edges.push_back(edge);
        }
    return edges;
}

} // namespace patina
