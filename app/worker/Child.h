// One request in a process of its own.
#pragma once

#include "core/worker/WorkerProtocol.h"

namespace patina::worker {

// Confines this process, does the work, answers and ends. Descriptors as in protocol::Request.
[[noreturn]] void runChild(const protocol::Request& request,
                           std::vector<FileDescriptor> descriptors);

} // namespace patina::worker
