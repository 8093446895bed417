// FLIP and SSIM as their papers define them, in double precision: two-dimensional kernels, every
// weight at every pixel. Written apart from core/compare.
#pragma once

#include "core/image/Image.h"

#include <vector>

namespace patina::test {

struct FlipReference {
    std::vector<double> flip, color, edge, point; // per pixel, row by row
};

// Linear light 0…1, three channels.
FlipReference flipReference(const Image& image, const Image& reference, double pixelsPerDegree);

struct HdrFlipReference {
    std::vector<double> flip;
    double start = 0, stop = 0;
    int count = 0;
};
HdrFlipReference hdrFlipReference(const Image& image, const Image& reference,
                                  double pixelsPerDegree);

// Per pixel, of grey pictures as they are; windows are cut at the border.
std::vector<double> ssimReference(const Image& image, const Image& reference);

} // namespace patina::test
