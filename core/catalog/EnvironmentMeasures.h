// What is measured of an environment's light, so that one can be chosen by numbers. All of them are
// of the picture alone, neither rotated nor brightened; docs/maths/environment-measures.md has the
// definitions. Angles: azimuth 0 is +Z, 90 is +X, -180 … 180; elevation 90 is up.
#pragma once

#include "core/image/Image.h"
#include "core/job/JobContext.h"
#include "core/light/ColorTemperature.h"

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace patina {

struct BrightestSource {
    double share = 0.0; // of the luminance of the whole picture
    double azimuthDeg = 0.0, elevationDeg = 0.0;
    double diameterDeg = 0.0; // of a disc of its solid angle and even radiance
    bool isClear = false;     // it stands out from what is around it (BrightSource::isClear)
    friend bool operator==(const BrightestSource&, const BrightestSource&) = default;
};

struct EnvironmentMeasures {
    double meanLuminance = 0.0; // over the sphere, nit where the file is in nit
    glm::dvec3 meanColor{0.0};  // linear sRGB, over the sphere
    // Of the mean colour; nothing where that is no colour of a black body.
    std::optional<ColorTemperature> temperature;
    std::optional<BrightestSource> source; // nothing where the light is even, or there is none
    // log2 of a high luminance over a low one: 99 % of the light is not brighter than the one, 99 %
    // of the sphere is not darker than the other. 0 … kMostStops; 0: uniform or black.
    double rangeStops = 0.0;
    // Irradiance of the side that gets most, over the mean of all that face away from it. 1 of
    // uniform light (and of none) … kMostKeyToFill.
    double keyToFill = 1.0;
    double keyAzimuthDeg = 0.0, keyElevationDeg = 0.0; // where that side faces
    // Of the linear band (core/light/DominantLight.h): where light comes from on the mean, and how
    // much of it, 0 … 1.
    double dominantAzimuthDeg = 0.0, dominantElevationDeg = 0.0, directionality = 0.0;
    double medianLuminance = 0.0; // half of the sphere is darker
    // Share of the sphere at the largest value of the file, where that is a plateau: light that was
    // brighter than the file or the camera could hold. 0: none.
    double clippedShare = 0.0;
    friend bool operator==(const EnvironmentMeasures&, const EnvironmentMeasures&) = default;
};

inline constexpr double kMostStops = 24.0; // darker counts as black
inline constexpr double kMostKeyToFill = 1000.0;

struct MeasuredEnvironment {
    EnvironmentMeasures measures;
    std::vector<glm::vec3> harmonics; // radiance, kMaxShOrder bands
    Image withoutSource;              // the picture that was measured, without its brightest source
};

// Pictures are measured at this width, to which light is averaged by exact areas.
inline constexpr int kMeasuredWidth = 1024;

// `environment`: lat-long, F32, 3 channels, finite, conventions of patina::Environment.
// Deterministic. Meaningless after a cancel.
[[nodiscard]] MeasuredEnvironment measureLight(const Image& environment,
                                               const JobContext& job = {});

} // namespace patina
