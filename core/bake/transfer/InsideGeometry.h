// Vertices that lie within a solid: no light ever reaches them, which is hardly what was meant.
#pragma once

#include "core/bake/transfer/Passes.h"
#include "core/trace/BakeGeometry.h"
#include "core/trace/RayScene.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace patina {

// Per mesh of the geometry the number of its vertices that lie within a solid. `points` of all
// vertices, mesh after mesh; `visibility`: the share of each one's rays that got out.
//
// A vertex counts when hardly a ray gets out and, of 32 to all sides, nearly all leave one and the
// same mesh (meet its back once more than its front): closed meshes have an inside, open ones and
// those of two-sided materials do not. Backs are where the vertex normals point away from,
// whichever way triangles are wound. Things that touch lie outside of each other: other meshes are
// looked for from slightly within the vertex' own surface. After a cancel the result is not
// complete.
[[nodiscard]] std::vector<std::size_t> countVerticesInside(const BakeGeometry& geometry,
                                                           const RayScene& scene,
                                                           std::span<const BakePoint> points,
                                                           std::span<const float> visibility,
                                                           const JobContext& job);

// Whether some vertices of one mesh lie within a solid, whatever they see: a number for each of
// `which`, 1 or 0. `points` of all vertices of that mesh. After a cancel the rest is 0.
[[nodiscard]] std::vector<std::uint8_t> verticesInside(const BakeGeometry& geometry,
                                                       const RayScene& scene, std::uint32_t mesh,
                                                       std::span<const BakePoint> points,
                                                       std::span<const std::uint32_t> which,
                                                       const JobContext& job);

// "“Ball”: 38 of 482 vertices lie inside …" for the user; empty where none does.
[[nodiscard]] std::string insideNote(const BakeGeometry& geometry,
                                     std::span<const std::size_t> inside);

} // namespace patina
