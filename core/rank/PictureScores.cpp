#include "core/rank/PictureScores.h"

#include "core/base/Check.h"
#include "core/math/Shading.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace patina {
namespace {

// The smallest value that this share does not exceed; reorders.
float nearestRank(std::vector<float>& values, double share) {
    const auto rank =
        static_cast<std::ptrdiff_t>(std::ceil(share * static_cast<double>(values.size())));
    const auto nth = values.begin() + std::max<std::ptrdiff_t>(rank - 1, 0);
    std::nth_element(values.begin(), nth, values.end());
    return *nth;
}

} // namespace

ClippedShares clippedShares(std::span<const float> shown, const DisplayEnds& ends) {
    const std::size_t count = shown.size() / 3;
    CHECK(count > 0);
    const float* red = shown.data();
    const float* green = red + count;
    const float* blue = green + count;
    std::size_t highlights = 0, shadows = 0;
    for (std::size_t p = 0; p < count; ++p) {
        const float most = std::max({red[p], green[p], blue[p]});
        highlights += most >= ends.white ? 1 : 0;
        shadows += most < ends.black ? 1 : 0;
    }
    const auto all = static_cast<double>(count);
    return {static_cast<double>(highlights) / all, static_cast<double>(shadows) / all};
}

double contrastStops(std::span<const float> shown) {
    const std::size_t count = shown.size() / 3;
    CHECK(count > 0);
    std::vector<float> luminance(count);
    for (std::size_t p = 0; p < count; ++p)
        luminance[p] = shading::luminance({shown[p], shown[count + p], shown[2 * count + p]});
    const double high = nearestRank(luminance, 0.95), low = nearestRank(luminance, 0.05);
    return std::log2((high + kScreenFlare) / (low + kScreenFlare));
}

DifferenceScore differenceScore(std::span<const float> values) {
    CHECK(!values.empty());
    DifferenceScore score;
    double sum = 0;
    for (std::size_t p = 0; p < values.size(); ++p) {
        sum += values[p];
        if (values[p] > static_cast<float>(score.max)) {
            score.max = values[p];
            score.maxAt = p;
        }
    }
    const auto all = static_cast<double>(values.size());
    score.mean = sum / all;
    const auto worst = static_cast<std::size_t>(std::max(1.0, std::round(kWorstShare * all)));
    std::vector<float> sorted(values.begin(), values.end());
    std::partial_sort(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(worst),
                      sorted.end(), std::greater<>());
    double worstSum = 0;
    for (std::size_t p = 0; p < worst; ++p)
        worstSum += sorted[p];
    score.worst = worstSum / static_cast<double>(worst);
    return score;
}

} // namespace patina
