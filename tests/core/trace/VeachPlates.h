// Four plates of metal under four spheres, after Veach 1997, "Robust Monte Carlo Methods for Light
// Transport Simulation", figure 9.2: where rays to lights are good, rays of the surface are not.
#pragma once

#include "core/trace/path/PathTracer.h"

#include <array>
#include <optional>
#include <vector>

namespace patina::test {

inline constexpr int kPlates = 4, kPlateLights = 4;

// Plates from the smoothest, behind, to the roughest; spheres of the same power from small, on the
// left, to large.
[[nodiscard]] TraceInputs veachPlates();
[[nodiscard]] TraceView ofVeachPlates();

// Which plate is behind the centre of each pixel, and the reflection of which light is nearest
// there: plate · kPlateLights + light. Nothing beside the plates.
[[nodiscard]] std::vector<std::optional<int>> plateCells();

} // namespace patina::test
