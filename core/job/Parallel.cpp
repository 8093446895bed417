#include "core/job/Parallel.h"

#include "core/job/ForkJoin.h"

#include <algorithm>
#include <atomic>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_scheduler_observer.h>
#include <sys/resource.h>
#include <thread>
#include <unistd.h>

namespace patina {

void parallelFor(const JobContext& job, std::size_t count, std::size_t grain,
                 const std::function<void(std::size_t, std::size_t)>& body) {
    if (count == 0)
        return;
    const std::size_t step = std::max<std::size_t>(grain, 1);
    const std::size_t chunks = (count + step - 1) / step;
    std::atomic<std::size_t> next = 0; // what a thread takes is the first that nobody took
    while (next < chunks && !job.cancelled()) {
        job.waitWhilePaused();
        ForkJoin forkJoin;
        tbb::parallel_for(
            tbb::blocked_range<std::size_t>(next, chunks, 1),
            [&](const tbb::blocked_range<std::size_t>& range) {
                const ForkJoin::Branch branch(forkJoin);
                for (std::size_t i = range.begin(); i != range.end(); ++i) {
                    job.giveWay();
                    if (job.cancelled() || job.paused())
                        return;
                    const std::size_t chunk = next.fetch_add(1);
                    body(chunk * step, std::min(count, (chunk + 1) * step));
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

namespace {

// Lowers each of the pool's threads as it starts to work.
class PriorityObserver : public tbb::task_scheduler_observer {
  public:
    PriorityObserver() { observe(true); }
    ~PriorityObserver() override { observe(false); }
    PriorityObserver(const PriorityObserver&) = delete;
    PriorityObserver& operator=(const PriorityObserver&) = delete;
    void on_scheduler_entry(bool isWorker) override {
        if (isWorker)
            lowerThreadPriority();
    }
};

} // namespace

void lowerThreadPriority() {
    // On Linux nice values belong to threads. Failing (a policy forbids it) costs only fluidity.
    static_cast<void>(::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), 10));
}

void lowerPoolPriority() {
    static PriorityObserver observer; // as long-lived as the pool, which belongs to the process
}

int threadCount() {
    return static_cast<int>(
        tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

} // namespace patina
