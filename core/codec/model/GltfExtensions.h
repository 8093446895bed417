// The extensions of a glTF file: which ones are read, and what is said of the others.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace patina::codec {

[[nodiscard]] bool isReadGltfExtension(std::string_view name);
// Not read, and nothing is missed without it.
[[nodiscard]] bool isHarmlessGltfExtension(std::string_view name);

// Throws Refusal for a file that means nothing without an extension that is not read.
void checkRequiredExtensions(const nlohmann::json& root);

// One sentence for each extension of materials that changes how they look and is not read, and one
// for all others.
[[nodiscard]] std::vector<std::string> unusedExtensions(const nlohmann::json& root);

} // namespace patina::codec
