// What a decoding child gives up before it looks at a file.
#pragma once

#include <cstdint>
#include <string>

namespace patina::worker {

// Limits memory, processor time, file size, open files, threads and core dumps; gives up root's
// capabilities and hides its memory from other processes; gives up all files (Landlock of this
// version; 0 for a kernel without it); and from then on makes no system call but those of
// SystemCallFilter.h. Files and memory files come from the client (TrappedCalls.h), with Landlock
// and without. Returns what failed, or nothing.
std::string confine(std::uint64_t memoryBytes, double cpuSeconds, int landlock);

} // namespace patina::worker
