#include "core/bake/transfer/RangeTracer.h"

#include "core/base/Check.h"
#include "core/math/SphericalHarmonics.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace patina {
namespace {

constexpr std::size_t kStream = 2048; // rays per call: more gain nothing (measured)

// The ten lowest bits of x, with two zeros after each.
constexpr std::uint32_t spreadBits(std::uint32_t x) {
    x = (x | (x << 16)) & 0x030000ffu;
    x = (x | (x << 8)) & 0x0300f00fu;
    x = (x | (x << 4)) & 0x030c30c3u;
    return (x | (x << 2)) & 0x09249249u;
}

// By 30 bits, ten at a time; equal ones keep their order.
void sortBySeed(std::vector<RangeElement>& elements) {
    std::vector<RangeElement> sorted(elements.size());
    for (int shift = 0; shift < 30; shift += 10) {
        std::array<std::uint32_t, 1025> begin{};
        const auto digit = [shift](const RangeElement& e) { return (e.seed >> shift) & 1023u; };
        for (const RangeElement& element : elements)
            ++begin[digit(element) + 1];
        std::partial_sum(begin.begin(), begin.end(), begin.begin());
        for (const RangeElement& element : elements)
            sorted[begin[digit(element)]++] = element;
        elements.swap(sorted);
    }
}

} // namespace

void orderRange(std::span<const BakePoint> points, const PointRange& range, int cluster,
                std::uint32_t seed, std::vector<RangeElement>& order, std::uint32_t firstPoint) {
    const std::span<const BakePoint> own = points.subspan(range.first, range.count);
    glm::vec3 low(std::numeric_limits<float>::max()), high(std::numeric_limits<float>::lowest());
    for (const BakePoint& point : own) {
        low = glm::min(low, point.origin);
        high = glm::max(high, point.origin);
    }
    const float extent = std::max({high.x - low.x, high.y - low.y, high.z - low.z, 1e-20f});
    order.resize(range.count);
    for (std::size_t i = 0; i < own.size(); ++i) {
        const glm::uvec3 cell((own[i].origin - low) * (1023.0f / extent));
        order[i] = {static_cast<std::uint32_t>(range.first + i),
                    spreadBits(cell.x) | (spreadBits(cell.y) << 1) | (spreadBits(cell.z) << 2)};
    }
    sortBySeed(order); // still the place on the curve
    const auto size = static_cast<std::size_t>(cluster);
    for (std::size_t i = 0; i < order.size(); ++i)
        order[i].seed =
            i % size == 0 ? seedFor(seed, firstPoint + order[i].point) : order[i - 1].seed;
}

RangeTracer::RangeTracer(const RayScene& scene, std::span<const BakePoint> points,
                         const PassSettings& settings, int cluster, const JobContext& job)
    : m_scene(scene)
    , m_points(points)
    , m_settings(settings)
    , m_cluster(static_cast<std::size_t>(cluster))
    , m_job(job)
    , m_maxDistance(settings.maxDistance > 0.0f ? settings.maxDistance
                                                : std::numeric_limits<float>::infinity())
    , m_rays(kStream)
    , m_sorted(kStream)
    , m_open(settings.shOrder) {
    CHECK(cluster >= 1 && m_cluster <= kStream);
}

bool RangeTracer::trace(std::span<const RangeElement> elements, const HemisphereSamples& samples,
                        bool mayStop, RangeMeans& means) {
    const auto stride = static_cast<std::size_t>(m_settings.stride());
    means.values.assign(elements.size() * stride, 0.0f);
    means.hiddenSky.assign(elements.size(), 0.0f);
    m_sumsHidden.assign(elements.size(), 0);
    m_filled = 0; // an interrupted batch may have left some
    m_blocks.clear();

    // A block has the same directions whatever elements come along, so that sums add up in the same
    // order.
    const std::size_t rayCount = samples.count();
    const std::size_t piece = std::min(rayCount, kStream / m_cluster);
    for (std::size_t first = 0, last = 0; first < elements.size(); first = last) {
        while (last < elements.size() && elements[last].seed == elements[first].seed &&
               last - first < m_cluster)
            ++last;
        for (std::size_t begin = 0; begin < rayCount; begin += piece) {
            const std::size_t end = std::min(begin + piece, rayCount);
            if (m_filled + (last - first) * (end - begin) > kStream) {
                flush(means);
                m_job.giveWay();
                if (m_job.cancelled() || (mayStop && m_job.stopping()))
                    return false;
            }
            addBlock({first, last, begin, end, m_filled}, elements, samples);
        }
    }
    flush(means);

    const float scale = 1.0f / static_cast<float>(rayCount);
    for (float& value : means.values)
        value *= scale;
    for (float& value : means.hiddenSky)
        value *= scale;
    for (std::size_t e = 0; e < elements.size(); ++e)
        if (m_sumsHidden[e] != 0)
            m_open.subtract(m_points[elements[e].point].normal,
                            std::span(means.values).subspan(e * stride, stride));
    return true;
}

