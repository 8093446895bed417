// Work in the background: what takes whose place, in what order, and how it ends. The owner's
// thread is the test's, which makes the calls that wait for it in until().
#include "core/job/TaskRunner.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <gtest/gtest.h>
#include <map>
#include <mutex>
#include <new>
#include <set>
#include <stdexcept>
#include <sys/resource.h>
#include <thread>
#include <unistd.h>

namespace patina {
namespace {

using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""s;

constexpr auto kLongEnough = 60s; // on a busy machine; nothing waits so long where all is well

class OwnThread {
  public:
    [[nodiscard]] TaskRunner::Post post() {
        return [this](std::function<void()> call) {
            {
                const std::lock_guard lock(m_mutex);
                m_calls.push_back(std::move(call));
            }
            m_posted.notify_all();
        };
    }
    // Makes calls until it holds; false when it never does.
    template <class Condition>
    [[nodiscard]] bool until(Condition condition) {
        const auto end = std::chrono::steady_clock::now() + kLongEnough;
        while (!condition()) {
            std::function<void()> call;
            {
                std::unique_lock lock(m_mutex);
                if (m_calls.empty() && std::chrono::steady_clock::now() >= end)
                    return false;
                m_posted.wait_for(lock, 1ms, [this] { return !m_calls.empty(); });
                if (m_calls.empty())
                    continue;
                call = std::move(m_calls.front());
                m_calls.pop_front();
            }
            call();
        }
        return true;
    }
    [[nodiscard]] bool hasCalls() {
        const std::lock_guard lock(m_mutex);
        return !m_calls.empty();
    }

  private:
    std::mutex m_mutex;
    std::condition_variable m_posted;
    std::deque<std::function<void()>> m_calls;
};

// Holds work up until it is opened.
class Barrier {
  public:
    void open() { m_open = true; }
    void wait() const {
        while (!m_open)
            std::this_thread::sleep_for(1ms);
    }

