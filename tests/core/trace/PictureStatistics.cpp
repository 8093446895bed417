#include "tests/core/trace/PictureStatistics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <map>
#include <numbers>
#include <utility>

namespace patina::test {
namespace {

constexpr int kBlock = 32;
constexpr double kCertain = 38.0; // beyond it a double knows no smaller chance

struct Sample {
    double mean = 0.0, variance = 0.0; // variance: of the mean
    double freedom = 1.0;
};

// Of a pixel over the seeds first … first + count - 1.
Sample sampleOf(const SeedPictures& pictures, std::size_t first, std::size_t count,
                std::size_t pixel, int channel) {
    const auto n = static_cast<double>(count);
    Sample sample;
    for (std::size_t s = first; s < first + count; ++s)
        sample.mean += pictures[s][pixel][channel] / n;
    for (std::size_t s = first; s < first + count; ++s) {
        const double apart = pictures[s][pixel][channel] - sample.mean;
        sample.variance += apart * apart / (n * (n - 1.0));
    }
    sample.freedom = n - 1.0;
    return sample;
}

// Welch 1947, "The Generalization of 'Student's' Problem when Several Different Population
// Variances are Involved".
Sample difference(const Sample& a, const Sample& b) {
    const double variance = a.variance + b.variance;
    const double freedom =
        variance * variance /
        (a.variance * a.variance / a.freedom + b.variance * b.variance / b.freedom);
    return {a.mean - b.mean, variance, freedom};
}

// |z| that one of n normal values exceeds with a chance of 1 %.
double sidakBound(std::size_t n) {
    const double each = -std::expm1(std::log(0.99) / static_cast<double>(n));
    double low = 0.0, high = 20.0;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (std::erfc(middle / std::numbers::sqrt2) > each ? low : high) = middle;
    }
    return low;
}

} // namespace

double normalOfStudent(double t, double freedom) {
    const double a = freedom - 0.5, b = 48.0 * a * a;
    const double y = a * std::log1p(t * t / freedom);
    const double z =
        ((((-0.4 * y - 3.3) * y - 24.0) * y - 85.5) / (0.8 * y * y + 100.0 + b) + y + 3.0) / b +
        1.0;
    return std::copysign(z * std::sqrt(y), t);
}

std::vector<std::optional<Difference>> differences(const SeedPictures& a, const SeedPictures& b,
                                                   int channel) {
    std::vector<std::optional<Difference>> result(a.front().size());
    for (std::size_t p = 0; p < result.size(); ++p) {
        Sample halves[2];
        for (const std::size_t half : {0u, 1u})
            halves[half] = difference(sampleOf(a, half * (a.size() / 2), a.size() / 2, p, channel),
                                      sampleOf(b, half * (b.size() / 2), b.size() / 2, p, channel));
        // Below that single precision differs, not light.
        const double rounding = 1e-5 * std::abs(a.front()[p][channel]);
        const auto agrees = [&](const Sample& half) {
            return half.variance <= rounding * rounding;
        };
        if (agrees(halves[0]) && agrees(halves[1])) {
            if (std::abs(halves[0].mean) > 10.0 * rounding)
                result[p] = {std::copysign(kCertain, halves[0].mean),
                             std::copysign(kCertain, halves[0].mean)};
            continue;
        }
        if (agrees(halves[0]) || agrees(halves[1])) // what is seen there is too rare to tell
            continue;
        Difference both;
        for (const int half : {0, 1}) {
            const Sample& other = halves[1 - half];
            const double t = halves[half].mean / std::sqrt(other.variance);
            both.normal += normalOfStudent(t, other.freedom) / std::numbers::sqrt2;
            both.unskewed +=
                t * std::sqrt((other.freedom - 2.0) / other.freedom) / std::numbers::sqrt2;
        }
        result[p] = both;
    }
    return result;
}

DifferenceSummary summary(const std::vector<std::optional<Difference>>& pixels, int width) {
    struct Sum {
        double sum = 0.0;
        std::size_t count = 0;
        [[nodiscard]] double mean() const {
            return count > 0 ? sum / std::sqrt(static_cast<double>(count)) : 0.0;
        }
    };
    Sum all;
    std::map<std::pair<std::size_t, std::size_t>, Sum> blocks;
    for (std::size_t p = 0; p < pixels.size(); ++p) {
        if (!pixels[p])
            continue;
        const auto columns = static_cast<std::size_t>(width);
        for (Sum* sum : {&all, &blocks[{p % columns / kBlock, p / columns / kBlock}]}) {
            sum->sum += pixels[p]->unskewed;
            ++sum->count;
        }
    }
    DifferenceSummary result;
    result.count = all.count;
    result.mean = all.mean();
    for (const auto& [place, block] : blocks)
        result.worstBlock = std::max(result.worstBlock, std::abs(block.mean()));
    const double bound = sidakBound(all.count);
    const auto passing = std::ranges::count_if(
        pixels, [&](const auto& pixel) { return pixel && std::abs(pixel->normal) <= bound; });
    result.passing = static_cast<double>(passing) / static_cast<double>(all.count);
    return result;
}

void expectSameMean(const SeedPictures& a, const SeedPictures& b, int width,
                    const std::string& name) {
    for (const int channel : {0, 1, 2}) {
        const DifferenceSummary found = summary(differences(a, b, channel), width);
        EXPECT_GT(found.count, a.front().size() / 2) << name << ", channel " << channel;
        EXPECT_GE(found.passing, 0.9975) << name << ", channel " << channel;
        EXPECT_LT(std::abs(found.mean), 3.0) << name << ", channel " << channel;
        EXPECT_LT(found.worstBlock, 5.0) << name << ", channel " << channel;
    }
}

} // namespace patina::test