void RangeTracer::addBlock(const Block& block, std::span<const RangeElement> elements,
                           const HemisphereSamples& samples) {
    const std::size_t count = block.last - block.first;
    const std::uint32_t seed = elements[block.first].seed;
    const glm::vec2 turn = HemisphereSamples::turn(seed);
    m_starts.resize(count);
    for (std::size_t e = 0; e < count; ++e) {
        const BakePoint& point = m_points[elements[block.first + e].point];
        m_starts[e] = {point.origin, HemisphereSamples::frame(point.normal, turn)};
    }
    OcclusionRay* ray = m_rays.data() + m_filled;
    for (const glm::vec3& local :
         samples.directions(seed, m_scratch).subspan(block.begin, block.end - block.begin))
        for (std::size_t e = 0; e < count; ++e, ++ray) {
            ray->origin = m_starts[e].origin;
            ray->minDistance = 0.0f;
            ray->direction = m_starts[e].frame * local;
            ray->maxDistance = m_maxDistance;
        }
    m_filled += count * (block.end - block.begin);
    m_blocks.push_back(block);
}

void RangeTracer::flush(RangeMeans& means) {
    m_scene.occludeFinite({m_rays.data(), m_filled});
    for (const Block& block : m_blocks)
        collect(block, means);
    m_blocks.clear();
    m_filled = 0;
}

// V Y_i(ω): with rays of density cos / pi the mean of it is ∫ V cos Y_i / pi dω.
void RangeTracer::collect(const Block& block, RangeMeans& means) {
    const auto stride = static_cast<std::size_t>(m_settings.stride());
    const std::size_t count = block.last - block.first, length = block.end - block.begin;
    // In the order of memory: each element's open directions from the front of its part of
    // m_sorted, hidden ones from the back.
    m_sides.assign(count, {});
    const OcclusionRay* ray = m_rays.data() + block.ray;
    for (std::size_t i = 0; i < length; ++i)
        for (std::size_t e = 0; e < count; ++e, ++ray) {
            Sides& sides = m_sides[e];
            const std::uint32_t hidden = ray->occluded() ? 1 : 0;
            sides.hidden += hidden;
            m_sorted[e * length + (hidden != 0 ? length - sides.hidden : sides.open)] =
                ray->direction;
            sides.open += 1 - hidden;
            sides.hiddenSky += hidden & (ray->direction.y > 0.0f ? 1 : 0);
        }
    for (std::size_t e = 0; e < count; ++e) {
        const std::size_t open = m_sides[e].open;
        const glm::vec3* sorted = m_sorted.data() + e * length;
        const std::size_t element = block.first + e;
        means.hiddenSky[element] += static_cast<float>(m_sides[e].hiddenSky);
        const std::span<float> values = std::span(means.values).subspan(element * stride, stride);
        if (m_settings.shOrder == 0) {
            values[0] += static_cast<float>(open);
            continue;
        }
        // The first directions tell which of the two are fewer. The methods to compare with stay
        // as they are known.
        if (block.begin == 0 && m_settings.method == SampleMethod::Qmc)
            m_sumsHidden[element] = 2 * open > length ? 1 : 0;
        if (m_sumsHidden[element] != 0)
            sumSh(m_settings.shOrder, {sorted + open, length - open}, values);
        else
            sumSh(m_settings.shOrder, {sorted, open}, values);
    }
}

} // namespace patina
