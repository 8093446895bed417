#include "app/worker/Child.h"

#include "app/worker/Landlock.h"
#include "app/worker/Sandbox.h"
#include "app/worker/SelfTest.h"
#include "core/codec/Codec.h"

#include <array>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <new>
#include <nlohmann/json.hpp>
#include <sys/syscall.h>
#include <unistd.h>

namespace patina::worker {

namespace {

using nlohmann::json;

// Without handlers, destructors and a leak sanitizer's final search, for which the sandbox has no
// room: the answer has been given.
[[noreturn]] void end(int status) {
    ::syscall(SYS_exit_group, status);
    __builtin_unreachable();
}

codec::Reply dispatch(const json& header, const Operations& operations,
                      const protocol::Request& request, FileDescriptor& payload) {
    const auto op = header.at("op").get<std::string>();
    if (const auto found = operations.find(op); found != operations.end())
        return found->second(header, request, payload);
    throw codec::Refusal("unknown request", op);
}

void answer(int socket, protocol::Event event, const std::string& header, MemoryFile payload) {
    protocol::Report report;
    report.event = event;
    report.headerSize = header.size();
    report.payloadSize = payload.bytes().size();
    auto text = MemoryFile::copyOf(std::as_bytes(std::span(header)));
    if (!text || !text->seal() || !payload.seal())
        end(2);
    const std::array<int, 2> descriptors{text->fd(), payload.fd()};
    if (!protocol::send(socket, report, descriptors))
        end(3);
}

// `kind`: "internal", "usage", or empty: the file is broken.
void refuse(int socket, const std::string& message, const std::string& detail,
            const std::string& kind = {}) {
    json error = {{"message", message}, {"detail", detail}};
    if (!kind.empty())
        error["kind"] = kind;
    auto empty = MemoryFile::create(0);
    if (!empty)
        end(2);
    answer(socket, protocol::Event::Failed, codec::toJsonText(error), std::move(*empty));
}

} // namespace

void runChild(const Operations& operations, const protocol::Request& request,
              std::vector<FileDescriptor> descriptors) {
    // (protocol::kRequestFd is free: it was the worker's control socket.)
    const FileDescriptor socket(
        ::fcntl(descriptors[0].get(), F_DUPFD_CLOEXEC, protocol::kRequestFd));
    descriptors[0].reset();
    // A crash is to end the process by its signal, whatever handlers libraries set. A sanitizer's
    // is kept for its report.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT})
        ::signal(signal, SIG_DFL);
#endif
    ::dup2(descriptors[2].get(), STDOUT_FILENO);
    ::dup2(descriptors[2].get(), STDERR_FILENO);
    descriptors[2].reset();
    try {
        // The header is the client's own; what is to be distrusted is the payload.
        auto text = MemoryFile::open(std::move(descriptors[1]), request.headerSize);
        if (!text)
            end(2);
        const json header = json::parse(text->text());
        text.reset();
        const int landlock = request.landlock != 0 ? landlockVersion() : 0;
        if (const std::string failure = confine(request.memoryBytes, request.cpuSeconds, landlock);
            !failure.empty()) {
            refuse(socket.get(), "the sandbox for reading files cannot be set up on this system",
                   failure, "internal");
            end(0);
        }
        codec::Reply reply = header.at("op") == "selfTest"
                                 ? selfTest(header, landlock)
                                 : dispatch(header, operations, request, descriptors[3]);
        answer(socket.get(), protocol::Event::Answered, reply.header, std::move(reply.payload));
    } catch (const codec::Refusal& refusal) {
        refuse(socket.get(), refusal.what(), refusal.detail, refusal.isUsage ? "usage" : "");
    } catch (const std::bad_alloc&) {
        refuse(socket.get(),
               fmt::format("reading the file needs more than {} MiB of memory; it is damaged or "
                           "too large",
                           request.memoryBytes >> 20),
               "out of memory");
    } catch (const std::exception& exception) {
        refuse(socket.get(), "the file is damaged or uses a feature that is not supported",
               exception.what());
    }
    end(0);
}

} // namespace patina::worker
