// The primaries and the white of a picture's colours, and the way from there to linear Rec.709.
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <optional>
#include <string_view>

namespace patina {

// CIE 1931 xy of red, green, blue and white, as in OpenEXR's `chromaticities`.
using Chromaticities = std::array<float, 8>;
inline constexpr Chromaticities kRec709{0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};

// Eight numbers; nothing when there are fewer.
[[nodiscard]] std::optional<Chromaticities> parseChromaticities(std::string_view text);

// To linear Rec.709. White stays white: the Bradford transform adapts it. Nothing when the
// primaries span no triangle.
[[nodiscard]] std::optional<glm::mat3> toRec709(const Chromaticities& from);

} // namespace patina
