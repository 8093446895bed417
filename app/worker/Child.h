// One request in a process of its own.
#pragma once

#include "core/codec/Codec.h"
#include "core/worker/WorkerProtocol.h"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace patina::worker {

// What a worker can do, by the request's "op". An operation takes the request's header, the request
// and its payload; it throws codec::Refusal and std::bad_alloc.
using Operation = std::function<codec::Reply(const nlohmann::json& header, const protocol::Request&,
                                             FileDescriptor& payload)>;
using Operations = std::map<std::string, Operation>;

// Confines this process, does the work, answers and ends. Descriptors as in protocol::Request.
[[noreturn]] void runChild(const Operations& operations, const protocol::Request& request,
                           std::vector<FileDescriptor> descriptors);

} // namespace patina::worker
