// Landlock (Linux 5.13 and later): this process and its threads lose files, and whatever else the
// kernel's version of it covers, below the system calls that name them.
#pragma once

#include <string>

namespace patina::worker {

// The kernel's version of Landlock; 0 where there is none, or where it is disabled.
[[nodiscard]] int landlockVersion();

// Nothing can be opened by name any more, for reading or writing, nor run, created, removed or
// renamed; from version 4 on no TCP port be bound or connected to, from 5 on no device be
// controlled, from 6 on no abstract socket or signal reach another process. Files that are open
// stay so. Needs PR_SET_NO_NEW_PRIVS. What failed, or nothing.
std::string giveUpFiles(int version);

} // namespace patina::worker
