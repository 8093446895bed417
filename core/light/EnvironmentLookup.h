// The light of an environment in any direction of the world, as each term of shading takes it: the
// picture itself, sums of bands, prefiltered levels, irradiance. What the Light lab reads out and
// `patina info --light` states.
#pragma once

#include "core/light/EnvironmentAnalysis.h"
#include "core/light/Ibl.h"
#include "core/light/Orientation.h"

#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>

namespace patina {

// Roughnesses that a series of prefiltered light is stated for, in equal steps from 0 to 1: looked
// up between the levels of the maps, as by the shader.
inline constexpr int kRoughnessSteps = 7;
[[nodiscard]] inline float roughnessStep(int step) { // perceptual, of 0 … kRoughnessSteps - 1
    return static_cast<float>(step) / static_cast<float>(kRoughnessSteps - 1);
}

// How far the sum of an environment's first bands is from it.
struct BandSumError {
    double rmse = 0.0;   // ShBandSum::rmse times the scale: radiance
    double share = 0.0;  // of the environment's RMS; 0 of a black one
    double lowest = 0.0; // the smallest channel of the sum in any direction: radiance
    glm::vec3 lowestDirection{0.0f, 1.0f, 0.0f}; // of the world
    bool belowZero = false;                      // by more than rounding: a thousandth of the RMS
};

// Values, cheap to copy. Directions are unit vectors of the world; radiance is that of the picture
// times scale and tint.
struct EnvironmentLookup {
    EnvironmentAnalysisPtr analysis;     // null: not there yet
    std::shared_ptr<const IblMaps> maps; // null: not there yet
    Orientation orientation;             // of the environment in the world
    float scale = 1.0f;                  // of all radiance, at least 0: the environment's exposure
    glm::vec3 tint{1.0f};                // and its colour in the mix, at most 1

    // Scale and tint of a factor of each channel, as EnvironmentPart::scale.
    void setScale(const glm::vec3& all);

    // Each is nothing while what it is looked up in is not there.
    [[nodiscard]] std::optional<glm::vec3> radiance(const glm::vec3& world) const;
    // Of the sum of the first 1 … kMaxShOrder bands; below zero where that is.
    [[nodiscard]] std::optional<glm::vec3> bandSum(int bands, const glm::vec3& world) const;
    // What a reflection of this roughness, 0…1, sees about a direction; 0: the cubemap that
    // reflections start from.
    [[nodiscard]] std::optional<glm::vec3> prefiltered(float perceptualRoughness,
                                                       const glm::vec3& world) const;
    // Irradiance of a surface with that normal: as surfaces take it, sampleIrradiance(); and from
    // nine coefficients (LightingMode::ShIrradiance).
    [[nodiscard]] std::optional<glm::vec3> irradiance(const glm::vec3& normal) const;
    [[nodiscard]] std::optional<glm::vec3> irradianceSh9(const glm::vec3& normal) const;

    // Numbers of all directions, with the scale and without the tint. They need `analysis`.
    [[nodiscard]] double rms() const; // of the radiance
    [[nodiscard]] BandSumError bandSumError(int bands) const;
};

// Root mean square over the sphere of the difference between irradiance from nine coefficients and
// the exact one, as a share of the exact one's root mean square; 0 of a black environment.
[[nodiscard]] double irradianceError(const IblMaps& maps);

} // namespace patina
