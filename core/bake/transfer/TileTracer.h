// Traces the rays of a tile of neighbours where they are needed: those of its rim, and of the
// points in between in the directions that the rim disagrees about.
#pragma once

#include "core/bake/domain/HemisphereSamples.h"
#include "core/bake/transfer/OpenTransfer.h"
#include "core/bake/transfer/Passes.h"
#include "core/bake/transfer/RangeTracer.h"
#include "core/bake/transfer/VisibilityTiles.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace patina {

// Belongs to one thread. What it finds depends on the tile and the batch alone.
class TileTracer {
  public:
    TileTracer(const RayScene& scene, std::span<const BakePoint> points,
               const PassSettings& settings, const JobContext& job);

    // Means of a tile of core/bake/transfer/VisibilityTiles.h, in its order; the number of rays
    // that were traced. In every eighth direction all points are, which tells whether those in
    // between do as the rim does: one that does not, and all of this tile are traced. Nothing when
    // cancelled.
    [[nodiscard]] std::optional<std::size_t> trace(std::span<const std::uint32_t> tile,
                                                   std::uint32_t seed,
                                                   const HemisphereSamples& samples,
                                                   RangeMeans& means);

  private:
    void add(std::size_t direction, std::size_t element);
    void flush();
    void sum(std::span<const std::uint32_t> tile, RangeMeans& means);
    // The rim's answer in a direction: free, hidden or divided.
    [[nodiscard]] std::uint8_t rimSees(std::size_t direction) const;

    const RayScene& m_scene;
    std::span<const BakePoint> m_points;
    const PassSettings& m_settings;
    const JobContext& m_job;
    OpenTransfer m_open;
    float m_maxDistance;
    // Of the tile in work.
    std::span<const glm::vec3> m_directions; // around +z
    std::vector<glm::vec3> m_origins;
    std::vector<glm::mat3> m_frames;
    std::vector<std::uint8_t> m_isRim;
    std::vector<std::uint8_t> m_hidden; // by direction and element
    std::vector<OcclusionRay> m_rays;
    std::vector<std::uint32_t> m_answers; // where in m_hidden each ray's answer goes
    std::size_t m_traced = 0;
    std::vector<glm::vec3> m_scratch, m_sorted;
};

} // namespace patina
