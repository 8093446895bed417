// What is found in an environment's picture before it lights anything: samples that are no light,
// and how much of it bands of spherical harmonics hold. The Light lab, the Transfer dock and
// `patina info --light` state these numbers.
#pragma once

#include "core/image/Image.h"
#include "core/job/JobContext.h"
#include "core/light/ShBands.h"

#include <cstddef>
#include <memory>

namespace patina {

struct EnvironmentAnalysis {
    ImagePtr environment;           // lat-long, finite, at least 0
    std::size_t invalidSamples = 0; // of the picture: negative, infinite or no number; repaired
    ShBands bands;                  // of `environment`, neither rotated nor scaled
};
using EnvironmentAnalysisPtr = std::shared_ptr<const EnvironmentAnalysis>;

// `environment`: lat-long, F32, 3 channels or more, conventions of patina::Environment; it is
// shared where it has no invalid samples. Deterministic. Null after a cancel.
[[nodiscard]] EnvironmentAnalysisPtr analyseEnvironment(const ImagePtr& environment,
                                                        const JobContext& job);

} // namespace patina
