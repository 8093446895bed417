// Finding vertices that are the same point: files often repeat a position for every triangle, but
// normals, charts and tangents must see one surface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace patina {

// For each of `count` rows of `stride` floats the index of the first row with equal numbers
// (0 and -0 are equal, NaN equals nothing but the same bits). Linear time; deterministic.
[[nodiscard]] std::vector<std::uint32_t> firstEqualRow(std::span<const float> rows,
                                                       std::size_t stride);

// The same for positions.
[[nodiscard]] std::vector<std::uint32_t> weldPositions(std::span<const glm::vec3> positions);

// The same for vertices, whose three arrays are of one length.
[[nodiscard]] std::vector<std::uint32_t> weldVertices(std::span<const glm::vec3> positions,
                                                      std::span<const glm::vec3> normals,
                                                      std::span<const glm::vec2> uvs);

} // namespace patina
