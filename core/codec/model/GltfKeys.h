// Which keys of a glTF file are used, and why the others are not: GltfReader.cpp and what it calls,
// said key by key. tests/core/worker/GltfKeysTest.cpp takes each key out of a file and looks
// whether what is imported changes.
#pragma once

#include "core/mesh/ModelKeys.h"

#include <nlohmann/json_fwd.hpp>
#include <vector>

namespace patina::codec {

// Of each key one row for each use and reason, sorted. Throws Refusal and json::exception as the
// reader does.
[[nodiscard]] std::vector<ModelKey> gltfKeys(const nlohmann::json& root);

} // namespace patina::codec
