#include "core/bake/Passes.h"

#include "core/bake/HemisphereSamples.h"
#include "core/base/Check.h"
#include "core/job/Parallel.h"
#include "core/math/Shading.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <fmt/format.h>

namespace patina {
namespace {

constexpr int kFirstPass = 32;
constexpr int kMaxSamples = 65536;
constexpr std::size_t kStream = 1024; // rays per call: the fastest length that stays in the cache
constexpr std::size_t kMaxCoefficients = 25;

using Sum = std::array<float, kMaxCoefficients>;

// V Y_i(ω): with rays of density cos / pi the mean of it is ∫ V cos Y_i / pi dω.
void addOpenDirection(int shOrder, const glm::vec3& direction, Sum& sum) {
    float basis[kMaxCoefficients];
    if (shOrder <= 3) {
        shading::shBasis9(direction, basis);
        for (std::size_t i = 0; i < 9; ++i)
            sum[i] += basis[i];
    } else {
        shading::shBasis25(direction, basis);
        for (std::size_t i = 0; i < 25; ++i)
            sum[i] += basis[i];
    }
}

// One pass over some points.
class PassTask {
  public:
    PassTask(const RayScene& scene, const HemisphereSamples& samples, const PassSettings& settings,
             int rayCount, const JobContext& job, bool mayStop)
        : m_scene(scene)
        , m_samples(samples)
        , m_settings(settings)
        , m_rayCount(rayCount)
        , m_job(job)
        , m_mayStop(mayStop)
        , m_rays(kStream) {}

    // The mean over this pass's rays, stride() values per point; false when interrupted.
    [[nodiscard]] bool run(std::span<const BakePoint> points, std::size_t firstElement,
                           std::span<float> means) {
        const auto stride = static_cast<std::size_t>(m_settings.stride());
        m_sums.assign(points.size(), Sum{});
        const float maxDistance = m_settings.maxDistance > 0.0f
                                      ? m_settings.maxDistance
                                      : std::numeric_limits<float>::infinity();
        for (std::size_t p = 0; p < points.size(); ++p) {
            const std::uint32_t seed =
                seedFor(m_settings.seed, static_cast<std::uint32_t>(firstElement + p));
            const glm::mat3 frame = HemisphereSamples::frame(points[p].normal, seed);
            for (const glm::vec3& local : m_samples.sequence(seed)) {
                OcclusionRay& ray = m_rays[m_filled++];
                ray.origin = points[p].origin;
                ray.minDistance = 0.0f;
                ray.direction = frame * local;
                ray.maxDistance = maxDistance;
                ray.id = static_cast<unsigned>(p);
                if (m_filled < kStream)
                    continue;
                flush();
                if (m_job.cancelled() || (m_mayStop && m_job.stopping()))
                    return false;
            }
        }
        flush();
        const float scale = 1.0f / static_cast<float>(m_rayCount);
        for (std::size_t p = 0; p < points.size(); ++p)
            for (std::size_t i = 0; i < stride; ++i)
                means[p * stride + i] = m_sums[p][i] * scale;
        return true;
    }

  private:
    void flush() {
        const std::span<OcclusionRay> rays(m_rays.data(), m_filled);
        // Points and normals are finite and unit by construction (core/bake/BakeGeometry.h).
        CHECK_EQ(m_scene.occlude(rays), std::size_t{0});
        for (const OcclusionRay& ray : rays) {
            if (ray.occluded())
                continue;
            Sum& sum = m_sums[ray.id];
            if (m_settings.shOrder == 0)
                sum[0] += 1.0f;
            else
                addOpenDirection(m_settings.shOrder, ray.direction, sum);
        }
        m_filled = 0;
    }

    const RayScene& m_scene;
    const HemisphereSamples& m_samples;
    const PassSettings& m_settings;
    int m_rayCount;
    const JobContext& m_job;
    bool m_mayStop;
    std::vector<OcclusionRay> m_rays;
    std::size_t m_filled = 0;
    std::vector<Sum> m_sums;
};

} // namespace

Result<int> roundSamples(int samples) {
    if (samples < 1 || samples > kMaxSamples)
        return Error{ErrorKind::Usage,
                     fmt::format("Bakes take 1 to {} samples, not {}.", kMaxSamples, samples),
                     {},
                     {}};
    return static_cast<int>(std::bit_ceil(static_cast<unsigned>(samples)));
}

Result<PassResult> runPasses(const RayScene& scene, std::span<const BakePoint> points,
                             std::span<const PointRange> ranges, const PassSettings& settings,
                             const PassCallbacks& callbacks, const JobContext& job) {
    CHECK(std::has_single_bit(static_cast<unsigned>(settings.samples)));
    CHECK(settings.shOrder >= 0 && settings.shOrder <= 5);
    const auto stride = static_cast<std::size_t>(settings.stride());
    int passCount = 1;
    for (int n = kFirstPass; n < settings.samples; n *= 2)
        ++passCount;

    // `next` is kept apart, so that a stop in the middle of a pass leaves the last one intact.
    PassResult result;
    std::vector<float> next(points.size() * stride);
    std::atomic<std::size_t> pointRays = 0; // rays of all points, all passes
    const double allRays = static_cast<double>(settings.samples) *
                           static_cast<double>(std::max<std::size_t>(points.size(), 1));
    for (int pass = 0; pass < passCount; ++pass) {
        const int done = result.samplesDone;
        const int rayCount = done == 0 ? std::min(kFirstPass, settings.samples) : done;
        if (done > 0 && job.stopping())
            break;
        job.setActivity(fmt::format("tracing pass {} of {}", pass + 1, passCount));
        const HemisphereSamples samples(settings.seed, static_cast<std::uint32_t>(done),
                                        static_cast<std::uint32_t>(rayCount));
        std::atomic<bool> complete = true;
        parallelFor(job, ranges.size(), 1, [&](std::size_t begin, std::size_t end) {
            const FlushDenormals flush;
            for (std::size_t r = begin; r < end; ++r) {
                if (done > 0 && job.stopping()) {
                    complete = false;
                    return;
                }
                const PointRange& range = ranges[r];
                const std::span<float> values(next.data() + range.first * stride,
                                              range.count * stride);
                PassTask task(scene, samples, settings, rayCount, job, done > 0);
                if (!task.run(points.subspan(range.first, range.count), range.first, values)) {
                    complete = false;
                    return;
                }
                // Each pass casts as many rays as all before it: the mean of the two means.
                if (done > 0)
                    for (std::size_t i = 0; i < values.size(); ++i)
                        values[i] = 0.5f * (values[i] + result.values[range.first * stride + i]);
                if (callbacks.range)
                    callbacks.range(range, values);
                const std::size_t rays = range.count * static_cast<std::size_t>(rayCount);
                const std::size_t total = pointRays.fetch_add(rays) + rays;
                job.addWork(static_cast<double>(rays), "rays");
                job.setProgress(static_cast<double>(total) / allRays);
            }
        });
        if (job.cancelled())
            return Error{ErrorKind::Cancelled, "The bake was cancelled.", {}, {}};
        if (!complete)
            break;
        result.values.resize(next.size());
        result.values.swap(next);
        result.samplesDone = done + rayCount;
        if (callbacks.passDone)
            callbacks.passDone(result.samplesDone);
    }
    return result;
}

} // namespace patina
