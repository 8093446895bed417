// A worker's side of a request: from JSON and bytes to JSON and bytes. Runs in a child that may
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
    // Of a request that asks for what the file does not hold.
    static Refusal usage(const std::string& message) {
        Refusal refusal(message);
        refusal.isUsage = true;
        return refusal;
    }
    std::string detail;
    bool isUsage = false;
};

// Memory for a payload. Throws std::bad_alloc.
MemoryFile allocate(std::size_t size);
// A file that is open. Throws std::bad_alloc.
MemoryFile mapFile(int fd);

// Throws Refusal for sizes that make no sense or lie beyond core/base/Limits.h.
void checkImageSize(long long width, long long height, long long channels, std::size_t sampleSize);

// Text from a file may be no UTF-8; JSON must be.
std::string toJsonText(const nlohmann::json& json);

} // namespace patina::codec
