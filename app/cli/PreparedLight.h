// Image-based light for the commands that need it.
#pragma once

#include "core/light/Ibl.h"

namespace patina::cli {

// Of the folder PATINA_LIGHT_CACHE, where one is named, or else computed, and kept there.
// `environment`: as computeIbl() takes it. Errors: Cancelled.
Result<IblMaps> prepareLight(const Image& environment, const JobContext& job);

} // namespace patina::cli
