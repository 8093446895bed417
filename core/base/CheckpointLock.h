// Holds the checkpoint of a long run, which one program writes at a time.
#pragma once

#include "core/base/FileLock.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string_view>

namespace patina {

class CheckpointLock {
  public:
    using Warn = std::function<void(const Error&)>; // may be empty

    // From now on nobody else writes `checkpoint`. Where somebody does, `warn` is told that
    // "another program `does` and writes its checkpoint", and `checkpoint` is empty afterwards: the
    // run goes on without one. Nothing happens to an empty one, and to one that is held.
    void hold(std::filesystem::path& checkpoint, std::string_view does, const Warn& warn);
    // The same, and it is no longer there. Returns whether it was.
    bool remove(std::filesystem::path& checkpoint, std::string_view does, const Warn& warn);

  private:
    std::optional<FileLock> m_lock; // none where nothing can be locked
};

} // namespace patina
