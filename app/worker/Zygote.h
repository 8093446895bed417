// The parent of all decoding children: started once, has the libraries loaded, forks a child for
// each request, kills it when the client loses interest, and tells the client how it ended. It
// reads no file itself.
#pragma once

#include "app/worker/Child.h"

namespace patina::worker {

// Returns the exit status when the client has closed the control socket. Single-threaded.
int serve(int controlSocket, const Operations& operations);

} // namespace patina::worker
