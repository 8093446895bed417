// Images with other channels.
#pragma once

#include "core/image/Image.h"

namespace patina {

// The first three of at least three channels, which opaque pictures have.
[[nodiscard]] Image withoutAlpha(const Image& image);

} // namespace patina
