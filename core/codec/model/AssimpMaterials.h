// Assimp's materials of OBJ, COLLADA and FBX files as metallic-roughness materials.
#pragma once

#include "core/mesh/ImportedModel.h"

#include <string>

struct aiMaterial;
struct aiScene;

namespace patina::codec {

class MtlText;

// Fills materials, embeddedImages and warnings. `texts`: of OBJ.
void readAssimpMaterials(const aiScene& scene, const std::string& format, const MtlText& texts,
                         ImportedModel& model);

// The set of texture coordinates that all textures of a material use; 0 where they differ.
[[nodiscard]] unsigned int assimpTextureSet(const aiMaterial& material);

} // namespace patina::codec
