// Looking radiance up in a cubemap, and unrolling a cubemap to a lat-long image.
#pragma once

#include "core/job/JobContext.h"
#include "core/light/Ibl.h"

namespace patina {

// Texel (x, y) of a face; up to one step outside it, the nearest texel of the neighbour. At a
// corner of the cube three texels meet and the fourth is either of its neighbours.
[[nodiscard]] glm::vec3 cubeTexel(const CubeLevel& level, int face, int x, int y);

// Bilinear between texel centres, seamless: beyond a face's edge lie the texels of its neighbour.
// `direction` need not be normalised.
[[nodiscard]] glm::vec3 sampleCube(const CubeLevel& level, const glm::vec3& direction);

// Both mixed, `share` 0…1 of the second: the levels of a LevelPair.
[[nodiscard]] glm::vec3 sampleCubes(const CubeLevel& first, const CubeLevel& second, float share,
                                    const glm::vec3& direction);

// E(n): of the irradiance cube, or without one the last prefiltered level times pi, whose lobe is
// the cosine. `normal` need not be normalised.
[[nodiscard]] glm::vec3 sampleIrradiance(const IblMaps& maps, const glm::vec3& normal);

// 4 size × 2 size, F32, 3 channels, conventions of patina::Environment. Four samples per pixel,
// where the pixels are about as large as the cube's texels. Meaningless after a cancel.
[[nodiscard]] Image latLongFromCube(const CubeLevel& level, const JobContext& job);

} // namespace patina
