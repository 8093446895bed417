// A picture lit by a bake of interreflected transfer shows as many bounces as its view asks for,
// off the colours that surfaces have now.
#pragma once

#include "core/base/Result.h"
#include "core/document/Document.h"
#include "core/document/Lighting.h"
#include "core/job/JobContext.h"

#include <string>
#include <vector>

namespace patina {

// Computes the bounces of attached bakes anew where a picture that is lit by `lighting` needs it:
// lightingOf() of its view. Returns warnings where they cannot be. Errors: Cancelled.
Result<std::vector<std::string>> followBounces(LightingMode lighting, Document& document,
                                               const JobContext& job);

} // namespace patina
