// The worker's side of a request: from JSON and bytes to JSON and bytes. Runs in a child that may
// die; nothing in here is linked into the editor or the command line.
#pragma once

#include "core/worker/MemoryFile.h"

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <stdexcept>
#include <string>

namespace patina::codec {

struct Reply {
    std::string header; // JSON
    MemoryFile payload;
};

// What the user is told: `what()` is the message, `detail` what the library said.
class Refusal : public std::runtime_error {
  public:
    explicit Refusal(const std::string& message, std::string libraryDetail = {})
        : std::runtime_error(message)
        , detail(std::move(libraryDetail)) {}
    std::string detail;
};

// Memory for a payload. Throws std::bad_alloc.
MemoryFile allocate(std::size_t size);

// Throws Refusal for sizes that make no sense or lie beyond core/base/Limits.h.
void checkImageSize(long long width, long long height, long long channels, std::size_t sampleSize);

// Text from a file may be no UTF-8; JSON must be.
std::string toJsonText(const nlohmann::json& json);

// All take the request's header and the payload and its descriptor. Throw Refusal and
// std::bad_alloc.
Reply decodeImage(const nlohmann::json& request, int payloadFd);
Reply encodeImage(const nlohmann::json& request, std::span<const std::byte> payload);
Reply importModel(const nlohmann::json& request, int payloadFd);
Reply displayMenu(const nlohmann::json& request);      // of an OpenColorIO configuration
Reply displayTransform(const nlohmann::json& request); // one of its views, for the GPU

// The part of decodeImage and encodeImage that Radiance files are.
Reply decodeRadiance(const nlohmann::json& request, int payloadFd);
Reply encodeRadiance(const nlohmann::json& request, std::span<const std::byte> payload);

// Once, before the first child is forked: loads what every child would have to load.
void prepareImageCodec();

} // namespace patina::codec
