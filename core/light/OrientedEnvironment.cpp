#include "core/light/OrientedEnvironment.h"

#include "core/base/Check.h"
#include "core/light/EnvironmentResample.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace patina {

namespace {

Image resampled(const Image& image, const Orientation& orientation, float exposureEv,
                const JobContext& job) {
    const EnvironmentMapping mapping =
        EnvironmentMapping::create(EnvironmentLayout::LatLong, {image.width(), image.height()})
            .value();
    Image result =
        resampleEnvironment(image, mapping, mapping, {orientation, std::exp2(exposureEv)}, job);
    for (float& sample : result.f32())
        sample = std::min(sample, std::numeric_limits<float>::max());
    return result;
}

} // namespace

Image orientEnvironment(const Image& image, const Orientation& orientation, float exposureEv,
                        const JobContext& job) {
    CHECK(image.type() == PixelType::F32);
    CHECK_EQ(image.channels(), 3);
    if (!orientation.isLevel())
        return resampled(image, orientation, exposureEv, job);
    const int width = image.width();
    // u grows clockwise as seen from above: what comes to rest at u was at u + turns before.
    const double turns = static_cast<double>(orientation.rotationDeg) / 360.0;
    const double shift = (turns - std::floor(turns)) * width;
    const int whole = static_cast<int>(shift);
    auto part = static_cast<float>(shift - whole);
    // An angle in single precision is seldom a whole number of pixels to the last digit.
    int first = whole;
    if (part > 1.0f - 1e-4f) {
        first += 1;
        part = 0.0f;
    } else if (part < 1e-4f) {
        part = 0.0f;
    }
    const double scale = std::exp2(static_cast<double>(exposureEv));

    Image result(width, image.height(), 3, PixelType::F32, image.encoding());
    const std::span<const float> from = image.f32();
    const std::span<float> to = result.f32();
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < width; ++x) {
            const std::size_t row = static_cast<std::size_t>(y) * width;
            const std::size_t a = 3 * (row + (x + first) % width);
            const std::size_t b = 3 * (row + (x + first + 1) % width);
            for (std::size_t c = 0; c < 3; ++c) {
                const double mixed =
                    part == 0.0f ? from[a + c] : from[a + c] * (1.0 - part) + from[b + c] * part;
                to[3 * (row + x) + c] = static_cast<float>(
                    std::min<double>(mixed * scale, std::numeric_limits<float>::max()));
            }
        }
    return result;
}

} // namespace patina
