// What a decoding child gives up before it looks at a file.
#pragma once

#include <cstdint>
#include <string>

namespace patina::worker {

// Limits memory, processor time, file size and core dumps, and forbids (seccomp) sockets, other
// programs, other processes, and opening or changing files for writing. Returns what failed, or
// nothing.
std::string confine(std::uint64_t memoryBytes, double cpuSeconds);

} // namespace patina::worker
