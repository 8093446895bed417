// An environment as a sweep of lights needs it: its harmonics, which side of it is dark, and which
// environments are the same light, rotated or not.
#pragma once

#include "core/base/Hash.h"
#include "core/image/Image.h"
#include "core/job/JobContext.h"

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace patina {

struct SweepEnvironment {
    std::string name;
    std::vector<glm::vec3> harmonics; // radiance, kMaxShOrder bands, neither rotated nor scaled
    Hash texels;
    // The least irradiance over all sides, as a share of the most: what matte surfaces get that
    // face `darkestSide` (unit) and the brightest side. 0: nothing at all; 1: the same from all
    // sides, or no light.
    double darkestShare = 1;
    glm::vec3 darkestSide{0.0f, -1.0f, 0.0f};
    bool black = false; // no light from anywhere

    [[nodiscard]] bool blackFromOneSide() const;
};

// Below this share, 7.6 stops under the brightest side, a side counts as black: no exposure shows
// both.
inline constexpr double kBlackSideShare = 0.005;

// `image`: as Environment::image. Meaningless after a cancel.
[[nodiscard]] SweepEnvironment measureEnvironment(std::string name, const Image& image,
                                                  const JobContext& job);

// An environment that is another one, rotated about +Y by rotationDeg (0 … 360, as
// Environment::rotationDeg).
struct SameEnvironment {
    std::size_t of = 0; // the first that is the same
    float rotationDeg = 0.0f;
    bool exactly = false;  // the very texels
    double difference = 0; // RMS over the sphere of what is left, relative to the environment's
};

// Relative RMS difference of kMaxShOrder bands below which two environments are one light: copies
// at another resolution stay below it, and no picture of transfer shows the rest.
inline constexpr double kSameTolerance = 0.005;

// For each environment the first one before it that is the same.
[[nodiscard]] std::vector<std::optional<SameEnvironment>>
findSameEnvironments(std::span<const SweepEnvironment> environments, const JobContext& job);

} // namespace patina
