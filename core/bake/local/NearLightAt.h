// What local lights send to one point under transfer with traced shadows, as the picture has it:
// for looking closer.
#pragma once

#include "core/bake/document/TransferPoint.h"
#include "core/bake/local/NearShadows.h"

#include <glm/vec3.hpp>
#include <vector>

namespace patina {

// Exit radiance of an open surface of albedo 1: irradiance / π, in closed form. `normal`: unit.
// Zero of a directional light.
[[nodiscard]] glm::vec3 openNearLight(const Light& light, const glm::vec3& place,
                                      const glm::vec3& normal);

struct NearLightAt {
    std::vector<Id> lights;   // that have shares there; of the others harmonics say what arrives
    glm::vec3 radiance{0.0f}; // of these, that arrives directly: exit radiance of albedo 1
};

// At a point of the document's surface: between vertices as triangles interpolate, at texels the
// nearest one's share. `shadows`: null: none.
[[nodiscard]] NearLightAt nearLightAt(const Document& document, const NearShadowsPtr& shadows,
                                      const MeshPoint& point);

} // namespace patina
