// What a light map holds at a texel: how the light that arrives there differs from that which the
// viewport's image-based light has, as core/bake/lightmap computes it and the surface shader reads
// it. Formulas: docs/maths/light-map.md.
#pragma once

#include "core/bake/domain/BakeRequest.h"
#include "core/bake/lightmap/LightMapFit.h"

#include <cstddef>

namespace patina {

// Floats of TexelBake::values for each texel, in vectors of four: linear radiance and irradiance of
// the world, of the environment, of glowing surfaces, and of everything by way of other surfaces,
// but not straight from lights.
//   0: irradiance that is to be added to the environment's, rgb; ambient visibility, 0…1
//   1 … 9: of each harmonic of the mirror direction what is to be added to the prefiltered
//      radiance, rgb, and the share of that which is missing (below 0: there is more)
//   last: mean direction of the light of a uniform environment, xyz, times the ambient visibility
inline constexpr int kLightMapVectors = 2 + static_cast<int>(kLightMapTerms);
inline constexpr int kLightMapStride = 4 * kLightMapVectors - 1;
static_assert(kLightMapStride == kLightMapNumbers);
// The first of them are what surfaces are lit with.
inline constexpr int kLightMapSlices = 1 + static_cast<int>(kLightMapTerms);

} // namespace patina
