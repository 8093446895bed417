// Maps of errors as pictures.
#pragma once

#include "core/image/ColorMap.h"
#include "core/image/Image.h"

namespace patina {

// Sets to 0 what nobody notices: where `flip`, of the same size, is below `threshold`.
void hideInvisible(Image& values, const Image& flip, float threshold);

// U8 sRGB, three channels: `from` has the colour at 0 of the map, `to` that at 1, both ends stand
// for what lies beyond. `values`: F32, one channel; from < to.
[[nodiscard]] Image colorErrors(const Image& values, ColorMap map, float from, float to);

} // namespace patina
