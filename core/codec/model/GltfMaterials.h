// The materials of a glTF file, with the textures they name.
#pragma once

#include "core/codec/model/GltfBuffers.h"
#include "core/mesh/ImportedModel.h"

#include <nlohmann/json_fwd.hpp>

namespace patina::codec {

// The set of texture coordinates that all textures of a material use; 0 where they differ.
[[nodiscard]] int gltfTextureSet(const nlohmann::json& material);

// Fills materials, embeddedImages and warnings.
void readGltfMaterials(const nlohmann::json& root, const GltfBuffers& buffers,
                       ImportedModel& model);

} // namespace patina::codec
