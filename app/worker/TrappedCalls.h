// System calls that a decoding child leaves to its client: those that open a file, ask about one by
// its name, or create a memory file. The filter (SystemCallFilter.h) turns each into a signal, and
// its handler requests the descriptor of the client (core/worker/GuestRequests.h). So libraries
// open files as they always do, and what they get is decided by a process that no file has touched.
#pragma once

#include <string>
#include <vector>

namespace patina::worker {

// By number; the filter traps these.
[[nodiscard]] const std::vector<int>& trappedCalls();

// Handles them from now on, through protocol::kRequestFd. What failed, or nothing.
std::string handleTrappedCalls();

} // namespace patina::worker
