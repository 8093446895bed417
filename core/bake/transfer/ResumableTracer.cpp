#include "core/bake/transfer/ResumableTracer.h"

#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

namespace patina {
namespace {

constexpr std::string_view kDoes = "computes this bake"; // who holds its checkpoint

Result<PassState> readCheckpoint(const std::filesystem::path& file, const BakeManifest& here,
                                 const PassWork& work) {
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
    if (Result<void> read = readBakeState(file, work.ranges, work.stride, state); !read)
        return read.error();
    return state;
}

// Of the shard's points, the samples that are taken; each pass but the first doubles them.
double tracedShare(const PassState& state, const PassWork& work, const PassShard& shard) {
    double share = 0.0;
    std::size_t points = 0;
    for (std::size_t r = 0; r < work.ranges.size(); ++r) {
        if (!shard.holds(r))
            continue;
        const PointRange& range = work.ranges[r];
        for (const std::uint8_t done : std::span(state.passes).subspan(range.first, range.count))
            share += done == 0 ? 0.0 : std::ldexp(1.0, done - work.passes);
        points += range.count;
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

Result<std::optional<PassState>> ResumableTracer::trace(const PassWork& work) {
    hold();
    BakeManifest& manifest = m_settings.manifest;
    manifest.points = work.points;
    manifest.ranges = work.ranges.size();

    PassState state;
    std::error_code ignored;
    if (m_settings.resume && std::filesystem::exists(m_settings.checkpoint, ignored)) {
        Result<PassState> read = readCheckpoint(m_settings.checkpoint, manifest, work);
        if (!read)
            return read.error();
        state = std::move(read).value();
        m_resumedFrom = state.samplesDone;
        m_kept = true;
    }

    Checkpointer checkpointer(m_settings.checkpoint, manifest, work.ranges, m_settings.warn);
    const auto keep = [&](const PassState& now, bool complete) {
        if (!m_settings.checkpoint.empty() &&
            checkpointer.write(now, complete, tracedShare(now, work, manifest.shard)))
            m_kept = true;
    };
    PassCallbacks callbacks = work.callbacks;
    callbacks.checkpointSeconds = m_settings.everySeconds;
    callbacks.checkpoint = [&](const PassState& now) {
        if (!work.job.cancelled() || m_settings.keepOnCancel)
            keep(now, false);
    };
    const auto start = std::chrono::steady_clock::now();
    Result<PassState> traced = work.run(manifest.shard, callbacks, std::move(state));
    if (!traced)
        return traced.error();
    m_samplesDone = traced->samplesDone;
    m_complete = !work.job.stopping() || traced->samplesDone == work.samples;

    // What follows (fit, bounces, writing) may take long or fail as well.
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (m_complete ? seconds >= m_settings.everySeconds : m_settings.keepOnCancel)
        keep(*traced, m_complete);
    if (m_settings.part.empty())
        return std::optional(std::move(traced).value());
    manifest.complete = m_complete;
    manifest.samplesDone = traced->samplesDone;
    manifest.done = tracedShare(*traced, work, manifest.shard);
    if (Result<void> written = writeBakeCheckpoint(m_settings.part, manifest, *traced, work.ranges,
                                                   StateFileName::OfUser);
        !written)
        return written.error();
    return std::optional<PassState>();
}

} // namespace patina
