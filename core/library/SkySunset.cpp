// A low sun behind thin clouds: single scattering in a spherical atmosphere after Nishita et al.,
// "Display of The Earth Taking into Account Atmospheric Scattering", SIGGRAPH 1993, with ozone.
#include "core/library/Directions.h"
#include "core/library/Noise.h"
#include "core/library/SkyCanvas.h"
#include "core/library/SkyRecipes.h"
#include "core/math/PortableMath.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <vector>

namespace patina::library {

namespace {

constexpr double kGroundRadius = 6360e3, kTopRadius = 6420e3; // metres
constexpr double kRayleighHeight = 8000.0, kMieHeight = 1200.0;
const glm::dvec3 kRayleigh(5.8e-6, 13.5e-6, 33.1e-6); // per metre at sea level, R G B
// Per metre at 25 km, twice the average amount: it takes the green out of the yellow horizon.
const glm::dvec3 kOzone(1.30e-6, 3.76e-6, 0.17e-6);
constexpr double kMie = 6.0e-6, kMieExtinction = 6.7e-6, kMieG = 0.78;

glm::dvec3 expNegative(const glm::dvec3& depth) {
    return {expPortable(-depth.r), expPortable(-depth.g), expPortable(-depth.b)};
}

double distanceToTop(const glm::dvec3& p, const glm::dvec3& d) {
    const double b = glm::dot(p, d);
    return -b + std::sqrt(b * b - glm::dot(p, p) + kTopRadius * kTopRadius);
}

// Column densities of air, aerosol and ozone.
struct Column {
    double air = 0, aerosol = 0, ozone = 0;
    void add(double altitude, double length) {
        air += expPortable(-altitude / kRayleighHeight) * length;
        aerosol += expPortable(-altitude / kMieHeight) * length;
        ozone += std::max(0.0, 1.0 - std::fabs(altitude - 25e3) / 15e3) * length;
    }
    [[nodiscard]] glm::dvec3 transmittance() const {
        return expNegative(kRayleigh * air + glm::dvec3(kMieExtinction * aerosol) + kOzone * ozone);
    }
};

glm::dvec3 scattered(const glm::dvec3& d, const glm::dvec3& sun) {
    constexpr int kSteps = 20, kSunSteps = 7;
    const glm::dvec3 origin(0.0, kGroundRadius + 50.0, 0.0);
    const double end = distanceToTop(origin, d);
    glm::dvec3 rayleigh(0.0);
    glm::dvec3 mie(0.0);
    Column view;
    double previous = 0.0;
    for (int i = 0; i < kSteps; ++i) {
        // Quadratic spacing: the air is dense near the eye.
        const double t = static_cast<double>(i + 1) / kSteps;
        const double next = end * t * t;
        const double length = next - previous;
        const glm::dvec3 p = origin + d * (previous + 0.5 * length);
        previous = next;
        const double altitude = glm::length(p) - kGroundRadius;
        Column path = view;
        path.add(altitude, 0.5 * length);
        view.add(altitude, length);

        const double sunEnd = distanceToTop(p, sun);
        double sunPrevious = 0.0;
        for (int k = 0; k < kSunSteps; ++k) {
            const double s = static_cast<double>(k + 1) / kSunSteps;
            const double sunNext = sunEnd * s * s;
            const glm::dvec3 q = p + sun * (0.5 * (sunPrevious + sunNext));
            path.add(std::max(0.0, glm::length(q) - kGroundRadius), sunNext - sunPrevious);
            sunPrevious = sunNext;
        }
        const glm::dvec3 light = path.transmittance() * length;
        rayleigh += light * expPortable(-altitude / kRayleighHeight);
        mie += light * expPortable(-altitude / kMieHeight);
    }
    const double mu = glm::dot(d, sun);
    const double phaseRayleigh = 3.0 / (16.0 * kPi) * (1.0 + mu * mu);
    // Henyey-Greenstein; x^1.5 as x sqrt(x).
    const double g2 = kMieG * kMieG, base = 1.0 + g2 - 2.0 * kMieG * mu;
    const double phaseMie = (1.0 - g2) / (4.0 * kPi * base * std::sqrt(base));
    // Light scattered more than once, which single scattering leaves out, is nearly isotropic.
    const double multiple = 0.35 / (4.0 * kPi);
    return rayleigh * kRayleigh * (phaseRayleigh + multiple) + mie * (kMie * (phaseMie + multiple));
}

// Radiance over azimuth from the sun (0…180°) and elevation, for a sun of irradiance 1 outside.
class SkyTable {
  public:
    SkyTable(const glm::vec3& sun, const JobContext& job)
        : m_values(static_cast<std::size_t>(kAzimuths) * kElevations) {
        const glm::dvec3 s(std::sqrt(1.0 - static_cast<double>(sun.y) * sun.y), sun.y, 0.0);
        parallelFor(job, kElevations, 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t e = begin; e < end; ++e) {
                const double t = static_cast<double>(e) / (kElevations - 1);
                const double turns = std::max(0.25 * t * t, 0.0002); // dense at the horizon
                for (std::size_t a = 0; a < kAzimuths; ++a) {
                    const double az = 0.5 * static_cast<double>(a) / (kAzimuths - 1);
                    const glm::dvec3 d(cosTurns(turns) * cosTurns(az), sinTurns(turns),
                                       cosTurns(turns) * sinTurns(az));
                    m_values[e * kAzimuths + a] = glm::vec3(scattered(d, s));
                }
            }
        });
    }
    [[nodiscard]] glm::vec3 sample(float elevationTurns, float azimuthTurns) const {
        const float e = std::sqrt(std::max(elevationTurns, 0.0f) * 4.0f) * (kElevations - 1);
        const float a = azimuthTurns * 2.0f * (kAzimuths - 1);
        const auto e0 = std::min(static_cast<std::size_t>(e), std::size_t{kElevations - 2});
        const auto a0 = std::min(static_cast<std::size_t>(a), std::size_t{kAzimuths - 2});
        const float fe = saturate(e - static_cast<float>(e0));
        const float fa = saturate(a - static_cast<float>(a0));
        const glm::vec3* v = &m_values[e0 * kAzimuths + a0];
        return glm::mix(glm::mix(v[0], v[1], fa), glm::mix(v[kAzimuths], v[kAzimuths + 1], fa), fe);
    }

