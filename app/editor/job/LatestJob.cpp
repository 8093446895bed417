#include "app/editor/job/LatestJob.h"

#include <utility>

namespace patina::editor {

LatestJob::LatestJob(TaskRunner& runner, const char* what, QObject* parent, TaskPriority priority)
    : QObject(parent)
    , m_spec{.tag = what, .policy = TaskPolicy::Follow, .priority = priority}
    , m_tasks(runner) {}

void LatestJob::request(Work work) {
    m_tasks.run(m_spec, std::move(work), [](const Result<Apply>& apply) {
        if (apply && *apply) // an error is in the log
            (*apply)();
    });
}

void LatestJob::cancel() {
    m_tasks.cancelAll();
}

} // namespace patina::editor
