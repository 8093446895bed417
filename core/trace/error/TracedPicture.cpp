#include "core/trace/error/TracedPicture.h"

#include <cmath>

namespace patina {

std::optional<TracedPicture> tracedPicture(const Film& film) {
    if (film.leastSamples() < 2)
        return std::nullopt;
    TracedPicture picture{film.radiance(), Image(film.width(), film.height(), 1, PixelType::F32,
                                                 ColorEncoding::Data)};
    float* error = picture.standardError.f32().data();
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x)
            *error++ = static_cast<float>(std::sqrt(film.at(x, y).variance()));
    return picture;
}

} // namespace patina
