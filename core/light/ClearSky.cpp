#include "core/light/ClearSky.h"

#include "core/base/Check.h"
#include "core/job/Parallel.h"
#include "core/light/DaylightModel.h"
#include "core/light/LatLongGrid.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <vector>

namespace patina {
namespace {

using library::kPi;

constexpr double kRealSunDiameterDeg = 0.53;
constexpr double kPerKilocandela = 1000.0 / kSkyUnitCandela;
// Preetham's model grows without bound towards the horizon: held from 3° above it downwards.
constexpr double kLowestCosTheta = 0.052;
constexpr double kGroundHaze = 0.045; // sine of the depression over which distance hides the ground

// --- The sun's light through the air: appendix A.1 of the paper, wavelengths in micrometres ---

// Piecewise Gaussian fits of the CIE 1931 colour matching functions: Wyman, Sloan, Shirley 2013,
// "Simple Analytic Approximations to the CIE XYZ Color Matching Functions", table 1 (in nm).
glm::dvec3 colorMatching(double nm) {
    const auto lobe = [nm](double height, double center, double below, double above) {
        const double t = (nm - center) * (nm < center ? below : above);
        return height * std::exp(-0.5 * t * t);
    };
    return {lobe(0.362, 442.0, 0.0624, 0.0374) + lobe(1.056, 599.8, 0.0264, 0.0323) +
                lobe(-0.065, 501.1, 0.0490, 0.0382),
            lobe(0.821, 568.8, 0.0213, 0.0247) + lobe(0.286, 530.9, 0.0613, 0.0322),
            lobe(1.217, 437.0, 0.0845, 0.0278) + lobe(0.681, 459.0, 0.0385, 0.0725)};
}

// Radiance of a black body of the sun's effective temperature, W m⁻² sr⁻¹ per metre.
double solarRadiance(double micrometres) {
    constexpr double kFirst = 1.191042972e-16, kSecond = 1.438776877e-2, kKelvin = 5778.0;
    const double lambda = micrometres * 1e-6;
    return kFirst / std::pow(lambda, 5.0) / std::expm1(kSecond / (lambda * kKelvin));
}

double transmittance(double lambda, double turbidity, double airMass) {
    const double rayleigh = 0.008735 * std::pow(lambda, -4.08);
    const double beta = 0.04608 * turbidity - 0.04586; // Ångström's turbidity
    const double aerosol = beta * std::pow(lambda, -1.3);
    // Ozone, 0.35 cm: a Gaussian through the Chappuis band instead of the paper's table. Gases and
    // water vapour absorb where the eye sees next to nothing and are left out.
    const double t = (lambda - 0.590) / 0.050;
    const double ozone = 0.35 * 0.125 * std::exp(-0.5 * t * t);
    return std::exp(-(rayleigh + aerosol + ozone) * airMass);
}

// Luminance and colour of the sun's real disc, linear sRGB in cd/m².
glm::dvec3 sunLuminance(double turbidity, double elevationDeg) {
    // Relative optical mass: Kasten 1966, as in the paper.
    const double zenithDeg = 90.0 - elevationDeg;
    const double airMass =
        1.0 / (std::cos(glm::radians(zenithDeg)) + 0.15 * std::pow(93.885 - zenithDeg, -1.253));
    constexpr double kLumensPerWatt = 683.0, kStepNm = 5.0;
    glm::dvec3 xyz(0.0);
    for (double nm = 380.0; nm <= 780.0; nm += kStepNm)
        xyz += colorMatching(nm) * (solarRadiance(nm * 1e-3) *
                                    transmittance(nm * 1e-3, turbidity, airMass) * kStepNm * 1e-9);
    return kLumensPerWatt * library::linearSrgbFromXyY(xyz.x / (xyz.x + xyz.y + xyz.z),
                                                       xyz.y / (xyz.x + xyz.y + xyz.z), xyz.y);
}

// --- The picture ---

class SkyPicture {
  public:
    SkyPicture(const Sky& sky, int height, const JobContext& job)
        : m_sky(sky)
        , m_job(job)
        , m_grid(height)
        , m_sun(directionFromAngles(sky.sunAzimuthDeg, sky.sunElevationDeg))
        , m_image(2 * height, height, 3, PixelType::F32, ColorEncoding::Linear)
        , m_pixels(reinterpret_cast<glm::vec3*>(m_image.f32().data())) {
        static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
    }

