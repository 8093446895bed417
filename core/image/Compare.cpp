#include "core/image/Compare.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace patina {
namespace {

// Regularises dark reference pixels in relMSE.
constexpr double kRelMseEpsilon = 0.01;

// The samples of two images side by side, with grey, colour and alpha brought to one layout.
class PairedSamples {
  public:
    PairedSamples(const Image& image, const Image& reference)
        : m_image(image)
        , m_reference(reference)
        , m_stored(image.encoding() == reference.encoding()) {
        const int most = std::max(image.channels(), reference.channels());
        m_raw = most > 4;
        m_alpha = !m_raw && (hasAlpha(image) || hasAlpha(reference));
        m_colors = m_raw ? most : (most <= 2 ? 1 : 3);
    }

    [[nodiscard]] int channels() const { return m_colors + (m_alpha ? 1 : 0); }
    [[nodiscard]] double image(int x, int y, int channel) const {
        return at(m_image, x, y, channel);
    }
    [[nodiscard]] double reference(int x, int y, int channel) const {
        return at(m_reference, x, y, channel);
    }

    static bool hasAlpha(const Image& image) {
        return image.channels() == 2 || image.channels() == 4;
    }

  private:
    [[nodiscard]] double at(const Image& image, int x, int y, int channel) const {
        if (m_raw)
            return image.sample(x, y, channel);
        const bool alpha = channel == m_colors;
        if (!m_stored)
            return image.linear(x, y)[alpha ? 3 : channel];
        if (alpha)
            return hasAlpha(image) ? image.sample(x, y, image.channels() - 1) : 1.0;
        return image.sample(x, y, image.channels() <= 2 ? 0 : channel);
    }

    const Image& m_image;
    const Image& m_reference;
    bool m_stored, m_raw = false, m_alpha = false;
    int m_colors = 3;
};

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

} // namespace

Result<ImageMetrics> compareImages(const Image& image, const Image& reference) {
    if (Result<void> comparable = checkComparable(image, reference); !comparable)
        return comparable.error();

    const PairedSamples samples(image, reference);
    ImageMetrics metrics;
    double squares = 0, relative = 0;
    std::size_t notFinite = 0;
    for (int y = 0; y < image.height(); ++y) {
        double rowSquares = 0, rowRelative = 0; // a sum per row keeps the rounding error small
        for (int x = 0; x < image.width(); ++x) {
            for (int c = 0; c < samples.channels(); ++c) {
                const double s = samples.image(x, y, c);
                const double r = samples.reference(x, y, c);
                if (!std::isfinite(s) || !std::isfinite(r)) {
                    ++notFinite;
                    continue;
                }
                const double difference = std::abs(s - r);
                metrics.max = std::max(metrics.max, difference);
                metrics.different += difference > 0 ? 1 : 0;
                rowSquares += difference * difference;
                rowRelative += difference * difference / (r * r + kRelMseEpsilon);
            }
        }
        squares += rowSquares;
        relative += rowRelative;
    }
    if (notFinite > 0)
        return Error{
            ErrorKind::InputBroken,
            fmt::format("{} samples are NaN or infinite, so no distance can be given", notFinite),
            {},
            {}};

    metrics.samples = static_cast<std::size_t>(image.width()) *
                      static_cast<std::size_t>(image.height()) *
                      static_cast<std::size_t>(samples.channels());
    const double count = static_cast<double>(metrics.samples);
    metrics.rmse = std::sqrt(squares / count);
    metrics.relMse = relative / count;
    metrics.psnr = metrics.rmse > 0 ? -20.0 * std::log10(metrics.rmse)
                                    : std::numeric_limits<double>::infinity();
    return metrics;
}

Result<Image> differenceImage(const Image& image, const Image& reference) {
    if (Result<void> comparable = checkComparable(image, reference); !comparable)
        return comparable.error();

    const PairedSamples samples(image, reference);
    Image result(image.width(), image.height(), 3, PixelType::F32, ColorEncoding::Data);
    const std::span<float> out = result.f32();
    std::size_t i = 0;
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            for (int c = 0; c < 3; ++c, ++i) {
                const int channel = samples.channels() < 3 ? 0 : c;
                out[i] = static_cast<float>(
                    std::abs(samples.image(x, y, channel) - samples.reference(x, y, channel)));
            }
        }
    }
    return result;
}

} // namespace patina
