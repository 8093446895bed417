#include "core/job/TaskRunner.h"

#include "core/base/Log.h"
#include "core/job/Parallel.h"

#include <algorithm>
#include <array>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <fmt/format.h>
#include <list>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>

namespace patina {
namespace {

constexpr std::chrono::seconds kIdleLife(20); // of a thread without work

enum class Phase { Waiting, Running, Done };
// Threads cannot get back the priority that they gave up, so there are two pools of them, and
// threads that end with their job.
enum class Lane { Low, Normal, Job };
constexpr std::size_t kLanes = 3;

constexpr std::size_t indexOf(Lane lane) {
    return static_cast<std::size_t>(lane);
}

Lane laneOf(TaskPriority priority) {
    switch (priority) {
    case TaskPriority::Low:
        return Lane::Low;
    case TaskPriority::Job:
        return Lane::Job;
    case TaskPriority::Normal:
    case TaskPriority::High:
        break;
    }
    return Lane::Normal;
}

// The one border that exceptions do not cross.
std::optional<Error> runGuarded(const std::string& name,
                                const std::function<void(const JobContext&)>& work,
                                const JobContext& job) {
    const auto failed = [&](const char* how, const char* detail) {
        Error error{ErrorKind::Internal, fmt::format("{}: {}", name, how), {}, detail};
        logError("{}", error.text());
        return error;
    };
    try {
        work(job);
        return std::nullopt;
    } catch (const std::bad_alloc& exception) {
        return failed("memory ran out", exception.what());
    } catch (const std::exception& exception) {
        return failed("failed unexpectedly", exception.what());
    } catch (...) {
        return failed("failed unexpectedly", "an exception of unknown type");
    }
}

} // namespace

struct TaskGroup::State {
    std::function<void()> changed;
};

struct TaskRunner::Impl : std::enable_shared_from_this<TaskRunner::Impl> {
    struct Task {
        std::uint64_t id = 0;
        const TaskGroup::State* group = nullptr; // to compare
        std::weak_ptr<TaskGroup::State> owner;
        TaskSpec spec;
        JobControl control;
        std::function<void(const JobContext&)> work;
        std::function<void(const std::optional<Error>&)> apply;
        std::optional<Error> error;
        Phase phase = Phase::Waiting;
        bool wanted = true; // else it was replaced or cancelled

        [[nodiscard]] bool mustBeDone() const { return spec.policy == TaskPolicy::Exclusive; }
        [[nodiscard]] bool sameTag(const Task& other) const {
            return group == other.group && spec.tag == other.spec.tag;
        }
    };
    using TaskPtr = std::shared_ptr<Task>;

    Impl(Post postCall, TaskLimits threadLimits)
        : post(std::move(postCall))
        , limits(threadLimits) {}

    // --- With the mutex held ---------------------------------------------------------------------
    [[nodiscard]] bool mayStart(const Task& task) const {
        if (task.phase != Phase::Waiting)
            return false;
        int normal = 0; // tasks of this priority that run
        for (const TaskPtr& other : tasks) {
            if (other->phase == Phase::Running && other->spec.priority == TaskPriority::Normal)
                ++normal;
            if (task.spec.policy == TaskPolicy::Newest || !other->sameTag(task))
                continue;
            // The next of a drag begins when the last is applied, which may ask for another.
            const bool unapplied = task.spec.policy == TaskPolicy::Follow && other->wanted &&
                                   other->phase == Phase::Done;
            if (other->phase == Phase::Running || unapplied)
                return false;
            const bool older = other->id < task.id && other->phase == Phase::Waiting;
            if (older && other->spec.priority >= task.spec.priority)
                return false;
        }
        return task.spec.priority != TaskPriority::Normal ||
               normal < std::max(1, limits.normal - limits.keptForHigh);
    }
    [[nodiscard]] TaskPtr next(Lane lane) const {
        TaskPtr best;
        for (const TaskPtr& task : tasks) // the oldest first
            if (laneOf(task->spec.priority) == lane && mayStart(*task) &&
                (!best || task->spec.priority > best->spec.priority))
                best = task;
        return best;
    }
    [[nodiscard]] int ready(Lane lane) const {
        return static_cast<int>(std::ranges::count_if(tasks, [&](const TaskPtr& task) {
            return laneOf(task->spec.priority) == lane && mayStart(*task);
        }));
    }
    [[nodiscard]] int limit(Lane lane) const {
        if (lane == Lane::Job)
            return static_cast<int>(tasks.size());
        return lane == Lane::Low ? limits.low : limits.normal;
    }

