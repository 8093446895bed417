// What processes that were killed in the instant of replacing a file have left beside it.
#pragma once

#include <filesystem>

namespace patina {

// Removes the temporary files of writeFileAtomically(path) whose process has ended. For those who
// hold the FileLock of what is written, so that no other machine's process is taken for dead.
void removeLeftovers(const std::filesystem::path& path);
// The same for all files of a folder.
void removeAllLeftovers(const std::filesystem::path& folder);

} // namespace patina
