#include "core/trace/error/PictureErrorMap.h"

#include "core/compare/DifferencePicture.h"

namespace patina {
namespace {

constexpr int kHatchPeriod = 8, kHatchWidth = 2; // pixels, along a row
constexpr int kHatchGrey = 128;                  // mixed with half of the colour

const Image& valuesOf(const PictureError& error, ErrorShown shown) {
    switch (shown) {
    case ErrorShown::Exposure:
        return error.exposure;
    case ErrorShown::Relative:
        return error.relative;
    case ErrorShown::Visible:
        break;
    }
    return error.flip;
}

} // namespace

ErrorColors errorColors(ErrorShown shown) {
    switch (shown) {
    case ErrorShown::Exposure:
        return {ColorMap::Diverging, -1.0f, 1.0f};
    case ErrorShown::Relative:
        return {ColorMap::Sequential, 0.0f, 0.5f};
    case ErrorShown::Visible:
        break;
    }
    return {ColorMap::Magma, 0.0f, 1.0f};
}

Image errorPicture(const PictureError& error, ErrorShown shown) {
    const ErrorColors colors = errorColors(shown);
    Image picture = colorErrors(valuesOf(error, shown), colors.map, colors.from, colors.to);
    std::uint8_t* pixel = picture.u8().data();
    std::size_t i = 0;
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x, pixel += 3)
            if (error.withinNoise[i++] != 0 && (x + y) % kHatchPeriod < kHatchWidth)
                for (int c = 0; c < 3; ++c)
                    pixel[c] = static_cast<std::uint8_t>((pixel[c] + kHatchGrey) / 2);
    return picture;
}

} // namespace patina
