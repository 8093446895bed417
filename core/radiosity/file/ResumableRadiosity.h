// Keeps a radiosity, or one shard of its light and form factors, while it is computed, so that
// nothing is lost: a checkpoint every so often, from which it goes on. While it lives the
// checkpoint is its own: one that another process writes is neither read nor touched; that is a
// warning, and the work goes on without.
#pragma once

#include "core/base/CheckpointLock.h"
#include "core/radiosity/file/RadiosityFile.h"

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>

namespace patina::radiosity {

struct RadiosityKeeping {
    RadiosityManifest manifest = {};       // of this solution and shard
    std::filesystem::path checkpoint = {}; // where it is kept; empty: nowhere
    double everySeconds = 30.0;
    bool resume = false;         // go on from the file, if it is there
    bool keepOnCancel = false;   // write it once more when the job is cancelled or stopped
    std::size_t maxRowBytes = 0; // of rows that are gone on with; 0: no limit
    std::function<void(const Error&)> warn = {}; // of a checkpoint that cannot be written, once
};

class ResumableRadiosity : public SolveKeeper {
  public:
    explicit ResumableRadiosity(RadiosityKeeping settings)
        : m_settings(std::move(settings)) {}

    // Errors: those of readRadiosityManifest() and readRadiosity(); InputBroken for the checkpoint
    // of another solution.
    Result<void> divide(ElementMesh& elements) override;
    Result<void> begin(const TraceScene& scene, const ElementMesh& elements) override;
    void between(const SolverView& solver) override;

    // The work has ended. What follows may take long or fail as well: keeps what there is, if it
    // took long; of one that was interrupted, if that is asked for.
    void finish(bool interrupted);
    // Keeps what could not be written. False when that cannot be written either.
    bool keepResult() { return keep(viewOf(m_state.solver)); }
    // The part that the shard has found. Errors: those of writeFileAtomically().
    Result<void> writePart(const std::filesystem::path& file);
    // Of which nobody has any more use. False when there is none of this solution.
    bool removeCheckpoint();
    [[nodiscard]] bool keptCheckpoint() const { return m_kept; } // the file is there, up to date
    // What it went on from, or nothing.
    [[nodiscard]] const std::optional<RadiosityManifest>& resumedFrom() const { return m_from; }

  private:
    using Clock = std::chrono::steady_clock;

    void hold();                         // the checkpoint, or there is none from now on
    bool keep(const SolverView& solver); // false when it was not written

    RadiosityKeeping m_settings;
    CheckpointLock m_lock;
    std::optional<RadiosityManifest> m_from;
    std::mutex m_keeping; // of the two below and the checkpoint
    Clock::time_point m_last = Clock::now();
    bool m_kept = false, m_warned = false;
    const Clock::time_point m_start = Clock::now();
};

} // namespace patina::radiosity
