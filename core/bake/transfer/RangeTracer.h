// Traces one batch of rays per point and sums up what they find: the inner loop of every bake.
#pragma once

#include "core/bake/domain/HemisphereSamples.h"
#include "core/bake/transfer/OpenTransfer.h"
#include "core/bake/transfer/Passes.h"

#include <cstdint>
#include <span>
#include <vector>

namespace patina {

// A point of a range, and the seed of its directions.
struct RangeElement {
    std::uint32_t point = 0, seed = 0;
};

// The points of a range along a Z-curve, so that neighbours follow each other; `cluster` of them
// share a seed. Depends on the points of the range alone, and on the index of the first of `points`
// among those of the whole bake.
void orderRange(std::span<const BakePoint> points, const PointRange& range, int cluster,
                std::uint32_t seed, std::vector<RangeElement>& order, std::uint32_t firstPoint = 0);

// Means over a batch of rays, for some elements.
struct RangeMeans {
    std::vector<float> values;    // stride per element
    std::vector<float> hiddenSky; // 1 per element
};

// Belongs to one thread. What it finds for a point does not depend on which points come with it.
class RangeTracer {
  public:
    RangeTracer(const RayScene& scene, std::span<const BakePoint> points,
                const PassSettings& settings, int cluster, const JobContext& job);

    // The rays of `samples` from `elements`, in the order of orderRange(). False when interrupted:
    // by a cancel, and where `mayStop` by a stop.
    [[nodiscard]] bool trace(std::span<const RangeElement> elements,
                             const HemisphereSamples& samples, bool mayStop, RangeMeans& means);

  private:
    // Rays of one stream: directions `begin` … `end` of the elements `first` … `last`, direction
    // after direction.
    struct Block {
        std::size_t first, last, begin, end, ray;
    };
    struct Start {
        glm::vec3 origin;
        glm::mat3 frame;
    };
    struct Sides { // numbers of an element's directions
        std::uint32_t open = 0, hidden = 0, hiddenSky = 0;
    };

    void addBlock(const Block& block, std::span<const RangeElement> elements,
                  const HemisphereSamples& samples);
    void flush(RangeMeans& means);
    void collect(const Block& block, RangeMeans& means);

    const RayScene& m_scene;
    std::span<const BakePoint> m_points;
    const PassSettings& m_settings;
    std::size_t m_cluster;
    const JobContext& m_job;
    float m_maxDistance;
    std::vector<OcclusionRay> m_rays;
    std::size_t m_filled = 0;
    std::vector<Block> m_blocks;
    std::vector<Start> m_starts; // of the block's elements
    std::vector<Sides> m_sides;
    std::vector<std::uint8_t> m_sumsHidden; // per element: its sum is of hidden directions
    std::vector<glm::vec3> m_sorted, m_scratch;
    OpenTransfer m_open;
};

} // namespace patina
