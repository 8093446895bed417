#include "core/compare/FlipKernels.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace patina::compare {
namespace {

using std::numbers::pi;

// A sum of Gaussians a √(π/b) exp(-π² x² / b), x in degrees of visual angle (2020, eq. 3 and table
// 1; b of Cz's first one is its widest and decides how far all filters reach).
struct Sensitivity {
    double a = 0, b = 1;
};
constexpr Sensitivity kAchromatic{1.0, 0.0047}, kRedGreen{1.0, 0.0053};
constexpr std::array<Sensitivity, 2> kBlueYellow{{{34.1, 0.04}, {13.5, 0.025}}};

// Weights below this share of the centre's change no result: floats are exact to 6e-8.
constexpr double kNegligible = 1e-8;

std::vector<double> gaussianHalf(double b, double pixelsPerDegree, int radius) {
    std::vector<double> half;
    for (int i = 0; i <= radius; ++i) {
        const double x = i / pixelsPerDegree;
        half.push_back(std::exp(-pi * pi * x * x / b));
        if (half.back() < kNegligible) {
            half.pop_back();
            break;
        }
    }
    return half;
}

double sumOf(const std::vector<double>& half) {
    return half[0] + 2.0 * std::accumulate(half.begin() + 1, half.end(), 0.0);
}

HalfKernel scaled(const std::vector<double>& half, double factor) {
    HalfKernel result;
    for (const double weight : half)
        result.push_back(static_cast<float>(weight * factor));
    return result;
}

} // namespace

FlipKernels::FlipKernels(double pixelsPerDegree) {
    // Three standard deviations of the widest Gaussian, in pixels.
    const int reach = static_cast<int>(
        std::ceil(3.0 * std::sqrt(kBlueYellow[0].b / (2.0 * pi * pi)) * pixelsPerDegree));
    const auto normalized = [&](const Sensitivity& sensitivity) {
        const std::vector<double> half = gaussianHalf(sensitivity.b, pixelsPerDegree, reach);
        return scaled(half, 1.0 / sumOf(half));
    };
    achromatic = normalized(kAchromatic);
    redGreen = normalized(kRedGreen);
    // The sum of both is normalized, not each: their shares are those of their volumes.
    std::array<double, 2> volume{};
    for (std::size_t i = 0; i < 2; ++i) {
        const Sensitivity& s = kBlueYellow[i];
        const double sum = sumOf(gaussianHalf(s.b, pixelsPerDegree, reach));
        volume[i] = s.a * std::sqrt(pi / s.b) * sum * sum;
        blueYellow[i] = normalized(s);
    }
    for (std::size_t i = 0; i < 2; ++i)
        blueYellowWeight[i] = static_cast<float>(volume[i] / (volume[0] + volume[1]));

    // The width of lines and edges that the eye is best at, 0.082 degrees, is twice the deviation.
    const double deviation = 0.5 * 0.082 * pixelsPerDegree;
    const int radius = static_cast<int>(std::ceil(3.0 * deviation));
    std::vector<double> g, first, second;
    for (int x = 0; x <= radius; ++x) {
        g.push_back(std::exp(-x * x / (2.0 * deviation * deviation)));
        first.push_back(x * g.back());
        second.push_back((x * x / (deviation * deviation) - 1.0) * g.back());
    }
    gaussian = scaled(g, 1.0 / sumOf(g));
    derivative = scaled(first, 1.0 / std::accumulate(first.begin(), first.end(), 0.0));
    double positive = 0, negative = 0;
    for (std::size_t i = 0; i < second.size(); ++i)
        (second[i] > 0 ? positive : negative) += (i == 0 ? 1.0 : 2.0) * second[i];
    for (double& weight : second)
        weight /= weight > 0 ? positive : -negative;
    secondDerivative = scaled(second, 1.0);
}

int FlipKernels::radius() const {
    std::size_t longest = 0;
    for (const HalfKernel* kernel :
         {&achromatic, &redGreen, &blueYellow[0], &blueYellow[1], &gaussian})
        longest = std::max(longest, kernel->size());
    return static_cast<int>(longest) - 1;
}

} // namespace patina::compare
