// The light of a clear sky: Preetham, Shirley, Smits 1999. Portable to the last bit, as everything
// the built-in skies are made of.
#pragma once

#include "core/math/PortableMath.h"

#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace patina::library {

// Preetham, Shirley, Smits: "A Practical Analytic Model for Daylight", SIGGRAPH 1999, appendix A.2.
struct Perez {
    double a, b, c, d, e;
    // Equation 3, the part that depends on the angle to the zenith and the part on that to the sun.
    [[nodiscard]] double zenithPart(double cosTheta) const {
        return 1.0 + a * expPortable(b / cosTheta);
    }
    [[nodiscard]] double sunPart(double gamma, double cosGamma) const {
        return 1.0 + c * expPortable(d * gamma) + e * cosGamma * cosGamma;
    }
};

struct PreethamSky {
    Perez luminance, x, y;
    double zenithLuminance, zenithX, zenithY; // kcd/m², chromaticity

    PreethamSky(double t, double thetaSun)
        : luminance{0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251,
                    0.1206 * t - 2.5771, -0.0670 * t + 0.3703}
        , x{-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989,
            -0.0033 * t + 0.0452}
        , y{-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537,
            -0.0109 * t + 0.0529} {
        const double chi = (4.0 / 9.0 - t / 120.0) * (kPi - 2.0 * thetaSun);
        zenithLuminance = (4.0453 * t - 4.9710) * sinRad(chi) / cosRad(chi) - 0.2155 * t + 2.4192;
        const double s1 = thetaSun, s2 = s1 * s1, s3 = s2 * s1;
        zenithX = t * t * (0.00166 * s3 - 0.00375 * s2 + 0.00209 * s1) +
                  t * (-0.02903 * s3 + 0.06377 * s2 - 0.03202 * s1 + 0.00394) +
                  (0.11693 * s3 - 0.21196 * s2 + 0.06052 * s1 + 0.25886);
        zenithY = t * t * (0.00275 * s3 - 0.00610 * s2 + 0.00317 * s1) +
                  t * (-0.04214 * s3 + 0.08970 * s2 - 0.04153 * s1 + 0.00516) +
                  (0.15346 * s3 - 0.26756 * s2 + 0.06670 * s1 + 0.26688);
    }
};

// CIE xyY to linear sRGB (D65).
inline glm::dvec3 linearSrgbFromXyY(double x, double y, double bigY) {
    const double bigX = x / y * bigY, bigZ = (1.0 - x - y) / y * bigY;
    return glm::max(glm::dvec3(3.2404542 * bigX - 1.5371385 * bigY - 0.4985314 * bigZ,
                               -0.9692660 * bigX + 1.8760108 * bigY + 0.0415560 * bigZ,
                               0.0556434 * bigX - 0.2040259 * bigY + 1.0572252 * bigZ),
                    glm::dvec3(0.0));
}

} // namespace patina::library
