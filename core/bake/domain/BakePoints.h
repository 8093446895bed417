// Where the rays of a bake start: at vertices, at points of triangles, or at the texels of a
// material's UV layout. Starting points are lifted off the surface so that no ray meets the
// triangle it leaves.
#pragma once

#include "core/base/Id.h"
#include "core/trace/BakeGeometry.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace patina {

// Where rays start and the middle of the hemisphere they fill.
struct BakePoint {
    glm::vec3 origin; // scene units, already lifted off the surface
    glm::vec3 normal; // unit
};

// Points that are computed and reported together.
struct PointRange {
    std::size_t first = 0, count = 0;
};

// A good number of points per range: enough for neighbours to travel together, few enough for all
// cores to share the work and for a picture that grows evenly.
[[nodiscard]] std::size_t rangeSize(std::size_t pointCount);

// One point per vertex of every mesh, mesh after mesh. A point is lifted along the vertex normal by
// kRayOffset and moved as far towards the middle of the triangles that use the vertex: where a
// floor ends at a wall of another mesh, its last vertices then stand before the wall, not in it.
[[nodiscard]] std::vector<BakePoint> vertexPoints(const BakeGeometry& geometry,
                                                  const JobContext& job);

// Ranges of at most `size` points that never span two meshes.
[[nodiscard]] std::vector<PointRange> vertexRanges(const BakeGeometry& geometry, std::size_t size);

// A starting point on the smooth surface that the normals suggest, by the barycentric coordinates
// of corners 1 and 2: Hanika 2021, "Hacking the Shadow Terminator" (Ray Tracing Gems II, chapter
// 4). On flat and hollow surfaces it is the triangle's point; on bulging ones it is lifted, so that
// a coarse mesh does not shadow itself.
[[nodiscard]] BakePoint surfacePoint(const BakeGeometryMesh& mesh, std::uint32_t triangle, float b1,
                                     float b2);

// The texels of one material's size × size texture. UVs outside 0…1 wrap around as they do on the
// surface. A texel whose centre no triangle covers but that one touches takes the nearest point.
struct TexelPoints {
    std::vector<std::uint32_t> texels;     // y * size + x, ascending, each once
    std::vector<std::uint32_t> firstPoint; // per texel its first point; one more entry at the end
    std::vector<BakePoint> points;
    std::size_t sharedTexels = 0;     // covered by several triangles (overlapping or tiled UVs)
    std::size_t skippedTriangles = 0; // that repeat the texture more than 8 times
};

// Where a point lies on its mesh.
struct SurfacePlace {
    std::uint32_t mesh = 0, triangle = 0; // of the geometry, of the mesh
    float b1 = 0.0f, b2 = 0.0f;           // barycentric coordinates of corners 1 and 2
};

// At most this many points are kept for a texel that several triangles cover.
inline constexpr int kMaxPointsPerTexel = 4;

// `places`: filled with those of the points.
[[nodiscard]] TexelPoints texelPoints(const BakeGeometry& geometry, Id material, int size,
                                      const JobContext& job,
                                      std::vector<SurfacePlace>* places = nullptr);

} // namespace patina
