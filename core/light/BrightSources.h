// Bright sources of an environment's picture (the sun, light fixtures, softboxes), found, measured
// and removed, so that lights replace them: what the picture loses is what the lights are given.
#pragma once

#include "core/image/Image.h"
#include "core/job/JobContext.h"

#include <glm/vec3.hpp>
#include <vector>

namespace patina {

struct Environment;
struct Light;

inline constexpr int kMostBrightSources = 8;

struct BrightSource {
    glm::dvec3 toSource{0.0, 1.0, 0.0}; // unit; the mean of its radiance's directions
    // Of a surface that faces it, by what was removed from the picture: linear sRGB.
    glm::dvec3 irradiance{0.0};
    double diameterDeg = 0.0;  // of a disc of its solid angle and even radiance
    double shareOfLight = 0.0; // of the luminance of the whole picture before
    bool isClear = false;      // it stands out: kClearContrast times what is around it
};

// A source is brighter than what is around it by this factor; below it is only the brightest place.
inline constexpr double kClearContrast = 4.0;

struct BrightSources {
    std::vector<BrightSource> sources; // the one with the most light of its place first
    Image picture;                     // without them, filled from around each
};

// `environment`: lat-long, F32, 3 channels, conventions of patina::Environment. The brightest place
// (the mean luminance over some 2°), then the brightest of what is left, `count` times (at most
// kMostBrightSources), fewer where the rest is black. A source is what is connected with its
// brightest texel and above a twentieth of its luminance over what is around it (median of a
// ring 8° to 16° away), at most 15° from it, with a rim of two texels; its place is filled by
// Laplace's equation from around it, and never made brighter. Deterministic. Without a picture
// after a cancel.
[[nodiscard]] BrightSources extractBrightSources(const Image& environment, int count,
                                                 const JobContext& job = {});

// The directional light that stands for it where the environment is rotated, brightened and tinted:
// as bright as the source was, as wide as it was seen.
[[nodiscard]] Light lightOf(const BrightSource& source, const Environment& environment);

} // namespace patina
