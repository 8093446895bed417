// What the workers have in common: programs for models, for images and for OpenImageIO, each linked
// with its libraries alone. Started by Patina itself (core/worker/WorkerClient.h), never by hand.
#pragma once

#include "app/worker/Child.h"

#include <functional>

namespace patina::worker {

// main() of a worker. `prepare` loads what every child would have to load, before the first one is
// forked.
int workerMain(const Operations& operations, const std::function<void()>& prepare);

// The payload of a request to encode something. Throws codec::Refusal.
MemoryFile openPayload(const protocol::Request& request, FileDescriptor& payload);

} // namespace patina::worker
