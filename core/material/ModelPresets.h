// Shading models by name, and metals by their measured optical constants.
#pragma once

#include "core/material/ShadingModel.h"

#include <span>
#include <string_view>

namespace patina {

struct ModelPreset {
    std::string_view title; // "Unreal Engine 4"
    std::string_view help;  // one sentence
    ShadingModel model;     // its choices count; f90, ior and the conductor's index do not
};

[[nodiscard]] std::span<const ModelPreset> modelPresets();
// Whether `model` makes the preset's choices, whatever its numbers.
[[nodiscard]] bool sameChoices(const ShadingModel& a, const ShadingModel& b);

// Complex refractive index n + ik at 630, 532 and 465 nm.
struct Conductor {
    std::string_view title; // "Gold"
    glm::vec3 n, k;
    std::string_view source; // of the measurement
};

[[nodiscard]] std::span<const Conductor> conductors();

} // namespace patina
