// Our own glTF 2.0 writer: scenes as JSON and one binary buffer, as separate files or as GLB.
// Checked with Khronos' glTF validator. Extensions: KHR_lights_punctual, KHR_texture_transform,
// KHR_materials_emissive_strength, KHR_materials_specular, KHR_materials_unlit,
// KHR_materials_variants, EXT_lights_image_based.
#pragma once

#include "core/base/AtomicFile.h"
#include "core/export/ExportContents.h"

#include <string>
#include <vector>

namespace patina {

struct GltfEnvironment;

struct GltfOutput {
    std::string json;
    Bytes buffer; // geometry, and for GLB the images
};

// `images`: for GLB the encoded file of each texture, which goes into the buffer; empty when the
// textures are files of their own. `environment`: its light and images, which always go into the
// buffer; null for none. Errors: Usage when the buffer would pass glTF's 4 GiB.
Result<GltfOutput> writeGltf(const ExportContents& contents, const ExportSettings& settings,
                             const std::vector<Bytes>& images,
                             const GltfEnvironment* environment = nullptr);

// JSON and buffer as one file: header, JSON chunk padded with spaces, BIN chunk with zeros.
[[nodiscard]] Bytes packGlb(const GltfOutput& gltf);

} // namespace patina
