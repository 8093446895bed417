#include "core/trace/file/FilmTracer.h"

#include "core/base/Check.h"
#include "core/trace/file/FilmTiles.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <fmt/format.h>
#include <mutex>
#include <string_view>

namespace patina {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::string_view kDoes = "traces this picture"; // who holds its checkpoint
// Samples of a pass, and so between two looks at the noise.
constexpr std::uint32_t kMostOfAPass = 16;

} // namespace

void FilmTracer::hold() {
    m_lock.hold(m_settings.checkpoint, kDoes, m_settings.warn);
}

bool FilmTracer::removeCheckpoint() {
    m_kept = false;
    return m_lock.remove(m_settings.checkpoint, kDoes, m_settings.warn);
}

Result<void> FilmTracer::readCheckpoint() {
    const std::filesystem::path& file = m_settings.checkpoint;
    const FilmManifest& here = m_settings.manifest;
    const Result<FilmManifest> there = readFilmManifest(file);
    if (!there)
        return there.error();
    const auto refuse = [&](const std::string& why) {
        return Error{ErrorKind::InputBroken,
                     fmt::format("this checkpoint is of another picture: they differ in {}; remove "
                                 "it, or render without resuming",
                                 why),
                     file,
                     {}};
    };
    if (const auto why = whyDifferent(*there, here))
        return refuse(*why);
    if (there->hasOutputs != here.hasOutputs)
        return refuse("what is written besides the picture");
    if (there->shard != here.shard)
        return refuse(fmt::format("the part (part {} of {} there, {} of {} here)",
                                  there->shard.index + 1, there->shard.count, here.shard.index + 1,
                                  here.shard.count));
    if (const Result<FilmManifest> read = readFilm(file, m_film, m_outputs); !read)
        return read.error();
    m_resumedFrom = samplesOf(m_film, here.shard).least;
    m_kept = true;
    return {};
}

void FilmTracer::updateManifest(bool complete) {
    FilmManifest& manifest = m_settings.manifest;
    const FilmSamples samples = samplesOf(m_film, manifest.shard);
    manifest.complete = complete;
    manifest.samples = samples.least;
    manifest.done = complete ? 1.0 : std::min(samples.mean / m_settings.samples, 1.0);
}

bool FilmTracer::keepResult() {
    return keep(m_settings.manifest.complete);
}

bool FilmTracer::keep(bool complete) {
    if (m_settings.checkpoint.empty())
        return false;
    updateManifest(complete);
    const Result<void> written = writeFilm(m_settings.checkpoint, m_settings.manifest, m_film,
                                           m_outputs, StateFileName::Own);
    m_kept = m_kept || written.ok();
    if (!written && !m_warned && m_settings.warn)
        m_settings.warn(written.error());
    m_warned = m_warned || !written;
    return written.ok();
}

Result<void> FilmTracer::trace(const TraceScene& scene, const TraceView& view,
                               const PathSettings& paths, const JobContext& job) {
    CHECK(m_settings.manifest.width == view.width && m_settings.manifest.height == view.height);
    return trace(
        [&](Film& film, std::uint32_t first, std::uint32_t count, const JobContext& context,
            const TraceTiles& tiles) {
            return tracePaths(scene, view, paths, film, first, count, context, nullptr, tiles);
        },
        job);
}

Result<void> FilmTracer::trace(const FilmPass& tracePass, const JobContext& job) {
    FilmManifest& manifest = m_settings.manifest;
    const int width = manifest.width, height = manifest.height;
    CHECK(!m_settings.noise || manifest.shard.count == 1);
    hold();
    m_film = Film(width, height);
    if (manifest.hasOutputs)
        m_outputs = TraceOutputs(width, height);
    std::error_code ignored;
    if (m_settings.resume && !m_settings.checkpoint.empty() &&
        std::filesystem::exists(m_settings.checkpoint, ignored))
        if (Result<void> read = readCheckpoint(); !read)
            return read;

    const auto start = Clock::now();
    const std::chrono::duration<double> every(m_settings.everySeconds);
    std::mutex film, keeping; // of the film's pixels; of the two below and the checkpoint
    Clock::time_point kept = start;
    const std::size_t tiles =
        tileCount(width, height) / static_cast<std::size_t>(manifest.shard.count);
    std::atomic<std::size_t> tilesDone = 0;
    double before = 0.0, after = 1.0; // progress, at the ends of the pass
    TraceTiles around{manifest.shard, &film, [&] {
                          const double share = static_cast<double>(++tilesDone) /
                                               static_cast<double>(std::max<std::size_t>(tiles, 1));
                          job.setProgress(before + (after - before) * std::min(share, 1.0));
                          // Threads that finish a pixel meanwhile wait until it is written.
                          const std::unique_lock one(keeping, std::try_to_lock);
                          if (!one || m_settings.checkpoint.empty() || job.cancelled() ||
                              Clock::now() - kept < every)
                              return;
                          const std::lock_guard still(film);
                          keep(false);
                          kept = Clock::now();
                      }};

    around.outputs = manifest.hasOutputs ? &m_outputs : nullptr;

    // Passes of 1, 2, 4, 8, 16, 16 … samples. One that a checkpoint has already is passed over,
    // and its noise was looked at then unless nothing came after it.
    std::uint32_t done = 0;
    bool certain = false;
    for (std::uint32_t pass = 1; done < m_settings.samples && !certain && !job.stopping();
         pass = std::min(2 * pass, kMostOfAPass)) {
        pass = std::min(pass, m_settings.samples - done);
        std::string activity =
            fmt::format("{}{} {} per pixel", m_settings.of, done, m_settings.unit);
        if (m_noise)
            activity += fmt::format(", ± {:.2f} %", 100.0 * *m_noise);
        job.setActivity(activity);
        after = static_cast<double>(done + pass) / m_settings.samples;
        // The error falls with the root of the paths.
        if (m_settings.noise && m_noise) {
            const double wanted = *m_settings.noise / *m_noise;
            after = std::max(after, std::min(wanted * wanted * (done + pass) / done, 1.0));
        }
        after = std::max(after, before);
        tilesDone = 0;
        if (samplesOf(m_film, manifest.shard).least < done + pass) {
            if (Result<void> traced = tracePass(m_film, done, pass, job, around); !traced) {
                if (m_settings.keepOnCancel)
                    keep(false);
                return traced;
            }
        }
        done += pass;
        before = after;
        job.setProgress(before);
        const FilmSamples samples = samplesOf(m_film, manifest.shard);
        if (manifest.shard.count > 1 || samples.least != done || samples.most != done)
            continue;
        m_noise = m_film.noise();
        certain = m_settings.noise && m_noise && *m_noise <= *m_settings.noise;
    }
    if (manifest.shard.count == 1)
        m_noise = m_film.noise(); // also of a pass that was stopped
    const FilmSamples samples = samplesOf(m_film, manifest.shard);
    const bool complete = samples.mean == 0.0 ? shardPixels(width, height, manifest.shard) == 0
                                              : certain || samples.least == m_settings.samples;

    // What follows (writing the picture) may fail as well.
    if (complete ? Clock::now() - start >= every : m_settings.keepOnCancel)
        keep(complete);
    updateManifest(complete);
    return {};
}

} // namespace patina
