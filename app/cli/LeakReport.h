// What `patina bake radiosity --find-leaks` says: leaks and seams of a solution.
#pragma once

#include "app/cli/BakeRadiosity.h"

namespace patina::cli {

// Errors: Cancelled.
Result<void> reportLeaksAndSeams(Session& session, const RadiosityInputs& inputs,
                                 const RadiositySettings& settings, const SolvedRadiosity& solved);

} // namespace patina::cli
