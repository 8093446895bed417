// Loops over all cores. The only part of Patina that sees oneTBB.
#pragma once

#include "core/job/JobContext.h"

#include <cstddef>
#include <functional>

namespace patina {

// Calls body(begin, end) for consecutive ranges that cover 0…count, each at most `grain` long, on
// the pool's threads, or on those of low priority where the caller has that (LowThreads); returns
// when all are done. Ranges start in ascending order, but results must
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

// From now on the calling thread, and those that work for it, yield to everything else the user
// does (nice 10), so that a bake leaves the editor fluid: for good. Linux.
void lowerThreadPriority();
// Starts the pool's threads, which have the priority of whoever starts them: before a thread of low
// priority does, in a library that shares them (Embree).
void startPool();

[[nodiscard]] int threadCount(); // threads the pool may use now

} // namespace patina
