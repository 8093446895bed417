// The system calls that a decoding child may make (seccomp): a list of those that some format
// needs, some with conditions on their arguments. All others do not exist for it (ENOSYS), those
// that kernels have yet to bring included; libraries take that for an older kernel.
#pragma once

#include <string>

namespace patina::worker {

// For this process and all its threads, for ever. Needs PR_SET_NO_NEW_PRIVS and
// handleTrappedCalls(). What failed, or nothing.
std::string filterSystemCalls();

} // namespace patina::worker
