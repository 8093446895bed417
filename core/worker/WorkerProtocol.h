// What the client and a worker say to each other. Both come from the same build, so the
// messages are plain structs; the heavy parts travel as memory files beside them (SCM_RIGHTS).
//
// The client keeps one control socket to the worker. For each request it makes a socket pair of
// its own and hands one end over: the worker announces the child on it, the child answers on it,
// the worker reports how the child ended. When the client closes its end, the worker kills the
// child.
//
// A child opens no file and creates no memory file: it requests them of the client on the same
// socket (OpenFile, OpenPayload, CreateMemory), which checks each request (GuestRequests.h) and
// sends a Grant. One request at a time.
#pragma once

#include "core/base/FileDescriptor.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace patina::protocol {

inline constexpr std::uint32_t kMagic = 0x31415450;                    // "PTA1"
inline constexpr int kControlFd = 3;                                   // in the worker
inline constexpr int kRequestFd = 3;                                   // in its children
inline constexpr std::size_t kMaxHeaderBytes = std::size_t{256} << 20; // JSON text
inline constexpr std::size_t kMaxErrorBytes = std::size_t{1} << 20;    // that of an error
inline constexpr std::size_t kLogBytes = std::size_t{64} << 10;        // what a decoder may print
inline constexpr std::size_t kMaxDescriptors = 4;
inline constexpr std::size_t kMaxPathBytes = 4096;
// In place of a size: a memory file that grows as it is written, for encoders.
inline constexpr std::int64_t kGrowing = -1;

// The worker for images answers this, without a payload, for files that are OpenImageIO's.
inline constexpr const char* kHandOn = R"({"handOn":true})";

// Client → worker. Descriptors: the request's socket, its header, the log, and the payload (a
// memory file or the input file itself).
struct Request {
    std::uint32_t magic = kMagic;
    std::uint32_t payloadIsFile = 0;
    std::uint64_t headerSize = 0;
    std::uint64_t payloadSize = 0;
    std::uint64_t memoryBytes = 0;
    double cpuSeconds = 0;
    std::uint32_t landlock = 1; // 0: as on a kernel without it
    std::uint32_t unused = 0;
};

enum class Event : std::uint32_t {
    Started = 1,    // value: process id of the child
    Answered = 2,   // value: 0; descriptors: header, payload
    Failed = 3,     // value: 0; descriptors: header (an error), payload (empty)
    Ended = 4,      // value: wait status of the child
    CannotFork = 5, // value: errno
    OpenFile = 6,   // the message goes on with a path, without a zero at its end
    OpenPayload = 7,
    CreateMemory = 8 // value: its size, or kGrowing
};

// Worker or child → client.
struct Report {
    std::uint32_t magic = kMagic;
    Event event = Event::Started;
    std::int64_t value = 0;
    std::uint64_t headerSize = 0;
    std::uint64_t payloadSize = 0;
};

// Client → child, after OpenFile, OpenPayload and CreateMemory. Descriptor: the file, when `error`
// is 0.
struct Grant {
    std::uint32_t magic = kMagic;
    std::int32_t error = 0; // errno
};

// One message over a SOCK_SEQPACKET socket, never blocking and never raising SIGPIPE. False with
// errno when it could not be sent.
bool send(int socket, std::span<const std::byte> message, std::span<const int> descriptors);

struct Received {
    std::size_t size = 0; // 0: the other side has closed
    std::vector<FileDescriptor> descriptors;
};
// Nothing on an error (errno), e.g. EAGAIN when no message waits.
std::optional<Received> receive(int socket, std::span<std::byte> message);

template <class Message>
bool send(int socket, const Message& message, std::span<const int> descriptors = {}) {
    return send(socket, std::as_bytes(std::span(&message, 1)), descriptors);
}

} // namespace patina::protocol
