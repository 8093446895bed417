// patina-worker: started by Patina itself (core/worker/WorkerClient.h), never by hand.
#include "app/worker/LibraryThreads.h"
#include "app/worker/Zygote.h"
#include "core/codec/Codec.h"
#include "core/worker/WorkerProtocol.h"

#include <chrono>
#include <cstdio>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <unistd.h>

int main() {
    int type = 0;
    socklen_t size = sizeof type;
    if (::getsockopt(patina::protocol::kControlFd, SOL_SOCKET, SO_TYPE, &type, &size) != 0 ||
        type != SOCK_SEQPACKET) {
        std::fputs("patina-worker reads files for Patina and is started by it.\n", stderr);
        return 2;
    }
    // What was needed to start is not to be found by a decoder, nor is one worker's memory by
    // another's.
    static char* nothing[] = {nullptr}; // no null pointer: libraries look through the list
    environ = nothing;
    ::prctl(PR_SET_DUMPABLE, 0, 0, 0, 0);
    patina::codec::prepareImageCodec();
    if (!patina::worker::settleLibraryThreads(std::chrono::seconds(2)))
        std::fputs("patina-worker: threads of a library stay busy\n", stderr);
    return patina::worker::serve(patina::protocol::kControlFd);
}
