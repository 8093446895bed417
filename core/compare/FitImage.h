// A picture brought to the size of another one, so that both can be compared.
#pragma once

#include "core/image/Image.h"

namespace patina {

// Each side by itself, so that other proportions are stretched: shorter ones average what each
// pixel covers, longer ones interpolate linearly between pixel centres, both in linear light. F32
// of the same encoding and channels; the image itself where it has the size already. Not empty.
[[nodiscard]] Image fitImage(const Image& image, int width, int height);

} // namespace patina
