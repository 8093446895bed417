// One run of a command: its worker process, its job with progress on standard error, and what
// SIGINT and SIGTERM do to it.
#pragma once

#include "app/cli/Options.h"
#include "app/cli/Report.h"
#include "core/job/JobContext.h"
#include "core/job/Parallel.h"
#include "core/worker/WorkerClient.h"

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>

namespace patina::cli {

class Watcher;

class Session {
  public:
    explicit Session(const CommonOptions& options);
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    [[nodiscard]] const CommonOptions& options() const { return m_options; }
    [[nodiscard]] WorkerClient& worker(); // its process starts with the first file
    // Before worker() is first asked for: most likely no image is read, and none but PNG is
    // written.
    void expectNoImages() { m_expectsImages = false; }
    [[nodiscard]] JobContext job() const; // of the current phase
    [[nodiscard]] Report& report() { return m_report; }

    // From here on standard error shows the job's progress, which starts anew.
    void beginPhase();
    void endProgress(); // before the user is asked something; the next phase shows it again
    // With --keep-partial: from here on the first signal means "finish with what there is".
    void allowPartialResult();
    [[nodiscard]] bool interrupted() const;
    // From here on a signal may leave `checkpoint` behind; see Watcher::expectCheckpoint().
    void expectCheckpoint(const std::filesystem::path& checkpoint, bool endsInOrder);
    // There is one to go on from, should the run end by a signal.
    void keptCheckpoint(const std::filesystem::path& checkpoint) { m_checkpoint = checkpoint; }

    // Ends the run: adds time, work and memory, prints the report. Returns the exit status.
    int finish(const Result<void>& result);

  private:
    CommonOptions m_options;
    std::chrono::steady_clock::time_point m_start = std::chrono::steady_clock::now();
    Report m_report;
    std::optional<ThreadLimit> m_threads;
    bool m_expectsImages = true;
    std::unique_ptr<WorkerClient> m_worker;
    std::unique_ptr<Watcher> m_watcher;
    std::filesystem::path m_checkpoint; // kept; empty: none
};

} // namespace patina::cli
