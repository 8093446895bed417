#include "core/mesh/BoxProjection.h"

#include "core/mesh/SplitVertices.h"
#include "core/mesh/TriangleGeometry.h"

namespace patina {

void boxProjectUvs(Mesh& mesh, std::vector<std::uint32_t>* origin) {
    // The axis of a triangle: x, y, z and which way it looks.
    std::vector<std::uint32_t> axes(mesh.triangleCount());
    for (std::size_t t = 0; t < axes.size(); ++t) {
        const glm::dvec3 n = areaVector(mesh, t);
        int axis = 0;
        for (int candidate = 1; candidate < 3; ++candidate)
            if (std::abs(n[candidate]) > std::abs(n[axis]))
                axis = candidate;
        axes[t] = static_cast<std::uint32_t>(2 * axis + (n[axis] < 0.0 ? 1 : 0));
    }
    const std::vector<std::uint32_t> axisOfVertex = splitVertices(mesh, axes, origin);

    // One scale for all axes, so that the texel density is uniform; a margin around each cell.
    const Bounds bounds = mesh.bounds();
    const glm::dvec3 low(bounds.min);
    const glm::dvec3 extent = glm::dvec3(bounds.max) - low;
    const double side = std::max({extent.x, extent.y, extent.z, 1e-300});
    constexpr double kMargin = 0.01;
    mesh.uvs.resize(mesh.vertexCount());
    for (std::size_t i = 0; i < mesh.uvs.size(); ++i) {
        const std::uint32_t label = axisOfVertex[i];
        const bool negative = label % 2 != 0;
        const glm::dvec3 p = (glm::dvec3(mesh.positions[i]) - low) / side;
        // Seen from outside: right and down in the image, so that nothing is mirrored.
        double right = 0.0, down = 0.0;
        switch (label / 2) {
        case 0:
            right = negative ? p.z : 1.0 - p.z;
            down = 1.0 - p.y;
            break;
        case 1:
            right = p.x;
            down = negative ? 1.0 - p.z : p.z;
            break;
        default:
            right = negative ? 1.0 - p.x : p.x;
            down = 1.0 - p.y;
            break;
        }
        const double cellX = label / 2, cellY = negative ? 1.0 : 0.0;
        mesh.uvs[i] = glm::vec2((cellX + kMargin + (1.0 - 2.0 * kMargin) * right) / 3.0,
                                (cellY + kMargin + (1.0 - 2.0 * kMargin) * down) / 3.0);
    }
}

} // namespace patina
