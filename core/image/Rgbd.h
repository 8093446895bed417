// RGBD, the texels of glTF's EXT_lights_image_based: a colour multiplied by D = alpha / 255 so that
// it fits into 0…1, encoded with a gamma of 2.2 in 8 bits. The extension leaves the gamma unsaid;
// this is how Babylon.js, its reference implementation, decodes.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

namespace patina {

inline constexpr float kLargestRgbd = 255.0f;

// Components are clamped to 0…255, NaN is 0. The brightest component is within 0.9 % of its value
// when that is above 0.2; below, the step is 0.0001 at 0.001 and 0.002 at 0.1.
[[nodiscard]] std::array<std::uint8_t, 4> rgbdFromColor(const glm::vec3& color);
[[nodiscard]] glm::vec3 colorFromRgbd(const std::array<std::uint8_t, 4>& rgbd);

} // namespace patina
