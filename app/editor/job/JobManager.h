// The bakes and exports that run or wait, each on a thread of its own (TaskPriority::Job). Exports
// start at once; bakes take turns, for the cores are better used by one than shared by two. UI
// thread only; progress is polled.
#pragma once

#include "app/editor/job/JobQueue.h"
#include "core/base/Result.h"
#include "core/job/TaskRunner.h"
#include "core/job/WorkGate.h"

#include <QObject>
#include <QString>
#include <QTimer>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace patina::editor {

class DocumentController;

enum class JobState { Queued, Running, Paused, Done, Stopped, Cancelled, Failed };

// One row of the Jobs dock.
struct JobRecord {
    quint64 id = 0;
    QString title;
    JobState state = JobState::Running;
    bool canStop = false;    // stopping keeps what has converged
    bool queued = false;     // takes turns: it can be paused and has a priority
    bool begun = false;      // a Queued one that has begun rests until it is its turn again
    bool stopping = false;   // it was told to stop or to be cancelled, and ends soon
    bool cancelling = false; // of the two, the latter
    JobPriority priority = JobPriority::Normal;
    JobProgress progress;     // as of the call of jobs()
    double workPerSecond = 0; // lately; 0: unknown
    double secondsLeft = -1;  // negative: unknown
    QString summary;          // once it has ended: what came of it

    [[nodiscard]] bool ended() const { return state >= JobState::Done; }
};

// What a job's thread hands back.
struct JobOutcome {
    std::optional<Error> error;
    QString summary;             // also of a cancelled one, where something was kept
    std::function<void()> apply; // runs on the UI thread, unless the job was cancelled
};

class JobManager : public QObject {
    Q_OBJECT
  public:
    using Work = std::function<JobOutcome(const JobContext&)>;
    // Called on the UI thread when it is the job's turn for the first time: the place to copy what
    // the work needs from the document. An error ends the job.
    using Prepare = std::function<Result<Work>()>;

    explicit JobManager(DocumentController& controller, QObject* parent = nullptr);
    ~JobManager() override;

    // `work` runs on a low-priority thread and must not touch the document: it gets copies.
    quint64 start(const QString& title, bool canStop, Work work);
    // The same when it is its turn; it can be stopped and paused.
    quint64 enqueue(const QString& title, JobPriority priority, Prepare prepare);
    void setPriority(quint64 id, JobPriority priority);
    void pause(quint64 id); // the next one gets its turn meanwhile
    void resume(quint64 id);
    void stop(quint64 id); // one that has not begun is cancelled
    void cancel(quint64 id);
    void cancelAll();
    void shutDown(); // the same at the program's end
    void clearFinished();

    [[nodiscard]] int runningCount() const;            // jobs that have not ended, waiting ones too
    [[nodiscard]] std::vector<JobRecord> jobs() const; // oldest first
    [[nodiscard]] std::optional<JobRecord> job(quint64 id) const;

    // Closed while a frame is drawn that the user waits for: jobs step aside.
    [[nodiscard]] const std::shared_ptr<WorkGate>& gate() const { return m_gate; }

  Q_SIGNALS:
    void jobsChanged();  // one was added, began, rests, goes on or has ended
    void shuttingDown(); // everything is about to be cancelled: keep what can be gone on from

  private:
    struct Job;
    void schedule();
    void begin(Job& job, Work work);
    void finish(quint64 id, const Result<JobOutcome>& outcome);
    void end(Job& job, const JobOutcome& outcome);
    void measure();
    [[nodiscard]] JobRecord record(const Job& job) const;
    [[nodiscard]] Job* find(quint64 id) const;

    DocumentController& m_controller;
    std::shared_ptr<WorkGate> m_gate = std::make_shared<WorkGate>();
    std::vector<std::unique_ptr<Job>> m_jobs;
    QTimer m_meter; // rates, while something runs
    quint64 m_nextId = 1;
    TaskGroup m_tasks; // last: it ends first
};

} // namespace patina::editor
