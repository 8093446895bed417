// Image-based light for the commands that need it.
#pragma once

#include "core/light/Ibl.h"

namespace patina::cli {

// Computed, and kept for the next time where the editor keeps it, too (~/.cache/Patina/Patina/ibl),
// or in the folder PATINA_LIGHT_CACHE; nowhere where that is empty.
// `environment`: as computeIbl() takes it. Errors: Cancelled.
Result<IblMaps> prepareLight(const Image& environment, const JobContext& job);

} // namespace patina::cli
