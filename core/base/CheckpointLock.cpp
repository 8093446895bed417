#include "core/base/CheckpointLock.h"

#include <chrono>
#include <fmt/format.h>
#include <system_error>
#include <utility>

namespace patina {

void CheckpointLock::hold(std::filesystem::path& checkpoint, std::string_view does,
                          const Warn& warn) {
    // For whoever only looks which checkpoints there are.
    constexpr std::chrono::milliseconds kPatience(200);
    if (m_lock || checkpoint.empty())
        return;
    auto taken = FileLock::takeWhenFree(checkpoint, kPatience);
    if (!taken) {
        const Error error{ErrorKind::CannotCreate,
                          fmt::format("another program {} and writes its checkpoint", does),
                          checkpoint, taken.error().message};
        checkpoint.clear();
        if (warn)
            warn(error);
    } else if (*taken) {
        m_lock.emplace(std::move(**taken));
    }
}

bool CheckpointLock::remove(std::filesystem::path& checkpoint, std::string_view does,
                            const Warn& warn) {
    hold(checkpoint, does, warn);
    std::error_code ignored;
    return !checkpoint.empty() && std::filesystem::remove(checkpoint, ignored);
}

} // namespace patina
