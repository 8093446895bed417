// Directions by azimuth and elevation.
#pragma once

#include "core/math/PortableMath.h"

#include <glm/vec3.hpp>

namespace patina::library {

// Unit vector; azimuth as the camera's yaw: 0 is +Z, 90 is +X.
inline glm::dvec3 directionFromAngles(double azimuthDeg, double elevationDeg) {
    const double a = azimuthDeg / 360.0, e = elevationDeg / 360.0;
    return {sinTurns(a) * cosTurns(e), sinTurns(e), cosTurns(a) * cosTurns(e)};
}

} // namespace patina::library
