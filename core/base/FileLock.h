// Holds a file to be written for one process: a second one that wants to write it is refused.
#pragma once

#include "core/base/FileDescriptor.h"
#include "core/base/Result.h"

#include <chrono>
#include <filesystem>
#include <optional>

namespace patina {

// The lock is a hidden file beside `path`, held with flock(2): it ends with the process, however
// that ends, and an empty file that a crash leaves behind locks nothing. On network drives it holds
// between machines where the drive supports that.
class FileLock {
  public:
    // Errors: CannotCreate when the folder is not writable, when another process (or lock of this
    // process) holds it, which the message names, or when something that is no lock has its name:
    // links are not followed, and what other files hold is not touched.
    static Result<FileLock> take(const std::filesystem::path& path);

    // The same for writers who are done soon: waits up to `patience` for whoever holds it, and then
    // is the same error. Nothing where the folder or the drive lets nobody lock (a line in the
    // log).
    static Result<std::optional<FileLock>> takeWhenFree(const std::filesystem::path& path,
                                                        std::chrono::milliseconds patience);

    ~FileLock();
    FileLock(FileLock&&) noexcept = default;
    FileLock& operator=(FileLock&&) = delete;

  private:
    FileLock(std::filesystem::path file, FileDescriptor descriptor)
        : m_file(std::move(file))
        , m_descriptor(std::move(descriptor)) {}

    std::filesystem::path m_file;
    FileDescriptor m_descriptor;
};

} // namespace patina
