#include "app/editor/job/JobQueue.h"

#include <tuple>

namespace patina::editor {

std::optional<quint64> nextJob(std::span<const WaitingJob> jobs) {
    const WaitingJob* best = nullptr;
    const auto before = [](const WaitingJob& a, const WaitingJob& b) {
        return std::tuple(a.priority, a.begun, b.id) > std::tuple(b.priority, b.begun, a.id);
    };
    for (const WaitingJob& job : jobs)
        if (!job.paused && (best == nullptr || before(job, *best)))
            best = &job;
    return best ? std::optional(best->id) : std::nullopt;
}

} // namespace patina::editor
