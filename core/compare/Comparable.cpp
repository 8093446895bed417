#include "core/compare/Comparable.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace patina::compare {
namespace {

std::size_t notFiniteSamples(const Image& image) {
    if (image.type() != PixelType::F32)
        return 0;
    const std::span<const float> samples = image.f32();
    return static_cast<std::size_t>(
        std::count_if(samples.begin(), samples.end(), [](float s) { return !std::isfinite(s); }));
}

} // namespace

Result<void> checkComparable(const Image& image, const Image& reference) {
    if (image.width() != reference.width() || image.height() != reference.height())
        return Error{ErrorKind::Usage,
                     fmt::format("the images differ in size: {} × {} and {} × {} pixels; only "
                                 "images of one size can be compared",
                                 image.width(), image.height(), reference.width(),
                                 reference.height()),
                     {},
                     {}};
    if (image.channels() != reference.channels() &&
        std::max(image.channels(), reference.channels()) > 4)
        return Error{ErrorKind::Usage,
                     fmt::format("the images have {} and {} channels and no common meaning",
                                 image.channels(), reference.channels()),
                     {},
                     {}};
    if (image.empty())
        return Error{ErrorKind::Usage, "the images are empty", {}, {}};
    return {};
}

Result<void> checkPictures(const Image& image, const Image& reference) {
    if (Result<void> comparable = checkComparable(image, reference); !comparable)
        return comparable;
    if (const int channels = image.channels(); channels > 4)
        return Error{
            ErrorKind::Usage,
            fmt::format("an image of {} channels is no picture that can be seen", channels),
            {},
            {}};
    if (const std::size_t count = notFiniteSamples(image) + notFiniteSamples(reference); count > 0)
        return notFiniteError(count);
    return {};
}

Error notFiniteError(std::size_t count) {
    return {ErrorKind::InputBroken,
            fmt::format("{} samples are NaN or infinite, so no distance can be given", count),
            {},
            {}};
}

} // namespace patina::compare
