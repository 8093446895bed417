#include "core/job/JobContext.h"
#include "core/job/Parallel.h"
#include "core/job/ProgressRate.h"
#include "core/job/WorkGate.h"

#include <atomic>
#include <chrono>
#include <functional>
#include <gtest/gtest.h>
#include <mutex>
#include <set>
#include <stdexcept>
#include <sys/resource.h>
#include <thread>
#include <unistd.h>
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

namespace {

// On a thread that has given its priority up.
void onLowThread(const std::function<void()>& work) {
    std::thread thread([&] {
        lowerThreadPriority();
        work();
    });
    thread.join();
}

int priorityHere() {
    return ::getpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()));
}

} // namespace

// Whoever waits is not slowed down by what ran at low priority before: a thread cannot get back
// what it gave up.
TEST(Parallel, ThreadsOfLowPriorityAreOthers) {
    const ThreadLimit limit(4);
    startPool();
    const int own = priorityHere();
    const auto seen = [] {
        std::mutex mutex;
        std::set<int> priorities;
        std::set<std::thread::id> threads;
        parallelFor({}, 64, 1, [&](std::size_t, std::size_t) {
            for (int i = 0; i < 1000; ++i) // so that the others come, too
                std::this_thread::yield();
            const std::lock_guard lock(mutex);
            priorities.insert(priorityHere());
            threads.insert(std::this_thread::get_id());
        });
        EXPECT_LE(threads.size(), 4u);
        return priorities;
    };
    EXPECT_EQ(seen(), std::set{own});
    std::set<int> low;
    onLowThread([&] { low = seen(); });
    EXPECT_EQ(low, std::set{std::max(own, 10)});
    EXPECT_EQ(seen(), std::set{own});
}

TEST(Parallel, LowThreadsDoAllOnceAndNested) {
    for (const int threads : {1, 2, 4}) {
        const ThreadLimit limit(threads);
        onLowThread([] {
            std::vector<std::atomic<int>> seen(60 * 20);
            parallelFor({}, 60, 1, [&](std::size_t outer, std::size_t) {
                parallelFor({}, 20, 3, [&](std::size_t begin, std::size_t end) {
                    for (std::size_t i = begin; i < end; ++i)
                        ++seen[outer * 20 + i];
                });
            });
            for (const auto& count : seen)
                ASSERT_EQ(count.load(), 1);
        });
    }
}

void expectNothingStartsAfterACancel() {
    JobControl control;
    std::atomic<int> ranges = 0;
    parallelFor(control.context(), 1'000'000, 1, [&](std::size_t, std::size_t) {
        ++ranges;
        control.cancel();
    });
    EXPECT_LE(ranges.load(), 64);
}

TEST(Parallel, LowThreadsPauseEndAndThrowAsTheOthersDo) {
    const ThreadLimit limit(4);
    onLowThread([] {
        EXPECT_THROW(parallelFor({}, 100, 1,
                                 [](std::size_t begin, std::size_t) {
                                     if (begin == 40)
                                         throw std::runtime_error("broken");
                                 }),
                     std::runtime_error);
        expectNothingStartsAfterACancel();

        JobControl rests;
        std::vector<std::atomic<int>> seen(200);
        std::atomic<bool> paused = false;
        std::thread resumes([&] {
            while (!paused)
                std::this_thread::yield();
            rests.resume();
        });
        parallelFor(rests.context(), seen.size(), 1, [&](std::size_t begin, std::size_t) {
            ++seen[begin];
            if (begin == 50) {
                rests.pause();
                paused = true;
            }
        });
        resumes.join();
        for (const auto& count : seen)
            EXPECT_EQ(count.load(), 1);
    });
}

TEST(Parallel, StartsNothingAfterACancel) {
    expectNothingStartsAfterACancel();
}

TEST(Job, APartsProgressIsAShareOfTheWhole) {
    JobControl control;
    const JobContext half = control.context().part(0.5, 1.0), quarter = half.part(0.0, 0.5);
    quarter.setProgress(0.0);
    EXPECT_DOUBLE_EQ(control.progress().fraction, 0.5);
    quarter.setProgress(0.5);
    EXPECT_DOUBLE_EQ(control.progress().fraction, 0.625);
    half.setProgress(7.0);
    EXPECT_DOUBLE_EQ(control.progress().fraction, 1.0);
    control.cancel();
    EXPECT_TRUE(quarter.cancelled()) << "it is the same work";
}