  private:
    static constexpr int kAzimuths = 48, kElevations = 40;
    std::vector<glm::vec3> m_values;
};

} // namespace

ImagePtr sunsetSky(double whiteFacingUp, const JobContext& job) {
    constexpr double kSunAzimuth = -44.0, kSunElevation = 4.7, kSunRadiusDeg = 0.2666;
    const glm::vec3 sun = directionFromAngles(kSunAzimuth, kSunElevation);
    const SkyTable table(sun, job);
    const Field cloudNoise = fbm(512, {4, 12, 6, 0.55f, 211});
    const Field cloudCover = fbm(256, {3, 3, 3, 0.5f, 212});

    SkyCanvas canvas(job);
    canvas.forRows(0, kSkyHeight / 2, [&](int y) {
        const auto elevation =
            static_cast<float>(0.25 - (static_cast<double>(y) + 0.5) / kSkyHeight * 0.5);
        for (int x = 0; x < kSkyWidth; ++x) {
            const glm::vec3 d = canvas.direction(x, y);
            // u grows against the camera's azimuth: u = 0.5 is -Z (180°), u = 0 is +Z.
            double azimuth = 1.0 - (x + 0.5) / kSkyWidth - kSunAzimuth / 360.0;
            azimuth -= roundNearest(azimuth);
            glm::vec3 color = table.sample(elevation, static_cast<float>(std::fabs(azimuth)));

            // Clouds on a plane overhead, thin where noise is low, lit through by the sun.
            const float distance = 1.0f / (d.y + 0.10f);
            const float px = d.x * distance, pz = d.z * distance;
            const float cover = cloudCover.sample(px * 14.0f, pz * 14.0f);
            const float noise = cloudNoise.sample(px * 60.0f + pz * 18.0f, pz * 60.0f - px * 18.0f);
            const float density = smoothstep(0.02f, 0.55f, noise + 0.7f * cover + 0.05f) *
                                  smoothstep(0.015f, 0.12f, d.y);
            const float toSun = std::max(0.0f, glm::dot(d, sun));
            const float forward = toSun * toSun * toSun * toSun;
            const glm::vec3 lit = glm::mix(glm::vec3(0.034f, 0.021f, 0.022f),
                                           glm::vec3(0.36f, 0.145f, 0.048f), forward);
            color = glm::mix(color, lit * (1.15f - 0.5f * density), 0.8f * density);
            canvas.pixel(x, y) = color;
        }
    });

    // The disc, dimmed by the same air; divided by its solid angle a unit irradiance is radiance.
    Column toSun;
    const glm::dvec3 origin(0.0, kGroundRadius + 50.0, 0.0), s(sun);
    const double end = distanceToTop(origin, s);
    for (int i = 0; i < 64; ++i)
        toSun.add(glm::length(origin + s * (end * (i + 0.5) / 64)) - kGroundRadius, end / 64);
    const double solidAngle = 2.0 * kPi * (1.0 - cosTurns(kSunRadiusDeg / 360.0));
    constexpr double kVeil = 0.18; // a thin cloud before the disc
    canvas.addDisc(sun, kSunRadiusDeg, glm::vec3(toSun.transmittance() * (kVeil / solidAngle)));
    canvas.fillGround({0.165f, 0.135f, 0.115f}, 0.35f);
    canvas.expose(whiteFacingUp);
    return canvas.finish();
}

} // namespace patina::library
