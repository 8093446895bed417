// The JSON and the binary chunk of a glTF file, GLB or not.
#pragma once

#include "core/codec/model/ModelFolder.h"

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string_view>

namespace patina::codec {

struct GltfContainer {
    std::string_view text;
    std::span<const std::byte> binary; // of a GLB
};

// By content and not by name. It lies in `file`. Throws Refusal.
[[nodiscard]] GltfContainer openGltfContainer(const MemoryFile& file);

// An object. Throws Refusal.
[[nodiscard]] nlohmann::json parseGltf(std::string_view text);

} // namespace patina::codec
