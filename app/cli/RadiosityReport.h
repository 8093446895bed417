// What `patina bake radiosity` says of a solution: counts, how exact it is, and what found it
// where.
#pragma once

#include "app/cli/Options.h"
#include "app/cli/Report.h"
#include "core/radiosity/Solve.h"
#include "core/radiosity/document/LitDocument.h"

namespace patina::cli {

void reportRadiosity(Report& report, const BakeRadiosityOptions& options,
                     const RadiositySettings& settings, const RadiosityScene& scene,
                     const radiosity::SolveReport& solved);

} // namespace patina::cli
