// Misbehaviour on request: crashes, hangs and attempts to leave the sandbox, so that tests can see
// what the client and the kernel make of them.
#pragma once

#include "core/worker/Codec.h"

namespace patina::worker {

// {"do": "crash" | "abort" | "hang" | "spin" | "allocate" | "exit" | "throw" | "echo" | "print"}
// acts; {"do": "try", "call": "socket" | "exec" | "fork" | "kill" | "create" | "write" | "thread"}
// answers {"errno": n}, 0 when the call succeeded.
codec::Reply selfTest(const nlohmann::json& request);

} // namespace patina::worker
