// How far two images are apart at every pixel: maps of one channel, and what is said of them.
#pragma once

#include "core/base/Result.h"
#include "core/image/Image.h"
#include "core/job/JobContext.h"

namespace patina {

struct PixelPosition {
    int x = 0, y = 0; // from the top left
    friend bool operator==(const PixelPosition&, const PixelPosition&) = default;
};

// Percentiles, the median among them, are those of the magnitudes: the value that this share of
// the pixels does not exceed (the smallest such one: "nearest rank").
struct ErrorSummary {
    double mean = 0;           // of the values, with their signs
    double max = 0;            // the largest magnitude …
    PixelPosition maxPosition; // … and the first pixel, row by row, that has it
    double median = 0, percentile95 = 0, percentile99 = 0;
};

struct ErrorMap {
    Image values; // F32 Data, one channel
    ErrorSummary summary;
};

// `values`: F32, one channel, not empty, finite.
[[nodiscard]] ErrorSummary summarize(const Image& values);

// With s of the image, r of the reference as in Metrics.h, alpha among them where there is one:
// a pixel has the value of the channel that is largest in magnitude, so that nothing cancels out.
enum class Difference {
    Signed,   // s - r
    Absolute, // |s - r|
    Relative, // |s - r| / √(r² + 0.01): the mean of its squares over all channels is relMSE
};

// Errors: as compareImages() has them; Cancelled.
Result<ErrorMap> differenceMap(const Image& image, const Image& reference, Difference difference,
                               const JobContext& job);

} // namespace patina
