// What a bake was made from, as hashes: whether it is stale.
#pragma once

#include "core/trace/BakeInputs.h"

namespace patina {

// What AO and direct transfer depend on: geometry, and where masked or blended surfaces let rays
// through. A bake whose hash differs is stale.
[[nodiscard]] Hash hashBakeInputs(const BakeInputs& inputs);
// What bounces depend on besides: albedo, its maps, and which surfaces have two sides. Reads every
// texel of the maps: some milliseconds for a large one.
[[nodiscard]] Hash hashBakeAlbedo(const BakeInputs& inputs);

} // namespace patina
