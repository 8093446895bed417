// Loops over all cores. The only part of Patina that sees oneTBB.
#pragma once

#include "core/job/JobContext.h"

#include <cstddef>
#include <functional>

namespace patina {

// Calls body(begin, end) for consecutive ranges that cover 0…count, each at most `grain` long, on
// the pool's threads; returns when all are done. Ranges start in ascending order, but results must
// depend neither on the order nor on the number of threads. After a cancel no new range starts.
// While the job is paused none starts either, and the pool's threads are free for others: only the
// caller waits. An exception thrown by the body reaches the caller.
void parallelFor(const JobContext& job, std::size_t count, std::size_t grain,
                 const std::function<void(std::size_t begin, std::size_t end)>& body);

// Limits the pool for the life of the object: `threads` = 0 means all cores.
class ThreadLimit {
  public:
    explicit ThreadLimit(int threads);
    ~ThreadLimit();
    ThreadLimit(const ThreadLimit&) = delete;
    ThreadLimit& operator=(const ThreadLimit&) = delete;

  private:
    void* m_control;
};

// From now on the pool's threads yield to everything else the user does (nice 10), so that a bake
// leaves the editor fluid. Linux; elsewhere without effect.
void lowerPoolPriority();
void lowerThreadPriority(); // the same for the calling thread

[[nodiscard]] int threadCount(); // threads the pool may use now

} // namespace patina
