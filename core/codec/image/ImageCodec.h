// What the worker for images does: PNG, JPEG, OpenEXR, Radiance and PFM without OpenImageIO, so
// that it starts in a few milliseconds.
#pragma once

#include "core/codec/Codec.h"

namespace patina::codec {

// Both take the request's header and the payload or its descriptor, and throw Refusal and
// std::bad_alloc. decodeImage() answers protocol::kHandOn for a file that it would not read exactly
// as OpenImageIO does, and for one that seems to be damaged.
Reply decodeImage(const nlohmann::json& request, int payloadFd);
Reply encodeImage(const nlohmann::json& request, std::span<const std::byte> payload);
// Several files, one after another in the payload: "images" has the size and the decodeImage()
// request of each. Answers with "images": the header of each answer and the size of its pixels,
// which follow each other; null for those that are handed on, and for all after too many pixels.
Reply decodeImages(const nlohmann::json& request, std::span<const std::byte> payload);

// The part of them that Radiance files are.
Reply decodeRadiance(const nlohmann::json& request, int payloadFd);
Reply encodeRadiance(const nlohmann::json& request, std::span<const std::byte> payload);

// Portable float maps.
Reply decodePfm(const nlohmann::json& request, int payloadFd);

// Once, before the first child is forked: loads what every child would have to load.
void prepareImageCodec();

} // namespace patina::codec
