// Which material is seen at each pixel of a traced picture.
#pragma once

#include "core/base/Id.h"
#include "core/job/JobContext.h"
#include "core/trace/path/PathTracer.h"

#include <vector>

namespace patina {

// Ids of Material, row by row from the top, at the middle of each pixel; 0: the background, or a
// mesh without a material. Backs of surfaces that have only one side are looked through. Fewer
// pixels than the view has when the job is cancelled.
[[nodiscard]] std::vector<Id> seenMaterials(const TraceScene& scene, const TraceView& view,
                                            const JobContext& job);

} // namespace patina
