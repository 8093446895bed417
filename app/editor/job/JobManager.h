// The bakes and exports that run, each on a thread of its own. UI thread only; progress is polled.
#pragma once

#include "core/base/Result.h"
#include "core/job/JobContext.h"

#include <QObject>
#include <QString>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace patina::editor {

class DocumentController;
class LivePreview;

enum class JobState { Running, Done, Stopped, Cancelled, Failed };

// One row of the Jobs dock.
struct JobRecord {
    quint64 id = 0;
    QString title;
    JobState state = JobState::Running;
    bool canStop = false;    // stopping keeps what has converged
    JobProgress progress;    // as of the call of jobs()
    double secondsLeft = -1; // negative: unknown
    QString summary;         // once it has ended: what came of it
};

// What a job's thread hands back.
struct JobOutcome {
    std::optional<Error> error;
    QString summary;
    std::function<void()> apply; // runs on the UI thread, unless the job was cancelled
};

class JobManager : public QObject {
    Q_OBJECT
  public:
    using Work = std::function<JobOutcome(const JobContext&)>;

    explicit JobManager(DocumentController& controller, QObject* parent = nullptr);
    ~JobManager() override; // cancels everything and waits

    // `work` runs on a low-priority thread and must not touch the document: it gets copies.
    quint64 start(const QString& title, bool canStop, Work work);
    void stop(quint64 id);
    void cancel(quint64 id);
    void cancelAll();
    void clearFinished();

    [[nodiscard]] int runningCount() const;
    [[nodiscard]] std::vector<JobRecord> jobs() const; // oldest first
    [[nodiscard]] std::optional<JobRecord> job(quint64 id) const;

    // What a running bake has found so far; null when no bake runs.
    [[nodiscard]] std::shared_ptr<LivePreview> preview() const { return m_preview; }
    void setPreview(std::shared_ptr<LivePreview> preview);

  Q_SIGNALS:
    void jobsChanged();    // one was started or has ended
    void previewChanged(); // preview() is another one

  private:
    struct Job;
    void finish(quint64 id, JobOutcome outcome);
    [[nodiscard]] JobRecord record(const Job& job) const;
    [[nodiscard]] Job* find(quint64 id) const;

    DocumentController& m_controller;
    std::vector<std::unique_ptr<Job>> m_jobs;
    std::shared_ptr<LivePreview> m_preview;
    quint64 m_nextId = 1;
};

} // namespace patina::editor
