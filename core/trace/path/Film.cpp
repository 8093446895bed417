#include "core/trace/path/Film.h"

#include "core/base/Check.h"
#include "core/math/Shading.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace patina {

static_assert(sizeof(Film::Pixel) == 48);

namespace {

double luminanceOfSum(const glm::dvec3& sum) {
    return 0.2126 * sum.x + 0.7152 * sum.y + 0.0722 * sum.z;
}

} // namespace

void Film::Pixel::add(const glm::vec3& radiance, float alpha) {
    if (std::has_single_bit(samples))
        firstSum = static_cast<float>(luminanceOfSum(sum));
    ++samples;
    coverage += alpha;
    if (!std::isfinite(radiance.x) || !std::isfinite(radiance.y) || !std::isfinite(radiance.z)) {
        ++invalid;
        return;
    }
    sum += glm::dvec3(radiance);
    const auto luminance = static_cast<double>(shading::luminance(radiance));
    squares += luminance * luminance;
}

double Film::Pixel::luminance() const {
    return samples > 0 ? luminanceOfSum(sum) / samples : 0.0;
}

double Film::Pixel::variance() const {
    const double n = samples, mean = luminance();
    return std::max(squares / n - mean * mean, 0.0) / (n - 1.0);
}

double Film::Pixel::halvesVariance() const {
    const double n = samples, first = std::bit_floor(samples - 1), others = n - first;
    const double apart = static_cast<double>(firstSum) / first -
                         (luminanceOfSum(sum) - static_cast<double>(firstSum)) / others;
    return apart * apart * first * others / (n * n);
}

Film::Film(int width, int height)
    : m_width(width)
    , m_height(height)
    , m_pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
    CHECK(width > 0 && height > 0);
}

std::size_t Film::invalid() const {
    std::size_t count = 0;
    for (const Pixel& pixel : m_pixels)
        count += pixel.invalid;
    return count;
}

std::uint32_t Film::leastSamples() const {
    return m_pixels.empty() ? 0 : std::ranges::min(m_pixels, {}, &Pixel::samples).samples;
}

Image Film::radiance(bool alpha) const {
    const int channels = alpha ? 4 : 3;
    Image image(m_width, m_height, channels, PixelType::F32, ColorEncoding::Linear);
    float* out = image.f32().data();
    for (const Pixel& pixel : m_pixels) {
        const double share = pixel.samples > 0 ? 1.0 / pixel.samples : 0.0;
        for (int c = 0; c < 3; ++c)
            *out++ = static_cast<float>(share * pixel.sum[c]);
        if (alpha)
            *out++ = static_cast<float>(share * static_cast<double>(pixel.coverage));
    }
    return image;
}

std::optional<double> Film::noise() const {
    double variances = 0.0, means = 0.0;
    for (const Pixel& pixel : m_pixels) {
        if (pixel.samples < 2)
            return std::nullopt;
        variances += pixel.halvesVariance();
        means += pixel.luminance();
    }
    if (!(means > 0.0))
        return std::nullopt;
    const auto count = static_cast<double>(m_pixels.size());
    return std::sqrt(variances / count) / (means / count);
}

} // namespace patina
