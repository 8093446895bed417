// From one layout of an environment to another, keeping constants constant and the flux of lights.
#pragma once

#include "core/job/JobContext.h"
#include "core/light/EnvironmentMapping.h"
#include "core/light/Orientation.h"

namespace patina {

struct EnvironmentView {
    Orientation orientation; // that the environment is brought into
    float scale = 1.0f;      // multiplies radiance
};

// `picture` is a float RGB image of the mapping `from`; the result one of `to`, black where `to`
// covers no direction. Radiance is averaged over each pixel of the result with at least two samples
// per pixel of the source; what is 16 times brighter than the mean (suns, light sources) is moved
// by area instead, so that its flux arrives however small it is. Lat-longs are reduced by exact
// areas. Meaningless after a cancel. Progress goes from 0 to 1.
[[nodiscard]] Image resampleEnvironment(const Image& picture, const EnvironmentMapping& from,
                                        const EnvironmentMapping& to,
                                        const EnvironmentView& view = {},
                                        const JobContext& job = {});

// A lat-long at most `maxWidth` wide, each pixel the mean of what it covers, weighted with exact
// solid angles. Unchanged when it fits.
[[nodiscard]] Image shrinkLatLong(const Image& picture, int maxWidth);

// The sum of radiance times solid angle over the sphere, W/m² seen by a sphere of cross-section 1.
[[nodiscard]] glm::dvec3 environmentFlux(const Image& picture, const EnvironmentMapping& mapping);

} // namespace patina
