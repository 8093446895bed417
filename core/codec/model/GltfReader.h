// glTF 2.0 and GLB (Khronos specification 2.0.1) with the extensions Patina understands:
// KHR_draco_mesh_compression, KHR_texture_transform, KHR_materials_emissive_strength,
// KHR_lights_punctual, KHR_mesh_quantization, EXT_mesh_gpu_instancing, EXT_meshopt_compression,
// EXT_texture_webp, and KHR_materials_pbrSpecularGlossiness (core/io/SpecularGlossiness.h).
//
// Read here and not through Assimp 5.2.5, which loses occlusion strength, normal scale and emissive
// strength, misreads normalised texture coordinates and does not decode percent signs in URIs.
#pragma once

#include "core/codec/model/ModelFolder.h"
#include "core/mesh/ImportedModel.h"

namespace patina::codec {

// ImportedTexture::file is the decoded URI. Throws Refusal, std::bad_alloc and nlohmann's errors.
ImportedModel readGltf(const ModelFolder& folder);

} // namespace patina::codec
