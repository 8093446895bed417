// The sRGB curve of IEC 61966-2-1:1999, exact at the joint of its two pieces to 1e-7, extended to
// negative numbers as an odd function.
#pragma once

#include <array>
#include <cstdint>

namespace patina {

[[nodiscard]] float srgbToLinear(float encoded);
[[nodiscard]] float linearToSrgb(float linear);

// All decoded values of 8 and 16 bits: entry k is srgbToLinear(k / max).
[[nodiscard]] const std::array<float, 256>& srgbTable8();
[[nodiscard]] const std::array<float, 65536>& srgbTable16();

// The 8-bit code whose decoded neighbourhood holds `linear`: the same as rounding
// linearToSrgb(linear) * 255, without the power. NaN gives 0.
[[nodiscard]] std::uint8_t linearToSrgb8(float linear);

// Whether the sRGB curve leaves this channel alone: alpha is linear in every encoding.
[[nodiscard]] constexpr bool isAlphaChannel(int channel, int channels) {
    return (channels == 2 && channel == 1) || (channels >= 4 && channel == 3);
}

} // namespace patina