TEST(Job, GivesWayWhileTheGateIsClosed) {
    using namespace std::chrono_literals;
    using Clock = WorkGate::Clock;
    const auto gate = std::make_shared<WorkGate>();
    JobControl control(gate);
    const JobContext job = control.context();
    JobControl().context().giveWay(); // of one without a gate
    job.giveWay();                    // open

    // Whoever closes it and forgets it does not hold work up for ever.
    gate->close();
    const Clock::time_point closed = Clock::now();
    job.giveWay();
    EXPECT_GE(Clock::now() - closed, WorkGate::kLongestWait);

    // A loop stands still until it opens; unless the machine is so busy that this takes long.
    gate->close();
    const Clock::time_point begin = Clock::now();
    std::atomic<bool> opened = false;
    std::thread opener([&] {
        std::this_thread::sleep_for(30ms);
        opened = true;
        gate->open();
    });
    parallelFor(job, 1, 1, [&](std::size_t, std::size_t) {
        EXPECT_TRUE(opened || Clock::now() - begin >= WorkGate::kLongestWait);
    });
    opener.join();

    // The end of the job is the end of every wait.
    control.cancel();
    int waited = 0; // or the machine was busy
    for (int i = 0; i < 50; ++i) {
        gate->close();
        const Clock::time_point before = Clock::now();
        job.giveWay();
        waited += Clock::now() - before >= WorkGate::kLongestWait ? 1 : 0;
    }
    EXPECT_LT(waited, 50);
}

TEST(Job, TimeStandsStillWhileItRests) {
    using namespace std::chrono_literals;
    JobControl control;
    control.pause();
    control.pause(); // asking twice counts once
    const double before = control.progress().secondsSoFar;
    std::this_thread::sleep_for(30ms);
    EXPECT_EQ(control.progress().secondsSoFar, before);
    const auto resumed = std::chrono::steady_clock::now();
    control.resume();
    const double after = control.progress().secondsSoFar;
    const std::chrono::duration<double> since = std::chrono::steady_clock::now() - resumed;
    EXPECT_LE(after, before + since.count() + 1e-6) << "what it rested is not counted";
    std::this_thread::sleep_for(5ms);
    EXPECT_GE(control.progress().secondsSoFar, before + 0.005);
}

TEST(Job, StopAndCancelEndTheRestForGood) {
    for (const bool cancel : {false, true}) {
        JobControl control;
        control.pause();
        std::thread work([job = control.context()] { job.waitWhilePaused(); });
        EXPECT_TRUE(control.context().paused());
        if (cancel)
            control.cancel();
        else
            control.stop();
        work.join(); // or this test never ends
        control.pause();
        EXPECT_FALSE(control.paused()) << "who is told to end does not rest";
    }
}

TEST(Parallel, StartsRangesInAscendingOrder) {
    const ThreadLimit limit(1);
    std::vector<std::size_t> order;
    parallelFor(JobContext(), 1000, 10,
                [&](std::size_t begin, std::size_t) { order.push_back(begin); });
    ASSERT_EQ(order.size(), 100u);
    EXPECT_TRUE(std::is_sorted(order.begin(), order.end()));
}

// Rests in the middle; then does the rest of the work, each range once.
TEST(Parallel, ARestLeavesThePoolAndLosesNothing) {
    JobControl control;
    std::vector<std::atomic<int>> seen(2000);
    std::atomic<int> ranges = 0;
    std::thread work([&] {
        parallelFor(control.context(), seen.size(), 1, [&](std::size_t begin, std::size_t) {
            ++seen[begin];
            if (++ranges == 500)
                control.pause();
        });
    });
    while (ranges < 500)
        std::this_thread::yield();
    // Another job gets the pool meanwhile.
    std::atomic<int> others = 0;
    parallelFor(JobContext(), 100, 1, [&](std::size_t, std::size_t) { ++others; });
    EXPECT_EQ(others, 100);
    EXPECT_LT(ranges, 2000) << "what was asked to rest went on";
    control.resume();
    work.join();
    for (const auto& count : seen)
        ASSERT_EQ(count.load(), 1);
}

TEST(ProgressRate, CountsFromWhereTheWorkWentOn) {
    ProgressRate rate;
    JobProgress now;
    now.fraction = 0.6; // from a checkpoint
    now.secondsSoFar = 1.0;
    rate.add(now);
    EXPECT_EQ(rate.workPerSecond(), 0.0);
    EXPECT_LT(rate.secondsLeft(), 0.0);
    now.fraction = 0.7;
    now.workDone = 4e6;
    now.secondsSoFar = 3.0;
    rate.add(now);
    EXPECT_DOUBLE_EQ(rate.workPerSecond(), 2e6);
    EXPECT_NEAR(rate.secondsLeft(), 6.0, 1e-9); // 0.3 at 0.05 a second
    rate.add(now);                              // no time has passed: it rests
    EXPECT_DOUBLE_EQ(rate.workPerSecond(), 2e6);
}

TEST(ProgressRate, ForgetsHowItWasLongAgo) {
    ProgressRate rate;
    JobProgress now;
    for (int i = 0; i <= 100; ++i) { // 10 s at 1 a second, then 10 s at 3 a second
        now.secondsSoFar = 0.2 * i;
        now.workDone += i <= 50 ? 0.2 : 0.6;
        now.fraction = now.workDone / 100.0;
        rate.add(now);
    }
    EXPECT_NEAR(rate.workPerSecond(), 3.0, 1e-9);
    EXPECT_NEAR(rate.secondsLeft(), (1.0 - now.fraction) / 0.03, 1e-6);
}

TEST(Parallel, ExceptionsReachTheCaller) {
    EXPECT_THROW(parallelFor(JobContext(), 10, 1,
                             [](std::size_t, std::size_t) { throw std::runtime_error("x"); }),
                 std::runtime_error);
}
