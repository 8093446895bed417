// Work that is asked for again and again while something is dragged: one runs in the background,
// and of those asked for meanwhile the newest is kept (TaskPolicy::Follow).
#pragma once

#include "core/job/TaskRunner.h"

#include <QObject>
#include <functional>

namespace patina::editor {

class LatestJob : public QObject {
    Q_OBJECT
  public:
    // Runs on the UI thread when the work is done; empty: nothing to do.
    using Apply = std::function<void()>;
    using Work = std::function<Apply(const JobContext&)>;

    // `what`, for the log: "light lab". Priority: Low, or High for what the user is watching, if it
    // is short.
    LatestJob(TaskRunner& runner, const char* what, QObject* parent = nullptr,
              TaskPriority priority = TaskPriority::Low);

    // What runs goes on to its end and is applied, so that results keep coming during a drag.
    void request(Work work);
    void cancel(); // nothing of what was requested is applied any more
    [[nodiscard]] bool busy() const { return m_tasks.busy(); }

  private:
    TaskSpec m_spec;
    TaskGroup m_tasks;
};

} // namespace patina::editor