    // Has threads for what may start. A thread has the priority of the one that starts it, or less:
    // those that gave theirs up start none of the normal lane.
    void wake(bool ofLowPriority = false) {
        for (const Lane lane : {Lane::Low, Lane::Normal, Lane::Job}) {
            const std::size_t l = indexOf(lane);
            if (lane == Lane::Normal && ofLowPriority)
                continue; // the owner's thread does, when it hears that this task is done
            for (int missing = ready(lane) - idle[l]; missing > 0 && threads[l] < limit(lane);
                 --missing)
                if (!addThread(lane))
                    break;
        }
        work.notify_all();
    }
    bool addThread(Lane lane) {
        for (std::thread& thread : ended) // they have let the mutex go for the last time
            thread.join();
        ended.clear();
        try {
            const auto place = running.emplace(running.end());
            *place = std::thread([this, lane, place] { serve(lane, place); });
        } catch (const std::system_error& error) {
            running.pop_back();
            logError("no thread could be started: {}", error.what());
            if (threads[indexOf(lane)] == 0)
                fail(lane, error.what());
            return false;
        }
        ++threads[indexOf(lane)];
        ++idle[indexOf(lane)]; // until it takes its first task
        return true;
    }
    // Without any thread these tasks would wait for ever.
    void fail(Lane lane, const char* reason) {
        while (const TaskPtr task = next(lane)) {
            task->error = Error{ErrorKind::Internal,
                                fmt::format("{}: the system is out of threads", nameOf(*task)),
                                {},
                                reason};
            task->phase = Phase::Done;
            postFinish(task->id);
        }
    }
    // Takes what waits out, or marks what runs as unwanted.
    void drop(const TaskPtr& task, std::vector<TaskPtr>& out) {
        task->control.cancel();
        task->wanted = false;
        if (task->phase == Phase::Waiting)
            out.push_back(task);
    }
    void erase(const std::vector<TaskPtr>& out) {
        std::erase_if(tasks,
                      [&](const TaskPtr& task) { return std::ranges::count(out, task) > 0; });
    }
    template <class Which>
    [[nodiscard]] bool any(Which which) const {
        return std::ranges::any_of(tasks, [&](const TaskPtr& task) { return which(*task); });
    }
    static const std::string& nameOf(const Task& task) {
        return task.spec.name.empty() ? task.spec.tag : task.spec.name;
    }

    // --- On the pool's threads -------------------------------------------------------------------
    void serve(Lane lane, std::list<std::thread>::iterator place) {
        if (lane != Lane::Normal)
            lowerThreadPriority();
        const std::size_t l = indexOf(lane);
        std::unique_lock lock(mutex);
        while (true) {
            if (const TaskPtr task = next(lane)) {
                --idle[l];
                execute(*task, lock);
                ++idle[l];
                wake(lane != Lane::Normal);
                continue;
            }
            if (closing || lane == Lane::Job)
                break;
            const auto wanted = [&] { return closing || next(lane) != nullptr; };
            if (!work.wait_for(lock, kIdleLife, wanted))
                break;
        }
        --idle[l];
        --threads[l];
        ended.splice(ended.end(), running, place);
    }
    void execute(Task& task, std::unique_lock<std::mutex>& lock) {
        task.phase = Phase::Running;
        auto run = std::exchange(task.work, nullptr);
        lock.unlock();
        std::optional<Error> error = runGuarded(nameOf(task), run, task.control.context());
        run = nullptr; // what it holds ends here
        lock.lock();
        task.error = std::move(error);
        task.phase = Phase::Done;
        postFinish(task.id);
        done.notify_all();
    }
    void postFinish(std::uint64_t id) {
        post([self = weak_from_this(), id] {
            if (const auto runner = self.lock())
                runner->finish(id);
        });
    }

