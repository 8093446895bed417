// What a document's lights do: in what colour and unit they shine, how much arrives at a
// point, and what a light becomes when its type is switched.
#pragma once

#include "core/light/Light.h"
#include "core/math/Bounds.h"

#include <string_view>
#include <utility>
#include <vector>

namespace patina {

// Linear sRGB without the intensity: the colour, or that of the temperature (luminance 1).
[[nodiscard]] glm::vec3 lightColor(const Light& light);

// The intensity with the mixer's gain, in the light's unit.
[[nodiscard]] float lightIntensity(const Light& light);

// What the light gives off, in its unit: colour, tint, intensity and gain.
[[nodiscard]] glm::vec3 lightPower(const Light& light);

[[nodiscard]] std::string_view intensityUnit(LightType type); // "cd", "lx" or "nit"

[[nodiscard]] constexpr bool hasPosition(LightType type) {
    return type != LightType::Directional;
}
[[nodiscard]] constexpr bool hasDirection(LightType type) {
    return type == LightType::Directional || type == LightType::Spot ||
           type == LightType::Rectangle;
}
[[nodiscard]] constexpr bool hasRange(LightType type) {
    return type == LightType::Point || type == LightType::Spot;
}
[[nodiscard]] constexpr bool canCastShadow(LightType type) {
    return type == LightType::Spot || type == LightType::Directional;
}

// Sets azimuth and elevation so that directionToLight() is `toLight`, which need not be of unit
// length; a vector of zeros changes nothing.
void setDirectionToLight(Light& light, const glm::vec3& toLight);

// A rectangle's axes: width lies along `x`, height along `y`; x × y is directionToLight(), so that
// seen from the lit side x runs to the left. The roll turns them about directionToLight(),
// clockwise seen from the lit side.
struct RectangleAxes {
    glm::vec3 x, y;
};
[[nodiscard]] RectangleAxes rectangleAxes(const Light& light);

// Cosines of the cone for spotFalloff() of shaders/shared/lights.glsl: scale and offset. The inner
// cone ends where the outer one does when it was set wider.
[[nodiscard]] std::pair<float, float> coneScaleOffset(const Light& light);

// Illuminance (lux, luminance of the colour left out) at `point` of a surface that faces the
// light's centre, unshadowed. Zero outside of its cone, range and lit side.
[[nodiscard]] float illuminanceAt(const Light& light, const glm::vec3& point);

// The same light as another type. It emits from the same side: a directional light gets a place at
// 2.5 times the scene's radius from its centre, a light with a place gets the direction it has seen
// from there, and a cone or rectangle that had no direction of its own aims at the centre. The
// intensity is converted so that illuminanceAt() the centre stays what it was; where the old or the
// new light does not reach the centre it becomes what a new light of that type has.
[[nodiscard]] Light convertedLight(const Light& light, LightType type, const Bounds& scene);

// A new light of the type for a scene of this size: up right of its front, lighting its centre with
// 3 lux, or what `Light` says for a directional one.
[[nodiscard]] Light defaultLight(LightType type, const Bounds& scene);

// Turns a light about the scene's centre, like the sun around the earth: `azimuthDeg` about +Y,
// counter-clockwise seen from above, then `elevationDeg` upwards, as far as the pole. A light with
// a place moves along, at the same distance, and keeps its aim relative to the centre.
[[nodiscard]] Light turnedLight(const Light& light, const glm::vec3& center, float azimuthDeg,
                                float elevationDeg);

} // namespace patina
