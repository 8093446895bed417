// Words that follow from what was measured of an environment, to search and to tell apart by. The
// thresholds stand here and in docs/maths/environment-measures.md.
#pragma once

#include "core/catalog/EnvironmentMeasures.h"

#include <string_view>
#include <vector>

namespace patina {

enum class EnvironmentTag { Sun, Soft, HighContrast, Warm, Neutral, Cool, Dark, Clipped };
inline constexpr int kEnvironmentTags = 8;

// Sun: one clear source, small as a sun or a distant light, above the horizon, with much of the
// light.
inline constexpr double kSunShare = 0.15, kSunDiameterDeg = 5.0;
// Soft: matte surfaces get nearly as much from behind as from the front, as under a clouded sky.
inline constexpr double kSoftKeyToFill = 3.5;
// High contrast: the side away from the key is three stops darker than it.
inline constexpr double kHighKeyToFill = 8.0;
// Warm and cool: as flash and daylight count as neutral.
inline constexpr double kWarmBelowK = 4500.0, kCoolAboveK = 7500.0;
// Dark: half of the sphere is darker than this share of its mean without the brightest source. A
// clear sky has .7, a street at night .2, a studio less.
inline constexpr double kDarkMedian = 1.0 / 3.0;

// In the order of the enumeration.
[[nodiscard]] std::vector<EnvironmentTag> tagsOf(const EnvironmentMeasures& measures);

[[nodiscard]] std::string_view tagLabel(EnvironmentTag tag); // "High contrast"
[[nodiscard]] std::string_view tagHelp(EnvironmentTag tag);  // "One small bright source …"

} // namespace patina
