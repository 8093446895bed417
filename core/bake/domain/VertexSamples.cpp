#include "core/bake/domain/VertexSamples.h"

#include "core/math/Sampling.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace patina {
namespace {

constexpr double kMaxPerTriangle = 256.0;

double triangleArea(const BakeGeometryMesh& mesh, std::size_t triangle) {
    const std::uint32_t* index = mesh.mesh->indices.data() + 3 * triangle;
    const glm::dvec3 a(mesh.positions[index[0]]), b(mesh.positions[index[1]]),
        c(mesh.positions[index[2]]);
    return 0.5 * glm::length(glm::cross(b - a, c - a));
}

} // namespace

std::size_t VertexSamples::meshOf(std::size_t vertexPoint) const {
    return static_cast<std::size_t>(
               std::upper_bound(firstOfMesh.begin(), firstOfMesh.end(), vertexPoint) -
               firstOfMesh.begin()) -
           1;
}

VertexSamples vertexSamples(const BakeGeometry& geometry, const JobContext& job) {
    VertexSamples samples;
    samples.points = vertexPoints(geometry, job);
    samples.ranges = vertexRanges(geometry, rangeSize(geometry.vertexCount()));
    samples.firstOfMesh.push_back(0);
    for (const BakeGeometryMesh& mesh : geometry.meshes)
        samples.firstOfMesh.push_back(samples.firstOfMesh.back() + mesh.positions.size());
    return samples;
}

VertexSamples fittedVertexSamples(const BakeGeometry& geometry, const JobContext& job) {
    VertexSamples samples = vertexSamples(geometry, job);
    double area = 0.0;
    std::size_t triangles = 0;
    for (const BakeGeometryMesh& mesh : geometry.meshes)
        for (std::size_t t = 0; t < mesh.mesh->triangleCount(); ++t)
            if (const double own = triangleArea(mesh, t); own > 0.0) {
                area += own;
                ++triangles;
            }
    if (triangles == 0 || job.cancelled())
        return samples;

    // Systematic sampling: a triangle due 0.3 points gets one where the running sum passes a
    // whole number.
    const auto wanted = static_cast<double>(std::max(samples.vertexCount(), kMinTrianglePoints));
    double due = 0.5;
    for (std::uint32_t m = 0; m < geometry.meshes.size(); ++m) {
        const BakeGeometryMesh& mesh = geometry.meshes[m];
        for (std::uint32_t t = 0; t < mesh.mesh->triangleCount(); ++t) {
            if (t % 65536 == 0 && job.cancelled())
                return samples;
            const double own = triangleArea(mesh, t);
            if (!(own > 0.0))
                continue;
            const double before = std::floor(due);
            due += std::min(0.5 * wanted * (1.0 / static_cast<double>(triangles) + own / area),
                            kMaxPerTriangle);
            const auto count = static_cast<std::uint32_t>(std::floor(due) - before);
            for (std::uint32_t i = 0; i < count; ++i) {
                // Owen-scrambled points of the unit square, folded into the triangle.
                glm::vec2 b = sobolOwen2D(i, seedFor(m, t));
                if (b.x + b.y > 1.0f)
                    b = glm::vec2(1.0f) - b;
                samples.onTriangles.push_back({m, t, b.x, b.y});
                samples.points.push_back(surfacePoint(mesh, t, b.x, b.y));
            }
        }
    }
    const std::size_t size = rangeSize(samples.points.size());
    samples.ranges = vertexRanges(geometry, size);
    for (std::size_t first = 0, end = 0; first < samples.onTriangles.size(); first = end) {
        while (end < samples.onTriangles.size() && end < first + size &&
               samples.onTriangles[end].mesh == samples.onTriangles[first].mesh)
            ++end;
        samples.ranges.push_back({samples.vertexCount() + first, end - first});
    }
    return samples;
}

} // namespace patina
