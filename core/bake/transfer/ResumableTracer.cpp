#include "core/bake/transfer/ResumableTracer.h"

#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

namespace patina {
namespace {

constexpr std::string_view kDoes = "computes this bake"; // who holds its checkpoint

Result<PassState> readCheckpoint(const std::filesystem::path& file, const BakeManifest& here,
                                 const TraceRequest& request) {
    const Result<BakeManifest> there = readBakeManifest(file);
    if (!there)
        return there.error();
    const auto refuse = [&](const std::string& why) {
        return Error{ErrorKind::InputBroken,
                     fmt::format("this checkpoint is of another bake: they differ in {}; remove "
                                 "it, or bake without resuming",
                                 why),
                     file,
                     {}};
    };
    if (const auto why = whyDifferent(*there, here))
        return refuse(*why);
    if (there->shard != here.shard)
        return refuse(fmt::format("the part (part {} of {} there, {} of {} here)",
                                  there->shard.index + 1, there->shard.count, here.shard.index + 1,
                                  here.shard.count));
    PassState state;
    if (Result<void> read = readBakeState(file, request.ranges, request.settings.stride(), state);
        !read)
        return read.error();
    return state;
}

// Of the shard's points, the rays that are cast; the first pass has 32, each further one doubles
// them.
double tracedShare(const PassState& state, std::span<const PointRange> ranges,
                   const PassSettings& settings) {
    int passes = 1;
    if (settings.method != SampleMethod::Stratified)
        for (int rays = 32; rays < settings.samples; rays *= 2)
            ++passes;
    double share = 0.0;
    std::size_t points = 0;
    for (std::size_t r = 0; r < ranges.size(); ++r) {
        if (!settings.shard.holds(r))
            continue;
        for (const std::uint8_t done :
             std::span(state.passes).subspan(ranges[r].first, ranges[r].count))
            share += done == 0 ? 0.0 : std::ldexp(1.0, done - passes);
        points += ranges[r].count;
    }
    return points == 0 ? 1.0 : share / static_cast<double>(points);
}

} // namespace

void ResumableTracer::hold() {
    m_lock.hold(m_settings.checkpoint, kDoes, m_settings.warn);
}

bool ResumableTracer::removeCheckpoint() {
    m_kept = false;
    return m_lock.remove(m_settings.checkpoint, kDoes, m_settings.warn);
}

Result<std::optional<PassState>> ResumableTracer::trace(const TraceRequest& request) {
    hold();
    BakeManifest& manifest = m_settings.manifest;
    manifest.points = request.points.size();
    manifest.ranges = request.ranges.size();

    PassState state;
    std::error_code ignored;
    if (m_settings.resume && std::filesystem::exists(m_settings.checkpoint, ignored)) {
        Result<PassState> read = readCheckpoint(m_settings.checkpoint, manifest, request);
        if (!read)
            return read.error();
        state = std::move(read).value();
        m_resumedFrom = state.samplesDone;
        m_kept = true;
    }

    PassSettings settings = request.settings;
    settings.shard = manifest.shard;
    Checkpointer checkpointer(m_settings.checkpoint, manifest, request.ranges, m_settings.warn);
    const auto keep = [&](const PassState& now, bool complete) {
        if (!m_settings.checkpoint.empty() &&
            checkpointer.write(now, complete, tracedShare(now, request.ranges, settings)))
            m_kept = true;
    };
    PassCallbacks callbacks = request.callbacks;
    callbacks.checkpointSeconds = m_settings.everySeconds;
    callbacks.checkpoint = [&](const PassState& now) {
        if (!request.job.cancelled() || m_settings.keepOnCancel)
            keep(now, false);
    };
    const auto start = std::chrono::steady_clock::now();
    Result<PassState> traced = runPasses(request.scene, request.points, request.ranges, settings,
                                         callbacks, request.job, std::move(state));
    if (!traced)
        return traced.error();
    m_samplesDone = traced->samplesDone;
    m_complete = !request.job.stopping() || traced->samplesDone == settings.samples;

    // What follows (fit, bounces, writing) may take long or fail as well.
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (m_complete ? seconds >= m_settings.everySeconds : m_settings.keepOnCancel)
        keep(*traced, m_complete);
    if (m_settings.part.empty())
        return std::optional(std::move(traced).value());
    manifest.complete = m_complete;
    manifest.samplesDone = traced->samplesDone;
    manifest.done = tracedShare(*traced, request.ranges, settings);
    if (Result<void> written = writeBakeCheckpoint(m_settings.part, manifest, *traced,
                                                   request.ranges, StateFileName::OfUser);
        !written)
        return written.error();
    return std::optional<PassState>();
}

} // namespace patina
