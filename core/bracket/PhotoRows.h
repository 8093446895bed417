// The photos of a bracket in memory, and their samples as codes whatever they are stored as.
#pragma once

#include "core/bracket/PhotoExposure.h"
#include "core/image/Image.h"

#include <filesystem>
#include <span>

namespace patina {

// Where the picture is in the photo: pixel (x, y) of the result is (x + dx, y + dy) there.
struct PhotoShift {
    int dx = 0, dy = 0;
    friend bool operator==(const PhotoShift&, const PhotoShift&) = default;
};

struct Photo {
    std::filesystem::path file;
    PhotoExposure exposure;
    double ev = 0.0; // log2 of its exposure, relative to the others
    Image image;     // 1 or 3 channels; U8, U16 through the camera's response, F32 linear
    PhotoShift shift;
    float white = 1.0f; // F32: the value at and above which samples are clipped

    [[nodiscard]] bool isLinear() const { return image.type() == PixelType::F32; }
    [[nodiscard]] double logExposure() const; // natural logarithm
};

// The value of a linear photo at which its samples are clipped: that of a plateau at the top.
// Without one it lies above the largest value, so that none is.
[[nodiscard]] float whiteOf(const Image& linear);

// Samples as codes 0 … 255 (ResponseCurve.h); linear values as that share of white. Code 0 is black
// or negative, 255 clipped. The row is one of the photo's own, all of its samples.
void codesOfRow(const Photo& photo, int y, std::span<float> codes);
[[nodiscard]] float codeAt(const Photo& photo, int x, int y, int channel);

} // namespace patina
