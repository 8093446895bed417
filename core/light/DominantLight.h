// The one directional light that stands for an environment where lighting is N·L alone.
#pragma once

#include <glm/vec3.hpp>
#include <span>

namespace patina {

struct DominantLight {
    glm::vec3 toLight{0.0f, 1.0f, 0.0f}; // unit
    glm::vec3 irradiance{0.0f};          // of a surface that faces it
};

// `irradianceSh`: nine coefficients of E(n), as IblMaps has them. The direction is that of the
// linear band, weighted by luminance (Sloan 2008, "Stupid Spherical Harmonics (SH) Tricks",
// "Extracting a dominant light"); straight up where there is none. The irradiance E of each channel
// is the one for which E max(0, n·l) comes closest to E(n) over all normals, by least squares:
//     E = <E(n), max(0, n·l)> / <max(0, n·l), max(0, n·l)> = 3 / 2π Σ A_l E_lm Y_lm(l).
[[nodiscard]] DominantLight dominantLight(std::span<const glm::vec3, 9> irradianceSh);

// How much an environment is like one directional light: |∫ L(l) l dl| / ∫ L(l) dl of its
// luminance, the length of the mean direction that light comes from. 0 of light that is alike from
// opposite sides, 1 of a single direction; 0 of a black one. With A_0 = pi and A_1 = 2pi/3 that is
// sqrt(3)/2 |(E_1-1, E_10, E_11)| / E_00.
[[nodiscard]] float directionality(std::span<const glm::vec3, 9> irradianceSh);

} // namespace patina
