#include "core/trace/error/TracedPicture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace patina {
namespace {

constexpr int kBlock = 16;           // pixels a side
constexpr double kLeastShare = 0.01; // of the variance of independent samples

// What the squared errors of a block's pixels are of those that independent samples would have: a
// pixel's halves alone say too little.
double shareOfIndependent(const Film& film, int left, int top) {
    double halves = 0.0, independent = 0.0;
    for (int y = top; y < std::min(top + kBlock, film.height()); ++y)
        for (int x = left; x < std::min(left + kBlock, film.width()); ++x) {
            halves += film.at(x, y).halvesVariance();
            independent += film.at(x, y).variance();
        }
    return independent > 0.0 ? std::clamp(halves / independent, kLeastShare, 1.0) : 1.0;
}

} // namespace

std::optional<TracedPicture> tracedPicture(const Film& film) {
    if (film.leastSamples() < 2)
        return std::nullopt;
    const int width = film.width(), height = film.height();
    TracedPicture picture{film.radiance(),
                          Image(width, height, 1, PixelType::F32, ColorEncoding::Data)};
    float* errors = picture.standardError.f32().data();
    for (int top = 0; top < height; top += kBlock)
        for (int left = 0; left < width; left += kBlock) {
            const double share = shareOfIndependent(film, left, top);
            for (int y = top; y < std::min(top + kBlock, height); ++y)
                for (int x = left; x < std::min(left + kBlock, width); ++x)
                    errors[static_cast<std::ptrdiff_t>(y) * width + x] =
                        static_cast<float>(std::sqrt(share * film.at(x, y).variance()));
        }
    return picture;
}

} // namespace patina
