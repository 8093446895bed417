#include "core/bake/bounce/HitCache.h"

#include "core/bake/bounce/HiddenElements.h"
#include "core/bake/domain/HemisphereSamples.h"
#include "core/base/Check.h"
#include "core/job/Parallel.h"
#include "core/trace/BakeInputs.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace patina {
namespace {

constexpr std::size_t kStream = 1024;           // rays per call
constexpr std::uint32_t kHitRays = 0xb0c5ce5fu; // other rays than those of the direct pass

void addBasis(const glm::vec3& direction, std::span<float> sum) {
    float basis[64];
    if (sum.size() <= 9)
        shading::shBasis9(direction, basis);
    else if (sum.size() <= 25)
        shading::shBasis25(direction, basis);
    else
        shading::shBasis64(direction, basis);
    for (std::size_t i = 0; i < sum.size(); ++i)
        sum[i] += basis[i];
}

// Traces the rays of one chunk after another.
class ChunkTracer {
  public:
    ChunkTracer(const RayScene& scene, const BakeGeometry& geometry, const BounceElements& elements,
                std::span<const BakePoint> points, const HemisphereSamples& samples,
                const HitSettings& settings)
        : m_scene(scene)
        , m_geometry(geometry)
        , m_elements(elements)
        , m_points(points)
        , m_samples(samples)
        , m_settings(settings) {}

    // `backTransfer`: of all back elements; `raysOut`: of all elements, how many rays leave
    // the scene or meet a front; `missed`: how many leave it. All may be empty: not asked for.
    void trace(std::size_t chunk, std::vector<CachedHit>& hits, std::span<float> backTransfer,
               std::span<std::uint32_t> raysOut, std::span<std::uint32_t> missed) {
        const FlushDenormals flush;
        hits.clear();
        m_backTransfer = backTransfer;
        m_raysOut = raysOut;
        m_missed = missed;
        const std::size_t first = chunk * kHitChunk;
        const std::size_t end = std::min(first + kHitChunk, m_points.size());
        if (!missed.empty()) // it may have been traced before, from elsewhere
            std::fill(missed.begin() + static_cast<std::ptrdiff_t>(first),
                      missed.begin() + static_cast<std::ptrdiff_t>(end), 0u);
        m_rays.clear();
        m_rays.reserve(kStream);
        m_open = first;
        m_begin = 0;
        for (std::size_t element = first; element < end; ++element) {
            const std::uint32_t seed =
                seedFor(m_settings.seed ^ kHitRays, static_cast<std::uint32_t>(element));
            const glm::mat3 frame = HemisphereSamples::frame(m_points[element].normal, seed);
            for (const glm::vec3& local : m_samples.directions(seed, m_scratch)) {
                ClosestRay& closest = m_rays.emplace_back();
                closest.ray.origin = m_points[element].origin;
                closest.ray.direction = frame * local;
                closest.ray.id = static_cast<unsigned>(element);
                if (m_rays.size() == kStream)
                    collect(hits);
            }
        }
        collect(hits);
        for (; m_open < end; ++m_open)
            closeElement(hits);
    }

  private:
    void collect(std::vector<CachedHit>& hits) {
        // Points and normals are finite and unit by construction (core/trace/BakeGeometry.h).
        CHECK_EQ(m_scene.intersect(m_rays), std::size_t{0});
        for (const ClosestRay& closest : m_rays) {
            for (; m_open < closest.ray.id; ++m_open)
                closeElement(hits);
            if (closest.mesh == ClosestRay::kNothing)
                miss(closest);
            else
                hit(closest, hits);
        }
        m_rays.clear();
    }

    // Marks the last hit of the element in work; the next one begins after it.
    void closeElement(std::vector<CachedHit>& hits) {
        if (hits.size() == m_begin)
            hits.push_back({CachedHit::kNoTriangle, 0, 0});
        hits.back().place |= CachedHit::kLast;
        m_begin = hits.size();
    }

    void miss(const ClosestRay& closest) {
        countRayOut(closest);
        if (!m_missed.empty())
            ++m_missed[closest.ray.id];
        if (closest.ray.id < m_elements.fronts() || m_backTransfer.empty())
            return;
        const auto stride = static_cast<std::size_t>(m_settings.order * m_settings.order);
        addBasis(closest.ray.direction,
                 m_backTransfer.subspan((closest.ray.id - m_elements.fronts()) * stride, stride));
    }

