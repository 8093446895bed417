#include "core/light/TransferLight.h"

#include "core/base/Check.h"
#include "core/document/Lights.h"
#include "core/math/ShRotation.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <limits>
#include <numbers>
#include <optional>

namespace patina {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kAngles = 256;        // samples of the irradiance from axis to antipode
constexpr double kTolerance = 1e-6; // of the mean, below zero: deringIrradiance() has the same
constexpr double kWidest = 64.0;    // bands: a window that does nothing
constexpr double kPointDeg = 1e-3;  // smaller discs are points

using Bands = std::array<double, kMaxShOrder>;

// A_l c_l0 K_l of the bands in use: irradiance at an angle t from the axis is Σ of these P_l(cos
// t).
Bands irradianceBands(const ZonalHarmonics& radiance, int order) {
    Bands bands{};
    for (int l = 0; l < order; ++l)
        bands[l] = cosineConvolution(l) * radiance[l] * std::sqrt((2.0 * l + 1.0) / (4.0 * kPi));
    return bands;
}

double lowest(const Bands& bands, const ShWindow& window) {
    Bands factors{};
    for (int l = 0; l < kMaxShOrder; ++l)
        factors[l] = window.factor(l) * bands[l];
    double lowest = std::numeric_limits<double>::max();
    for (int i = 0; i <= kAngles; ++i) {
        const double x = std::cos(kPi * i / kAngles);
        double p = x, previous = 1.0, sum = factors[0];
        for (int l = 1; l < kMaxShOrder; ++l) {
            sum += factors[l] * p;
            const double next = ((2.0 * l + 1.0) * x * p - l * previous) / (l + 1.0);
            previous = p;
            p = next;
        }
        lowest = std::min(lowest, sum);
    }
    return lowest;
}

double change(const Bands& bands, const ShWindow& window) {
    double sum = 0.0;
    for (int l = 0; l < kMaxShOrder; ++l) {
        const double lost = (1.0 - window.factor(l)) * bands[l];
        sum += lost * lost / (2.0 * l + 1.0); // mean of P_l² over the sphere
    }
    return sum;
}

void addEnvironment(const EnvironmentPart& part, std::span<const glm::vec3> known,
                    std::span<glm::vec3> sum, int order) {
    const std::size_t count = sum.size();
    std::vector<glm::vec3> turned(count);
    ShRotation::aboutY(glm::radians(static_cast<double>(part.rotationDeg)), order)
        .apply(known.first(count), std::span<glm::vec3>(turned));
    for (std::size_t i = 0; i < count; ++i)
        sum[i] += part.scale * turned[i];
}

} // namespace

ShWindow deringZonal(const ZonalHarmonics& radiance, int order) {
    CHECK(order >= 1 && order <= kMaxShOrder);
    const Bands bands = irradianceBands(radiance, order);
    const double floor = -kTolerance * std::abs(bands[0]);
    if (bands[0] <= 0.0 || lowest(bands, {}) >= floor)
        return {};
    std::optional<ShWindow> best;
    for (const ShWindowType type : {ShWindowType::Hann, ShWindowType::Lanczos}) {
        // Below one band only the mean is left, which is positive.
        double narrow = 1.0, wide = kWidest;
        while (wide - narrow > 1e-9 * wide) {
            const double width = 0.5 * (narrow + wide);
            (lowest(bands, {type, width}) >= floor ? narrow : wide) = width;
        }
        const ShWindow window{type, narrow};
        if (!best || change(bands, window) < change(bands, *best))
            best = window;
    }
    return *best;
}

ZonalHarmonics discLight(double diameterDeg, int order) {
    CHECK(diameterDeg >= 0.0 && diameterDeg <= 180.0);
    ZonalHarmonics light =
        diameterDeg < kPointDeg ? zonalDirectional() : zonalCap(0.5 * glm::radians(diameterDeg));
    const ShWindow window = deringZonal(light, order);
    for (int l = 0; l < kMaxShOrder; ++l)
        light[l] *= l < order ? window.factor(l) : 0.0;
    double facing = 0.0;
    for (const double band : irradianceBands(light, order))
        facing += band;
    for (double& coefficient : light)
        coefficient /= facing;
    return light;
}

std::array<float, kMaxShOrder> nearLightWindow(int order) {
    const ShWindow window = deringZonal(zonalDirectional(), order);
    std::array<float, kMaxShOrder> factors{};
    for (int l = 0; l < order; ++l)
        factors[l] = static_cast<float>(window.factor(l));
    return factors;
}

std::vector<glm::vec3> transferLight(const Document& document, int order,
                                     const EnvironmentProjection& projection) {
    CHECK(order >= 1 && order <= kMaxShOrder);
    const auto count = static_cast<std::size_t>(shCount(order));
    std::vector<glm::vec3> sum(count, glm::vec3(0.0f));

    const std::vector<EnvironmentPart> parts = environmentParts(document);
    const bool allKnown = std::all_of(parts.begin(), parts.end(), [&](const EnvironmentPart& part) {
        return projection(part).size() >= count;
    });
    if (allKnown) {
        for (const EnvironmentPart& part : parts)
            addEnvironment(part, projection(part), sum, order);
    } else if (const EnvironmentPart shown = shownEnvironment(document);
               projection(shown).size() >= count) {
        addEnvironment(shown, projection(shown), sum, order);
    }

    for (const Light& light : document.lights)
        if (light.type == LightType::Directional && shines(document, light))
            addZonal(discLight(light.shadowSoftness, order), light.directionToLight(),
                     lightPower(light), sum);
    return sum;
}

} // namespace patina
