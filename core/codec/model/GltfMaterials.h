// The materials of a glTF file, with the textures they name.
#pragma once

#include "core/codec/model/GltfBuffers.h"
#include "core/mesh/ImportedModel.h"

#include <nlohmann/json_fwd.hpp>

namespace patina::codec {

// Fills materials, embeddedImages and warnings.
void readGltfMaterials(const nlohmann::json& root, const GltfBuffers& buffers,
                       ImportedModel& model);

} // namespace patina::codec