    void countRayOut(const ClosestRay& closest) {
        if (!m_raysOut.empty())
            ++m_raysOut[closest.ray.id];
    }

    void hit(const ClosestRay& closest, std::vector<CachedHit>& hits) {
        const BounceElements::MeshPart& part = m_elements.meshes()[closest.mesh];
        const bool back = meetsBack(m_geometry.meshes[closest.mesh], closest);
        if (!back)
            countRayOut(closest);
        else if (!part.doubleSided)
            return;
        const auto quantised = [](float weight) {
            return static_cast<std::uint16_t>(
                std::lround(65535.0f * std::clamp(weight, 0.0f, 1.0f)));
        };
        hits.push_back({(part.firstTriangle + closest.triangle) | (back ? CachedHit::kBack : 0u),
                        quantised(closest.u), quantised(closest.v)});
    }

    const RayScene& m_scene;
    const BakeGeometry& m_geometry;
    const BounceElements& m_elements;
    std::span<const BakePoint> m_points;
    const HemisphereSamples& m_samples;
    const HitSettings& m_settings;
    std::span<float> m_backTransfer;
    std::span<std::uint32_t> m_raysOut, m_missed;
    std::vector<ClosestRay> m_rays;
    std::vector<glm::vec3> m_scratch;
    std::size_t m_open = 0, m_begin = 0; // the element in work, and its first hit
};

// Rays to the density cos / pi: the mean of what they find is the integral.
void scaleBackTransfer(std::span<float> values, int samples) {
    for (float& value : values)
        value /= static_cast<float>(samples);
}

// Elements with more than every fourth ray ending at a back. Where backs come into view little by
// little it hardly matters which of two neighbours tells; where they do at once, something begins.
std::vector<std::uint8_t> hiddenOf(const std::vector<std::uint32_t>& raysOut, int samples) {
    std::vector<std::uint8_t> hidden;
    hidden.reserve(raysOut.size());
    for (const std::uint32_t count : raysOut)
        hidden.push_back(4 * std::uint64_t{count} < 3 * static_cast<std::uint64_t>(samples) ? 1
                                                                                            : 0);
    return hidden;
}

// The chunks that hold any of the elements; both ascending.
std::vector<std::size_t> chunksOf(const std::vector<std::uint32_t>& elements) {
    std::vector<std::size_t> chunks;
    for (const std::uint32_t element : elements)
        if (chunks.empty() || chunks.back() != element / kHitChunk)
            chunks.push_back(element / kHitChunk);
    return chunks;
}

// Sums of the back elements of a chunk that is to be traced again.
void clearBackTransfer(const BounceElements& elements, int order, std::size_t chunk,
                       std::span<float> backTransfer) {
    const auto stride = static_cast<std::size_t>(order * order);
    const std::size_t first = std::max(chunk * kHitChunk, elements.fronts()),
                      end = std::min((chunk + 1) * kHitChunk, elements.count());
    for (std::size_t e = first; e < end; ++e)
        std::fill_n(backTransfer.begin() +
                        static_cast<std::ptrdiff_t>((e - elements.fronts()) * stride),
                    stride, 0.0f);
}

std::size_t backValues(const BounceElements& elements, int order) {
    return (elements.count() - elements.fronts()) * static_cast<std::size_t>(order * order);
}

} // namespace

bool meetsBack(const BakeGeometryMesh& mesh, const ClosestRay& closest) {
    const std::uint32_t* corner = mesh.mesh->indices.data() + 3 * std::size_t{closest.triangle};
    const glm::vec3 normal = (1.0f - closest.u - closest.v) * mesh.normals[corner[0]] +
                             closest.u * mesh.normals[corner[1]] +
                             closest.v * mesh.normals[corner[2]];
    return (glm::dot(closest.geometricNormal, normal) < 0.0f) ==
           (glm::dot(closest.geometricNormal, closest.ray.direction) < 0.0f);
}

