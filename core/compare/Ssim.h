// Structural similarity: Wang, Bovik, Sheikh & Simoncelli, "Image Quality Assessment: From Error
// Visibility to Structural Similarity", IEEE TIP 13(4), 2004, with their constants.
#pragma once

#include "core/base/Result.h"
#include "core/image/Image.h"
#include "core/job/JobContext.h"

namespace patina {

// With means μ, variances σ² and covariance σ_ab in a Gaussian window of 11 × 11 pixels, σ = 1.5:
//   SSIM = (2 μ_a μ_b + C₁) (2 σ_ab + C₂) / ((μ_a² + μ_b² + C₁) (σ_a² + σ_b² + C₂)),
//   C₁ = (0.01 L)², C₂ = (0.03 L)², L = 1
// of display-encoded luma Y' = 0.2126 R' + 0.7152 G' + 0.0722 B': what is stored of sRGB pictures,
// linear light cut to 0…1 and encoded with the sRGB curve.
struct Ssim {
    // 1 where alike, down to -1; F32 Data, one channel. At the border the part of the window that
    // lies in the picture counts.
    Image map;
    // Over the pixels whose whole window lies in the picture, as in the paper; over all of a
    // picture that is narrower or lower than the window. 1 for identical pictures, and for no
    // others.
    double mean = 1;
};

// Symmetric. Alpha is not seen. Errors: Usage for images of other sizes or of more than four
// channels, InputBroken for NaN and infinity, Cancelled.
Result<Ssim> computeSsim(const Image& image, const Image& reference, const JobContext& job);

} // namespace patina
