// What a decoding child may have of the system, decided on the client's side: the files of one
// folder, read-only, its payload, and memory files up to a limit. Nothing else is within its reach
// (app/worker/Sandbox.h).
#pragma once

#include "core/base/FileDescriptor.h"
#include "core/worker/WorkerProtocol.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace patina {

struct GuestRights {
    std::filesystem::path file;   // the payload's own name; opening it opens the payload
    std::filesystem::path folder; // whose files may be read, canonical; empty: none
    int payloadFd = -1;
    std::size_t memoryBytes = 0; // of all memory files together
    bool encodes = false;        // pixels of ours: one of the memory files may grow
};

class GuestRequests {
  public:
    explicit GuestRequests(GuestRights rights);

    // Answers a request of the child at the other end of `socket`. False when it makes no sense:
    // the child is to be given up.
    [[nodiscard]] bool answer(int socket, const protocol::Report& report, std::string_view path);

  private:
    int openFile(std::string_view path, FileDescriptor& file) const; // these return an errno
    int openPayload(FileDescriptor& file) const;
    int createMemory(std::int64_t size, FileDescriptor& file);

    GuestRights m_rights;
    std::size_t m_memoryLeft;
    bool m_mayGrow;
    int m_count = 0;
};

// Opens a regular file in `folder` (canonical) or below, read-only. Links are followed as long as
// they stay below. EACCES for all that lies elsewhere, is no regular file, or has a name that
// begins with a dot, or a folder of such a name above it: a model in the home folder gives no keys
// away.
int openBelow(const std::filesystem::path& folder, const std::filesystem::path& path,
              FileDescriptor& file);

} // namespace patina
