#include "core/compare/Metrics.h"

#include "core/compare/Comparable.h"
#include "core/compare/PairedSamples.h"

#include <cmath>
#include <limits>

namespace patina {

Result<ImageMetrics> compareImages(const Image& image, const Image& reference) {
    if (Result<void> comparable = compare::checkComparable(image, reference); !comparable)
        return comparable.error();

    const compare::PairedSamples samples(image, reference);
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
                if (difference > metrics.max) {
                    metrics.max = difference;
                    metrics.maxPosition = {x, y};
                }
                metrics.different += difference > 0 ? 1 : 0;
                rowSquares += difference * difference;
                rowRelative += difference * difference / (r * r + kRelMseEpsilon);
            }
        }
        squares += rowSquares;
        relative += rowRelative;
    }
    if (notFinite > 0)
        return compare::notFiniteError(notFinite);

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
    if (Result<void> comparable = compare::checkComparable(image, reference); !comparable)
        return comparable.error();

    const compare::PairedSamples samples(image, reference);
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
