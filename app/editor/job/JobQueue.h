// Whose turn it is among jobs that share the cores one after another.
#pragma once

#include <QtGlobal>
#include <optional>
#include <span>

namespace patina::editor {

enum class JobPriority { Low, Normal, High };

struct WaitingJob {
    quint64 id = 0;
    JobPriority priority = JobPriority::Normal;
    bool paused = false; // by the user: not before it is resumed
    bool begun = false;  // has a thread, which may rest
};

// The highest priority; among equals what has begun, then what was asked for first.
[[nodiscard]] std::optional<quint64> nextJob(std::span<const WaitingJob> jobs);

} // namespace patina::editor