  private:
    std::atomic<bool> m_open = false;
};

// How many work at once, and at most did.
struct Crowd {
    struct Member {
        explicit Member(Crowd& joined)
            : crowd(joined) {
            const int now = ++crowd.now;
            int before = crowd.most;
            while (before < now && !crowd.most.compare_exchange_weak(before, now)) {
            }
        }
        ~Member() { --crowd.now; }
        Crowd& crowd;
    };
    std::atomic<int> now = 0, most = 0;
};

void runUntilCancelled(const JobContext& job) {
    while (!job.cancelled())
        std::this_thread::sleep_for(1ms);
}

const auto ignore = [](const auto&) {};

struct TaskRunnerTest : ::testing::Test {
    OwnThread here;
};

TEST_F(TaskRunnerTest, TheNewestWinsAmongMany) {
    TaskRunner runner(here.post());
    TaskGroup tasks(runner);
    constexpr int kCount = 1000;
    std::vector<int> applied;
    std::atomic<int> ended = 0, begun = 0;
    Crowd crowd;
    for (int i = 0; i < kCount; ++i) {
        const int before = begun;
        tasks.run(
            {.tag = "light"},
            [&, i](const JobContext& job) {
                const Crowd::Member member(crowd);
                ++begun;
                if (i + 1 < kCount) // only the cancel ends these
                    runUntilCancelled(job);
                ++ended;
                return i;
            },
            [&](const Result<int>& result) { applied.push_back(result.value()); });
        if (i % 20 == 0) { // some are replaced while they run, the others while they wait
            ASSERT_TRUE(here.until([&] { return begun > before; }));
        }
    }
    ASSERT_TRUE(here.until([&] { return !tasks.busy(); }));
    EXPECT_EQ(applied, std::vector<int>{kCount - 1});
    ASSERT_TRUE(tasks.waitForDone(kLongEnough));
    EXPECT_EQ(begun, ended);
    EXPECT_LE(crowd.most, TaskLimits().normal) << "the pool is bounded";
    EXPECT_EQ(applied.size(), 1u);
}

TEST_F(TaskRunnerTest, FollowKeepsWhatRunsAndTheNewestBehindIt) {
    TaskRunner runner(here.post());
    TaskGroup tasks(runner);
    Barrier go;
    Crowd crowd;
    std::vector<int> applied;
    const auto request = [&](int i) {
        tasks.run(
            {.tag = "drag", .policy = TaskPolicy::Follow},
            [&, i](const JobContext&) {
                const Crowd::Member member(crowd);
                go.wait();
                return i;
            },
            [&](const Result<int>& result) {
                applied.push_back(result.value());
                EXPECT_FALSE(here.hasCalls()) << "the next begins when this is applied";
            });
    };
    for (int i = 0; i < 5; ++i) {
        request(i); // the first is kept even where no thread has got to it yet
        if (i == 2) {
            ASSERT_TRUE(here.until([&] { return crowd.now == 1; }));
        }
    }
    go.open();
    ASSERT_TRUE(here.until([&] { return !tasks.busy(); }));
    EXPECT_EQ(applied, (std::vector<int>{0, 4}));
    EXPECT_EQ(crowd.most, 1);

    // A cancelled one still ends before the next begins.
    std::atomic<bool> sawCancel = false;
    tasks.run(
        {.tag = "drag", .policy = TaskPolicy::Follow},
        [&](const JobContext& job) {
            const Crowd::Member member(crowd);
            runUntilCancelled(job);
            sawCancel = true;
        },
        [&](const Result<void>&) { applied.push_back(-1); });
    ASSERT_TRUE(here.until([&] { return crowd.now == 1; }));
    tasks.cancel("drag");
    EXPECT_FALSE(tasks.busy());
    request(5);
    ASSERT_TRUE(here.until([&] { return !tasks.busy(); }));
    EXPECT_TRUE(sawCancel);
    EXPECT_EQ(applied, (std::vector<int>{0, 4, 5}));
    EXPECT_EQ(crowd.most, 1);
}

TEST_F(TaskRunnerTest, AQueueKeepsItsOrderAndHoldsUpNobodyElse) {
    TaskRunner runner(here.post());
    TaskGroup tasks(runner), others(runner);
    Barrier go;
    Crowd crowd;
    std::vector<int> applied;
    for (int i = 0; i < 50; ++i)
        tasks.run(
            {.tag = "queue", .policy = TaskPolicy::Queue},
            [&, i](const JobContext&) {
                const Crowd::Member member(crowd);
                go.wait();
                return i;
            },
            [&](const Result<int>& result) { applied.push_back(result.value()); });
    // Another tag, and the same tag of another owner.
    int beside = 0;
    tasks.run(
        {.tag = "other", .policy = TaskPolicy::Queue}, [](const JobContext&) {},
        [&](const Result<void>&) { ++beside; });
    others.run(
        {.tag = "queue", .policy = TaskPolicy::Queue}, [](const JobContext&) {},
        [&](const Result<void>&) { ++beside; });
    ASSERT_TRUE(here.until([&] { return beside == 2; }));
    EXPECT_TRUE(applied.empty());
    go.open();
    ASSERT_TRUE(here.until([&] { return !tasks.busy(); }));
    ASSERT_EQ(applied.size(), 50u);
    EXPECT_TRUE(std::ranges::is_sorted(applied));
    EXPECT_EQ(crowd.most, 1);
}

TEST_F(TaskRunnerTest, WhatMustBeDoneIsDone) {
    std::vector<int> written, applied;
    Barrier go;
    {
        TaskRunner runner(here.post());
        {
            TaskGroup tasks(runner);
            const auto save = [&](int i) {
                tasks.run(
                    {.tag = "save", .policy = TaskPolicy::Exclusive},
                    [&, i](const JobContext& job) {
                        go.wait();
                        EXPECT_FALSE(job.cancelled());
                        written.push_back(i); // one at a time
                        return i;
                    },
                    [&](const Result<int>& result) { applied.push_back(result.value()); });
            };
            save(0);
            save(1);
            // Neither takes it back.
            tasks.cancel("save");
            tasks.cancelAll();
            tasks.run(
                {.tag = "save"}, [](const JobContext&) {}, ignore);
            EXPECT_TRUE(tasks.busy("save"));
            go.open();
            ASSERT_TRUE(here.until([&] { return !tasks.busy(); }));
            EXPECT_EQ(applied, (std::vector<int>{0, 1}));
            save(2); // these wait when the owner ends
            save(3);
        }
        EXPECT_EQ(written, (std::vector<int>{0, 1, 2, 3}));
        TaskGroup tasks(runner);
        for (int i = 4; i < 8; ++i)
            tasks.run(
                {.tag = "save", .policy = TaskPolicy::Exclusive},
                [&, i](const JobContext&) { written.push_back(i); }, ignore);
        EXPECT_TRUE(runner.shutDown(0ms)) << "whatever the patience";
        EXPECT_EQ(written.size(), 8u);
    }
    EXPECT_EQ(written, (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7}));
}

TEST_F(TaskRunnerTest, AnotherThreadMayWaitForWhatIsBeingSaved) {
    Barrier go;
    TaskRunner runner(here.post());
    EXPECT_TRUE(runner.finishExclusive(0ms)) << "nothing is";
    TaskGroup tasks(runner);
    std::atomic<int> written = 0;
    const auto work = [&](const JobContext&) {
        go.wait();
        ++written;
    };
    for (int i = 0; i < 2; ++i)
        tasks.run({.tag = "save", .policy = TaskPolicy::Exclusive, .priority = TaskPriority::High},
                  work, ignore);
    Barrier never;
    tasks.run(
        {.tag = "cache", .policy = TaskPolicy::Exclusive, .priority = TaskPriority::Low},
        [&](const JobContext&) { never.wait(); }, ignore);
    EXPECT_FALSE(runner.finishExclusive(10ms));
    std::thread other([&] { EXPECT_TRUE(runner.finishExclusive(60s)); });
    go.open();
    other.join();
    EXPECT_EQ(written, 2);
    never.open();
    ASSERT_TRUE(here.until([&] { return !tasks.busy(); }));
}

TEST_F(TaskRunnerTest, WhatWorkThrowsIsAnErrorThatNamesIt) {
    TaskRunner runner(here.post());
    TaskGroup tasks(runner);
    std::vector<Error> errors;
    const auto run = [&](auto work) {
        tasks.run({.tag = "t", .policy = TaskPolicy::Queue, .name = "Opening chair.obj"}, work,
                  [&](const Result<int>& result) {
                      if (!result)
                          errors.push_back(result.error());
                      else
                          EXPECT_EQ(result.value(), 7);
                  });
    };
    run([](const JobContext&) -> int { throw std::runtime_error("no such thing"); });
    run([](const JobContext&) -> int { throw std::bad_alloc(); });
    run([](const JobContext&) -> int { throw 3; }); // NOLINT(hicpp-exception-baseclass)
    run([](const JobContext&) -> Result<int> {
        return Error{ErrorKind::InputMissing, "there is no file", "chair.obj", {}};
    });
    run([](const JobContext&) { return 7; }); // goes on as if nothing had been
    ASSERT_TRUE(here.until([&] { return !tasks.busy(); }));
    ASSERT_EQ(errors.size(), 4u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(errors[i].kind, ErrorKind::Internal);
        EXPECT_EQ(errors[i].message.rfind("Opening chair.obj: ", 0), 0u) << errors[i].message;
    }
    EXPECT_EQ(errors[0].detail, "no such thing");
    EXPECT_NE(errors[1].message.find("memory ran out"), std::string::npos);
    EXPECT_EQ(errors[3].kind, ErrorKind::InputMissing) << "an error of its own stays as it is";
}

TEST_F(TaskRunnerTest, NothingIsAppliedOnceItsOwnerIsGone) {
    TaskRunner runner(here.post());
    bool applied = false, changed = false;
    auto owner = std::make_unique<TaskGroup>(runner, [&] { changed = true; });
    owner->run(
        {.tag = "a"}, [](const JobContext&) { return 1; },
        [&](const Result<int>&) { applied = true; });
    ASSERT_TRUE(owner->waitForDone(kLongEnough)); // the call waits for this thread now
    changed = false;
    owner.reset();
    // Another's call comes behind it.
    TaskGroup after(runner);
    bool done = false;
    after.run(
        {.tag = "a"}, [](const JobContext&) {}, [&](const Result<void>&) { done = true; });
    ASSERT_TRUE(here.until([&] { return done; }));
    EXPECT_FALSE(applied);
    EXPECT_FALSE(changed);

    // In the middle of work: it is cancelled and waited for, for it refers to what ends now.
    std::atomic<bool> begun = false, ended = false;
    owner = std::make_unique<TaskGroup>(runner);
    owner->run(
        {.tag = "a"},
        [&](const JobContext& job) {
            begun = true;
            runUntilCancelled(job);
            ended = true;
        },
        [&](const Result<void>&) { applied = true; });
    ASSERT_TRUE(here.until([&] { return begun.load(); }));
    owner.reset();
    EXPECT_TRUE(ended);

    // By its own result.
    owner = std::make_unique<TaskGroup>(runner);
    owner->run(
        {.tag = "a"}, [](const JobContext&) {}, [&](const Result<void>&) { owner.reset(); });
    EXPECT_TRUE(here.until([&] { return owner == nullptr; }));
}

TEST_F(TaskRunnerTest, TheEndCancelsAndWaits) {
    std::atomic<int> begun = 0, ended = 0;
    bool applied = false;
    {
        TaskRunner runner(here.post());
        TaskGroup tasks(runner);
        for (const TaskPriority priority :
             {TaskPriority::Low, TaskPriority::Normal, TaskPriority::High, TaskPriority::Job})
            for (const char* tag : {"a", "b"})
                tasks.run(
                    {.tag = tag + std::to_string(static_cast<int>(priority)), .priority = priority},
                    [&](const JobContext& job) {
                        ++begun;
                        runUntilCancelled(job);
                        ++ended;
                    },
                    [&](const Result<void>&) { applied = true; });
        ASSERT_TRUE(here.until([&] { return begun == 8; }));
        EXPECT_TRUE(runner.shutDown(kLongEnough));
        EXPECT_EQ(ended, 8);
        EXPECT_FALSE(tasks.busy());
        tasks.run(
            {.tag = "late"}, [&](const JobContext&) { ++begun; }, ignore);
        EXPECT_FALSE(tasks.busy()) << "nothing is started any more";
    }
    EXPECT_EQ(begun, 8);
    EXPECT_TRUE(here.until([&] { return !here.hasCalls(); })); // of a runner that is gone
    EXPECT_FALSE(applied);

    // What does not listen is reported, not waited for.
    Barrier go;
    TaskRunner runner(here.post());
    TaskGroup tasks(runner);
    std::atomic<bool> runs = false;
    tasks.run(
        {.tag = "deaf"},
        [&](const JobContext&) {
            runs = true;
            go.wait();
        },
        ignore);
    ASSERT_TRUE(here.until([&] { return runs.load(); }));
    EXPECT_FALSE(runner.shutDown(1ms));
    go.open();
    EXPECT_TRUE(runner.shutDown(kLongEnough));
}

// From the cancel on: at once for the owner, with its next look for the work.
TEST_F(TaskRunnerTest, ACancelIsSeenByTheNextPoll) {
    TaskRunner runner(here.post());
    TaskGroup tasks(runner);
    std::atomic<int> polls = 0, pollsAfter = 0;
    std::atomic<bool> told = false, ended = false;
    bool applied = false;
    tasks.run(
        {.tag = "long"},
        [&](const JobContext& job) {
            while (true) {
                const bool after = told;
                ++polls;
                if (job.cancelled())
                    break;
                pollsAfter += after ? 1 : 0;
                std::this_thread::sleep_for(1ms);
            }
            ended = true;
        },
        [&](const Result<void>&) { applied = true; });
    ASSERT_TRUE(here.until([&] { return polls > 3; }));
    tasks.cancel("long");
    told = true;
    EXPECT_FALSE(tasks.busy());
    EXPECT_TRUE(tasks.waitForDone(kLongEnough));
    EXPECT_TRUE(ended);
    EXPECT_EQ(pollsAfter, 0);
    EXPECT_TRUE(here.until([&] { return !here.hasCalls(); }));
    EXPECT_FALSE(applied);
}

// A job is told by its control, and what it then comes to is applied: a stop keeps what there is.
TEST_F(TaskRunnerTest, WhatAStoppedJobKeepsIsApplied) {
    TaskRunner runner(here.post());
    TaskGroup tasks(runner);
    std::optional<int> kept;
    JobControl control = tasks.run(
        {.tag = "bake", .priority = TaskPriority::Job},
        [](const JobContext& job) {
            int passes = 0;
            do {
                job.setProgress(0.1 * ++passes);
                std::this_thread::sleep_for(1ms);
            } while (!job.stopping());
            return passes;
        },
        [&](const Result<int>& result) { kept = result.value(); });
    ASSERT_TRUE(here.until([&] { return control.progress().fraction > 0.0; }));
    control.stop();
    ASSERT_TRUE(here.until([&] { return kept.has_value(); }));
    EXPECT_GT(*kept, 0);
}

TEST_F(TaskRunnerTest, TheHighestPriorityGoesFirstAndFindsAThreadFree) {
    TaskRunner runner(here.post(), {.low = 1, .normal = 3, .keptForHigh = 2});
    TaskGroup tasks(runner);
    Barrier go;
    std::vector<std::string> order; // of applies
    std::atomic<bool> begun = false;
    const auto run = [&](const std::string& tag, TaskPriority priority, auto work) {
        tasks.run({.tag = tag, .priority = priority}, work,
                  [&, tag](const Result<void>&) { order.push_back(tag); });
    };
    // A hung file takes the one thread that tasks of its priority may take.
    run("hung", TaskPriority::Normal, [&](const JobContext&) {
        begun = true;
        go.wait();
    });
    ASSERT_TRUE(here.until([&] { return begun.load(); }));
    run("waits", TaskPriority::Normal, [](const JobContext&) {});
    run("save", TaskPriority::High, [](const JobContext&) {});
    run("idle", TaskPriority::Low, [](const JobContext&) {});
    ASSERT_TRUE(here.until([&] { return order.size() == 2; }));
    EXPECT_EQ(std::set<std::string>(order.begin(), order.end()),
              (std::set<std::string>{"save", "idle"}));
    go.open();
    ASSERT_TRUE(here.until([&] { return !tasks.busy(); }));

    // One thread, and all wait for it.
    order.clear();
    TaskRunner narrow(here.post(), {.low = 1, .normal = 1, .keptForHigh = 0});
    TaskGroup few(narrow);
    Barrier second;
    std::atomic<bool> holds = false;
    few.run(
        {.tag = "first"},
        [&](const JobContext&) {
            holds = true;
            second.wait();
        },
        ignore);
    ASSERT_TRUE(here.until([&] { return holds.load(); }));
    for (const auto& [tag, priority] :
         {std::pair("n1", TaskPriority::Normal), std::pair("n2", TaskPriority::Normal),
          std::pair("h1", TaskPriority::High), std::pair("h2", TaskPriority::High)})
        few.run(
            {.tag = tag, .priority = priority}, [](const JobContext&) {},
            [&, tag = tag](const Result<void>&) { order.emplace_back(tag); });
    second.open();
    ASSERT_TRUE(here.until([&] { return !few.busy(); }));
    EXPECT_EQ(order, (std::vector<std::string>{"h1", "h2", "n1", "n2"}));
}

TEST_F(TaskRunnerTest, LowTasksAndJobsYieldToTheRest) {
    TaskRunner runner(here.post());
    TaskGroup tasks(runner);
    std::map<TaskPriority, int> nice;
    const int own = ::getpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()));
    // The end of a low one lets a normal one begin, whose thread must not take after it.
    Barrier go;
    int behind = -1;
    tasks.run(
        {.tag = "q", .policy = TaskPolicy::Queue, .priority = TaskPriority::Low},
        [&](const JobContext&) { go.wait(); }, ignore);
    tasks.run(
        {.tag = "q", .policy = TaskPolicy::Exclusive},
        [](const JobContext&) {
            return ::getpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()));
        },
        [&](const Result<int>& result) { behind = result.value(); });
    go.open();
    ASSERT_TRUE(here.until([&] { return !tasks.busy(); }));
    EXPECT_EQ(behind, own);
    {
        TaskRunner fresh(here.post());
        bool done = false;
        {
            TaskGroup ends(fresh);
            ends.run({.tag = "q", .policy = TaskPolicy::Queue, .priority = TaskPriority::Low},
                     runUntilCancelled, ignore);
            ends.run(
                {.tag = "q", .policy = TaskPolicy::Exclusive},
                [&](const JobContext&) { done = true; }, ignore);
        } // while this thread waits, it still starts the thread
        EXPECT_TRUE(done);
    }
    for (const TaskPriority priority :
         {TaskPriority::Low, TaskPriority::Normal, TaskPriority::High, TaskPriority::Job})
        tasks.run(
            {.tag = std::to_string(static_cast<int>(priority)), .priority = priority},
            [](const JobContext&) {
                return ::getpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()));
            },
            [&, priority](const Result<int>& result) { nice[priority] = result.value(); });
    ASSERT_TRUE(here.until([&] { return !tasks.busy(); }));
    EXPECT_EQ(nice[TaskPriority::Normal], own);
    EXPECT_EQ(nice[TaskPriority::High], own);
    EXPECT_EQ(nice[TaskPriority::Low], std::max(own, 10));
    EXPECT_EQ(nice[TaskPriority::Job], std::max(own, 10));
}

