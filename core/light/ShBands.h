// How much of an environment its first bands of spherical harmonics hold: what their sums look
// like, how far they are from the environment and how far below zero they go.
#pragma once

#include "core/image/Image.h"
#include "core/job/JobContext.h"
#include "core/math/SphericalHarmonics.h"

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace patina {

// The sum of an environment's first bands, against the environment.
struct ShBandSum {
    // sqrt(1/4pi ∫ mean over R, G, B of (L - sum)² dω): radiance, taken at the pixels' centres.
    double rmse = 0.0;
    // The smallest channel at any pixel's centre, and where it is. A sum of bands goes below zero
    // beside lights that are small or have sharp edges, although no radiance does.
    float lowest = 0.0f;
    glm::vec3 lowestDirection{0.0f, 1.0f, 0.0f};
};

struct ShBands {
    std::vector<glm::vec3> coefficients;     // kMaxShOrder bands: projectLatLong()
    std::array<ShBandSum, kMaxShOrder> sums; // sums[n - 1]: of n bands
    double rms = 0.0;                        // of the environment itself, as rmse above
};

// `environment`: lat-long, F32, 3 channels or more, finite, conventions of patina::Environment.
// Deterministic. Meaningless after a cancel.
[[nodiscard]] ShBands computeShBands(const Image& environment, const JobContext& job = {});

// Mean over the sphere and over R, G, B of the square of what band l alone adds to radiance, by
// Parseval's theorem: Σ_m mean(c_lm²) / 4pi. Of all bands together it is the square of the rms, and
// of those from n on that of rmse for sums[n - 1].
[[nodiscard]] double bandEnergy(std::span<const glm::vec3> coefficients, int l);

// Σ c_i Y_i(direction) over the first `order` bands; negative where the sum is.
[[nodiscard]] glm::vec3 shSum(std::span<const glm::vec3> coefficients, int order,
                              const glm::vec3& direction);

// The same as a lat-long picture, 2h × h, F32, 3 channels, at the pixels' centres.
[[nodiscard]] Image shLatLong(std::span<const glm::vec3> coefficients, int order, int height,
                              const JobContext& job = {});

// One band alone, l = 0 … of what the coefficients hold, as such a picture: half of it is negative.
[[nodiscard]] Image shBandLatLong(std::span<const glm::vec3> coefficients, int l, int height,
                                  const JobContext& job = {});

} // namespace patina
