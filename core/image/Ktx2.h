// Our own writer of KTX 2.0 files (Khronos, "KTX File Format Specification", version 2), not
// supercompressed.
#pragma once

#include "core/image/FloatTexture.h"

#include <map>
#include <string>

namespace patina {

// A 2D texture or cubemap with its levels. `values`: key/value data with text values, beside
// KTXorientation "rd" (rows run to the right and downwards) and KTXwriter.
[[nodiscard]] EncodedTexture encodeKtx2(const FloatTexture& texture, TexelFormat format,
                                        const std::map<std::string, std::string>& values = {});

} // namespace patina
