// A picture from elsewhere (a photo, another renderer's image) made comparable with a cell's: of
// its size, displayed as the cell is.
#pragma once

#include "core/base/Result.h"
#include "core/document/View.h"
#include "core/image/Image.h"

#include <string>

namespace patina {

struct ReferenceSettings {
    bool stretch = false;       // to the cell's proportions, where its own are others
    bool matchExposure = false; // its mean luminance becomes that of the cell, in linear light
};

struct ReferencePicture {
    Image displayed;        // U8, 3 channels, sRGB: as the cell is displayed
    float matchedEv = 0.0f; // what matchExposure brightened it by, EV
    std::string note;       // what was done to it: "512 × 512 fitted to 256 × 256"; may be empty
};

// Whether the sides' ratios differ by more than a hundredth.
[[nodiscard]] bool hasOtherProportions(const Image& picture, int width, int height);

// `picture`: as it was read; floats are radiance before exposure and tone curve and get those of
// `view` (an exposure that adapts adapts to it), integers are values as displayed. `cell`: of the
// cell before exposure and tone curve where the picture is radiance, else as displayed; F32 or U8,
// at least 3 channels, its size is the result's. Errors: Usage where proportions differ and are not
// to be stretched, or where the view's tone curve is OpenColorIO's and the picture radiance.
[[nodiscard]] Result<ReferencePicture> referencePicture(const Image& picture, const Image& cell,
                                                        const View& view,
                                                        const ReferenceSettings& settings);

// Floats that are to be exposed and tone mapped.
[[nodiscard]] bool isRadiance(const Image& picture);

} // namespace patina