Result<BounceElements> BounceElements::make(const BakeGeometry& geometry) {
    BounceElements elements;
    if (geometry.triangleCount() >= CachedHit::kNoTriangle ||
        2 * geometry.vertexCount() >= CachedHit::kNoTriangle)
        return Error{ErrorKind::InputBroken,
                     "The scene has too many triangles to follow bounces; hide meshes, or bake "
                     "transfer without bounces.",
                     {},
                     {}};
    elements.m_triangles.reserve(geometry.triangleCount());
    for (const BakeGeometryMesh& mesh : geometry.meshes) {
        MeshPart& part = elements.m_meshes.emplace_back();
        part.id = mesh.id;
        part.mesh = mesh.mesh;
        part.doubleSided = mesh.doubleSided;
        part.firstElement = static_cast<std::uint32_t>(elements.m_fronts);
        part.firstTriangle = static_cast<std::uint32_t>(elements.m_triangles.size());
        const std::vector<std::uint32_t>& indices = mesh.mesh->indices;
        for (std::size_t i = 0; i < indices.size(); i += 3)
            elements.m_triangles.push_back(
                {{part.firstElement + indices[i], part.firstElement + indices[i + 1],
                  part.firstElement + indices[i + 2]},
                 static_cast<std::uint32_t>(elements.m_meshes.size() - 1)});
        elements.m_fronts += mesh.positions.size();
    }
    for (MeshPart& part : elements.m_meshes) {
        if (!part.doubleSided)
            continue;
        part.toBack = static_cast<std::uint32_t>(elements.count() - part.firstElement);
        elements.m_backs += part.mesh->positions.size();
    }
    return elements;
}

std::size_t BounceElements::memoryBytes() const {
    return m_triangles.capacity() * sizeof(Triangle) + m_meshes.capacity() * sizeof(MeshPart);
}

std::vector<BakePoint> BounceElements::points(const BakeGeometry& geometry,
                                              const JobContext& job) const {
    std::vector<BakePoint> points = vertexPoints(geometry, job);
    if (points.size() != m_fronts) // cancelled
        return {};
    points.reserve(count());
    for (const MeshPart& part : m_meshes) {
        if (!part.doubleSided)
            continue;
        for (std::size_t v = 0; v < part.mesh->positions.size(); ++v) {
            const BakePoint& front = points[part.firstElement + v];
            points.push_back({front.origin - 2.0f * kRayOffset * front.normal, -front.normal});
        }
    }
    return points;
}

Result<std::shared_ptr<const HitCache>>
HitCache::trace(const RayScene& scene, const BakeGeometry& geometry, BounceElements elements,
                const HitSettings& settings, const JobContext& job) {
    std::shared_ptr<HitCache> cache(new HitCache(std::move(elements), settings));
    std::vector<BakePoint> points = cache->elements().points(geometry, job);
    const HemisphereSamples samples(settings.seed ^ kHitRays, 0,
                                    static_cast<std::uint32_t>(settings.samples));
    cache->m_chunks.resize(cache->chunkCount());
    cache->m_backTransfer.assign(backValues(cache->elements(), settings.order), 0.0f);
    if (job.cancelled())
        return bakeCancelled();
    std::vector<std::uint32_t> raysOut(points.size(), 0);
    cache->m_missed.assign(points.size(), 0);
    const auto traceChunk = [&](std::size_t chunk, ChunkTracer& tracer,
                                std::vector<CachedHit>& hits) {
        tracer.trace(chunk, hits, cache->m_backTransfer, raysOut, cache->m_missed);
        cache->m_chunks[chunk] = std::vector<CachedHit>(hits.begin(), hits.end());
        job.addWork(static_cast<double>(kHitChunk) * settings.samples, "rays");
    };
    parallelFor(job, cache->chunkCount(), 1, [&](std::size_t begin, std::size_t end) {
        ChunkTracer tracer(scene, geometry, cache->elements(), points, samples, settings);
        std::vector<CachedHit> hits;
        for (std::size_t chunk = begin; chunk < end; ++chunk)
            traceChunk(chunk, tracer, hits);
    });
    if (job.cancelled())
        return bakeCancelled();

    // What stands within something looks again, from beside it.
    const std::vector<std::size_t> again =
        chunksOf(moveHiddenPoints(cache->elements(), hiddenOf(raysOut, settings.samples), points));
    for (const std::size_t chunk : again)
        clearBackTransfer(cache->elements(), settings.order, chunk, cache->m_backTransfer);
    parallelFor(job, again.size(), 1, [&](std::size_t begin, std::size_t end) {
        ChunkTracer tracer(scene, geometry, cache->elements(), points, samples, settings);
        std::vector<CachedHit> hits;
        for (std::size_t i = begin; i < end; ++i)
            traceChunk(again[i], tracer, hits);
    });
    if (job.cancelled())
        return bakeCancelled();
    scaleBackTransfer(cache->m_backTransfer, settings.samples);
    return std::shared_ptr<const HitCache>(std::move(cache));
}

