#include "core/job/Parallel.h"

#include "core/job/ForkJoin.h"
#include "core/job/LowThreads.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <sys/resource.h>
#include <thread>
#include <unistd.h>

namespace patina {

namespace {

// This thread gave its priority up. Aligned at least as what follows it in a program: with
// mold 1.10 thread-local memory of a smaller alignment that comes to lie on the last bytes of a
// page makes a program that does not start ("cannot apply additional memory protection after
// relocation").
alignas(64) thread_local bool t_isLow = false;

LowThreads& lowThreads() {
    static LowThreads threads; // as long-lived as oneTBB's, which belong to the process
    return threads;
}

} // namespace

void parallelFor(const JobContext& job, std::size_t count, std::size_t grain,
                 const std::function<void(std::size_t, std::size_t)>& body) {
    if (count == 0)
        return;
    const std::size_t step = std::max<std::size_t>(grain, 1);
    const std::size_t chunks = (count + step - 1) / step;
    std::atomic<std::size_t> next = 0; // what a thread takes is the first that nobody took
    const auto ends = [&] { return job.cancelled() || job.paused(); };
    const auto takeOne = [&] {
        const std::size_t chunk = next.fetch_add(1);
        if (chunk < chunks)
            body(chunk * step, std::min(count, (chunk + 1) * step));
    };
    while (next < chunks && !job.cancelled()) {
        job.waitWhilePaused();
        if (t_isLow) {
            std::atomic<bool> failed = false;
            const auto left = static_cast<int>(std::min<std::size_t>(chunks - next, 1024));
            lowThreads().run(std::min(threadCount(), left) - 1, [&] {
                try {
                    while (next < chunks && !failed) {
                        job.giveWay();
                        if (ends())
                            return;
                        takeOne();
                    }
                } catch (...) {
                    failed = true;
                    throw;
                }
            });
            continue;
        }
        ForkJoin forkJoin;
        tbb::parallel_for(
            tbb::blocked_range<std::size_t>(next, chunks, 1),
            [&](const tbb::blocked_range<std::size_t>& range) {
                const ForkJoin::Branch branch(forkJoin);
                for (std::size_t i = range.begin(); i != range.end(); ++i) {
                    job.giveWay();
                    if (ends())
                        return;
                    takeOne();
                }
            },
            tbb::simple_partitioner{});
    }
}

ThreadLimit::ThreadLimit(int threads)
    : m_control(nullptr) {
    const std::size_t count = threads > 0
                                  ? static_cast<std::size_t>(threads)
                                  : std::max<std::size_t>(std::thread::hardware_concurrency(), 1);
    m_control = new tbb::global_control(tbb::global_control::max_allowed_parallelism, count);
}

ThreadLimit::~ThreadLimit() {
    delete static_cast<tbb::global_control*>(m_control);
}

void lowerThreadPriority() {
    t_isLow = true;
    // On Linux nice values belong to threads. Failing (a policy forbids it) costs only fluidity.
    static_cast<void>(::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), 10));
}

void startPool() {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point patience = Clock::now() + std::chrono::milliseconds(50);
    const int count = threadCount();
    std::atomic<int> arrived = 0;
    tbb::parallel_for(
        tbb::blocked_range<int>(0, count, 1),
        [&](const tbb::blocked_range<int>&) {
            ++arrived;
            while (arrived < count && Clock::now() < patience) // or one would do it all
                std::this_thread::yield();
        },
        tbb::simple_partitioner{});
}

int threadCount() {
    return static_cast<int>(
        tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

} // namespace patina
