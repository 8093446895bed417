// Work in the background, all of it in one place: a bounded pool of threads, one rule for what
// takes whose place, one border that no exception crosses, and one end. What work comes to is
// applied on the thread that owns the runner (the editor's UI thread).
//
// Everything here is called by that thread alone. Work gets values and a JobContext, which it
// polls.
#pragma once

#include "core/base/Result.h"
#include "core/job/JobContext.h"

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace patina {

// Between tasks of one tag of one group; tasks of different tags know nothing of each other.
enum class TaskPolicy {
    // Cancels and drops what it replaces, waiting or running, and does not wait for the end of
    // that.
    Newest,
    // Waits for the end of the first, which is applied, so that results keep coming while something
    // is dragged, and replaces what waits for that already. Never two at once.
    Follow,
    Queue, // one after another, the highest priority first
    // One after another, and for good: nothing replaces or cancels it, and the end of the group or
    // of the runner waits for it. For what must be done, such as saving.
    Exclusive,
};

enum class TaskPriority {
    Low,    // whatever else the user does goes first (lowerThreadPriority)
    Normal, // somebody waits, but it may wait itself: for a disk, for another process
    High,   // what the user is watching, and short; saving. Threads are kept free for it
    // Has a thread of its own, at low priority and beyond the pool's bound: it may take hours and
    // pause meanwhile. Whoever starts jobs decides how many. The runner's end waits for them.
    Job,
};

struct TaskSpec {
    std::string tag;
    TaskPolicy policy = TaskPolicy::Newest;
    TaskPriority priority = TaskPriority::Normal;
    std::string name = {};                          // in messages; empty: the tag
    std::shared_ptr<const WorkGate> gate = nullptr; // where the work waits for frames
};

// Threads of the pool. They start when they are needed, and end when they have been idle.
struct TaskLimits {
    int low = 6;         // for tasks of low priority
    int normal = 8;      // for all others but jobs
    int keptForHigh = 2; // of the latter: not for tasks of normal priority
};

class TaskRunner {
  public:
    // Has the owner's thread make the call later. Any thread may call it, as long as the runner
    // lives.
    using Post = std::function<void(std::function<void()> call)>;

    explicit TaskRunner(Post post, TaskLimits limits = {});
    ~TaskRunner(); // shutDown(), and waits for all work
    TaskRunner(const TaskRunner&) = delete;
    TaskRunner& operator=(const TaskRunner&) = delete;

    // From now on nothing is started. Cancels everything but Exclusive tasks; waits for those and
    // for jobs to their end, and for the rest as long as `patience`. False when something still
    // runs.
    bool shutDown(std::chrono::milliseconds patience);
    // Waits for Exclusive tasks of high priority, from any thread; false after `patience`.
    bool finishExclusive(std::chrono::milliseconds patience);

  private:
    friend class TaskGroup;
    struct Impl;
    std::shared_ptr<Impl> m_impl;
};

namespace detail {
template <class T>
struct TaskValue {
    using type = T;
};
template <class T>
struct TaskValue<Result<T>> {
    using type = T;
};
} // namespace detail

// The tasks of one owner. When the group ends they are cancelled and waited for, and nothing of
// them is applied any more; so what they refer to stands before it.
class TaskGroup {
  public:
    // `changed` is called after busy() or activity() may have become another.
    explicit TaskGroup(TaskRunner& runner, std::function<void()> changed = {});
    ~TaskGroup();
    TaskGroup(const TaskGroup&) = delete;
    TaskGroup& operator=(const TaskGroup&) = delete;

    // `work(const JobContext&)` returns T or Result<T>, or nothing (then T is void); it runs on a
    // thread of the pool. `apply(Result<T>)` follows on the owner's thread, unless the task was
    // replaced or cancelled. What work throws arrives as an error (Internal) that names it, and in
    // the log. The control pauses, stops or cancels the work; what that comes to is applied.
    template <class Work, class Apply>
    JobControl run(TaskSpec spec, Work work, Apply apply) {
        using Answer = std::invoke_result_t<Work&, const JobContext&>;
        using Value = typename detail::TaskValue<Answer>::type;
        auto found = std::make_shared<std::optional<Result<Value>>>();
        return start(
            std::move(spec),
            [work = std::move(work), found](const JobContext& job) mutable {
                if constexpr (std::is_void_v<Answer>) {
                    work(job);
                    found->emplace();
                } else {
                    found->emplace(work(job));
                }
            },
            [apply = std::move(apply), found](const std::optional<Error>& error) mutable {
                apply(error ? Result<Value>(*error) : std::move(**found));
            });
    }

    // Nothing of these is applied any more; those that must be done (Exclusive) are left alone.
    void cancel(const std::string& tag);
    void cancelAll(const std::vector<std::string>& but = {}); // except where the tag begins so
    // False when something still runs after so long. Applies nothing.
    bool waitForDone(std::chrono::milliseconds patience);

    // Of those that are not cancelled: one waits, runs, or is about to be applied.
    [[nodiscard]] bool busy() const;
    [[nodiscard]] bool busy(const std::string& tag) const;
    [[nodiscard]] std::string activity() const; // name of the newest such task; empty when idle

  private:
    JobControl start(TaskSpec spec, std::function<void(const JobContext&)> work,
                     std::function<void(const std::optional<Error>&)> apply);

    friend class TaskRunner;
    struct State;
    std::shared_ptr<TaskRunner::Impl> m_runner;
    std::shared_ptr<State> m_state;
};

} // namespace patina
