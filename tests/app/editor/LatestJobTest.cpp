// The editor's end of a request that the newest one replaces.

#include "app/editor/job/LatestJob.h"
#include "app/editor/job/UiTasks.h"

#include <QTest>
#include <QThread>
#include <atomic>
#include <gtest/gtest.h>
#include <stdexcept>
#include <vector>

namespace patina::editor {
namespace {

TEST(LatestJob, KeepsTheNewestOfWhatIsAskedMeanwhile) {
    TaskRunner runner(postToThisThread());
    LatestJob job(runner, "test");
    std::atomic<bool> go = false;
    std::vector<int> applied;
    for (int i = 0; i < 5; ++i)
        job.request([&, i](const JobContext&) -> LatestJob::Apply {
            while (!go)
                QThread::msleep(1);
            return [&applied, i] { applied.push_back(i); };
        });
    EXPECT_TRUE(job.busy());
    go = true;
    ASSERT_TRUE(QTest::qWaitFor([&] { return !job.busy(); }, 30'000));
    EXPECT_EQ(applied, (std::vector<int>{0, 4})) << "the first goes on, the last follows";
}

TEST(LatestJob, ACancelledOneAppliesNothingAndTheNextRuns) {
    TaskRunner runner(postToThisThread());
    LatestJob job(runner, "test");
    std::vector<int> applied;
    std::atomic<bool> begun = false, sawCancel = false;
    job.request([&](const JobContext& context) -> LatestJob::Apply {
        begun = true;
        while (!context.cancelled())
            QThread::msleep(1);
        sawCancel = true;
        return [&] { applied.push_back(1); };
    });
    ASSERT_TRUE(QTest::qWaitFor([&] { return begun.load(); }, 30'000));
    job.cancel();
    EXPECT_FALSE(job.busy());
    job.request(
        [&](const JobContext&) -> LatestJob::Apply { return [&] { applied.push_back(2); }; });
    ASSERT_TRUE(QTest::qWaitFor([&] { return !job.busy(); }, 30'000));
    EXPECT_TRUE(sawCancel);
    EXPECT_EQ(applied, std::vector<int>{2});
}

TEST(LatestJob, AnExceptionEndsOneRequestOnly) {
    TaskRunner runner(postToThisThread());
    LatestJob job(runner, "test");
    bool applied = false;
    job.request([](const JobContext&) -> LatestJob::Apply { throw std::runtime_error("no"); });
    ASSERT_TRUE(QTest::qWaitFor([&] { return !job.busy(); }, 30'000));
    job.request([&](const JobContext&) -> LatestJob::Apply { return [&] { applied = true; }; });
    ASSERT_TRUE(QTest::qWaitFor([&] { return applied; }, 30'000));
}

} // namespace
} // namespace patina::editor
