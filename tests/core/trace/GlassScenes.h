// Bodies of glass whose light is known, for tests.
#pragma once

#include "core/trace/path/Film.h"
#include "core/trace/path/TraceScene.h"

#include <cstdint>

namespace patina::test {

// Reflectance of unpolarised light, written apart from the code under test: by sines and tangents,
// Born & Wolf 1999, section 1.5.2. `cosine` on the side of index 1, the other has `eta`.
[[nodiscard]] double fresnel(double cosine, double eta);

[[nodiscard]] Material glass(float ior, bool thinWalled); // smooth, colourless

constexpr double kSlabThickness = 0.2; // metres

// The lower half of all directions is as bright as that, the upper half black.
[[nodiscard]] TraceEnvironment lowerSky(float radiance);
[[nodiscard]] TraceEnvironment checkeredSky();

// Many times wider than thick, about the origin.
[[nodiscard]] TraceInputs slab(const Material& material, const TraceEnvironment& environment);
// One face of 40 m, at y = 0, facing up.
[[nodiscard]] TraceInputs sheet(const Material& material, const TraceEnvironment& environment);
// Of radius 1 in uniform light of radiance 1; `inner`: of the hollow, 0 without one.
[[nodiscard]] TraceInputs hollowSphere(const Material& material, float inner, int rings);

[[nodiscard]] TraceScene built(const TraceInputs& inputs);
// Mean luminance of one pixel that looks at the origin from above at that angle.
double lookedAt(const TraceScene& scene, float pitchDeg, std::uint32_t samples,
                Film::Pixel* pixel = nullptr);

// A glowing ball above a ball of glass above a disc in its shadow: what arrives there has come
// through the glass.
struct CausticScene {
    double glassHeight = 0.6, glassRadius = 0.5, lampHeight = 2.0, lampRadius = 0.4;
    double discRadius = 0.15, ior = 1.5, radiance = 2.0;

    [[nodiscard]] TraceInputs inputs() const;
    // Of the disc: photons from the lamp's surface, by Snell and Fresnel on exact spheres.
    [[nodiscard]] double photonFlux(std::uint32_t photons) const;
};

} // namespace patina::test
