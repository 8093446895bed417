// An environment as the scene sees it: turned and exposed.
#pragma once

#include "core/image/Image.h"

namespace patina {

// `image`: lat-long, F32, 3 channels. Turned about +Y, counter-clockwise as seen from above, and
// scaled by 2^exposureEv. A turn by whole pixels only moves them; in between, neighbours in a row
// are mixed in proportion, which keeps the flux of every row.
[[nodiscard]] Image orientEnvironment(const Image& image, float rotationDeg, float exposureEv);

} // namespace patina
