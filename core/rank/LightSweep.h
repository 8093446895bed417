// A scene under many lights: environments × rotations about +Y, each a small picture by radiance
// transfer, and how much each loses. docs/maths/light-sweep.md.
#pragma once

#include "core/base/Result.h"
#include "core/compare/ErrorMap.h"
#include "core/document/View.h"
#include "core/image/Image.h"
#include "core/job/JobContext.h"
#include "core/rank/PictureScores.h"
#include "core/rank/SweepEnvironment.h"
#include "core/rank/SweepPixels.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace patina {

struct SweepLight {
    std::size_t environment = 0; // index
    double rotationDeg = 0;      // as Environment::rotationDeg
};

struct SweepSettings {
    int rotations = 36;                  // evenly spaced, the first at 0°
    glm::vec3 scale{1.0f};               // of all environments: tint and 2^EV
    View view;                           // exposure and tone curve; not ToneMap::OpenColorIo
    std::optional<SweepLight> reference; // the look to compare with; none: the mean look
};

inline constexpr int kMostRotations = 3600;

struct LightScore {
    SweepLight light;
    ClippedShares clipped;
    double contrastStops = 0;
    double lostContrast = 0;    // 0…1: 1 - contrastStops / the reference's, where it has more
    DifferenceScore difference; // LDR-FLIP of displayed light, at the surfaces
    PixelPosition worstPixel;   // where difference.max is
};

struct LightSweep {
    std::vector<LightScore> scores; // environment by environment, rotations ascending
    Image reference;                // the look that was compared with: F32 Linear, displayed light
    double referenceContrastStops = 0;
    // One value per pixel, F32 Data, 0 where no surface is: the standard deviation over all lights,
    // in stops, of exposed luminance before the tone curve. Its square is the variance.
    Image sensitivity;
};

// Displayed luminance that sensitivity takes for black, so that its logarithm stays finite: ten
// stops under the display's white.
inline constexpr float kSensitivityFloor = 1.0f / 1024.0f;

// Exact for every light: nothing is skipped. Does not depend on the number of threads. With
// automatic exposure each picture is exposed by its own surfaces. Errors: Usage for an OpenColorIO
// view or settings out of range; Cancelled.
Result<LightSweep> sweepLights(const SweepPixels& pixels,
                               std::span<const SweepEnvironment> environments,
                               const SweepSettings& settings, const JobContext& job);

// One light's picture as it was scored: displayed light, F32 Linear 0…1, middle grey where no
// surface is.
[[nodiscard]] Image sweepPicture(const SweepPixels& pixels,
                                 std::span<const SweepEnvironment> environments,
                                 const SweepSettings& settings, const SweepLight& light);

enum class RankBy { Clipping, Contrast, Difference };

[[nodiscard]] double rankingScore(const LightScore& score, RankBy by);
// Indices into LightSweep::scores, the worst light first; equal ones in their own order.
[[nodiscard]] std::vector<std::size_t> rankLights(const LightSweep& sweep, RankBy by);

// A light whose picture has at least this share of its pixels at the top of the display clips.
inline constexpr double kClipsShare = 0.001;
[[nodiscard]] inline bool clips(const LightScore& score) {
    return score.clipped.highlights >= kClipsShare;
}

} // namespace patina