std::size_t HitCache::hitBytes() const {
    std::size_t bytes = 0;
    for (const std::vector<CachedHit>& chunk : m_chunks)
        bytes += chunk.capacity() * sizeof(CachedHit);
    return bytes;
}

struct HitRetracer::Tracing {
    const RayScene& scene;
    const BakeGeometry& geometry;
    std::vector<BakePoint> points;
    HemisphereSamples samples;
};

HitRetracer::HitRetracer(BounceElements elements, const HitSettings& settings,
                         std::unique_ptr<Tracing> tracing)
    : HitSource(std::move(elements), settings)
    , m_tracing(std::move(tracing)) {}

HitRetracer::~HitRetracer() = default;

Result<HitSourcePtr> HitRetracer::make(const RayScene& scene, const BakeGeometry& geometry,
                                       BounceElements elements, const HitSettings& settings,
                                       const JobContext& job) {
    std::vector<BakePoint> points = elements.points(geometry, job);
    if (job.cancelled())
        return bakeCancelled();
    auto tracing = std::make_unique<Tracing>(
        Tracing{scene, geometry, std::move(points),
                HemisphereSamples(settings.seed ^ kHitRays, 0,
                                  static_cast<std::uint32_t>(settings.samples))});
    std::shared_ptr<HitRetracer> retracer(
        new HitRetracer(std::move(elements), settings, std::move(tracing)));
    // One round of rays for the light that comes straight to the backs, and to find what stands
    // within something; that looks again, from beside it.
    Tracing& t = *retracer->m_tracing;
    const BounceElements& all = retracer->elements();
    retracer->m_backTransfer.assign(backValues(all, settings.order), 0.0f);
    std::vector<std::uint32_t> raysOut(t.points.size(), 0);
    retracer->m_missed.assign(t.points.size(), 0);
    const auto traceChunks = [&](std::size_t count, const auto& chunkAt) {
        parallelFor(job, count, 1, [&](std::size_t begin, std::size_t end) {
            ChunkTracer tracer(scene, geometry, all, t.points, t.samples, settings);
            std::vector<CachedHit> hits;
            for (std::size_t i = begin; i < end; ++i)
                tracer.trace(chunkAt(i), hits, retracer->m_backTransfer, raysOut,
                             retracer->m_missed);
        });
    };
    traceChunks(retracer->chunkCount(), [](std::size_t i) { return i; });
    if (job.cancelled())
        return bakeCancelled();
    const std::vector<std::size_t> again =
        chunksOf(moveHiddenPoints(all, hiddenOf(raysOut, settings.samples), t.points));
    for (const std::size_t chunk : again)
        clearBackTransfer(all, settings.order, chunk, retracer->m_backTransfer);
    if (!again.empty())
        traceChunks(again.size(), [&](std::size_t i) { return again[i]; });
    if (job.cancelled())
        return bakeCancelled();
    scaleBackTransfer(retracer->m_backTransfer, settings.samples);
    return HitSourcePtr(std::move(retracer));
}

std::span<const CachedHit> HitRetracer::hits(std::size_t chunk,
                                             std::vector<CachedHit>& scratch) const {
    ChunkTracer tracer(m_tracing->scene, m_tracing->geometry, elements(), m_tracing->points,
                       m_tracing->samples, settings());
    tracer.trace(chunk, scratch, {}, {}, {});
    return scratch;
}

} // namespace patina
