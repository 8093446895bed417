#include "core/worker/Codec.h"

#include <new>
#include <nlohmann/json.hpp>

namespace patina::codec {

MemoryFile allocate(std::size_t size) {
    auto file = MemoryFile::create(size);
    if (!file)
        throw std::bad_alloc();
    return std::move(*file);
}

std::string toJsonText(const nlohmann::json& json) {
    return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

} // namespace patina::codec
