// White, clear and overcast: skies with a published formula.
#include "core/library/Directions.h"
#include "core/library/SkyCanvas.h"
#include "core/library/SkyRecipes.h"
#include "core/light/DaylightModel.h"
#include "core/math/PortableMath.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace patina::library {

ImagePtr whiteSky(double whiteFacingUp, const JobContext& job) {
    SkyCanvas canvas(job);
    canvas.fill(0, kSkyHeight,
                [&](const glm::vec3&) { return glm::vec3(static_cast<float>(whiteFacingUp)); });
    return canvas.finish();
}

// A clear morning, turbidity 2.6, sun 44° high; two thirds of the light come from the sun's disc.
ImagePtr clearSky(double whiteFacingUp, const JobContext& job) {
    constexpr double kTurbidity = 2.6, kSunRadiusDeg = 0.2666;
    const glm::dvec3 kHaze(0.925, 1.0, 1.22); // of luminance 1
    const glm::vec3 sun = directionFromAngles(-22.0, 43.8);
    const double thetaSun = acosPortable(sun.y);
    const PreethamSky sky(kTurbidity, thetaSun);
    const double cosSun = sun.y;

    SkyCanvas canvas(job);
    canvas.forRows(0, kSkyHeight / 2, [&](int row) {
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
ImagePtr overcastSky(double whiteFacingUp, const JobContext& job) {
    SkyCanvas canvas(job);
    const glm::vec3 tint(0.985f, 1.0f, 1.035f);
    canvas.fillSky([&](const glm::vec3& d) { return tint * ((1.0f + 2.0f * d.y) / 3.0f); });
    canvas.fillGround({0.20f, 0.19f, 0.17f}, 0.25f);
    canvas.expose(whiteFacingUp);
    return canvas.finish();
}

} // namespace patina::library
