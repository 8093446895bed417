// Traces one batch of rays per point and sums up what they find: the inner loop of every bake.
#pragma once

#include "core/bake/HemisphereSamples.h"
#include "core/bake/Passes.h"

#include <cstdint>
#include <span>
#include <vector>

namespace patina {

// Means over a batch of rays, for some points.
struct RangeMeans {
    std::vector<float> values;    // stride per point
    std::vector<float> hiddenSky; // 1 per point
};

// Belongs to one thread. What it finds for a point does not depend on which points come with it.
class RangeTracer {
  public:
    RangeTracer(const RayScene& scene, std::span<const BakePoint> points,
                const PassSettings& settings, const JobContext& job);

    // The rays of `samples` from the points `elements`; false when interrupted: by a cancel, and
    // where `mayStop` by a stop.
    [[nodiscard]] bool trace(std::span<const std::uint32_t> elements,
                             const HemisphereSamples& samples, bool mayStop, RangeMeans& means);

  private:
    void collect(std::size_t slot, std::span<const OcclusionRay> rays, RangeMeans& means);

    const RayScene& m_scene;
    std::span<const BakePoint> m_points;
    const PassSettings& m_settings;
    const JobContext& m_job;
    std::vector<OcclusionRay> m_rays;
    std::vector<glm::vec3> m_open, m_scratch;
};

} // namespace patina
