#include "core/image/TexelRange.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace patina {

namespace {

// One stored channel.
struct Extent {
    double low = std::numeric_limits<double>::infinity(), high = -low, sum = 0.0;
    double count = 0.0;

    void add(double value, double times) {
        low = std::min(low, value);
        high = std::max(high, value);
        sum += times * value;
        count += times;
    }
};

using Extents = std::array<Extent, 4>;

// Integers are counted by value first: there are few values and many texels, and each value is
// decoded once.
template <typename Integer>
void addIntegers(Extents& extents, const Image& image, std::span<const Integer> samples,
                 const JobContext& job) {
    constexpr int kValues = 1 << (8 * sizeof(Integer));
    const int channels = image.channels(), counted = std::min(channels, 4);
    std::vector<std::size_t> counts(static_cast<std::size_t>(counted) * kValues);
    const std::size_t row = static_cast<std::size_t>(image.width()) * channels;
    for (int y = 0; y < image.height() && !job.cancelled(); ++y)
        for (std::size_t i = y * row; i < (y + 1) * row; i += channels)
            for (int c = 0; c < counted; ++c)
                ++counts[static_cast<std::size_t>(c) * kValues + samples[i + c]];

    // Every value as a texel, so that the image decodes it.
    Image ramp(256, kValues / 256, 3, image.type(), image.encoding());
    for (int v = 0; v < kValues; ++v) {
        const auto value = static_cast<Integer>(v);
        if constexpr (sizeof(Integer) == 1)
            ramp.u8()[v * 3] = value;
        else
            ramp.u16()[v * 3] = value;
    }
    const bool hasAlpha = channels == 2 || channels == 4;
    for (int c = 0; c < counted; ++c) {
        const bool alpha = hasAlpha && c == channels - 1;
        for (int v = 0; v < kValues; ++v)
            if (const std::size_t n = counts[static_cast<std::size_t>(c) * kValues + v]; n > 0)
                extents[c].add(alpha ? v / (kValues - 1.0) : ramp.linear(v % 256, v / 256).x,
                               static_cast<double>(n));
    }
}

void addFloats(Extents& extents, const Image& image, const JobContext& job) {
    const int counted = std::min(image.channels(), 4);
    const bool hasAlpha = image.channels() == 2 || image.channels() == 4;
    for (int y = 0; y < image.height() && !job.cancelled(); ++y)
        for (int x = 0; x < image.width(); ++x) {
            const glm::vec4 texel = image.linear(x, y);
            for (int c = 0; c < counted; ++c) {
                const bool alpha = hasAlpha && c == image.channels() - 1;
                const float value = alpha ? texel.w : texel[c];
                if (std::isfinite(value))
                    extents[c].add(value, 1.0);
            }
        }
}

} // namespace

TexelRange texelRange(const Image& image, const JobContext& job) {
    Extents extents;
    if (image.type() == PixelType::U8)
        addIntegers(extents, image, image.u8(), job);
    else if (image.type() == PixelType::U16)
        addIntegers(extents, image, image.u16(), job);
    else
        addFloats(extents, image, job);

    // Grey and missing alpha as in Image::linear().
    TexelRange range;
    for (int c = 0; c < 4; ++c) {
        int stored = c;
        if (image.channels() <= 2)
            stored = c < 3 ? 0 : 1;
        if (stored >= image.channels() || extents[stored].count == 0.0)
            continue;
        const Extent& extent = extents[stored];
        range.low[c] = static_cast<float>(extent.low);
        range.mean[c] = static_cast<float>(extent.sum / extent.count);
        range.high[c] = static_cast<float>(extent.high);
    }
    return range;
}

} // namespace patina
