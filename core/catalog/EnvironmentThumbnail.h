// A small picture of an environment as a screen shows it.
#pragma once

#include "core/image/Image.h"

namespace patina {

inline constexpr int kThumbnailWidth = 256, kThumbnailHeight = 128;

// U8, sRGB, 3 channels, kThumbnailWidth × kThumbnailHeight: exposed so that the mean luminance of
// `withoutSource` (the same picture without its brightest source) becomes middle grey, so that a
// sun does not leave the rest black, and tone mapped by PBR Neutral. `environment`: lat-long, F32
// RGB, finite.
[[nodiscard]] Image environmentThumbnail(const Image& environment, const Image& withoutSource);

} // namespace patina
