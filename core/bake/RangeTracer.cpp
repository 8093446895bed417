#include "core/bake/RangeTracer.h"

#include "core/base/Check.h"
#include "core/math/SphericalHarmonics.h"

#include <algorithm>
#include <limits>

namespace patina {
namespace {
constexpr std::size_t kStream = 1024; // rays per call: the fastest length that stays in the cache
} // namespace

RangeTracer::RangeTracer(const RayScene& scene, std::span<const BakePoint> points,
                         const PassSettings& settings, const JobContext& job)
    : m_scene(scene)
    , m_points(points)
    , m_settings(settings)
    , m_job(job)
    , m_rays(kStream)
    , m_open(kStream) {}

bool RangeTracer::trace(std::span<const std::uint32_t> elements, const HemisphereSamples& samples,
                        bool mayStop, RangeMeans& means) {
    const auto stride = static_cast<std::size_t>(m_settings.stride());
    means.values.assign(elements.size() * stride, 0.0f);
    means.hiddenSky.assign(elements.size(), 0.0f);
    const float maxDistance = m_settings.maxDistance > 0.0f
                                  ? m_settings.maxDistance
                                  : std::numeric_limits<float>::infinity();

    // A stream holds whole points, or a piece of one: sums then add up in the same order whatever
    // points come along.
    const std::size_t rayCount = samples.count();
    const std::size_t piece = std::min(rayCount, kStream);
    const std::size_t together = kStream / piece;
    for (std::size_t first = 0; first < elements.size(); first += together) {
        const std::size_t end = std::min(first + together, elements.size());
        for (std::size_t begin = 0; begin < rayCount; begin += piece) {
            if (m_job.cancelled() || (mayStop && m_job.stopping()))
                return false;
            const std::size_t length = std::min(piece, rayCount - begin);
            std::size_t filled = 0;
            for (std::size_t slot = first; slot < end; ++slot) {
                const BakePoint& point = m_points[elements[slot]];
                const std::uint32_t seed = seedFor(m_settings.seed, elements[slot]);
                const glm::mat3 frame = HemisphereSamples::frame(point.normal, seed);
                for (const glm::vec3& local :
                     samples.directions(seed, m_scratch).subspan(begin, length)) {
                    OcclusionRay& ray = m_rays[filled++];
                    ray.origin = point.origin;
                    ray.minDistance = 0.0f;
                    ray.direction = frame * local;
                    ray.maxDistance = maxDistance;
                }
            }
            const std::span<OcclusionRay> rays(m_rays.data(), filled);
            // Points and normals are finite and unit by construction (core/bake/BakeGeometry.h).
            CHECK_EQ(m_scene.occlude(rays), std::size_t{0});
            for (std::size_t slot = first; slot < end; ++slot)
                collect(slot, rays.subspan((slot - first) * length, length), means);
        }
    }

    const float scale = 1.0f / static_cast<float>(rayCount);
    for (float& value : means.values)
        value *= scale;
    for (float& value : means.hiddenSky)
        value *= scale;
    return true;
}

// V Y_i(ω): with rays of density cos / pi the mean of it is ∫ V cos Y_i / pi dω.
void RangeTracer::collect(std::size_t slot, std::span<const OcclusionRay> rays, RangeMeans& means) {
    std::size_t open = 0, hiddenSky = 0;
    for (const OcclusionRay& ray : rays) {
        m_open[open] = ray.direction;
        open += ray.occluded() ? 0 : 1;
        hiddenSky += ray.occluded() && ray.direction.y > 0.0f ? 1 : 0;
    }
    means.hiddenSky[slot] += static_cast<float>(hiddenSky);
    if (m_settings.shOrder == 0)
        means.values[slot] += static_cast<float>(open);
    else
        sumSh(m_settings.shOrder, {m_open.data(), open},
              std::span(means.values)
                  .subspan(slot * static_cast<std::size_t>(m_settings.stride()),
                           static_cast<std::size_t>(m_settings.stride())));
}

} // namespace patina
