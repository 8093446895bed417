// How far a picture that was drawn by other means is from the traced one of the same scene and
// camera: at each pixel, in the picture and in each material, and how much of that may be the noise
// of the traced one. docs/maths/picture-error.md has the formulas.
#pragma once

#include "core/base/Id.h"
#include "core/base/Result.h"
#include "core/image/Image.h"
#include "core/job/JobContext.h"
#include "core/trace/error/TracedPicture.h"

#include <cstdint>
#include <span>
#include <vector>

namespace patina {

struct Luminance;
struct View;

struct ErrorScore {
    Id material = 0; // of the pixels; 0 in PictureError::whole: all of them
    std::size_t pixels = 0;
    // Mean LDR-FLIP of both as they are displayed, 0…1, and what the noise of the traced picture
    // alone would make of it.
    double flip = 0.0, flipNoise = 0.0;
    // How much brighter the drawn one is on the whole, EV: log2 of the ratio of mean luminances;
    // and its standard error. 0 where either is black.
    double biasEv = 0.0, biasEvNoise = 0.0;
    // The root mean square of the luminance's relative error, without what noise adds: 0.1 is 10 %.
    double relative = 0.0;
};

struct PictureError {
    // F32, Data, 1 channel each.
    Image exposure; // EV that the drawn pixel is too bright (above 0) or too dark
    Image relative; // |drawn - traced| / √(traced² + d²) of luminances, d a twentieth of white
    Image flip;     // 0…1
    // Per pixel: no further from the traced one than two of its standard errors, which are more
    // than 2 % of it: there may be an error, or none.
    std::vector<std::uint8_t> withinNoise;
    ErrorScore whole;
    std::vector<ErrorScore> materials; // those seen, by their share of the whole FLIP
};

// The luminance below which a difference counts less: the twentieth part of white.
[[nodiscard]] double darkLuminance(const View& view, const Luminance& luminance);

// `drawn`: F32, linear, 3 channels or 4 and premultiplied. `view`: exposure and tone curve of both;
// automatic exposure is that of the traced picture. `materials`: seenMaterials(); empty: no scores
// of materials. Errors: Usage for another size, a tone curve of OpenColorIO's; InputBroken for NaN
// and infinity; Cancelled.
Result<PictureError> pictureError(const Image& drawn, const TracedPicture& traced, const View& view,
                                  std::span<const Id> materials, const JobContext& job);

} // namespace patina
