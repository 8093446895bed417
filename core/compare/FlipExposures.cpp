#include "core/compare/Flip.h"
#include "core/compare/FlipColor.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace patina {
namespace {

// Where the tone curve reaches `value`: the positive root of (a - v c) x² + (b - v d) x - v e = 0.
double inverseToneCurve(double value) {
    using Curve = compare::FlipToneCurve;
    const double p = Curve::a - value * static_cast<double>(Curve::c);
    const double q = Curve::b - value * static_cast<double>(Curve::d);
    const double r = -value * static_cast<double>(Curve::e);
    return (-q + std::sqrt(q * q - 4.0 * p * r)) / (2.0 * p);
}

} // namespace

FlipExposures flipExposures(const Image& reference) {
    std::vector<float> luminances;
    luminances.reserve(static_cast<std::size_t>(reference.width()) *
                       static_cast<std::size_t>(reference.height()));
    for (int y = 0; y < reference.height(); ++y)
        for (int x = 0; x < reference.width(); ++x) {
            // Of Rec.709; negative light is none, as for the tone curve.
            const glm::vec4 light = reference.linear(x, y);
            luminances.push_back(0.212639f * std::max(light.x, 0.0f) +
                                 0.715169f * std::max(light.y, 0.0f) +
                                 0.072192f * std::max(light.z, 0.0f));
        }
    const auto median = [](auto begin, auto end) {
        const auto middle = begin + (end - begin) / 2;
        std::nth_element(begin, middle, end);
        return *middle;
    };
    const float largest =
        luminances.empty() ? 0.0f : *std::max_element(luminances.begin(), luminances.end());
    if (!(largest > 0.0f))
        return {};
    float middle = median(luminances.begin(), luminances.end());
    // A background of black would ask for exposures without end.
    if (!(middle > 0.0f))
        middle = median(std::partition(luminances.begin(), luminances.end(),
                                       [](float l) { return !(l > 0.0f); }),
                        luminances.end());

    const double bright = inverseToneCurve(0.85);
    FlipExposures result;
    result.start = std::log2(bright / static_cast<double>(largest));
    result.stop = std::log2(bright / static_cast<double>(middle));
    result.count = std::max(2, static_cast<int>(std::ceil(result.stop - result.start)));
    return result;
}

} // namespace patina
