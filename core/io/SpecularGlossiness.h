// Materials of glTF's specular-glossiness model become metallic-roughness, numbers and maps, as in
// Khronos' converter (KhronosGroup/glTF,
// extensions/2.0/Archived/KHR_materials_pbrSpecularGlossiness, examples/convert-between-workflows).
#pragma once

#include "core/mesh/ImportedModel.h"

#include <functional>
#include <glm/vec3.hpp>

namespace patina {

class WorkerClient;

struct MetallicColor {
    glm::vec3 baseColor{0.0f};
    float metallic = 0.0f;
};

// The base colour and metalness whose diffuse and specular colours, both linear, are nearest.
[[nodiscard]] MetallicColor metallicOf(const glm::vec3& diffuse, const glm::vec3& specular);

// Once the files of textures are known; `readable` says which may be read. Converted maps join the
// embedded images, behind those of the file, in an order that depends on the file alone.
void convertSpecularGlossiness(WorkerClient& worker, ImportedModel& model,
                               const std::function<bool(const ImportedTexture&)>& readable);

} // namespace patina
