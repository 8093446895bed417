#include "core/bake/transfer/TileTracer.h"

#include "core/base/Check.h"
#include "core/math/SphericalHarmonics.h"

#include <algorithm>
#include <limits>

namespace patina {
namespace {

constexpr std::size_t kTileStream = 2048;
constexpr std::size_t kCheckEvery = 8; // directions
constexpr std::uint8_t kFree = 0, kHidden = 1, kDivided = 2;

} // namespace

TileTracer::TileTracer(const RayScene& scene, std::span<const BakePoint> points,
                       const PassSettings& settings, const JobContext& job)
    : m_scene(scene)
    , m_points(points)
    , m_settings(settings)
    , m_job(job)
    , m_open(settings.shOrder)
    , m_maxDistance(settings.maxDistance > 0.0f ? settings.maxDistance
                                                : std::numeric_limits<float>::infinity()) {
    CHECK(settings.shOrder > 0 && settings.method == SampleMethod::Qmc);
    m_rays.reserve(kTileStream);
    m_answers.reserve(kTileStream);
}

std::optional<std::size_t> TileTracer::trace(std::span<const std::uint32_t> tile,
                                             std::uint32_t seed, const HemisphereSamples& samples,
                                             RangeMeans& means) {
    const std::size_t count = tile.size();
    m_directions = samples.directions(seed, m_scratch);
    const glm::vec2 turn = HemisphereSamples::turn(seed);
    m_origins.clear();
    m_frames.clear();
    for (const std::uint32_t p : tile) {
        m_origins.push_back(m_points[p].origin);
        m_frames.push_back(HemisphereSamples::frame(m_points[p].normal, turn));
    }
    findRim(m_points, tile, m_isRim);
    m_hidden.assign(m_directions.size() * count, kFree);
    m_rays.clear();
    m_answers.clear();
    m_traced = 0;

    // The rim, and everything in some directions.
    for (std::size_t d = 0; d < m_directions.size(); ++d)
        for (std::size_t e = 0; e < count; ++e)
            if (m_isRim[e] != 0 || d % kCheckEvery == 0)
                add(d, e);
    flush();
    bool asTheRim = true;
    for (std::size_t d = 0; d < m_directions.size(); d += kCheckEvery)
        if (const std::uint8_t seen = rimSees(d); seen != kDivided)
            for (std::size_t e = 0; e < count; ++e)
                asTheRim = asTheRim && m_hidden[d * count + e] == seen;

    // The rest, where it is not as good as known.
    for (std::size_t d = 0; d < m_directions.size(); ++d) {
        if (d % kCheckEvery == 0)
            continue;
        const std::uint8_t seen = asTheRim ? rimSees(d) : kDivided;
        for (std::size_t e = 0; e < count; ++e) {
            if (m_isRim[e] != 0)
                continue;
            if (seen == kDivided)
                add(d, e);
            else
                m_hidden[d * count + e] = seen;
        }
    }
    flush();
    if (m_job.cancelled())
        return std::nullopt;
    sum(tile, means);
    return m_traced;
}

std::uint8_t TileTracer::rimSees(std::size_t direction) const {
    const std::size_t count = m_origins.size();
    std::optional<std::uint8_t> seen;
    for (std::size_t e = 0; e < count; ++e) {
        if (m_isRim[e] == 0)
            continue;
        const std::uint8_t hidden = m_hidden[direction * count + e];
        if (seen.value_or(hidden) != hidden)
            return kDivided;
        seen = hidden;
    }
    return *seen;
}

void TileTracer::add(std::size_t direction, std::size_t element) {
    OcclusionRay& ray = m_rays.emplace_back();
    ray.origin = m_origins[element];
    ray.direction = m_frames[element] * m_directions[direction];
    ray.maxDistance = m_maxDistance;
    m_answers.push_back(static_cast<std::uint32_t>(direction * m_origins.size() + element));
    if (m_rays.size() == kTileStream)
        flush();
}

void TileTracer::flush() {
    m_job.giveWay();
    if (!m_job.cancelled())
        m_scene.occludeFinite(m_rays);
    for (std::size_t i = 0; i < m_rays.size(); ++i)
        m_hidden[m_answers[i]] = m_rays[i].occluded() ? kHidden : kFree;
    m_traced += m_rays.size();
    m_rays.clear();
    m_answers.clear();
}

void TileTracer::sum(std::span<const std::uint32_t> tile, RangeMeans& means) {
    const auto stride = static_cast<std::size_t>(m_settings.stride());
    const std::size_t count = tile.size(), length = m_directions.size();
    const float scale = 1.0f / static_cast<float>(length);
    means.values.assign(count * stride, 0.0f);
    means.hiddenSky.assign(count, 0.0f);
    for (std::size_t e = 0; e < count; ++e) {
        std::size_t hidden = 0;
        for (std::size_t d = 0; d < length; ++d)
            hidden += m_hidden[d * count + e];
        const std::uint8_t fewer = 2 * hidden <= length ? kHidden : kFree;
        m_sorted.clear();
        int hiddenUp = 0;
        for (std::size_t d = 0; d < length; ++d) {
            const bool isHidden = m_hidden[d * count + e] == kHidden;
            const glm::vec3 direction = m_frames[e] * m_directions[d];
            hiddenUp += isHidden && direction.y > 0.0f ? 1 : 0;
            if (m_hidden[d * count + e] == fewer)
                m_sorted.push_back(direction);
        }
        const std::span<float> values = std::span(means.values).subspan(e * stride, stride);
        sumSh(m_settings.shOrder, m_sorted, values);
        for (float& value : values)
            value *= scale;
        if (fewer == kHidden)
            m_open.subtract(m_points[tile[e]].normal, values);
        means.hiddenSky[e] = scale * static_cast<float>(hiddenUp);
    }
}

} // namespace patina
