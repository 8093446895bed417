// SIGTERM, SIGHUP and SIGINT from the first moment of the editor on: the system or the user's
// terminal ends it. A thread hears of them whatever the window is busy with (a driver may compile
// shaders for half a minute): the editor has some time to end in order, and is ended then. A second
// signal ends it at once.
#pragma once

#include "core/base/FileDescriptor.h"

#include <chrono>
#include <functional>
#include <mutex>
#include <thread>

namespace patina::editor {

class TerminationWatch {
  public:
    static constexpr int kStatus = 128; // plus the signal's number, as shells say it
    // For the end in order. Tests have less patience.
    static constexpr std::chrono::milliseconds kPatience{1000};

    // One for the process, the first thing that main() does. Signals that it was started to ignore
    // (nohup) stay ignored.
    explicit TerminationWatch(std::chrono::milliseconds patience = kPatience);
    ~TerminationWatch(); // signals end the process again
    TerminationWatch(const TerminationWatch&) = delete;
    TerminationWatch& operator=(const TerminationWatch&) = delete;

    // All are called on the watch's thread, the first two when a signal has come. Until somebody
    // ends in order nothing is unsaved, and the process ends at once.
    void atSignal(std::function<void()> hook);
    void endInOrder(std::function<void(int signal)> hook);
    // The time is up: what must not be lost goes to the disk, and then the process ends.
    void atLast(std::function<void()> hook);
    // Forgets the last two; waits for one that is running.
    void release();

  private:
    void watch();
    [[nodiscard]] int nextByte(int timeoutMs) const; // -1: none came

    const std::chrono::milliseconds m_patience;
    FileDescriptor m_read, m_write;
    std::mutex m_mutex; // guards the hooks, and is held while they run
    std::function<void()> m_atSignal, m_atLast;
    std::function<void(int)> m_endInOrder;
    bool m_hadOwner = false; // somebody has ended, or ends, in order
    std::thread m_thread;
};

} // namespace patina::editor