    Image make() {
        drawAir();
        const glm::vec3* lowest = &pixel(0, m_grid.height() / 2 - 1);
        m_horizon.assign(lowest, lowest + m_grid.width());
        drawSun();
        drawGround();
        return std::move(m_image);
    }

  private:
    glm::vec3& pixel(int x, int y) {
        return m_pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(m_grid.width()) +
                        static_cast<std::size_t>(x)];
    }

    void forRows(int count, const std::function<void(int)>& body) {
        parallelFor(m_job, static_cast<std::size_t>(count), m_grid.rowsPerRange(),
                    [&](std::size_t begin, std::size_t end) {
                        for (std::size_t row = begin; row < end; ++row)
                            body(static_cast<int>(row));
                    });
    }

    void drawAir() {
        const double thetaSun = glm::radians(90.0 - m_sky.sunElevationDeg), cosSun = m_sun.y;
        const library::PreethamSky model(m_sky.turbidity, thetaSun);
        // Under a high sun its horizon is purple or brown: there the colour, not the luminance,
        // gives way to that of distant haze, the whiter the more of it there is.
        const glm::dvec3 haze =
            glm::mix(glm::dvec3(0.925, 1.0, 1.22), glm::dvec3(1.0), (m_sky.turbidity - 2.0) / 8.0);
        const double hazeTint = 0.85 * glm::smoothstep(5.0f, 25.0f, m_sky.sunElevationDeg);
        forRows(m_grid.height() / 2, [&](int y) {
            const double cosTheta = std::max(kLowestCosTheta, m_grid.direction(0, y).y);
            const auto factor = [&](const library::Perez& p, double zenith) {
                return zenith * p.zenithPart(cosTheta) /
                       (p.zenithPart(1.0) * p.sunPart(thetaSun, cosSun));
            };
            const double fY = factor(model.luminance, model.zenithLuminance) * kPerKilocandela;
            const double fx = factor(model.x, model.zenithX), fy = factor(model.y, model.zenithY);
            const double tint = hazeTint * std::exp(-(cosTheta - kLowestCosTheta) / 0.11);
            for (int x = 0; x < m_grid.width(); ++x) {
                const double cosGamma =
                    std::clamp(glm::dot(m_grid.direction(x, y), m_sun), -1., 1.);
                const double gamma = library::acosPortable(cosGamma);
                const double bigY = fY * model.luminance.sunPart(gamma, cosGamma);
                const glm::dvec3 color =
                    library::linearSrgbFromXyY(fx * model.x.sunPart(gamma, cosGamma),
                                               fy * model.y.sunPart(gamma, cosGamma), bigY);
                pixel(x, y) = glm::mix(color, haze * bigY, tint);
            }
        });
    }

    // Share of a texel's area that the sun covers, on a grid fine against the sun.
    [[nodiscard]] double covered(int x, int y, double radius) const {
        const auto parts = [radius](double size) {
            return std::max(6, static_cast<int>(std::ceil(8.0 * size / radius)));
        };
        const int rows = parts(m_grid.texelAngle());
        const int columns = parts(m_grid.texelAngle() * m_grid.sinPolar(y));
        const double cosRadius = std::cos(radius);
        int inside = 0;
        for (int j = 0; j < rows; ++j)
            for (int i = 0; i < columns; ++i) {
                const glm::dvec3 d =
                    m_grid.directionAt(x + (i + 0.5) / columns, y + (j + 0.5) / rows);
                inside += glm::dot(d, m_sun) >= cosRadius;
            }
        return static_cast<double>(inside) / (rows * columns);
    }

