// Traces a bake, or one shard of it, so that nothing is lost: keeps a checkpoint every so often,
// and goes on from one. While it lives the checkpoint is its own: one that another bake writes, of
// whichever process, is neither read nor touched; that is a warning, and the bake goes on without.
#pragma once

#include "core/bake/transfer/BakeCheckpoint.h"
#include "core/bake/transfer/BakeTracer.h"
#include "core/base/CheckpointLock.h"

#include <filesystem>
#include <optional>

namespace patina {

struct ResumeSettings {
    BakeManifest manifest;            // of this bake; points and ranges are filled in
    std::filesystem::path checkpoint; // where it is kept; empty: nowhere
    double everySeconds = 30.0;
    bool resume = false;          // go on from the file, if it is there
    bool keepOnCancel = false;    // write it once more when the job is cancelled or stopped
    std::filesystem::path part;   // where the shard's part goes; empty: the bake goes on to its end
    Checkpointer::Warn warn = {}; // of a checkpoint that cannot be written; the bake goes on
};

class ResumableTracer : public BakeTracer {
  public:
    explicit ResumableTracer(ResumeSettings settings)
        : m_settings(std::move(settings)) {}

    // Errors besides those of the work: those of readBakeState(), InputBroken for the checkpoint of
    // another bake; those of writeBakeCheckpoint() for the part.
    Result<std::optional<PassState>> trace(const PassWork& work) override;

    // Of which nobody has any more use. False when there is none of this bake.
    bool removeCheckpoint();
    [[nodiscard]] bool keptCheckpoint() const { return m_kept; } // the file is there, up to date
    [[nodiscard]] int samplesDone() const { return m_samplesDone; }
    [[nodiscard]] int resumedFrom() const { return m_resumedFrom; } // its samplesDone, or -1
    // Every point of the shard has what it should have; else it was stopped before.
    [[nodiscard]] bool complete() const { return m_complete; }

  private:
    void hold(); // the checkpoint, or there is none from now on

    ResumeSettings m_settings;
    CheckpointLock m_lock;
    bool m_kept = false, m_complete = false;
    int m_resumedFrom = -1, m_samplesDone = 0;
};

} // namespace patina