// More jobs than the pool has threads: a paused one holds up neither others nor tasks.
TEST_F(TaskRunnerTest, JobsHaveThreadsOfTheirOwn) {
    TaskRunner runner(here.post(), {.low = 1, .normal = 1, .keptForHigh = 0});
    TaskGroup tasks(runner);
    std::vector<JobControl> controls;
    std::atomic<int> begun = 0;
    int ended = 0;
    for (int i = 0; i < 8; ++i)
        controls.push_back(tasks.run(
            {.tag = "job" + std::to_string(i), .priority = TaskPriority::Job},
            [&](const JobContext& job) {
                ++begun;
                runUntilCancelled(job);
            },
            [&](const Result<void>&) { ++ended; }));
    ASSERT_TRUE(here.until([&] { return begun == 8; }));
    bool done = false;
    tasks.run(
        {.tag = "low", .priority = TaskPriority::Low}, [](const JobContext&) {},
        [&](const Result<void>&) { done = true; });
    ASSERT_TRUE(here.until([&] { return done; }));
    for (JobControl& control : controls)
        control.cancel(); // not dropped: it says how it ended
    ASSERT_TRUE(here.until([&] { return ended == 8; }));
}

TEST_F(TaskRunnerTest, TellsWhatItDoes) {
    TaskRunner runner(here.post());
    int changes = 0;
    TaskGroup tasks(runner, [&] { ++changes; });
    Barrier go;
    const auto work = [&](const JobContext&) { go.wait(); };
    EXPECT_EQ(tasks.activity(), "");
    tasks.run({.tag = "a", .name = "Opening a"}, work, ignore);
    tasks.run({.tag = "b 1", .name = "Opening b"}, work, ignore);
    tasks.run({.tag = "c", .policy = TaskPolicy::Exclusive, .name = "Saving c"}, work, ignore);
    EXPECT_EQ(changes, 3);
    EXPECT_EQ(tasks.activity(), "Saving c");
    EXPECT_TRUE(tasks.busy("a"));
    tasks.cancelAll({"b"});
    EXPECT_FALSE(tasks.busy("a"));
    EXPECT_TRUE(tasks.busy("b 1"));
    EXPECT_TRUE(tasks.busy("c"));
    EXPECT_FALSE(tasks.waitForDone(1ms));
    go.open();
    ASSERT_TRUE(here.until([&] { return !tasks.busy(); }));
    EXPECT_EQ(tasks.activity(), "");
    EXPECT_GE(changes, 6);
}

} // namespace
} // namespace patina
