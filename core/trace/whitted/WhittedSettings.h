// What a classical ray tracer is told.
#pragma once

#include <cstdint>

namespace patina {

// How a surface reflects the light of a light.
enum class LocalModel {
    Patina,      // the BRDF of the viewport and of paths
    Whitted1980, // the equation of the paper, with constant coefficients
};

struct WhittedSettings {
    LocalModel model = LocalModel::Patina;
    // Reflections and refractions after the camera's ray, along one branch.
    int maxDepth = 8;
    // A branch whose weight is below in every channel is not cast. Hall & Greenberg 1983, "A
    // Testbed for Realistic Image Synthesis", adaptive tree depth control.
    float minContribution = 0.002f;
    // A pixel's square, and then its quarters, are divided where their corners' contrast is above
    // this, at most so many times; 0 divisions: the mean of the pixel's corners.
    float contrast = 0.1f;
    int subdivisions = 2;
    // Stochastic: shadow rays to points of the lights, and mirror rays spread by the roughness of
    // every surface, and rays from points of the camera's lens, which is else a pinhole. A pixel is
    // then the mean of samples over its square.
    bool softShadows = false, gloss = false, depthOfField = false;
    std::uint32_t seed = 0;

    [[nodiscard]] bool isStochastic() const { return softShadows || gloss || depthOfField; }
    friend bool operator==(const WhittedSettings&, const WhittedSettings&) = default;
};

inline constexpr int kMostWhittedDepth = 32, kMostSubdivisions = 4;
// Weights of what one surface sends on sum up to 1, so that no level of a tree has more rays than
// the inverse of this.
inline constexpr float kLeastContribution = 1e-4f;
// Mirror rays and refracted ones start from surfaces that are smoother than this.
inline constexpr float kMirrorRoughness = 0.1f;

} // namespace patina
