// A traced picture, and how certain each of its pixels is.
#pragma once

#include "core/image/Image.h"
#include "core/trace/path/Film.h"

#include <optional>

namespace patina {

struct TracedPicture {
    Image radiance;      // F32, linear, 3 channels
    Image standardError; // F32, Data, 1 channel: of each pixel's luminance
};

// Nothing before each pixel has two samples.
[[nodiscard]] std::optional<TracedPicture> tracedPicture(const Film& film);

} // namespace patina
