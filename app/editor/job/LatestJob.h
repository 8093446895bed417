// Work that is asked for again and again while something is dragged: one runs in the background,
// and of those asked for meanwhile the newest is kept.
#pragma once

#include "core/job/JobContext.h"

#include <QObject>
#include <QThreadPool>
#include <functional>

namespace patina::editor {

class LatestJob : public QObject {
    Q_OBJECT
  public:
    // Runs on the UI thread when the work is done; empty: nothing to do.
    using Apply = std::function<void()>;
    using Work = std::function<Apply(const JobContext&)>;

    // Low: whatever else the user does goes first. Normal: what the user is watching, and short.
    enum class Priority { Low, Normal };

    // `what`, for the log: "light lab".
    explicit LatestJob(const char* what, QObject* parent = nullptr,
                       Priority priority = Priority::Low);
    ~LatestJob() override; // cancels and waits

    // What runs goes on to its end and is applied, so that results keep coming during a drag.
    void request(Work work);
    void cancel(); // nothing of what was requested is applied any more
    [[nodiscard]] bool busy() const { return m_running; }

  private:
    void start(Work work);
    void finish(quint64 id, const Apply& apply);

    const char* m_what;
    Priority m_priority;
    QThreadPool m_pool;
    JobControl m_control;
    bool m_running = false;
    quint64 m_id = 0; // of what runs; results of others are dropped
    Work m_next;
};

} // namespace patina::editor
