// Triangles of polygons, concave ones and such with points on their edges included.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace patina::codec {

// Ear clipping. Triangles name corners by their numbers and have the polygon's orientation; they
// are at most two fewer than corners. Together they cover a polygon that does not cross itself
// exactly once. It may touch itself, as outlines do that run into a hole and back. Throws Refusal
// where it has very many corners and touches or crosses itself so often that it would take too
// long.
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>>
triangulatePolygon(std::span<const glm::vec3> corners);

} // namespace patina::codec
