// White, clear and overcast: skies with a published formula.
#include "core/library/Directions.h"
#include "core/library/PortableMath.h"
#include "core/library/SkyCanvas.h"
#include "core/library/SkyRecipes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace patina::library {

namespace {

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
glm::dvec3 linearSrgbFromXyY(double x, double y, double bigY) {
    const double bigX = x / y * bigY, bigZ = (1.0 - x - y) / y * bigY;
    return glm::max(glm::dvec3(3.2404542 * bigX - 1.5371385 * bigY - 0.4985314 * bigZ,
                               -0.9692660 * bigX + 1.8760108 * bigY + 0.0415560 * bigZ,
                               0.0556434 * bigX - 0.2040259 * bigY + 1.0572252 * bigZ),
                    glm::dvec3(0.0));
}

} // namespace

ImagePtr whiteSky(double whiteFacingUp) {
    SkyCanvas canvas;
    canvas.fill(0, kSkyHeight,
                [&](const glm::vec3&) { return glm::vec3(static_cast<float>(whiteFacingUp)); });
    return canvas.finish();
}

// A clear morning, turbidity 2.6, sun 44° high; two thirds of the light come from the sun's disc.
ImagePtr clearSky(double whiteFacingUp) {
    constexpr double kTurbidity = 2.6, kSunRadiusDeg = 0.2666;
    const glm::dvec3 kHaze(0.925, 1.0, 1.22); // of luminance 1
    const glm::vec3 sun = directionFromAngles(-22.0, 43.8);
    const double thetaSun = acosPortable(sun.y);
    const PreethamSky sky(kTurbidity, thetaSun);
    const double cosSun = sun.y;

    SkyCanvas canvas;
    forRows(kSkyHeight / 2, [&](int row) {
        // Preetham's model grows without bound towards the horizon: held at 3°.
        const double cosTheta = std::max(0.052, static_cast<double>(canvas.direction(0, row).y));
        const auto factor = [&](const Perez& p, double zenith) {
            return zenith * p.zenithPart(cosTheta) /
                   (p.zenithPart(1.0) * p.sunPart(thetaSun, cosSun));
        };
        const double fY = factor(sky.luminance, sky.zenithLuminance);
        const double fx = factor(sky.x, sky.zenithX), fy = factor(sky.y, sky.zenithY);
        // Its horizon is purple at low turbidity: there the colour, not the luminance, gives way to
        // that of distant haze.
        const double haze = 0.85 * expPortable(-(cosTheta - 0.052) / 0.11);
        for (int x = 0; x < kSkyWidth; ++x) {
            const double cosGamma = glm::dot(canvas.direction(x, row), sun);
            const double gamma = acosPortable(cosGamma);
            const double bigY = fY * sky.luminance.sunPart(gamma, cosGamma);
            const glm::dvec3 color = linearSrgbFromXyY(fx * sky.x.sunPart(gamma, cosGamma),
                                                       fy * sky.y.sunPart(gamma, cosGamma), bigY);
            canvas.pixel(x, row) = glm::vec3(glm::mix(color, kHaze * bigY, haze));
        }
    });

    // The sun: twice what the whole sky gives to the ground, slightly warm after the air.
    const double ground = luminance(canvas.irradianceUpOverPi()) * kPi;
    const double solidAngle = 2.0 * kPi * (1.0 - cosTurns(kSunRadiusDeg / 360.0));
    const glm::dvec3 warm(1.08, 0.99, 0.86);
    canvas.addDisc(sun, kSunRadiusDeg, glm::vec3(warm * (2.0 * ground / (solidAngle * cosSun))));
    canvas.fillGround({0.21f, 0.18f, 0.145f}, 0.35f);
    canvas.expose(whiteFacingUp);
    return canvas.finish();
}

// CIE Standard Overcast Sky (ISO 15469, type 1 without its exponential; Moon & Spencer 1942):
// L(elevation) = Lz (1 + 2 sin elevation) / 3, so that E = 7 pi / 9 Lz.
ImagePtr overcastSky(double whiteFacingUp) {
    SkyCanvas canvas;
    const glm::vec3 tint(0.985f, 1.0f, 1.035f);
    canvas.fillSky([&](const glm::vec3& d) { return tint * ((1.0f + 2.0f * d.y) / 3.0f); });
    canvas.fillGround({0.20f, 0.19f, 0.17f}, 0.25f);
    canvas.expose(whiteFacingUp);
    return canvas.finish();
}

} // namespace patina::library
