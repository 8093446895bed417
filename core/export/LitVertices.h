// Light that a radiosity solution has left on the vertices of a scene, as files take it along.
#pragma once

#include "core/base/Id.h"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <map>
#include <vector>

namespace patina {

// One of each per vertex.
struct LitVertices {
    // To be shown as it is, times the base colour's texture where there is one: linear, 0…1, and
    // opacity 1.
    std::vector<glm::vec4> colors;
    std::vector<glm::vec3> radiance; // of all that leaves, without texture lookups; not clamped
    // Where a texture multiplies `colors`: the radiance of a white surface, which they show instead
    // of `radiance`. Else empty.
    std::vector<glm::vec3> whiteRadiance{};
};

using LitMeshes = std::map<Id, LitVertices>; // by MeshInstance::id

} // namespace patina
