// An environment as the scene sees it: rotated and exposed.
#pragma once

#include "core/image/Image.h"
#include "core/job/JobContext.h"
#include "core/light/Orientation.h"

namespace patina {

// `image`: lat-long, F32, 3 channels. As it stands in the world, scaled by 2^exposureEv. A rotation
// by whole pixels only moves them; in between, neighbours in a row are mixed in proportion, which
// keeps the flux of every row. What is tilted or rolled is resampled (resampleEnvironment());
// meaningless after a cancel.
[[nodiscard]] Image orientEnvironment(const Image& image, const Orientation& orientation,
                                      float exposureEv, const JobContext& job = {});

} // namespace patina
