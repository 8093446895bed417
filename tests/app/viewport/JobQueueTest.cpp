#include "app/editor/job/JobQueue.h"

#include <gtest/gtest.h>
#include <vector>

using patina::editor::JobPriority;
using patina::editor::nextJob;
using patina::editor::WaitingJob;

TEST(JobQueue, TheHighestPriorityGoesFirst) {
    EXPECT_EQ(nextJob({}), std::nullopt);
    std::vector<WaitingJob> jobs{{1, JobPriority::Low, false, true},
                                 {2, JobPriority::Normal, false, false},
                                 {3, JobPriority::High, false, false},
                                 {4, JobPriority::High, false, false}};
    EXPECT_EQ(nextJob(jobs), 3u) << "even if another has begun; the older of two";
    jobs[2].paused = true;
    EXPECT_EQ(nextJob(jobs), 4u);
    jobs[3].priority = JobPriority::Normal;
    EXPECT_EQ(nextJob(jobs), 2u);
    jobs[3].begun = true;
    EXPECT_EQ(nextJob(jobs), 4u) << "what has begun goes on before its equals";
    for (WaitingJob& job : jobs)
        job.paused = true;
    EXPECT_EQ(nextJob(jobs), std::nullopt);
}
