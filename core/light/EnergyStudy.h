// A material's energy over roughness and angle: curves, a map, and what is wrong, for people to
// look at. Computed at once from a model and the material's numbers, apart from any window.
#pragma once

#include "core/image/TexelRange.h"
#include "core/job/JobContext.h"
#include "core/light/Energy.h"

#include <functional>
#include <optional>
#include <vector>

namespace patina {

struct Material;

// Between which numbers a material lies: its maps vary them. Each number for itself; the mean is
// that of all texels.
struct SurfaceRange {
    SurfacePoint low, mean, high;
    friend bool operator==(const SurfaceRange&, const SurfaceRange&) = default;
};

// `rangeOf`: texelRange() of a map's image, perhaps remembered. Maps that could not be read do not
// count. Metallic and roughness are limited to 0…1 as the renderer does; colours are not.
[[nodiscard]] SurfaceRange surfaceRange(const Material& material,
                                        const std::function<TexelRange(const ImagePtr&)>& rangeOf);

struct EnergyPoint {
    Returned single, compensated; // of a uniform environment, without and with energy compensation
    Returned lights;              // of lights, by the model as it is: the exact integral
};

// What a material does that no real one can, and where it is worst.
struct EnergyFault {
    enum class Kind {
        MakesLight,   // lights return more than arrives; value: how much of it
        LightsDiffer, // lights and the environment disagree; value: lights minus environment
        ColorAboveOne // texels of the base colour; value: the brightest
    };
    Kind kind = Kind::MakesLight;
    std::optional<int> channel; // 0…2, the worst; nothing: all alike
    double value = 0.0;
    float NoV = 1.0f, perceptualRoughness = 0.0f; // not of ColorAboveOne
};

struct EnergyStudy {
    static constexpr int kRoughnesses = 41, kAngles = 46, kMapSize = 40;

    ShadingModel model;
    SurfaceRange surface;
    float NoV = 1.0f;                     // of byRoughness
    std::vector<EnergyPoint> byRoughness; // perceptual roughness i / (kRoughnesses - 1)
    std::vector<EnergyPoint> byAngle;     // at the mean roughness, from 0° to 90° in even steps
    EnergyPoint average;                  // at the mean roughness, seen from all sides
    EnergyPoint roughest;                 // the same at the highest roughness
    // What returns of a uniform environment as the model is; roughness (x + 0.5) / size, angle
    // (y + 0.5) / size · 90°, row by row.
    std::vector<glm::vec3> map;
    std::vector<EnergyFault> faults;
};

// Cosine of the view angle 0…90°, as seen by the shading code (never quite 0).
[[nodiscard]] float cosineOfAngle(float angleDeg);

// 30 to 60 ms on one core, by the range of the roughness; nothing when cancelled.
[[nodiscard]] std::optional<EnergyStudy> studyEnergy(const ShadingModel& model,
                                                     const SurfaceRange& surface, float NoV,
                                                     const JobContext& job);

} // namespace patina
