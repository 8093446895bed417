// Threads that libraries start before main(): what they hold locked at a fork, the child finds
// locked for ever.
#pragma once

#include <chrono>

namespace patina::worker {

// Ends the threads of log4cplus (which OpenImageIO draws in through OpenVDB, and nobody uses), then
// waits until every other thread of the process sleeps. False when some still run after `patience`.
bool settleLibraryThreads(std::chrono::milliseconds patience);

} // namespace patina::worker
