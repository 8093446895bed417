// Whether two scenes are the same for rays.
#pragma once

#include "core/trace/BakeInputs.h"

namespace patina {

// Rays end at the same places: geometry, and where it lets them pass; not colours.
[[nodiscard]] bool sameTransport(const BakeInputs& a, const BakeInputs& b);

} // namespace patina
