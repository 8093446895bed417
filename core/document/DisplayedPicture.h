// A picture of radiance as a view displays it, computed on the CPU: what the GPU's tone mapping
// makes of a frame.
#pragma once

#include "core/base/Result.h"
#include "core/document/ToneResponse.h"
#include "core/image/Image.h"

namespace patina {

struct View;

// `radiance`: F32, linear, 3 channels or more; pixels of a fourth count by it. As AdaptationPass
// measures it.
[[nodiscard]] Luminance luminanceOf(const Image& radiance);

// `radiance`: F32, linear, before exposure; 3 channels, or 4 and premultiplied. U8, sRGB or what
// the view's display wants, of as many channels, straight alpha. Automatic exposure is that of
// `luminance`. Usage error where the tone curve is OpenColorIO's, which only the GPU has.
[[nodiscard]] Result<Image> displayedPicture(const Image& radiance, const View& view,
                                             const Luminance& luminance);

} // namespace patina
