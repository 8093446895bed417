// Misbehaviour on request: crashes, hangs and attempts to leave the sandbox, so that tests can see
// what the client and the kernel make of them.
#pragma once

#include "core/codec/Codec.h"

namespace patina::worker {

// {"do": "crash" | "abort" | "hang" | "spin" | "allocate" | "exit" | "throw" | "echo" | "print"}
// acts; {"do": "try", "call": "exec" | "fork" | "thread"} answers {"errno": n}, 0 when the call
// succeeded. {"do": "call", "calls": [{"number": n, "arguments": [number | text | {"bytes": n} |
// {"result": i}, …]}, …]} makes system calls, texts and blocks of zeros being passed by address and
// results being those of the calls before, and answers [{"errno", "result"}, …].
// {"do": "files"} copies descriptors until that fails, {"do": "memory", "each": n} creates memory
// files of n bytes. {"do": "describe"} says what the process has and which version of Landlock it
// is under. "size" is that of the answer's payload, "hollow" leaves it unwritten, "words" makes a
// header or a message of that many bytes.
codec::Reply selfTest(const nlohmann::json& request, int landlock);

} // namespace patina::worker
