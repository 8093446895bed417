#include "core/radiosity/document/RadiositySurfaces.h"

#include <memory>
#include <utility>

namespace patina {

using namespace radiosity;

std::vector<RadiositySurface> radiositySurfaces(const LitMesh& mesh, const ElementMesh& elements,
                                                const BakeGeometry& geometry, Corners corners) {
    constexpr std::size_t kNoSurface = ~std::size_t{0};
    std::vector<RadiositySurface> surfaces;
    std::vector<std::unique_ptr<Mesh>> meshes;
    // Of each vertex of `mesh`: its number in the surface's mesh, and the element it was added for.
    std::vector<std::uint32_t> numbers(mesh.vertices.size(), kNone), owners = numbers;
    std::vector<std::size_t> surfaceOf(2 * geometry.meshes.size(), kNoSurface);
    for (const LitMesh::Triangle& triangle : mesh.triangles) {
        const Face& face = elements.face(triangle.element);
        std::size_t& index = surfaceOf[2 * face.mesh + (face.back ? 1 : 0)];
        if (index == kNoSurface) {
            index = surfaces.size();
            surfaces.push_back({geometry.meshes[face.mesh].id, face.back, nullptr, {}, {}});
            meshes.push_back(std::make_unique<Mesh>());
        }
        RadiositySurface& surface = surfaces[index];
        Mesh& to = *meshes[index];
        for (const std::uint32_t v : triangle.vertices) {
            const bool known = numbers[v] != kNone &&
                               (corners == Corners::Shared || owners[v] == triangle.element);
            if (!known) {
                const LitMesh::Vertex& vertex = mesh.vertices[v];
                numbers[v] = static_cast<std::uint32_t>(to.positions.size());
                owners[v] = triangle.element;
                to.positions.push_back(vertex.position);
                to.normals.push_back(vertex.normal);
                to.uvs.push_back(vertex.uv);
                surface.lights.push_back(vertex.light);
                surface.elements.push_back(triangle.element);
            }
            to.indices.push_back(numbers[v]);
        }
    }
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        computeTangents(*meshes[i]);
        surfaces[i].mesh = std::move(meshes[i]);
    }
    return surfaces;
}

} // namespace patina
