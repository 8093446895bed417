// Images and OpenColorIO's configurations: what the worker for images does.
#pragma once

#include "core/codec/Codec.h"

namespace patina::codec {

// All take the request's header and the payload or its descriptor. Throw Refusal and
// std::bad_alloc.
Reply decodeImage(const nlohmann::json& request, int payloadFd);
Reply encodeImage(const nlohmann::json& request, std::span<const std::byte> payload);
Reply displayMenu(const nlohmann::json& request);      // of an OpenColorIO configuration
Reply displayTransform(const nlohmann::json& request); // one of its views, for the GPU

// The part of decodeImage and encodeImage that Radiance files are.
Reply decodeRadiance(const nlohmann::json& request, int payloadFd);
Reply encodeRadiance(const nlohmann::json& request, std::span<const std::byte> payload);

// Once, before the first child is forked: loads what every child would have to load.
void prepareImageCodec();

} // namespace patina::codec
