#include "core/bake/transfer/Passes.h"

#include "core/bake/transfer/OpenTransfer.h"
#include "core/bake/transfer/PassPlan.h"
#include "core/bake/transfer/RangeTracer.h"
#include "core/bake/transfer/TileTracer.h"
#include "core/bake/transfer/WorkOrder.h"
#include "core/base/Check.h"
#include "core/job/Parallel.h"
#include "core/math/SphericalHarmonics.h"
#include "core/trace/BakeInputs.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <mutex>
#include <optional>
#include <shared_mutex>

namespace patina {
namespace {

constexpr int kMaxSamples = 65536;

// Points that share their directions: on scenes that outgrow the caches, rays of one direction from
// neighbouring points travel together 1.5 times as fast as each point's by themselves (measured),
// and 32 of a million points may have their noise in common. Drawn directions are every point's
// own.
constexpr std::size_t kLargeScene = 200'000; // triangles
constexpr int kCluster = 32;

int clusterSize(const RayScene& scene, const PassSettings& settings) {
    if (settings.method != SampleMethod::Qmc)
        return 1;
    if (settings.tolerance > 0.0f) // points share those of their tile
        return 1;
    if (settings.cluster > 0)
        return settings.cluster;
    return scene.triangleCount() >= kLargeScene ? kCluster : 1;
}

// How the standard error of a mean over two halves relates to half the difference of the halves:
// for independent rays they are equal; two halves of a scrambled net make up for each other's
// errors (measured on the shader ball and in the Cornell box, 64 to 1024 rays: 0.67 to 0.73).
float errorPerHalfDifference(SampleMethod method) {
    return method == SampleMethod::Qmc ? 0.7f : 1.0f;
}

// Replaces the mean over some rays by the mean over those and as many again; returns half the
// difference of the halves, RMS over the values.
float merge(std::span<float> values, std::span<const float> more) {
    float squares = 0.0f;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const float half = 0.5f * (more[i] - values[i]);
        values[i] = 0.5f * (values[i] + more[i]);
        squares += half * half;
    }
    return std::sqrt(squares / static_cast<float>(values.size()));
}

class PassRunner {
  public:
    PassRunner(const RayScene& scene, std::span<const BakePoint> points,
               std::span<const PointRange> ranges, const PassSettings& settings,
               const PassCallbacks& callbacks, const JobContext& job, PassState& state)
        : m_scene(scene)
        , m_points(points)
        , m_ranges(ranges)
        , m_settings(settings)
        , m_callbacks(callbacks)
        , m_job(job)
        , m_state(state)
        , m_plan(points, ranges, settings, state)
        , m_cluster(clusterSize(scene, settings))
        , m_rays(m_plan.raysKnown())
        , m_allRays(m_plan.allRays()) {
        // Embree aborts the process on rays that are not finite.
        for (const BakePoint& point : m_points)
            for (int axis = 0; axis < 3; ++axis)
                CHECK(std::abs(point.origin[axis]) < 1e6f && std::abs(point.normal[axis]) < 2.0f);
    }

    void run() {
        while (m_plan.pending() || m_plan.wantMore()) {
            if (m_job.cancelled() || (m_state.samplesDone > 0 && m_job.stopping()))
                return;
            if (!runPass())
                return;
            m_plan.updateSamplesDone();
            if (m_callbacks.passDone)
                m_callbacks.passDone(m_state.samplesDone);
        }
    }

  private:
    // False when it was interrupted.
    [[nodiscard]] bool runPass() {
        const std::vector<PassBatch> all = m_plan.batches();
        m_job.setActivity(
            fmt::format("pass {} of {}", all.front().pass + 1, m_plan.schedule().passes()));
        if (m_plan.tiles() && m_settings.method == SampleMethod::Qmc &&
            all.front().pass >= kPassesEverywhere)
            return runTiles(all);
        const bool mayStop = m_state.samplesDone > 0;
        std::vector<std::size_t> held;
        for (const std::uint32_t r :
             workOrder(m_points, m_ranges, m_callbacks.view ? m_callbacks.view() : std::nullopt))
            if (m_settings.shard.holds(r))
                held.push_back(r);
        std::atomic<bool> complete = true;
        parallelFor(m_job, held.size(), 1, [&](std::size_t begin, std::size_t end) {
            const FlushDenormals flush;
            std::unique_ptr<RangeTracer> tracer = borrowTracer();
            for (std::size_t i = begin; i < end; ++i)
                if (!runRange(m_ranges[held[i]], all, *tracer, mayStop))
                    complete = false;
            const std::lock_guard lock(m_idle);
            m_idleTracers.push_back(std::move(tracer));
        });
        return complete && !m_job.cancelled();
    }