    // --- On the owner's thread -------------------------------------------------------------------
    void finish(std::uint64_t id) {
        TaskPtr task;
        {
            const std::lock_guard lock(mutex);
            const auto found = std::ranges::find(tasks, id, &Task::id);
            if (found == tasks.end())
                return; // its group is gone
            task = *found;
            tasks.erase(found);
        }
        const std::weak_ptr<TaskGroup::State> owner = task->owner;
        if (owner.expired())
            return;
        if (task->wanted)
            task->apply(task->error);
        task.reset();
        {
            const std::lock_guard lock(mutex);
            wake();
        }
        notify(owner);
    }
    // The owner may have gone, and may go meanwhile.
    static void notify(const std::weak_ptr<TaskGroup::State>& owner) {
        std::function<void()> changed;
        if (const auto state = owner.lock())
            changed = state->changed;
        if (changed)
            changed();
    }

    const Post post;
    const TaskLimits limits;
    std::mutex mutex; // guards what follows
    std::condition_variable work, done;
    std::vector<TaskPtr> tasks; // the oldest first
    std::array<int, kLanes> threads{}, idle{};
    std::list<std::thread> running, ended; // the latter are to be joined
    std::uint64_t nextId = 1;
    bool closing = false;
};

// --- TaskRunner ----------------------------------------------------------------------------------

TaskRunner::TaskRunner(Post post, TaskLimits limits)
    : m_impl(std::make_shared<Impl>(std::move(post), limits)) {}

TaskRunner::~TaskRunner() {
    shutDown(std::chrono::milliseconds(0));
    std::list<std::thread> all;
    {
        std::unique_lock lock(m_impl->mutex);
        m_impl->done.wait(lock, [this] {
            return !m_impl->any([](const auto& task) { return task.phase == Phase::Running; });
        });
        m_impl->work.notify_all();
    }
    // Each thread moves itself from one list to the other as its last act.
    while (true) {
        std::unique_lock lock(m_impl->mutex);
        all.splice(all.end(), m_impl->ended);
        const bool more = !m_impl->running.empty();
        lock.unlock();
        for (std::thread& thread : all)
            thread.join();
        all.clear();
        if (!more)
            break;
        std::this_thread::yield();
    }
}

bool TaskRunner::shutDown(std::chrono::milliseconds patience) {
    std::vector<Impl::TaskPtr> out;
    std::unique_lock lock(m_impl->mutex);
    m_impl->closing = true;
    for (const Impl::TaskPtr& task : m_impl->tasks)
        if (!task->mustBeDone())
            m_impl->drop(task, out);
    m_impl->erase(out);
    const auto unfinished = [this](bool all) {
        return m_impl->any([all](const Impl::Task& task) {
            return task.phase != Phase::Done &&
                   (all || task.mustBeDone() || task.spec.priority == TaskPriority::Job);
        });
    };
    m_impl->done.wait(lock, [&] {
        m_impl->wake(); // for what must be done
        return !unfinished(false);
    });
    return m_impl->done.wait_for(lock, patience, [&] { return !unfinished(true); });
}

bool TaskRunner::finishExclusive(std::chrono::milliseconds patience) {
    std::unique_lock lock(m_impl->mutex);
    return m_impl->done.wait_for(lock, patience, [this] {
        return !m_impl->any([](const Impl::Task& task) {
            return task.mustBeDone() && task.spec.priority == TaskPriority::High &&
                   task.phase != Phase::Done;
        });
    });
}

// --- TaskGroup -----------------------------------------------------------------------------------

TaskGroup::TaskGroup(TaskRunner& runner, std::function<void()> changed)
    : m_runner(runner.m_impl)
    , m_state(std::make_shared<State>(State{std::move(changed)})) {}

TaskGroup::~TaskGroup() {
    m_state->changed = nullptr;
    cancelAll();
    std::vector<TaskRunner::Impl::TaskPtr> mine; // end after the mutex is free
    std::unique_lock lock(m_runner->mutex);
    m_runner->done.wait(lock, [this] {
        m_runner->wake(); // for what must be done
        return !m_runner->any([this](const auto& task) {
            return task.group == m_state.get() && task.phase != Phase::Done;
        });
    });
    for (const TaskRunner::Impl::TaskPtr& task : m_runner->tasks)
        if (task->group == m_state.get())
            mine.push_back(task);
    m_runner->erase(mine);
}

JobControl TaskGroup::start(TaskSpec spec, std::function<void(const JobContext&)> work,
                            std::function<void(const std::optional<Error>&)> apply) {
    using Task = TaskRunner::Impl::Task;
    auto task = std::make_shared<Task>();
    task->group = m_state.get();
    task->owner = m_state;
    task->control = JobControl(spec.gate);
    task->spec = std::move(spec);
    task->work = std::move(work);
    task->apply = std::move(apply);
    const JobControl control = task->control;
    std::vector<TaskRunner::Impl::TaskPtr> out; // end after the mutex is free
    {
        const std::lock_guard lock(m_runner->mutex);
        if (m_runner->closing) {
            if (task->mustBeDone())
                logError("{}: too late, the program ends", TaskRunner::Impl::nameOf(*task));
            task->control.cancel();
            return control;
        }
        bool first = true; // of those of its tag that are wanted
        for (const TaskRunner::Impl::TaskPtr& other : m_runner->tasks) {
            if (!other->sameTag(*task) || other->mustBeDone() || !other->wanted)
                continue;
            const bool begins = std::exchange(first, false);
            if (task->spec.policy == TaskPolicy::Newest ||
                (task->spec.policy == TaskPolicy::Follow && !begins &&
                 other->phase == Phase::Waiting))
                m_runner->drop(other, out);
        }
        m_runner->erase(out);
        task->id = m_runner->nextId++;
        m_runner->tasks.push_back(std::move(task));
        m_runner->wake();
    }
    TaskRunner::Impl::notify(m_state);
    return control;
}

void TaskGroup::cancel(const std::string& tag) {
    std::vector<TaskRunner::Impl::TaskPtr> out;
    {
        const std::lock_guard lock(m_runner->mutex);
        for (const TaskRunner::Impl::TaskPtr& task : m_runner->tasks)
            if (task->group == m_state.get() && task->spec.tag == tag && !task->mustBeDone())
                m_runner->drop(task, out);
        m_runner->erase(out);
        m_runner->wake(); // for others of the tag
    }
    TaskRunner::Impl::notify(m_state);
}

void TaskGroup::cancelAll(const std::vector<std::string>& but) {
    std::vector<TaskRunner::Impl::TaskPtr> out;
    const auto stays = [&](const std::string& tag) {
        return std::ranges::any_of(but, [&](const auto& begin) { return tag.starts_with(begin); });
    };
    {
        const std::lock_guard lock(m_runner->mutex);
        for (const TaskRunner::Impl::TaskPtr& task : m_runner->tasks)
            if (task->group == m_state.get() && !task->mustBeDone() && !stays(task->spec.tag))
                m_runner->drop(task, out);
        m_runner->erase(out);
        m_runner->wake();
    }
    TaskRunner::Impl::notify(m_state);
}

bool TaskGroup::waitForDone(std::chrono::milliseconds patience) {
    std::unique_lock lock(m_runner->mutex);
    return m_runner->done.wait_for(lock, patience, [this] {
        return !m_runner->any([this](const auto& task) {
            return task.group == m_state.get() && task.phase != Phase::Done;
        });
    });
}

bool TaskGroup::busy() const {
    const std::lock_guard lock(m_runner->mutex);
    return m_runner->any(
        [this](const auto& task) { return task.group == m_state.get() && task.wanted; });
}

bool TaskGroup::busy(const std::string& tag) const {
    const std::lock_guard lock(m_runner->mutex);
    return m_runner->any([&](const auto& task) {
        return task.group == m_state.get() && task.wanted && task.spec.tag == tag;
    });
}

std::string TaskGroup::activity() const {
    const std::lock_guard lock(m_runner->mutex);
    for (auto task = m_runner->tasks.rbegin(); task != m_runner->tasks.rend(); ++task)
        if ((*task)->group == m_state.get() && (*task)->wanted)
            return TaskRunner::Impl::nameOf(**task);
    return {};
}

} // namespace patina
