// What the worker with OpenImageIO does: the formats that the worker for images does not read or
// write itself, the files that it hands on, and OpenColorIO's configurations.
#pragma once

#include "core/codec/Codec.h"

namespace patina::codec {

// All take the request's header and the payload or its descriptor. Throw Refusal and
// std::bad_alloc.
Reply decodeWithOpenImageIo(const nlohmann::json& request, int payloadFd);
Reply encodeWithOpenImageIo(const nlohmann::json& request, std::span<const std::byte> payload);
Reply displayMenu(const nlohmann::json& request);      // of an OpenColorIO configuration
Reply displayTransform(const nlohmann::json& request); // one of its views, for the GPU

// Once, before the first child is forked: loads what every child would have to load.
void prepareOpenImageIo();

} // namespace patina::codec
