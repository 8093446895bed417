// Threads that libraries start as they are loaded. A fork copies the locks they hold, and nobody in
// the child would ever release them.
#pragma once

#include <chrono>

namespace patina::worker {

// Ends the threads of log4cplus (which OpenImageIO draws in through OpenVDB, and nobody uses), then
// waits until all others have settled down. False when some still run after `patience`.
bool settleLibraryThreads(std::chrono::milliseconds patience);

} // namespace patina::worker
