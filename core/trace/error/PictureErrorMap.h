// Errors of a picture in colours.
#pragma once

#include "core/image/ColorMap.h"
#include "core/trace/error/PictureError.h"

namespace patina {

enum class ErrorShown { Exposure, Relative, Visible };

struct ErrorColors {
    ColorMap map = ColorMap::Grey;
    float from = 0.0f, to = 1.0f; // that the ends of the colours stand for
};
// The same for all pictures, so that they can be compared: -1…1 EV, 0…50 %, FLIP 0…1.
[[nodiscard]] ErrorColors errorColors(ErrorShown shown);

// U8, sRGB, 3 channels. What is within the noise is hatched.
[[nodiscard]] Image errorPicture(const PictureError& error, ErrorShown shown);

} // namespace patina
