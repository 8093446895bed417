// How far two images are apart, in the numbers the field uses.
#pragma once

#include "core/base/Result.h"
#include "core/compare/ErrorMap.h"
#include "core/image/Image.h"

#include <cstddef>

namespace patina {

// Regularises dark reference pixels in relMSE.
inline constexpr double kRelMseEpsilon = 0.01;

// Over all samples s of an image and r of its reference. Two images of the same encoding are
// compared as stored (sRGB code values 0…1, linear radiance, data); otherwise both in linear light.
struct ImageMetrics {
    double rmse = 0;           // √mean((s - r)²)
    double psnr = 0;           // 20 log10(1 / rmse) dB, of a peak of 1; infinite for equal images
    double relMse = 0;         // mean((s - r)² / (r² + 0.01)), Rousselle et al. 2011, sec. 6
    double max = 0;            // max |s - r| …
    PixelPosition maxPosition; // … and the first pixel, row by row, that has it
    std::size_t samples = 0;   // how many were compared: pixels × channels
    std::size_t different = 0; // how many of them differ at all
};

// Grey is compared with RGB as equal channels; alpha takes part when either image has it (the
// other's is 1). Images of more than four channels need the same number. Errors: Usage for images
// of different size, InputBroken for NaN and infinite samples.
Result<ImageMetrics> compareImages(const Image& image, const Image& reference);

// |s - r| of RGB as compareImages sees it, F32 Data: black where the images agree.
Result<Image> differenceImage(const Image& image, const Image& reference);

} // namespace patina
