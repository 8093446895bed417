// Misbehaviour on request: crashes, hangs and attempts to leave the sandbox, so that tests can see
// what the client and the kernel make of them.
#pragma once

#include "core/codec/Codec.h"

namespace patina::worker {

// {"do": "crash" | "abort" | "hang" | "spin" | "allocate" | "exit" | "throw" | "echo" | "print"}
// acts; {"do": "try", "call": "exec" | "fork" | "thread"} answers {"errno": n}, 0 when the call
// succeeded. {"do": "call", "number": n, "arguments": [number | text | {"bytes": n}, …]} makes a
// system call, texts and blocks of zeros being passed by address, and answers {"errno", "result"}.
// {"do": "files"} opens files until that fails. {"do": "describe"} tells what the process sees
// of the system. "size" is that of the answer's payload, "hollow" leaves it unwritten, "words"
// makes a header or a message of that many bytes.
codec::Reply selfTest(const nlohmann::json& request);

} // namespace patina::worker
