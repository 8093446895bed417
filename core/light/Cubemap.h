// Cubemaps with exact solid angles: directions, resampling of a lat-long image, reduction.
#pragma once

#include "core/job/JobContext.h"
#include "core/light/Ibl.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace patina {

// Direction, not normalised (its largest component is ±1), of face 0…5 at s, t in 0…1, t downwards
// from the first row. OpenGL 4.6, table 8.19, inverted.
[[nodiscard]] glm::vec3 cubeDirection(int face, float s, float t);

// Face and position of a direction, the inverse of cubeDirection.
struct CubePosition {
    int face;
    float s, t;
};
[[nodiscard]] CubePosition cubePosition(const glm::vec3& direction);

// Solid angles of a face's size² texels, row by row: the same for all faces. Exact: differences of
// atan(xy / sqrt(x² + y² + 1)) at the corners; six faces sum to 4pi.
[[nodiscard]] std::vector<float> cubeSolidAngles(int size);

// Radiance averaged over each texel of a cubemap: about two bilinear samples per texel of the image
// and direction; suns and other bright texels are moved by area, so that their energy is exact.
// Images much larger than the cubemap are averaged down first. Meaningless after a cancel.
[[nodiscard]] CubeLevel cubeFromLatLong(const Image& environment, int size, const JobContext& job);

// The next level: each texel the mean of four, weighted by their solid angles, so that the
// integral over the sphere stays the same.
[[nodiscard]] CubeLevel halveCube(const CubeLevel& level);

} // namespace patina
