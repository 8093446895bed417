// Lets work of low priority step aside while something that somebody waits for is computed, such
// as a frame under a moving hand: a scheduler's priorities leave it a share even then, and what its
// threads have in hand where a frame's threads wake up.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>

namespace patina {

class WorkGate {
  public:
    using Clock = std::chrono::steady_clock;
    // Whoever closes it and does not come back holds work up no longer than this.
    static constexpr std::chrono::milliseconds kLongestClosed{500};
    // Who has waited this long passes, so that no work stands still.
    static constexpr std::chrono::milliseconds kLongestWait{100};

    // By one thread; both may be called again and again.
    void close();
    void open();

    // By the threads that work: returns when the gate is open. `ended` is asked meanwhile.
    template <class Ended>
    void pass(const Ended& ended) const {
        if (Clock::now().time_since_epoch().count() >=
            m_closedUntil.load(std::memory_order_relaxed))
            return;
        const Clock::time_point begin = Clock::now();
        while (!ended() && wait(begin)) {
        }
    }

  private:
    [[nodiscard]] bool wait(Clock::time_point begin) const; // for a while; true: still closed

    std::atomic<Clock::rep> m_closedUntil = 0; // of the clock; in the past: open
    mutable std::mutex m_mutex;
    mutable std::condition_variable m_opened;
};

} // namespace patina
