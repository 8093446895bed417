// Our own writer of DirectDraw Surface files with the DX10 header extension (Microsoft,
// "Programming Guide for DDS").
#pragma once

#include "core/image/FloatTexture.h"

namespace patina {

// A 2D texture or cubemap with its levels: face after face, each from its largest level down.
[[nodiscard]] EncodedTexture encodeDds(const FloatTexture& texture, TexelFormat format);

} // namespace patina
