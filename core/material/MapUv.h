// Where a map is looked up: its scale, rotation and offset applied to texture coordinates.
#pragma once

#include "core/material/MapSlot.h"

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace patina {

// Rows of the 2 × 2 part of u' = T · R · S · u, as glTF's KHR_texture_transform is implemented
// everywhere (Khronos sample viewer, three.js, Babylon.js): (c sx, s sy) and (-s sx, c sy).
[[nodiscard]] glm::vec4 uvMatrix(const MapSlot& map);
[[nodiscard]] glm::vec2 mapUv(const MapSlot& map, const glm::vec2& uv);
// A normal map that is turned or mirrored on the surface takes its slopes along: its x points where
// u' grows, its y where v' shrinks, in the frame (tangent, bitangent) = (growing u, shrinking v).
// The slopes (x, y) become (dot(xy, slopes), dot(zw, slopes)).
[[nodiscard]] glm::vec4 normalBasis(const MapSlot& map);

} // namespace patina
