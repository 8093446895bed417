// How much a solution would change if its elements were smaller: what an error bound, which is
// about the same elements, says nothing of.
#pragma once

#include "core/base/Result.h"
#include "core/job/JobContext.h"
#include "core/radiosity/document/LitDocument.h"

#include <cstddef>

namespace patina {

// An estimate, not a bound: it has the noise of both solutions, and elements that are twice too
// large may agree with those that are four times too large.
struct DiscretisationEstimate {
    std::size_t elements = 0; // of the finer solution
    // W/m²: root mean square by area, and the largest, of the differences between an element's
    // radiosity and the mean of the four that it was divided into, in any colour.
    double rms = 0.0, largest = 0.0;
};

// Divides every element in four and solves anew. `solution`: that of `scene` with the settings.
// Errors: Usage for more than settings.maxElements; those of SceneProblem::make() and solve().
Result<DiscretisationEstimate> estimateDiscretisation(const RadiosityScene& scene,
                                                      const radiosity::Solution& solution,
                                                      const RadiositySettings& settings,
                                                      const JobContext& job);

} // namespace patina
