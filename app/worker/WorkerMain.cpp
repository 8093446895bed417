#include "app/worker/WorkerMain.h"

#include "app/worker/LibraryThreads.h"
#include "app/worker/Zygote.h"
#include "core/worker/WorkerProtocol.h"

#include <chrono>
#include <cstdio>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <unistd.h>

namespace patina::worker {

int workerMain(const Operations& operations, const std::function<void()>& prepare) {
    int type = 0;
    socklen_t size = sizeof type;
    if (::getsockopt(protocol::kControlFd, SOL_SOCKET, SO_TYPE, &type, &size) != 0 ||
        type != SOCK_SEQPACKET) {
        std::fputs("This program reads files for Patina and is started by it.\n", stderr);
        return 2;
    }
    // What was needed to start is not to be found by a decoder, nor is one worker's memory by
    // another's.
    static char* nothing[] = {nullptr}; // no null pointer: libraries look through the list
    environ = nothing;
    ::prctl(PR_SET_DUMPABLE, 0, 0, 0, 0);
    prepare();
    if (!settleLibraryThreads(std::chrono::seconds(2)))
        std::fputs("patina: threads of a worker's library stay busy\n", stderr);
    return serve(protocol::kControlFd, operations);
}

MemoryFile openPayload(const protocol::Request& request, FileDescriptor& payload) {
    auto bytes = MemoryFile::open(std::move(payload), request.payloadSize);
    if (!bytes)
        throw codec::Refusal("the image cannot be encoded", "payload");
    return std::move(*bytes);
}

} // namespace patina::worker
