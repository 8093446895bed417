// The thread that watches over a command: it shows progress and turns SIGINT and SIGTERM into a
// cancel, or into a stop where a partial result is wanted.
#pragma once

#include "app/cli/Options.h"
#include "core/job/JobContext.h"

#include <atomic>
#include <csignal>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>

namespace patina::cli {

class Watcher {
  public:
    explicit Watcher(const CommonOptions& options);
    ~Watcher();
    Watcher(const Watcher&) = delete;
    Watcher& operator=(const Watcher&) = delete;

    // The work's progress starts anew with each phase: opening a scene, then baking it. A cancel
    // stays one.
    void beginPhase();
    [[nodiscard]] JobControl control() const; // of the current phase

    void showProgress() { m_showsProgress = true; }
    void hideProgress() { m_showsProgress = false; }
    void allowPartialResult() { m_partialAllowed = true; }
    // `checkpoint` may be there when a signal comes. With `endsInOrder` the work writes it then and
    // is given the time; a second signal ends it at once.
    void expectCheckpoint(std::filesystem::path checkpoint, bool endsInOrder);
    void end(); // no progress and no hard exit from here on; clears the bar

    [[nodiscard]] int signal() const { return m_signal; } // the first one that came, or 0
    [[nodiscard]] bool stoppedEarly() const { return m_stoppedEarly; }

  private:
    void run();
    [[nodiscard]] bool onSignal(int signal); // whether the process is to end by itself
    [[noreturn]] void leave();
    void update();
    void clearBar();

    mutable std::mutex m_mutex; // guards m_control, m_checkpoint, m_endsInOrder
    JobControl m_control;
    std::filesystem::path m_checkpoint;
    bool m_endsInOrder = false;
    const CommonOptions& m_options;
    const bool m_terminal; // standard error is one
    int m_pipe[2] = {-1, -1};
    struct sigaction m_previousInt {
    }, m_previousTerm{};
    std::atomic<bool> m_showsProgress = false, m_partialAllowed = false, m_stoppedEarly = false;
    std::atomic<int> m_signal = 0;
    std::atomic<int> m_lastStep = -1; // of 5 %, that was printed
    bool m_barShown = false;
    std::thread m_thread;
};

} // namespace patina::cli
