// The threads on which parallelFor() works for a thread of low priority. On Linux a thread cannot
// get back the priority that it gave up (neither nice values nor SCHED_IDLE, for a user without
// privileges), so those that work for somebody who waits are others: oneTBB's, which never give
// theirs up.
#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <list>
#include <mutex>
#include <thread>

namespace patina {

class LowThreads {
  public:
    LowThreads() = default;
    ~LowThreads();
    LowThreads(const LowThreads&) = delete;
    LowThreads& operator=(const LowThreads&) = delete;

    // Has the caller and up to `others` threads call `work` at the same time, each once, and
    // returns when all that did are back. Whoever comes back has left nothing to do. From inside
    // `work`, too. What is thrown reaches the caller.
    void run(int others, const std::function<void()>& work);

  private:
    struct Loop {
        const std::function<void()>* work;
        int places;     // for threads that may still join
        int inside = 0; // that did and are not back
        std::exception_ptr error;
    };
    void serve();
    [[nodiscard]] Loop* next(); // with a place; null: none has

    std::mutex m_mutex; // guards what follows
    std::condition_variable m_begun, m_ended;
    std::list<Loop*> m_loops; // the oldest first
    std::list<std::thread> m_threads;
    int m_idle = 0;
    bool m_closing = false;
};

} // namespace patina
