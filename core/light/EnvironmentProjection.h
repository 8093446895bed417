// Spherical harmonics of an environment by either of the methods there are: exactly, or by samples,
// as the classical programs do.
#pragma once

#include "core/image/Image.h"
#include "core/job/JobContext.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace patina {

enum class ShMethod {
    Exact,      // every pixel over its whole solid angle: projectLatLong()
    Qmc,        // Owen-scrambled Sobol' points: projectSobol()
    Stratified, // one random point in each of N × N cells: projectStratified()
};

// Samples as they are taken: for Stratified the next square.
[[nodiscard]] int environmentSamples(ShMethod method, int samples);

// Coefficients of `order` bands. `environment`: lat-long, F32, 3 channels or more; samples, 1 …
// 2^28, look up the pixel that they fall on. Does not depend on the number of threads; meaningless
// after a cancel.
[[nodiscard]] std::vector<glm::vec3> projectEnvironment(const Image& environment, int order,
                                                        ShMethod method, int samples,
                                                        const JobContext& job = {});

} // namespace patina
