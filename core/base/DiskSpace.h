// Whether what is about to be computed can be written where it is wanted.
#pragma once

#include "core/base/Result.h"

#include <cstdint>
#include <filesystem>
#include <optional>

namespace patina {

// What the file system of `path` has left for this user. Nothing where nobody knows: the folder is
// not there, or `path` is a device.
[[nodiscard]] std::optional<std::uint64_t> freeDiskBytes(const std::filesystem::path& path);

// Errors (Io, naming `path`): `bytes` do not fit there, or this process may write no file of
// `largestFile` bytes (RLIMIT_FSIZE).
Result<void> checkDiskSpace(const std::filesystem::path& path, std::uint64_t bytes,
                            std::uint64_t largestFile);

} // namespace patina
