#include "core/mix/TransferLight.h"

#include "core/base/Check.h"
#include "core/light/Light.h"
#include "core/light/Lights.h"
#include "core/light/NearRectangle.h"
#include "core/math/ShRotation.h"
#include "core/math/Shading.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <utility>

namespace patina {
namespace {

constexpr int kAngles = 256;       // samples of the irradiance from axis to antipode
constexpr double kPointDeg = 1e-3; // smaller discs are points

using Bands = std::array<double, kMaxShOrder>;

// A_l c_l0 K_l of the bands in use: irradiance at the angle t from the axis is Σ these P_l(cos t).
Bands irradianceBands(const ZonalHarmonics& radiance, int order) {
    Bands bands{};
    for (int l = 0; l < order; ++l)
        bands[l] = cosineConvolution(l) * radiance[l] *
                   std::sqrt((2.0 * l + 1.0) / (4.0 * std::numbers::pi));
    return bands;
}

void addEnvironment(const EnvironmentPart& part, std::span<const glm::vec3> known,
                    std::span<glm::vec3> sum, int order) {
    const std::size_t count = sum.size();
    std::vector<glm::vec3> turned(count);
    part.orientation.harmonics(order).apply(known.first(count), std::span<glm::vec3>(turned));
    for (std::size_t i = 0; i < count; ++i)
        sum[i] += part.scale * turned[i];
}

} // namespace

double deringFactor(const ZonalHarmonics& radiance, int order) {
    CHECK(order >= 1 && order <= kMaxShOrder);
    const Bands bands = irradianceBands(radiance, order);
    double lowest = 0.0; // of the bands from 1 on
    for (int i = 0; i <= kAngles; ++i) {
        const double x = std::cos(std::numbers::pi * i / kAngles);
        double p = x, previous = 1.0, sum = 0.0;
        for (int l = 1; l < order; ++l) {
            sum += bands[l] * p;
            const double next = ((2.0 * l + 1.0) * x * p - l * previous) / (l + 1.0);
            previous = p;
            p = next;
        }
        lowest = std::min(lowest, sum);
    }
    return bands[0] < -lowest ? bands[0] / -lowest : 1.0;
}

ZonalHarmonics discLight(double diameterDeg, int order) {
    CHECK(diameterDeg >= 0.0 && diameterDeg <= 180.0);
    ZonalHarmonics light =
        diameterDeg < kPointDeg ? zonalDirectional() : zonalCap(0.5 * glm::radians(diameterDeg));
    const double factor = deringFactor(light, order);
    for (int l = 1; l < kMaxShOrder; ++l)
        light[l] *= l < order ? factor : 0.0;
    double facing = 0.0;
    for (const double band : irradianceBands(light, order))
        facing += band;
    for (double& coefficient : light)
        coefficient /= facing;
    return light;
}

std::array<float, kMaxShOrder> nearLightWindow(int order) {
    std::array<float, kMaxShOrder> factors{};
    factors[0] = 1.0f;
    const double factor = deringFactor(zonalDirectional(), order);
    for (int l = 1; l < order; ++l)
        factors[l] = static_cast<float>(factor);
    return factors;
}

std::optional<std::vector<glm::vec3>> environmentLight(std::span<const EnvironmentPart> parts,
                                                       int order,
                                                       const EnvironmentProjection& projection) {
    CHECK(order >= 1 && order <= kMaxShOrder);
    const auto count = static_cast<std::size_t>(shCount(order));
    std::vector<glm::vec3> sum(count, glm::vec3(0.0f));
    for (const EnvironmentPart& part : parts) {
        const std::span<const glm::vec3> known = projection(part);
        if (known.size() < count)
            return {};
        addEnvironment(part, known, sum, order);
    }
    return sum;
}

void addDistantLights(const Document& document, int order, std::span<glm::vec3> sum) {
    for (const Light* light : activeLights(document))
        if (light->type == LightType::Directional)
            addZonal(discLight(light->shadowSoftness, order), light->directionToLight(),
                     lightPower(*light), sum);
}

void addNearLights(const Document& document, const glm::vec3& place, int order,
                   std::span<glm::vec3> sum) {
    for (const Light* light : activeLights(document))
        if (light->type != LightType::Directional)
            addNearLight(*light, place, order, sum);
}

void addNearLight(const Light& light, const glm::vec3& place, int order, std::span<glm::vec3> sum) {
    CHECK(order >= 1 && order <= kMaxShOrder);
    const std::array<float, kMaxShOrder> window = nearLightWindow(order);
    std::array<float, kMaxShOrder * kMaxShOrder> y{};
    const glm::vec3 toLight = light.position - place;
    float reaches = 1.0f;
    switch (light.type) {
    case LightType::Directional:
        break;
    case LightType::Point:
    case LightType::Spot: {
        const float distance2 = glm::dot(toLight, toLight);
        const glm::vec3 l = toLight / std::sqrt(std::max(distance2, 1e-12f));
        const float range2 = light.range * light.range;
        reaches = shading::pointFalloff(distance2, range2 > 0.0f ? 1.0f / range2 : 0.0f);
        if (light.type == LightType::Spot) {
            const auto [scale, offset] = coneScaleOffset(light);
            reaches *= shading::spotFalloff(glm::dot(light.directionToLight(), l), scale, offset);
        }
        shading::nearPointSh(l, order, window.data(), y.data());
        break;
    }
    case LightType::Sphere:
        shading::nearSphereSh(toLight, light.radius, order, window.data(), y.data());
        break;
    case LightType::Rectangle: {
        const RectangleAxes axes = rectangleAxes(light);
        projectRectangle(nearRectangle(light.position, 0.5f * light.width * axes.x,
                                       0.5f * light.height * axes.y),
                         place, order, window, y);
        break;
    }
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(shCount(order)); ++i)
        sum[i] += lightPower(light) * (reaches * y[i]);
}

std::vector<glm::vec3> transferLight(const Document& document, int order,
                                     const EnvironmentProjection& projection) {
    auto sum = environmentLight(environmentParts(document), order, projection);
    if (!sum)
        sum = environmentLight(std::array{shownEnvironment(document)}, order, projection);
    if (!sum)
        sum.emplace(static_cast<std::size_t>(shCount(order)), glm::vec3(0.0f));
    addDistantLights(document, order, *sum);
    return std::move(*sum);
}

} // namespace patina
