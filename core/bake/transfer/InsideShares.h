// Shares of light at vertices that lie within a solid, where none arrives although their triangles
// reach out of it: a floor would be dark beside a box that stands on it, where it is lit.
#pragma once

#include "core/bake/domain/BakePoints.h"
#include "core/trace/BakeScene.h"

#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

namespace patina {

// Knows of a mesh which vertices lie within a solid, as far as it was asked. Callable from any
// thread.
class InsideShares {
  public:
    // `mesh`: index into the geometry, whose vertices' `points` must live as long.
    InsideShares(const BakeScene& scene, std::uint32_t mesh, std::span<const BakePoint> points);

    // Vertices without light within a solid take the mean of those across an edge that are not,
    // where some light arrives there. After a cancel shares may be as they were.
    void mend(std::span<float> shares, const JobContext& job) const;

  private:
    void ask(const std::vector<std::uint32_t>& vertices, const JobContext& job) const;

    const BakeScene& m_scene;
    std::uint32_t m_mesh;
    std::span<const BakePoint> m_points;
    enum : std::uint8_t { kUnknown, kOutside, kInside };
    mutable std::mutex m_mutex;
    mutable std::vector<std::uint8_t> m_known; // of each vertex
};

} // namespace patina
