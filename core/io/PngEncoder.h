// PNG files of our own pixels, encoded in this process: the worker with OpenImageIO is a quarter of
// a second away, and what it guards against is foreign files. The bytes are those that OpenImageIO
// 2.4, which wrote them before, makes of the same pixels.
#pragma once

#include "core/base/AtomicFile.h"
#include "core/base/Result.h"
#include "core/image/Image.h"

namespace patina {

// U8 or U16, one to four channels, of at most limits::kMaxImageSide a side; alpha as it is. Errors:
// Internal when libpng has no memory or refuses.
Result<Bytes> encodePng(const Image& image);

} // namespace patina
