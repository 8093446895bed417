// Assimp's materials of OBJ, COLLADA and FBX files as metallic-roughness materials.
#pragma once

#include "core/mesh/ImportedModel.h"

#include <string>

struct aiScene;

namespace patina::codec {

// Fills materials, embeddedImages and warnings.
void readAssimpMaterials(const aiScene& scene, const std::string& format, ImportedModel& model);

} // namespace patina::codec
