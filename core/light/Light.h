// A light other than the environment, as plain values. What it does: core/light/Lights.h.
#pragma once

#include "core/base/Id.h"

#include <glm/vec3.hpp>
#include <string>

namespace patina {

enum class LightType { Point, Directional, Spot, Sphere, Rectangle };

// Every light emits along -directionToLight() where it has a direction (directional, spot,
// rectangle).
struct Light {
    Id id = 0;
    std::string name = "Light";
    LightType type = LightType::Directional;
    bool enabled = true;
    bool solo = false; // while anything is solo, everything else is off: LightMix.h
    bool usesTemperature = false;
    glm::vec3 color{1.0f};        // linear sRGB
    float temperatureK = 6500.0f; // of a black body; replaces `color` when usesTemperature
    // Directional: lux at normal incidence (E); point and spot: candela (I, at the spot's centre);
    // sphere and rectangle: nit (radiance L). Radiometrically the same numbers: 1 W ≙ 1 lm.
    float intensity = 3.0f;
    float gainEv = 0.0f;                  // the mixer's: scales the light by 2^EV
    glm::vec3 tint{1.0f};                 // the mixer's, linear sRGB: multiplies the light's colour
    glm::vec3 position{2.0f, 3.0f, 2.0f}; // metres; not of a directional light
    float azimuthDeg = 40.0f;             // where the light comes from, around +Y, 0 is +Z
    float elevationDeg = 45.0f;           // above the horizon
    float rollDeg = 0.0f;                 // rectangle: about its own direction
    float range = 0.0f;          // metres, 0: without end; glTF's windowed falloff (not area)
    float innerConeDeg = 20.0f;  // spot: half angle of full intensity
    float outerConeDeg = 35.0f;  // spot: half angle where it ends
    float radius = 0.25f;        // metres, sphere
    float width = 1.0f;          // metres, rectangle, along its local x
    float height = 1.0f;         // metres, rectangle
    bool castsShadow = true;     // spot and directional
    float shadowSoftness = 1.0f; // degrees: apparent diameter of the source, seen from the scene
    [[nodiscard]] glm::vec3 directionToLight() const; // unit vector
    friend bool operator==(const Light&, const Light&) = default;
};

} // namespace patina
