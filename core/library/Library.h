// The built-in library: meshes, skies and materials made by Patina's own code, so that nothing has
// to be downloaded. Deterministic: the same name gives the same bytes on every machine, and the
// same pointers for as long as somebody holds one of them.
#pragma once

#include "core/base/Result.h"
#include "core/image/Image.h"
#include "core/job/JobContext.h"
#include "core/material/Material.h"
#include "core/mesh/Mesh.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace patina::library {

struct Entry {
    std::string name;  // "shader-ball" — used as "builtin:shader-ball"
    std::string title; // "Shader Ball"
    std::string help;  // one sentence
};

[[nodiscard]] const std::vector<Entry>&
models(); // sphere rounded-cube torus-knot shader-ball cornell-box cornell-reference wall chess
          // gallery plane …
[[nodiscard]] const std::vector<Entry>&
environments(); // white clear-sky overcast studio sunset night
[[nodiscard]] const std::vector<Entry>&
materials(); // worn-painted-metal gold brushed-steel rough-plastic ceramic wood leather concrete …

struct ModelPart {
    std::string name;
    MeshPtr mesh;             // in metres, standing on y = 0
    std::string materialName; // parts with the same name share a material
    Material material;        // its default look (id 0)
};
// Usage error listing the names when there is none such.
Result<std::vector<ModelPart>> model(const std::string& name);

// Models that their own lights light, by way of their walls: they want no environment, and
// radiosity. A box is open at its front (+Z) alone.
enum class Room { None, Open, Box };
[[nodiscard]] Room roomOf(const std::string& model);

// Lat-long F32 RGB, 1024 × 512, conventions of patina::Environment; in up to a second, which a
// cancel ends between rows. Errors: Usage as above; Cancelled.
Result<ImagePtr> environment(const std::string& name, const JobContext& job = {});

// A material with its maps (ids 0), each map's source "builtin:MATERIAL/MAP"
// ("builtin:wood/baseColor"). Tileable, 512² or 1024².
Result<Material> material(const std::string& name);
Result<ImagePtr> map(const std::string& materialSlashMap); // "wood/baseColor"

} // namespace patina::library
