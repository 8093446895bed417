// Traces a picture, or one shard of it, pass after pass, so that nothing is lost: keeps a
// checkpoint every so often, and goes on from one. While it lives the checkpoint is its own: one
// that another process writes is neither read nor touched; that is a warning, and the work goes on
// without.
#pragma once

#include "core/base/CheckpointLock.h"
#include "core/base/Result.h"
#include "core/job/JobContext.h"
#include "core/trace/file/FilmFile.h"
#include "core/trace/path/PathTracer.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

namespace patina {

struct FilmTracerSettings {
    FilmManifest manifest;            // of this picture and shard
    std::uint32_t samples = 1;        // of a pixel, at most
    std::optional<double> noise;      // ends at this share of the mean; a whole picture only
    std::filesystem::path checkpoint; // where it is kept; empty: nowhere
    double everySeconds = 30.0;
    bool resume = false;       // go on from the file, if it is there
    bool keepOnCancel = false; // write it once more when the job is cancelled or stopped
    std::function<void(const Error&)> warn; // of a checkpoint that cannot be written, once
    std::string unit = "paths";             // what a sample is
    std::string of = {};                    // what the job's activity begins with
};

// Adds samples to a film, as tracePaths() does: of these numbers, to all pixels of the tiles'
// shard.
using FilmPass = std::function<Result<void>(Film& film, std::uint32_t first, std::uint32_t count,
                                            const JobContext& job, const TraceTiles& tiles)>;

class FilmTracer {
  public:
    explicit FilmTracer(FilmTracerSettings settings)
        : m_settings(std::move(settings)) {}

    // Errors: Cancelled; those of readFilm(), InputBroken for the checkpoint of another picture.
    Result<void> trace(const FilmPass& pass, const JobContext& job);
    Result<void> trace(const TraceScene& scene, const TraceView& view, const PathSettings& paths,
                       const JobContext& job);

    [[nodiscard]] const Film& film() const { return m_film; }
    [[nodiscard]] const TraceOutputs& outputs() const { return m_outputs; } // or empty
    // What the film belongs to and how far it has come.
    [[nodiscard]] const FilmManifest& manifest() const { return m_settings.manifest; }
    // Film::noise(), of a shard nothing.
    [[nodiscard]] const std::optional<double>& noise() const { return m_noise; }

    // Writes the checkpoint of what was traced, whose result could not be written. False when it
    // cannot be written either.
    bool keepResult();
    // Of which nobody has any more use. False when there is none of this picture.
    bool removeCheckpoint();
    [[nodiscard]] bool keptCheckpoint() const { return m_kept; } // the file is there, up to date
    // The samples of each pixel that it went on from, or nothing.
    [[nodiscard]] const std::optional<std::uint32_t>& resumedFrom() const { return m_resumedFrom; }

  private:
    void hold(); // the checkpoint, or there is none from now on
    Result<void> readCheckpoint();
    bool keep(bool complete); // the checkpoint, as the film is; false when it was not written
    void updateManifest(bool complete);

    FilmTracerSettings m_settings;
    CheckpointLock m_lock;
    Film m_film;
    TraceOutputs m_outputs;
    std::optional<double> m_noise;
    bool m_kept = false, m_warned = false;
    std::optional<std::uint32_t> m_resumedFrom;
};

} // namespace patina
