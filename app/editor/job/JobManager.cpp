#include "app/editor/job/JobManager.h"

#include "app/editor/document/DocumentController.h"
#include "core/base/Log.h"
#include "core/job/Parallel.h"
#include "core/job/ProgressRate.h"

#include <algorithm>

namespace patina::editor {
namespace {

constexpr int kMeterMs = 250;

} // namespace

struct JobManager::Job {
    quint64 id = 0;
    QString title;
    bool canStop = false;
    JobState state = JobState::Running;
    Prepare prepare; // of a queued one, until it begins
    bool queued = false, pausedByUser = false, begun = false;
    JobPriority priority = JobPriority::Normal;
    JobControl control;
    ProgressRate rate;
    JobProgress lastProgress; // kept once the job has ended
    QString summary;

    [[nodiscard]] bool ended() const { return state >= JobState::Done; }
};

JobManager::JobManager(DocumentController& controller, QObject* parent)
    : QObject(parent)
    , m_controller(controller)
    , m_tasks(controller.runner()) {
    startPool();
    m_meter.setInterval(kMeterMs);
    connect(&m_meter, &QTimer::timeout, this, &JobManager::measure);
}

JobManager::~JobManager() = default;

quint64 JobManager::start(const QString& title, bool canStop, Work work) {
    Job& job = *m_jobs.emplace_back(std::make_unique<Job>());
    job.id = m_nextId++;
    job.title = title;
    job.canStop = canStop;
    begin(job, std::move(work));
    const quint64 id = job.id;
    Q_EMIT jobsChanged();
    return id;
}

quint64 JobManager::enqueue(const QString& title, JobPriority priority, Prepare prepare) {
    Job& job = *m_jobs.emplace_back(std::make_unique<Job>());
    job.id = m_nextId++;
    job.title = title;
    job.canStop = job.queued = true;
    job.priority = priority;
    job.prepare = std::move(prepare);
    job.state = JobState::Queued;
    const quint64 id = job.id;
    schedule();
    return id;
}

void JobManager::begin(Job& job, Work work) {
    job.begun = true;
    job.state = JobState::Running;
    job.control =
        m_tasks.run({.tag = "job " + std::to_string(job.id),
                     .policy = TaskPolicy::Queue,
                     .priority = TaskPriority::Job,
                     .name = job.title.toStdString(),
                     .gate = m_gate}, // its clock starts now
                    std::move(work), [this, id = job.id](const Result<JobOutcome>& outcome) {
                        finish(id, outcome);
                    });
    m_meter.start();
}

// Lets the queued job whose turn it is run, and the others rest.
void JobManager::schedule() {
    std::vector<WaitingJob> waiting;
    for (const auto& job : m_jobs)
        if (job->queued && !job->ended())
            waiting.push_back({job->id, job->priority, job->pausedByUser, job->begun});
    const std::optional<quint64> next = nextJob(waiting);
    for (const WaitingJob& other : waiting) {
        Job& job = *find(other.id);
        if (next == job.id)
            continue;
        job.state = job.pausedByUser ? JobState::Paused : JobState::Queued;
        if (job.begun)
            job.control.pause();
    }
    if (next) {
        Job& job = *find(*next);
        job.state = JobState::Running;
        if (job.begun) {
            job.control.resume();
        } else {
            const Prepare prepare = std::exchange(job.prepare, nullptr);
            Result<Work> work = prepare();
            if (!work) {
                end(job, {work.error(), {}, {}});
                schedule();
                return;
            }
            begin(job, std::move(work).value());
        }
    }
    Q_EMIT jobsChanged();
}

JobManager::Job* JobManager::find(quint64 id) const {
    const auto it =
        std::find_if(m_jobs.begin(), m_jobs.end(), [id](const auto& job) { return job->id == id; });
    return it == m_jobs.end() ? nullptr : it->get();
}

void JobManager::finish(quint64 id, const Result<JobOutcome>& outcome) {
    Job* job = find(id);
    if (!job)
        return;
    end(*job, outcome ? *outcome : JobOutcome{outcome.error(), {}, {}});
    if (runningCount() == 0)
        m_meter.stop();
    schedule();
}

void JobManager::end(Job& job, const JobOutcome& outcome) {
    job.lastProgress = job.control.progress();
    // A cancel wins over whatever the work still returned.
    if (job.control.cancelled() || (outcome.error && outcome.error->kind == ErrorKind::Cancelled)) {
        job.state = JobState::Cancelled;
        job.summary = outcome.error && !outcome.summary.isEmpty()
                          ? outcome.summary
                          : tr("Cancelled, nothing was kept");
    } else if (outcome.error) {
        job.state = JobState::Failed;
        job.summary = QString::fromStdString(outcome.error->message);
        Q_EMIT m_controller.noticed(UserNotice::fromError(*outcome.error));
    } else {
        job.state = job.control.stopping() ? JobState::Stopped : JobState::Done;
        job.summary = outcome.summary;
        if (outcome.apply)
            outcome.apply();
    }
    logInfo("{}: {}", job.title.toStdString(), job.summary.toStdString());
}

void JobManager::setPriority(quint64 id, JobPriority priority) {
    Job* job = find(id);
    if (!job || job->priority == priority)
        return;
    job->priority = priority;
    schedule();
}

void JobManager::pause(quint64 id) {
    Job* job = find(id);
    if (!job || !job->queued || job->ended())
        return;
    job->pausedByUser = true;
    schedule();
}

void JobManager::resume(quint64 id) {
    Job* job = find(id);
    if (!job || !job->pausedByUser)
        return;
    job->pausedByUser = false;
    schedule();
}

void JobManager::stop(quint64 id) {
    Job* job = find(id);
    if (job && !job->begun)
        cancel(id);
    else if (job)
        job->control.stop();
    Q_EMIT jobsChanged();
}

void JobManager::cancel(quint64 id) {
    Job* job = find(id);
    if (!job || job->ended())
        return;
    job->control.cancel();
    if (job->begun) {
        Q_EMIT jobsChanged();
        return; // finish() follows
    }
    end(*job, {});
    schedule();
}

void JobManager::cancelAll() {
    // Those that wait first, or they would get their turn.
    for (const auto& job : m_jobs)
        if (!job->begun && !job->ended()) {
            job->control.cancel();
            end(*job, {});
        }
    for (const auto& job : m_jobs)
        if (!job->ended())
            job->control.cancel();
    Q_EMIT jobsChanged();
}

void JobManager::shutDown() {
    Q_EMIT shuttingDown();
    cancelAll();
}

void JobManager::clearFinished() {
    std::erase_if(m_jobs, [](const auto& job) { return job->ended(); });
    Q_EMIT jobsChanged();
}

int JobManager::runningCount() const {
    return static_cast<int>(
        std::count_if(m_jobs.begin(), m_jobs.end(), [](const auto& job) { return !job->ended(); }));
}

void JobManager::measure() {
    for (const auto& job : m_jobs)
        if (job->begun && !job->ended())
            job->rate.add(job->control.progress());
}

JobRecord JobManager::record(const Job& job) const {
    JobRecord result;
    result.id = job.id;
    result.title = job.title;
    result.state = job.state;
    result.canStop = job.canStop;
    result.queued = job.queued;
    result.begun = job.begun;
    result.priority = job.priority;
    result.summary = job.summary;
    if (job.ended()) {
        result.progress = job.lastProgress;
        result.secondsLeft = 0.0;
    } else if (job.begun) {
        result.stopping = job.control.stopping();
        result.cancelling = job.control.cancelled();
        result.progress = job.control.progress();
        result.workPerSecond = job.rate.workPerSecond();
        result.secondsLeft = job.rate.secondsLeft();
    }
    return result;
}

std::vector<JobRecord> JobManager::jobs() const {
    std::vector<JobRecord> result;
    for (const auto& job : m_jobs)
        result.push_back(record(*job));
    return result;
}

std::optional<JobRecord> JobManager::job(quint64 id) const {
    const Job* found = find(id);
    return found ? std::optional(record(*found)) : std::nullopt;
}

} // namespace patina::editor
