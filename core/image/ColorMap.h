// Colour maps of views, legends and plots: perceptually uniform, readable by colour-blind people.
#pragma once

#include <glm/vec3.hpp>

namespace patina {

// Sequential: dark to light. Diverging: blue, neutral at 0.5, orange. Grey: the value itself, for
// 0…1 quantities that artists know as grey maps. Magma: black over purple to light yellow, in which
// FLIP is shown.
enum class ColorMap { Grey, Sequential, Diverging, Magma };

// `t`: 0…1, clamped; NaN is taken as 0. Display-encoded sRGB, 0…1.
[[nodiscard]] glm::vec3 mapColor(ColorMap map, float t);

} // namespace patina