    void drawSun() {
        const glm::dvec3 radiance = sunRadiance(m_sky);
        if (radiance == glm::dvec3(0.0))
            return;
        const double radius = glm::radians(0.5 * m_sky.sunDiameterDeg);
        const double reach = 0.75 * m_grid.texelAngle(); // from a texel's centre to its corners
        const double cosInner = std::cos(std::max(0.0, radius - reach));
        const double cosOuter = std::cos(radius + reach);
        const double polar = glm::radians(90.0 - m_sky.sunElevationDeg);
        const glm::ivec2 rows = m_grid.rowsBetween(polar - radius - reach, polar + radius + reach);

        struct Texel {
            int x, y;
            double part;
        };
        std::vector<Texel> texels;
        double sum = 0.0;
        for (int y = rows[0]; y < rows[1]; ++y)
            for (int x = 0; x < m_grid.width(); ++x) {
                const double c = glm::dot(m_grid.direction(x, y), m_sun);
                if (c < cosOuter)
                    continue;
                const bool whole = radius > reach && c > cosInner;
                const double part = whole ? 1.0 : covered(x, y, radius);
                if (part > 0.0) {
                    texels.push_back({x, y, part});
                    sum += part * m_grid.solidAngle(y);
                }
            }
        // The grid's small error is taken out; what lies below the horizon belongs to the sum, but
        // not to the picture.
        const double correction = sunSolidAngle(m_sky) / sum;
        for (const Texel& texel : texels)
            if (texel.y < m_grid.height() / 2)
                pixel(texel.x, texel.y) += glm::vec3(radiance * (texel.part * correction));
    }

    void drawGround() {
        // Irradiance of the ground, rows summed one by one in a fixed order.
        std::vector<glm::dvec3> rows(static_cast<std::size_t>(m_grid.height() / 2));
        forRows(m_grid.height() / 2, [&](int y) {
            glm::dvec3 row(0.0);
            for (int x = 0; x < m_grid.width(); ++x)
                row += glm::dvec3(pixel(x, y));
            rows[static_cast<std::size_t>(y)] = row * m_grid.projectedSolidAngle(y);
        });
        glm::dvec3 irradiance(0.0);
        for (const glm::dvec3& row : rows)
            irradiance += row;
        const glm::vec3 lit = glm::vec3(irradiance * (m_sky.groundAlbedo / kPi));
        forRows(m_grid.height() / 2, [&](int row) {
            const int y = m_grid.height() / 2 + row;
            // Far away the ground takes on the colour of the air in front of it.
            const double depth = -m_grid.direction(0, y).y;
            const auto air = static_cast<float>(0.8 * std::exp(-depth / kGroundHaze));
            for (int x = 0; x < m_grid.width(); ++x)
                pixel(x, y) = glm::mix(lit, m_horizon[static_cast<std::size_t>(x)], air);
        });
    }

    const Sky& m_sky;
    const JobContext& m_job;
    LatLongGrid m_grid;
    glm::dvec3 m_sun;
    Image m_image;
    glm::vec3* m_pixels;
    std::vector<glm::vec3> m_horizon; // the lowest row of the sky, without the sun
};

} // namespace

double sunSolidAngle(const Sky& sky) {
    const double s = std::sin(glm::radians(0.25 * sky.sunDiameterDeg)); // 1 - cos r = 2 sin² r/2
    return 4.0 * kPi * s * s;
}

glm::dvec3 sunRadiance(const Sky& sky) {
    const double quarter = glm::radians(0.25 * kRealSunDiameterDeg);
    const double realSolidAngle = 4.0 * kPi * std::sin(quarter) * std::sin(quarter);
    return sunLuminance(sky.turbidity, sky.sunElevationDeg) *
           (sky.sunScale * realSolidAngle / (sunSolidAngle(sky) * kSkyUnitCandela));
}

Image clearSkyImage(const Sky& sky, int height, const JobContext& job) {
    return SkyPicture(sky, height, job).make();
}

} // namespace patina
