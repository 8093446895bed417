// The table of linearly transformed cosines that area lights are shaded with: see
// shaders/shared/lights.glsl and docs/maths/lights.md. Made by tools/FitLobes.cpp.
#pragma once

#include <glm/vec4.hpp>
#include <span>

namespace patina {

inline constexpr int kLobeTableSize = 32;

// kLobeTableSize rows of perceptualRoughness 0…1, first and last included, of kLobeTableSize values
// of sqrt(1 - N·V) 0…1.
[[nodiscard]] std::span<const glm::vec4> lobeTable();

// Looked up as the GPU does: bilinear.
[[nodiscard]] glm::vec4 lobeFit(float perceptualRoughness, float NoV);

} // namespace patina
