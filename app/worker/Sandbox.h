// What a decoding child gives up before it looks at a file.
#pragma once

#include <cstdint>
#include <string>

namespace patina::worker {

enum class Files {
    ReadOnly, // for decoding what somebody else has made
    Writable  // for encoding our own pixels: OpenEXR opens its memory file by name
};

// Limits memory, processor time, file size, open files, threads and core dumps; gives up root's
// capabilities (but for reading) and hides its memory from other processes; and forbids (seccomp)
// sockets, other programs, other processes, signals, devices, changing the file system and, when
// `ReadOnly`, opening files for writing. Returns what failed, or nothing.
std::string confine(std::uint64_t memoryBytes, double cpuSeconds, Files files);

} // namespace patina::worker
