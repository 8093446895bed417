#include "core/compare/ErrorMap.h"

#include "core/base/Check.h"
#include "core/compare/Comparable.h"
#include "core/compare/Metrics.h"
#include "core/compare/PairedSamples.h"
#include "core/job/Parallel.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

namespace patina {
namespace {

// Rows that one thread takes at a time: some milliseconds of a wide picture.
constexpr std::size_t kRowsAtATime = 16;

double differenceOf(double s, double r, Difference difference) {
    switch (difference) {
    case Difference::Signed:
        return s - r;
    case Difference::Absolute:
        return std::abs(s - r);
    case Difference::Relative:
        return std::abs(s - r) / std::sqrt(r * r + kRelMseEpsilon);
    }
    return s - r;
}

} // namespace

ErrorSummary summarize(const Image& values) {
    CHECK(!values.empty() && values.channels() == 1);
    const std::span<const float> all = values.f32();
    const auto width = static_cast<std::size_t>(values.width());
    ErrorSummary summary;
    double sum = 0;
    std::size_t largest = 0;
    for (std::size_t begin = 0; begin < all.size(); begin += width) {
        double row = 0; // a sum per row keeps the rounding error small
        for (std::size_t i = begin; i < begin + width; ++i) {
            row += static_cast<double>(all[i]);
            if (std::abs(all[i]) > std::abs(all[largest]))
                largest = i;
        }
        sum += row;
    }
    summary.mean = sum / static_cast<double>(all.size());
    summary.max = static_cast<double>(std::abs(all[largest]));
    summary.maxPosition = {static_cast<int>(largest % width), static_cast<int>(largest / width)};

    std::vector<float> magnitudes(all.size());
    std::transform(all.begin(), all.end(), magnitudes.begin(), [](float v) { return std::abs(v); });
    auto from = magnitudes.begin(); // each higher percentile lies behind the one before
    const auto percentile = [&](double share) {
        const auto rank =
            static_cast<std::ptrdiff_t>(std::ceil(share * static_cast<double>(all.size())));
        const auto at = magnitudes.begin() + std::max<std::ptrdiff_t>(rank, 1) - 1;
        std::nth_element(from, at, magnitudes.end());
        from = at;
        return static_cast<double>(*at);
    };
    summary.median = percentile(0.5);
    summary.percentile95 = percentile(0.95);
    summary.percentile99 = percentile(0.99);
    return summary;
}

Result<ErrorMap> differenceMap(const Image& image, const Image& reference, Difference difference,
                               const JobContext& job) {
    if (Result<void> comparable = compare::checkComparable(image, reference); !comparable)
        return comparable.error();
    const compare::PairedSamples samples(image, reference);
    ErrorMap map;
    map.values = Image(image.width(), image.height(), 1, PixelType::F32, ColorEncoding::Data);
    const std::span<float> out = map.values.f32();
    std::atomic<std::size_t> notFinite = 0;
    parallelFor(job, static_cast<std::size_t>(image.height()), kRowsAtATime,
                [&](std::size_t begin, std::size_t end) {
                    std::size_t i = begin * static_cast<std::size_t>(image.width());
                    std::size_t broken = 0;
                    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
                        for (int x = 0; x < image.width(); ++x, ++i) {
                            double largest = 0;
                            for (int c = 0; c < samples.channels(); ++c) {
                                const double d = differenceOf(
                                    samples.image(x, y, c), samples.reference(x, y, c), difference);
                                broken += std::isfinite(d) ? 0 : 1;
                                if (std::abs(d) > std::abs(largest))
                                    largest = d;
                            }
                            out[i] = static_cast<float>(largest);
                        }
                    notFinite += broken;
                });
    if (job.cancelled())
        return Error{ErrorKind::Cancelled, "cancelled", {}, {}};
    if (notFinite > 0)
        return compare::notFiniteError(notFinite);
    map.summary = summarize(map.values);
    return map;
}

} // namespace patina
