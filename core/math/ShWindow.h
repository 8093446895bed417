// Windows against ringing: factors per band that trade sharpness for freedom from ripples.
#pragma once

#include "core/math/SphericalHarmonics.h"

#include <glm/vec3.hpp>
#include <span>

namespace patina {

// Sloan 2008, "Stupid Spherical Harmonics (SH) Tricks", "Windowing". `width` > 0, in bands: from
// there on the factor is 0.
[[nodiscard]] double hannWindow(int l, double width);    // (1 + cos(pi l / width)) / 2
[[nodiscard]] double lanczosWindow(int l, double width); // sin(pi l / width) / (pi l / width)
// The curve of least squared Laplacian: 1 / (1 + lambda l² (l + 1)²), lambda >= 0.
[[nodiscard]] double laplacianWindow(int l, double lambda);

enum class ShWindowType { None, Hann, Lanczos };

struct ShWindow {
    ShWindowType type = ShWindowType::None;
    double width = 0.0; // bands; of no effect for None

    [[nodiscard]] double factor(int l) const;
    bool operator==(const ShWindow&) const = default;
};

// Band by band, in place; any number of whole bands up to kMaxShOrder.
void applyWindow(const ShWindow& window, std::span<glm::vec3> coefficients);

// Where the irradiance of radiance coefficients is lowest, over all normals and channels; found
// from 2048 normals by descent to 1e-9 of the root mean square.
struct LowestIrradiance {
    double value = 0.0;
    glm::dvec3 normal{0.0, 0.0, 1.0};
    int channel = 0;
};
[[nodiscard]] LowestIrradiance lowestIrradiance(std::span<const glm::vec3> radiance);

// The window that changes the irradiance of these radiance coefficients least (in the mean square
// over the sphere) of all of `type` that keep it from going below zero, to within 1e-6 of its mean,
// for every normal and channel. No window where none is needed. A channel whose own mean is not
// positive cannot be helped by any window and is left out. Sloan 2017, "Deringing Spherical
// Harmonics", which does the same for radiance.
[[nodiscard]] ShWindow deringIrradiance(std::span<const glm::vec3> radiance, ShWindowType type);
// The better of Hann and Lanczos, by the same measure.
[[nodiscard]] ShWindow deringIrradiance(std::span<const glm::vec3> radiance);

} // namespace patina
