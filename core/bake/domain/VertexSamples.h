// Where the rays of a bake per vertex start: at the vertices, and for values that are fitted also
// at points all over the triangles.
#pragma once

#include "core/bake/domain/BakePoints.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace patina {

// A point of a triangle by the barycentric coordinates of its corners 1 and 2.
struct TrianglePoint {
    std::uint32_t mesh = 0, triangle = 0;
    float b1 = 0.0f, b2 = 0.0f;
};

struct VertexSamples {
    std::vector<BakePoint> points;        // of all vertices, mesh after mesh, then of `onTriangles`
    std::vector<PointRange> ranges;       // of points, none over vertices and triangles at once
    std::vector<std::size_t> firstOfMesh; // first vertex of each mesh; at the end their number
    std::vector<TrianglePoint> onTriangles; // by mesh and triangle

    [[nodiscard]] std::size_t vertexCount() const { return firstOfMesh.back(); }
    [[nodiscard]] std::size_t meshOf(std::size_t vertexPoint) const;
};

// Points on triangles are at least this many where values are fitted, else as many as vertices.
inline constexpr std::size_t kMinTrianglePoints = 8192;

[[nodiscard]] VertexSamples vertexSamples(const BakeGeometry& geometry, const JobContext& job);

// And about as many points on the triangles as there are vertices, at least 8192: half of them
// evenly over the triangles, half by area, at most 256 on one. Depends on the geometry only.
[[nodiscard]] VertexSamples fittedVertexSamples(const BakeGeometry& geometry,
                                                const JobContext& job);

} // namespace patina
