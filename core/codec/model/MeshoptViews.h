// Buffer views of glTF that are compressed by EXT_meshopt_compression.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <vector>

namespace patina::codec {

// The extension of a view, whose own bytes are then a fallback that may be missing; else null.
[[nodiscard]] const nlohmann::json* meshoptOf(const nlohmann::json& view);

// The view's bytes, decoded and filtered as the extension says. Throws Refusal where it or its
// bytes are damaged, or where it announces more than so many bytes can hold.
[[nodiscard]] std::vector<std::byte> decodeMeshopt(const nlohmann::json& extension,
                                                   std::span<const std::byte> bytes);

} // namespace patina::codec
