#include "core/job/JobContext.h"
#include "core/job/Parallel.h"

#include <atomic>
#include <gtest/gtest.h>
#include <stdexcept>
#include <vector>

using namespace patina;

TEST(Job, ProgressIsClampedAndStopIsNotCancel) {
    JobControl control;
    const JobContext job = control.context();
    job.setProgress(2.0);
    job.setActivity("tracing");
    job.addWork(10, "rays");
    EXPECT_EQ(control.progress().fraction, 1.0);
    EXPECT_EQ(control.progress().activity, "tracing");
    EXPECT_EQ(control.progress().workDone, 10.0);
    control.stop();
    EXPECT_TRUE(job.stopping());
    EXPECT_FALSE(job.cancelled());
    control.cancel();
    EXPECT_TRUE(job.cancelled());
}

TEST(Parallel, CoversEveryIndexOnceForAnyGrainAndThreadCount) {
    for (const int threads : {1, 2, 4}) {
        const ThreadLimit limit(threads);
        for (const std::size_t grain : {1u, 7u, 1000u, 5000u}) {
            std::vector<std::atomic<int>> seen(1234);
            parallelFor(JobContext(), seen.size(), grain, [&](std::size_t begin, std::size_t end) {
                EXPECT_LE(end - begin, grain);
                for (std::size_t i = begin; i < end; ++i)
                    ++seen[i];
            });
            for (const auto& count : seen)
                ASSERT_EQ(count.load(), 1);
        }
    }
}

TEST(Parallel, StartsNothingAfterACancel) {
    JobControl control;
    std::atomic<int> ranges = 0;
    parallelFor(control.context(), 1'000'000, 1, [&](std::size_t, std::size_t) {
        ++ranges;
        control.cancel();
    });
    EXPECT_LE(ranges.load(), 64);
}

TEST(Parallel, ExceptionsReachTheCaller) {
    EXPECT_THROW(parallelFor(JobContext(), 10, 1,
                             [](std::size_t, std::size_t) { throw std::runtime_error("x"); }),
                 std::runtime_error);
}
