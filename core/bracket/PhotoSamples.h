// Places of the scene from which a response can be recovered: spread over the whole picture, where
// it is flat, so that neither the last pixel of misalignment nor noise matters much.
#pragma once

#include "core/bracket/PhotoRows.h"
#include "core/bracket/ResponseCurve.h"
#include "core/job/JobContext.h"

#include <array>
#include <span>
#include <vector>

namespace patina {

// For each channel of the photos the places that two of them show without clipping. `photos` have
// their shifts. The same ones every time.
[[nodiscard]] std::vector<std::vector<ResponseSample>> chooseSamples(std::span<const Photo> photos,
                                                                     const JobContext& job = {});

} // namespace patina
