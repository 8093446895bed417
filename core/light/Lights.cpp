#include "core/light/Lights.h"

#include "core/light/Blackbody.h"
#include "core/light/Light.h"
#include "core/math/Shading.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace patina {
namespace {

constexpr float kPlaceDistance = 2.5f;  // of a new light from the centre, in scene radii
constexpr float kNewIlluminance = 3.0f; // lux at the centre
constexpr float kMinRadius = 1e-3f;     // metres: an empty scene has none

float sceneRadius(const Bounds& scene) {
    return std::max(scene.radius(), kMinRadius);
}

// Two digits are enough for a number that was made up.
float rounded(float value) {
    if (!(value > 0.0f) || !std::isfinite(value))
        return value;
    const float unit = std::pow(10.0f, std::floor(std::log10(value)) - 1.0f);
    return std::round(value / unit) * unit;
}

} // namespace

glm::vec3 Light::directionToLight() const {
    const float azimuth = glm::radians(azimuthDeg), elevation = glm::radians(elevationDeg);
    return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
            std::cos(azimuth) * std::cos(elevation)};
}

glm::vec3 lightColor(const Light& light) {
    return light.usesTemperature ? blackbodyColor(light.temperatureK) : light.color;
}

float lightIntensity(const Light& light) {
    return light.intensity * std::exp2(light.gainEv);
}

glm::vec3 lightPower(const Light& light) {
    return lightColor(light) * light.tint * lightIntensity(light);
}

std::string_view intensityUnit(LightType type) {
    switch (type) {
    case LightType::Point:
    case LightType::Spot:
        return "cd";
    case LightType::Directional:
        return "lx";
    case LightType::Sphere:
    case LightType::Rectangle:
        return "nit";
    }
    return {};
}

void setDirectionToLight(Light& light, const glm::vec3& toLight) {
    const float length = glm::length(toLight);
    if (!(length > 0.0f) || !std::isfinite(length))
        return;
    // At the poles every azimuth is right; the light keeps the one it has.
    if (std::hypot(toLight.x, toLight.z) > 1e-6f * length)
        light.azimuthDeg = glm::degrees(std::atan2(toLight.x, toLight.z));
    light.elevationDeg = glm::degrees(std::asin(std::clamp(toLight.y / length, -1.0f, 1.0f)));
}

RectangleAxes rectangleAxes(const Light& light) {
    // From the angles, not from a cross product with "up", which vanishes at the poles.
    const float azimuth = glm::radians(light.azimuthDeg), roll = glm::radians(light.rollDeg);
    const glm::vec3 x(std::cos(azimuth), 0.0f, -std::sin(azimuth));
    const glm::vec3 y = glm::cross(light.directionToLight(), x);
    return {std::cos(roll) * x + std::sin(roll) * y, std::cos(roll) * y - std::sin(roll) * x};
}

std::pair<float, float> coneScaleOffset(const Light& light) {
    const float outer = std::cos(glm::radians(light.outerConeDeg));
    const float inner = std::cos(glm::radians(std::min(light.innerConeDeg, light.outerConeDeg)));
    const float scale = 1.0f / std::max(0.001f, inner - outer);
    return {scale, -outer * scale};
}

float illuminanceAt(const Light& light, const glm::vec3& point) {
    const float intensity = lightIntensity(light);
    if (light.type == LightType::Directional)
        return intensity;
    const glm::vec3 toLight = light.position - point;
    const float distance2 = glm::dot(toLight, toLight);
    const float range2 = light.range * light.range;
    const float falloff =
        shading::pointFalloff(distance2, light.range > 0.0f ? 1.0f / range2 : 0.0f);
    switch (light.type) {
    case LightType::Point:
        return intensity * falloff;
    case LightType::Spot: {
        const auto [scale, offset] = coneScaleOffset(light);
        const float cosAngle =
            distance2 > 0.0f ? glm::dot(light.directionToLight(), toLight) / std::sqrt(distance2)
                             : 1.0f;
        return intensity * falloff * shading::spotFalloff(cosAngle, scale, offset);
    }
    case LightType::Sphere: {
        const float sin2 = light.radius * light.radius / std::max(distance2, 1e-12f);
        return intensity * shading::kPi * std::min(sin2, 1.0f);
    }
    case LightType::Rectangle: {
        if (!(distance2 > 0.0f))
            return 0.0f;
        const glm::vec3 n = toLight / std::sqrt(distance2);
        glm::vec3 x, y;
        shading::orthonormalBasis(n, x, y);
        const RectangleAxes axes = rectangleAxes(light);
        const auto local = [&](float across, float up) {
            const glm::vec3 p =
                toLight + across * light.width * axes.x + up * light.height * axes.y;
            return glm::vec3(glm::dot(x, p), glm::dot(y, p), glm::dot(n, p));
        };
        return intensity * shading::kPi *
               shading::quadFormFactor(local(-0.5f, -0.5f), local(0.5f, -0.5f), local(0.5f, 0.5f),
                                       local(-0.5f, 0.5f));
    }
    case LightType::Directional:
        break;
    }
    return 0.0f;
}

Light convertedLight(const Light& light, LightType type, const Bounds& scene) {
    if (type == light.type)
        return light;
    Light result = light;
    result.type = type;
    const glm::vec3 center = scene.center();
    if (!hasPosition(light.type))
        result.position = center + kPlaceDistance * sceneRadius(scene) * light.directionToLight();
    else if (!hasDirection(light.type) || type == LightType::Directional)
        setDirectionToLight(result, light.position - center);
    result.intensity = 1.0f;
    const float before = illuminanceAt(light, center), perUnit = illuminanceAt(result, center);
    const float converted = before / perUnit;
    result.intensity =
        before > 0.0f && std::isfinite(converted) ? converted : defaultLight(type, scene).intensity;
    return result;
}

Light defaultLight(LightType type, const Bounds& scene) {
    Light light;
    light.type = type;
    const float radius = sceneRadius(scene);
    light.position = scene.center() + kPlaceDistance * radius * light.directionToLight();
    light.radius = rounded(0.25f * radius);
    light.width = light.height = rounded(0.5f * radius);
    light.intensity = 1.0f;
    light.intensity = rounded(kNewIlluminance / illuminanceAt(light, scene.center()));
    return light;
}

Light turnedLight(const Light& light, const glm::vec3& center, float azimuthDeg,
                  float elevationDeg) {
    // Where it stands, as seen from the centre.
    Light place = light;
    const glm::vec3 offset = light.position - center;
    const float distance = glm::length(offset);
    if (hasPosition(light.type))
        setDirectionToLight(place, offset);
    Light turned = place;
    turned.azimuthDeg = std::remainder(place.azimuthDeg + azimuthDeg, 360.0f);
    turned.elevationDeg = std::clamp(place.elevationDeg + elevationDeg, -90.0f, 90.0f);
    Light result = light;
    if (!hasPosition(light.type)) {
        result.azimuthDeg = turned.azimuthDeg;
        result.elevationDeg = turned.elevationDeg;
        return result;
    }
    result.position = center + distance * turned.directionToLight();
    if (!hasDirection(light.type))
        return result;
    // Its aim keeps its angles to the line to the centre.
    result.azimuthDeg =
        std::remainder(light.azimuthDeg + turned.azimuthDeg - place.azimuthDeg, 360.0f);
    result.elevationDeg =
        std::clamp(light.elevationDeg + turned.elevationDeg - place.elevationDeg, -90.0f, 90.0f);
    return result;
}

} // namespace patina
