// A cloudless sky with its sun over a plain ground: Preetham, Shirley, Smits 1999, "A Practical
// Analytic Model for Daylight" (docs/maths/ibl.md).
#pragma once

#include "core/image/Image.h"
#include "core/job/JobContext.h"
#include "core/light/Environment.h"

#include <glm/vec3.hpp>

namespace patina {

// One unit of radiance in the picture of a sky, in cd/m²: with it the default sky lights a
// horizontal surface like builtin:clear-sky at EV 0.
inline constexpr double kSkyUnitCandela = 20000.0;

// The sun as it looks through the air, linear sRGB in the units of the picture: its illuminance
// does not depend on `sunDiameterDeg`, so that a larger sun is softer and not brighter.
[[nodiscard]] glm::dvec3 sunRadiance(const Sky& sky);
[[nodiscard]] double sunSolidAngle(const Sky& sky); // 2 pi (1 - cos radius)

// Lat-long, F32, 3 channels, 2 height × height. The sun's texels hold its flux exactly however
// coarse the picture is; of a sun on the horizon the part above. Meaningless after a cancel.
[[nodiscard]] Image clearSkyImage(const Sky& sky, int height, const JobContext& job = {});

} // namespace patina
