#include "core/bake/domain/BakePoints.h"

#include <algorithm>
#include <bit>
#include <glm/geometric.hpp>

namespace patina {
namespace {

glm::vec3 faceVector(const BakeGeometryMesh& mesh, const std::uint32_t* index) {
    const glm::dvec3 a(mesh.positions[index[0]]), b(mesh.positions[index[1]]),
        c(mesh.positions[index[2]]);
    const glm::dvec3 cross = glm::cross(b - a, c - a) * static_cast<double>(mesh.winding);
    const double length = glm::length(cross);
    return length > 0.0 ? glm::vec3(cross / length) : glm::vec3(0.0f);
}

// Along the surface towards the middle of each vertex's triangles, at most kRayOffset long.
std::vector<glm::vec3> insets(const BakeGeometryMesh& mesh) {
    const std::vector<std::uint32_t>& indices = mesh.mesh->indices;
    std::vector<glm::vec3> inset(mesh.positions.size(), glm::vec3(0.0f));
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        const glm::vec3 centre = (mesh.positions[indices[i]] + mesh.positions[indices[i + 1]] +
                                  mesh.positions[indices[i + 2]]) /
                                 3.0f;
        for (std::size_t corner = 0; corner < 3; ++corner)
            inset[indices[i + corner]] += centre - mesh.positions[indices[i + corner]];
    }
    for (std::size_t v = 0; v < inset.size(); ++v) {
        inset[v] -= mesh.normals[v] * glm::dot(mesh.normals[v], inset[v]);
        const float length = glm::length(inset[v]);
        if (length > kRayOffset)
            inset[v] *= kRayOffset / length;
    }
    // Never behind a triangle that the lifted point itself is in front of.
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        const glm::vec3 face = faceVector(mesh, indices.data() + i);
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t v = indices[i + corner];
            const float lift = kRayOffset * glm::dot(face, mesh.normals[v]);
            if (lift > 0.0f && lift + glm::dot(face, inset[v]) < 0.25f * lift)
                inset[v] = glm::vec3(0.0f);
        }
    }
    return inset;
}

} // namespace

std::vector<BakePoint> vertexPoints(const BakeGeometry& geometry, const JobContext& job) {
    std::vector<BakePoint> points;
    points.reserve(geometry.vertexCount());
    for (const BakeGeometryMesh& mesh : geometry.meshes) {
        if (job.cancelled())
            break;
        const std::vector<glm::vec3> inset = insets(mesh);
        for (std::size_t v = 0; v < mesh.positions.size(); ++v)
            points.push_back(
                {mesh.positions[v] + kRayOffset * mesh.normals[v] + inset[v], mesh.normals[v]});
    }
    return points;
}

std::size_t rangeSize(std::size_t pointCount) {
    return std::clamp<std::size_t>(std::bit_ceil(pointCount / 256), 64, 2048);
}

std::vector<PointRange> vertexRanges(const BakeGeometry& geometry, std::size_t size) {
    std::vector<PointRange> ranges;
    std::size_t first = 0;
    for (const BakeGeometryMesh& mesh : geometry.meshes) {
        const std::size_t end = first + mesh.positions.size();
        for (; first < end; first += ranges.back().count)
            ranges.push_back({first, std::min(size, end - first)});
    }
    return ranges;
}

} // namespace patina
