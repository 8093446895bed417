#include "app/editor/job/JobManager.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/job/LivePreview.h"
#include "core/base/Log.h"
#include "core/job/Parallel.h"

#include <QMetaObject>
#include <algorithm>
#include <thread>

namespace patina::editor {

struct JobManager::Job {
    quint64 id = 0;
    QString title;
    bool canStop = false;
    JobState state = JobState::Running;
    JobControl control;
    JobProgress lastProgress; // kept once the job has ended
    QString summary;
    std::thread thread;
};

JobManager::JobManager(DocumentController& controller, QObject* parent)
    : QObject(parent)
    , m_controller(controller) {
    lowerPoolPriority();
}

JobManager::~JobManager() {
    cancelAll();
    for (const auto& job : m_jobs)
        if (job->thread.joinable())
            job->thread.join();
}

quint64 JobManager::start(const QString& title, bool canStop, Work work) {
    auto job = std::make_unique<Job>();
    const quint64 id = m_nextId++;
    job->id = id;
    job->title = title;
    job->canStop = canStop;
    const JobContext context = job->control.context();
    job->thread = std::thread([this, id, context, run = std::move(work)] {
        lowerThreadPriority();
        JobOutcome outcome;
        try {
            outcome = run(context);
        } catch (const std::exception& exception) {
            outcome.error =
                Error{ErrorKind::Internal, "the job failed unexpectedly", {}, exception.what()};
        }
        // The manager joins this thread before it dies, so `this` is alive.
        QMetaObject::invokeMethod(
            this,
            [this, id, result = std::move(outcome)]() mutable { finish(id, std::move(result)); },
            Qt::QueuedConnection);
    });
    m_jobs.push_back(std::move(job));
    Q_EMIT jobsChanged();
    return id;
}

JobManager::Job* JobManager::find(quint64 id) const {
    const auto it =
        std::find_if(m_jobs.begin(), m_jobs.end(), [id](const auto& job) { return job->id == id; });
    return it == m_jobs.end() ? nullptr : it->get();
}

void JobManager::finish(quint64 id, JobOutcome outcome) {
    Job* job = find(id);
    if (!job)
        return;
    job->thread.join();
    job->lastProgress = job->control.progress();

    // A cancel wins over whatever the work still returned.
    if (job->control.cancelled() ||
        (outcome.error && outcome.error->kind == ErrorKind::Cancelled)) {
        job->state = JobState::Cancelled;
        job->summary = tr("Cancelled, nothing was kept");
    } else if (outcome.error) {
        job->state = JobState::Failed;
        job->summary = QString::fromStdString(outcome.error->message);
        Q_EMIT m_controller.noticed(UserNotice::fromError(*outcome.error));
    } else {
        job->state = job->control.stopping() ? JobState::Stopped : JobState::Done;
        job->summary = outcome.summary;
        if (outcome.apply)
            outcome.apply();
    }
    logInfo("{}: {}", job->title.toStdString(), job->summary.toStdString());
    Q_EMIT jobsChanged();
}

void JobManager::stop(quint64 id) {
    if (Job* job = find(id))
        job->control.stop();
}

void JobManager::cancel(quint64 id) {
    if (Job* job = find(id))
        job->control.cancel();
}

void JobManager::cancelAll() {
    for (const auto& job : m_jobs)
        if (job->state == JobState::Running)
            job->control.cancel();
}

void JobManager::clearFinished() {
    std::erase_if(m_jobs, [](const auto& job) { return job->state != JobState::Running; });
    Q_EMIT jobsChanged();
}

int JobManager::runningCount() const {
    return static_cast<int>(std::count_if(m_jobs.begin(), m_jobs.end(), [](const auto& job) {
        return job->state == JobState::Running;
    }));
}

JobRecord JobManager::record(const Job& job) const {
    JobRecord result;
    result.id = job.id;
    result.title = job.title;
    result.state = job.state;
    result.canStop = job.canStop;
    result.summary = job.summary;
    const bool running = job.state == JobState::Running;
    result.progress = running ? job.control.progress() : job.lastProgress;
    result.secondsLeft = running ? job.control.secondsLeft() : 0.0;
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

void JobManager::setPreview(std::shared_ptr<LivePreview> preview) {
    m_preview = std::move(preview);
    Q_EMIT previewChanged();
}

} // namespace patina::editor
