// Light that a radiosity solution has left on a scene, at its vertices or in a light map, as files
// take it along.
#pragma once

#include "core/base/Id.h"
#include "core/image/Image.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <map>
#include <optional>
#include <vector>

namespace patina {

// One of each per vertex. With a light map: its coordinates alone.
struct LitVertices {
    // To be shown as it is, times the base colour's texture where there is one: linear, 0…1, and
    // opacity 1.
    std::vector<glm::vec4> colors;
    std::vector<glm::vec3> radiance; // of all that leaves, without texture lookups; not clamped
    // Where a texture multiplies `colors`: the radiance of a white surface, which they show instead
    // of `radiance`. Else empty.
    std::vector<glm::vec3> whiteRadiance{};
    std::vector<glm::vec2> lightMapUvs{}; // from the top-left corner, 0…1
};

using LitMeshes = std::map<Id, LitVertices>; // by MeshInstance::id

// A light map that all lit meshes share.
struct LitTexels {
    ImagePtr radiance;              // RGB, F32, linear, W/(m² sr): of all that leaves
    ImagePtr shown;                 // the same as displayed: RGB, U8, sRGB
    std::optional<double> exposure; // of `shown`: k; nullopt: cut off at 1
    // k that a bake with the automatic exposure shows the same light with. What it is computed from
    // (areas, what glows) is not in the texels, so that the file of `radiance` keeps it.
    double automaticExposure = 1.0;
};
// Attribute of that file: LitTexels::automaticExposure as text, as short as reads back the same.
inline constexpr const char* kAutomaticExposureAttribute = "patina:automaticExposure";
// MapSlot::source of Material::emissiveMap where it is the light map.
inline constexpr const char* kLightMapSource = "light map";
inline constexpr const char* kLightMapName = "light-map"; // what its files' names end with

} // namespace patina
