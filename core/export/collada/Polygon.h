// Polygons of a file as triangles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace patina::collada {

// Concave polygons of more corners take too long to cut.
inline constexpr std::size_t kMaxConcaveCorners = 1024;

// Corners of a polygon (three or more, nearly in a plane) as count - 2 triangles of its turning
// sense. A convex one is a fan of its first corner; ears are cut off a concave one. None: concave,
// and of more than kMaxConcaveCorners corners.
[[nodiscard]] std::optional<std::vector<std::array<std::uint32_t, 3>>>
trianglesOf(std::span<const glm::dvec3> corners);

} // namespace patina::collada