    // A pass over the tiles that want more; false when it was interrupted.
    [[nodiscard]] bool runTiles(const std::vector<PassBatch>& batches) {
        std::vector<std::size_t> changed;
        for (std::size_t r = 0; r < m_ranges.size(); ++r)
            for (std::size_t p = 0; p < m_ranges[r].count; ++p)
                if (m_state.passes[m_ranges[r].first + p] < m_state.wanted[m_ranges[r].first + p]) {
                    changed.push_back(r);
                    break;
                }
        std::atomic<bool> complete = true;
        constexpr std::size_t kTogether = 8;
        parallelFor(m_job, m_plan.tiles()->count(), kTogether,
                    [&](std::size_t begin, std::size_t end) {
                        const FlushDenormals flush;
                        TileTracer tracer(m_scene, m_points, m_settings, m_job);
                        for (std::size_t t = begin; t < end; ++t)
                            if (!runTile(m_plan.tiles()->points(t), batches, tracer))
                                complete = false;
                    });
        const auto stride = static_cast<std::size_t>(m_settings.stride());
        if (m_callbacks.range)
            for (const std::size_t r : changed)
                m_callbacks.range(m_ranges[r], std::span<const float>(m_state.values)
                                                   .subspan(m_ranges[r].first * stride,
                                                            m_ranges[r].count * stride));
        return complete && !m_job.cancelled();
    }

    [[nodiscard]] bool runTile(std::span<const std::uint32_t> tile,
                               const std::vector<PassBatch>& batches, TileTracer& tracer) {
        const int pass = m_state.passes[tile.front()]; // as of all of them
        if (pass == m_state.wanted[tile.front()])
            return true;
        if (m_job.stopping())
            return false;
        const auto batch = std::ranges::find(batches, pass, &PassBatch::pass);
        RangeMeans means;
        const std::optional<std::size_t> traced =
            tracer.trace(tile, m_plan.tiles()->seedOf(tile.front()), batch->samples, means);
        if (!traced)
            return false;
        {
            const std::shared_lock lock(m_commit);
            const auto stride = static_cast<std::size_t>(m_settings.stride());
            for (std::size_t e = 0; e < tile.size(); ++e) {
                addHalf(tile[e], std::span<const float>(means.values).subspan(e * stride, stride),
                        means.hiddenSky[e]);
                ++m_state.passes[tile[e]];
            }
        }
        m_job.addWork(static_cast<double>(*traced), "rays");
        const std::size_t known = tile.size() * batch->samples.count();
        m_job.setProgress(static_cast<double>(m_rays.fetch_add(known) + known) / m_allRays);
        checkpoint();
        return true;
    }

    // The other half of a point's rays.
    void addHalf(std::size_t p, std::span<const float> values, float hiddenSky) {
        m_state.error[p] =
            errorPerHalfDifference(m_settings.method) *
            merge(std::span(m_state.values).subspan(p * values.size(), values.size()), values);
        if (!m_state.hiddenSky.empty())
            m_state.hiddenSky[p] = 0.5f * (m_state.hiddenSky[p] + hiddenSky);
    }

    std::unique_ptr<RangeTracer> borrowTracer() {
        const std::lock_guard lock(m_idle);
        if (m_idleTracers.empty())
            return std::make_unique<RangeTracer>(m_scene, m_points, m_settings, m_cluster, m_job);
        std::unique_ptr<RangeTracer> tracer = std::move(m_idleTracers.back());
        m_idleTracers.pop_back();
        return tracer;
    }

    [[nodiscard]] bool runRange(const PointRange& range, const std::vector<PassBatch>& batches,
                                RangeTracer& tracer, bool mayStop) {
        if (mayStop && m_job.stopping())
            return false;
        const auto stride = static_cast<std::size_t>(m_settings.stride());
        std::vector<RangeElement> order, elements;
        orderRange(m_points, range, m_cluster, m_settings.seed, order, m_settings.firstPoint);
        if (m_plan.tiles())
            for (RangeElement& element : order)
                element.seed = m_plan.tiles()->seedOf(element.point);
        RangeMeans means, firstHalf;
        std::size_t rays = 0;
        for (std::size_t b = 0; b < batches.size(); ++b) {
            const PassBatch& batch = batches[b];
            elements.clear();
            for (const RangeElement& element : order) {
                const std::size_t p = element.point;
                if (m_state.passes[p] == m_state.wanted[p] || m_state.passes[p] != batch.pass)
                    continue;
                elements.push_back(element);
            }
            if (elements.empty())
                continue;
            if (!tracer.trace(elements, batch.samples, mayStop, means))
                return false;
            rays += elements.size() * batch.samples.count();
            const bool halved = batch.pass == 0 && m_plan.schedule().halvesFirst();
            if (halved && !batch.second) {
                std::swap(firstHalf, means);
                continue;
            }

            // No checkpoint sees a range half changed.
            const std::shared_lock lock(m_commit);
            for (std::size_t e = 0; e < elements.size(); ++e) {
                const std::size_t p = elements[e].point;
                const std::span<float> values =
                    std::span(m_state.values).subspan(p * stride, stride);
                const std::span<const float> fresh =
                    std::span<const float>(means.values).subspan(e * stride, stride);
                if (batch.pass == 0) {
                    const float* from = halved ? firstHalf.values.data() : means.values.data();
                    std::copy_n(from + e * stride, stride, values.begin());
                }
                if (batch.pass == 0 && !m_state.hiddenSky.empty())
                    m_state.hiddenSky[p] = halved ? firstHalf.hiddenSky[e] : means.hiddenSky[e];
                if (batch.second)
                    addHalf(p, fresh, means.hiddenSky[e]);
                ++m_state.passes[p];
            }
        }
        if (rays == 0)
            return true; // reached already, before the state was kept
        if (m_callbacks.range)
            m_callbacks.range(range, std::span<const float>(m_state.values)
                                         .subspan(range.first * stride, range.count * stride));
        const std::size_t total = m_rays.fetch_add(rays) + rays;
        m_job.addWork(static_cast<double>(rays), "rays");
        m_job.setProgress(static_cast<double>(total) / m_allRays);
        checkpoint();
        return true;
    }

    void checkpoint() {
        if (!m_callbacks.checkpoint)
            return;
        const std::unique_lock lock(m_commit, std::try_to_lock);
        const auto now = std::chrono::steady_clock::now();
        if (!lock || std::chrono::duration<double>(now - m_lastCheckpoint).count() <
                         m_callbacks.checkpointSeconds)
            return; // the next range tries again
        m_callbacks.checkpoint(m_state);
        m_lastCheckpoint = std::chrono::steady_clock::now();
    }

    const RayScene& m_scene;
    std::span<const BakePoint> m_points;
    std::span<const PointRange> m_ranges;
    const PassSettings& m_settings;
    const PassCallbacks& m_callbacks;
    const JobContext& m_job;
    PassState& m_state;
    PassPlan m_plan;
    int m_cluster;
    std::mutex m_idle; // guards m_idleTracers
    std::vector<std::unique_ptr<RangeTracer>> m_idleTracers;
    std::atomic<std::size_t> m_rays; // of all points, all passes
    double m_allRays;
    std::shared_mutex m_commit; // held alone while a checkpoint is taken; guards m_lastCheckpoint
    std::chrono::steady_clock::time_point m_lastCheckpoint = std::chrono::steady_clock::now();
};

} // namespace

Result<int> roundSamples(int samples, SampleMethod method) {
    if (samples < 1 || samples > kMaxSamples)
        return Error{ErrorKind::Usage,
                     fmt::format("Bakes take 1 to {} samples, not {}.", kMaxSamples, samples),
                     {},
                     {}};
    if (method == SampleMethod::Stratified) {
        const int side = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(samples))));
        return side * side;
    }
    return static_cast<int>(std::bit_ceil(static_cast<unsigned>(samples)));
}

// T_lm = A_l Y_lm(n) / pi.
Result<PassState> openPasses(std::span<const BakePoint> points, std::span<const PointRange> ranges,
                             const PassSettings& settings, const PassCallbacks& callbacks,
                             const JobContext& job) {
    CHECK(settings.shOrder > 0 && settings.shOrder <= kMaxShOrder);
    PassState state;
    PassPlan plan(points, ranges, settings, state);
    const OpenTransfer open(settings.shOrder);
    const auto stride = static_cast<std::size_t>(settings.stride());
    const auto passes = static_cast<std::uint8_t>(plan.schedule().passes());
    parallelFor(job, ranges.size(), 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t r = begin; r < end; ++r) {
            const PointRange& range = ranges[r];
            for (std::size_t p = range.first; p < range.first + range.count; ++p) {
                // From nothing.
                open.subtract(points[p].normal,
                              std::span(state.values).subspan(p * stride, stride));
                state.passes[p] = state.wanted[p] = passes;
            }
            if (callbacks.range)
                callbacks.range(range, std::span<const float>(state.values)
                                           .subspan(range.first * stride, range.count * stride));
        }
    });
    if (job.cancelled())
        return bakeCancelled();
    plan.updateSamplesDone();
    if (callbacks.passDone)
        callbacks.passDone(state.samplesDone);
    return state;
}

Result<PassState> runPasses(const RayScene& scene, std::span<const BakePoint> points,
                            std::span<const PointRange> ranges, const PassSettings& settings,
                            const PassCallbacks& callbacks, const JobContext& job,
                            PassState state) {
    CHECK(settings.method == SampleMethod::Stratified ||
          std::has_single_bit(static_cast<unsigned>(settings.samples)));
    CHECK(settings.shOrder >= 0 && settings.shOrder <= kMaxShOrder);
    CHECK(settings.tolerance == 0.0f || // which looks at all points
          (settings.shard.count == 1 && settings.method != SampleMethod::Stratified));
    CHECK(settings.shard.index >= 0 && settings.shard.index < settings.shard.count);
    PassRunner(scene, points, ranges, settings, callbacks, job, state).run();
    if (job.cancelled()) {
        if (callbacks.checkpoint)
            callbacks.checkpoint(state);
        return bakeCancelled();
    }
    return state;
}

} // namespace patina
