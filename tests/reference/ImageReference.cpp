#include "ImageReference.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <numbers>

namespace patina::test {
namespace {

constexpr double kPi = std::numbers::pi;

struct Picture {
    int width = 0, height = 0;
    std::vector<glm::dvec3> pixels;

    // Beyond the border its pixels are repeated.
    [[nodiscard]] const glm::dvec3& at(int x, int y) const {
        const int column = std::clamp(x, 0, width - 1), row = std::clamp(y, 0, height - 1);
        return pixels[static_cast<std::size_t>(row * width + column)];
    }
};

Picture pictureOf(const Image& image) {
    Picture result{image.width(), image.height(), {}};
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            result.pixels.emplace_back(glm::dvec3(image.linear(x, y)));
    return result;
}

Picture mapped(Picture picture, const std::function<glm::dvec3(const glm::dvec3&)>& f) {
    for (glm::dvec3& pixel : picture.pixels)
        pixel = f(pixel);
    return picture;
}

// The XYZ of a linear sRGB colour (IEC 61966-2-1 to seven digits), written row by row.
glm::dvec3 xyzOf(const glm::dvec3& c) {
    return {0.4123908 * c.x + 0.3575843 * c.y + 0.1804808 * c.z,
            0.2126390 * c.x + 0.7151687 * c.y + 0.0721923 * c.z,
            0.0193308 * c.x + 0.1191948 * c.y + 0.9505322 * c.z};
}

const glm::dvec3 kWhite = xyzOf(glm::dvec3(1));

glm::dvec3 ycxczOf(const glm::dvec3& rgb) {
    const glm::dvec3 v = xyzOf(rgb) / kWhite;
    return {116 * v.y - 16, 500 * (v.x - v.y), 200 * (v.y - v.z)};
}

glm::dvec3 rgbOfYcxcz(const glm::dvec3& v) {
    const double y = (v.x + 16) / 116;
    const glm::dvec3 xyz = glm::dvec3(v.y / 500 + y, y, y - v.z / 200) * kWhite;
    const glm::dmat3 columns(xyzOf({1, 0, 0}), xyzOf({0, 1, 0}), xyzOf({0, 0, 1}));
    return glm::inverse(columns) * xyz;
}

glm::dvec3 huntLabOf(const glm::dvec3& rgb) {
    const glm::dvec3 v = xyzOf(rgb) / kWhite;
    const auto f = [](double t) {
        return t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16) / 116;
    };
    const double lightness = 116 * f(v.y) - 16;
    return {lightness, lightness / 100 * 500 * (f(v.x) - f(v.y)),
            lightness / 100 * 200 * (f(v.y) - f(v.z))};
}

double hyabOf(const glm::dvec3& a, const glm::dvec3& b) {
    return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

struct Kernel {
    int radius = 0;
    std::vector<double> weights; // row by row

    Kernel(int r, const std::function<double(int, int)>& weight)
        : radius(r) {
        for (int y = -r; y <= r; ++y)
            for (int x = -r; x <= r; ++x)
                weights.push_back(weight(x, y));
    }
    // All weights sum to 1; or, with signs, positive ones to 1 and negative ones to -1.
    Kernel& normalize(bool withSigns) {
        double positive = 0, negative = 0;
        for (const double w : weights)
            (w > 0 ? positive : negative) += w;
        for (double& w : weights)
            w /= withSigns ? (w > 0 ? positive : -negative) : positive + negative;
        return *this;
    }
    [[nodiscard]] double apply(const Picture& picture, int channel, int x, int y) const {
        double sum = 0;
        std::size_t i = 0;
        for (int dy = -radius; dy <= radius; ++dy)
            for (int dx = -radius; dx <= radius; ++dx)
                sum += weights[i++] * picture.at(x + dx, y + dy)[channel];
        return sum;
    }
};

// Table 1 of the paper: a₁, b₁, a₂, b₂ for the channels A, RG and BY.
constexpr double kSensitivity[3][4] = {
    {1, 0.0047, 0, 1e-5}, {1, 0.0053, 0, 1e-5}, {34.1, 0.04, 13.5, 0.025}};

Kernel sensitivity(int channel, double pixelsPerDegree) {
    const auto& [a1, b1, a2, b2] = kSensitivity[channel];
    const int radius =
        static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * kPi * kPi)) * pixelsPerDegree));
    return Kernel(radius,
                  [&](int x, int y) {
                      const double squared = (x * x + y * y) / (pixelsPerDegree * pixelsPerDegree);
                      const auto gaussian = [&](double a, double b) {
                          return a * std::sqrt(kPi / b) * std::exp(-kPi * kPi * squared / b);
                      };
                      return gaussian(a1, b1) + gaussian(a2, b2);
                  })
        .normalize(false);
}

// First or second derivative of a Gaussian, along x or y.
Kernel feature(bool second, bool alongY, double pixelsPerDegree) {
    const double deviation = 0.082 / 2 * pixelsPerDegree;
    return Kernel(static_cast<int>(std::ceil(3 * deviation)),
                  [&](int x, int y) {
                      const double along = alongY ? y : x, variance = deviation * deviation;
                      const double gaussian = std::exp(-(x * x + y * y) / (2 * variance));
                      return (second ? along * along / variance - 1 : -along) * gaussian;
                  })
        .normalize(true);
}

std::vector<double> magnitudes(const Picture& luminance, bool second, double pixelsPerDegree) {
    const Kernel alongX = feature(second, false, pixelsPerDegree);
    const Kernel alongY = feature(second, true, pixelsPerDegree);
    std::vector<double> result;
    for (int y = 0; y < luminance.height; ++y)
        for (int x = 0; x < luminance.width; ++x)
            result.push_back(
                std::hypot(alongX.apply(luminance, 0, x, y), alongY.apply(luminance, 0, x, y)));
    return result;
}

std::vector<double> distances(const std::vector<double>& a, const std::vector<double>& b) {
    std::vector<double> result;
    for (std::size_t i = 0; i < a.size(); ++i)
        result.push_back(std::abs(a[i] - b[i]));
    return result;
}

FlipReference flipOf(const Picture& image, const Picture& reference, double pixelsPerDegree) {
    const Picture a = mapped(image, ycxczOf), b = mapped(reference, ycxczOf);
    const Kernel kernels[3] = {sensitivity(0, pixelsPerDegree), sensitivity(1, pixelsPerDegree),
                               sensitivity(2, pixelsPerDegree)};
    const double largest = std::pow(hyabOf(huntLabOf({0, 1, 0}), huntLabOf({0, 0, 1})), 0.7);
    const auto seen = [&](const Picture& picture, int x, int y) {
        const glm::dvec3 filtered(kernels[0].apply(picture, 0, x, y),
                                  kernels[1].apply(picture, 1, x, y),
                                  kernels[2].apply(picture, 2, x, y));
        return huntLabOf(glm::clamp(rgbOfYcxcz(filtered), 0.0, 1.0));
    };
    FlipReference result;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x) {
            const double distance = std::pow(hyabOf(seen(a, x, y), seen(b, x, y)), 0.7);
            const double knee = 0.4 * largest;
            result.color.push_back(distance < knee
                                       ? 0.95 / knee * distance
                                       : 0.95 + (distance - knee) / (largest - knee) * (1 - 0.95));
        }
    const auto luminance = [](const glm::dvec3& v) { return glm::dvec3((v.x + 16) / 116); };
    const Picture la = mapped(a, luminance), lb = mapped(b, luminance);
    result.edge =
        distances(magnitudes(la, false, pixelsPerDegree), magnitudes(lb, false, pixelsPerDegree));
    result.point =
        distances(magnitudes(la, true, pixelsPerDegree), magnitudes(lb, true, pixelsPerDegree));
    for (std::size_t i = 0; i < result.color.size(); ++i) {
        const double features =
            std::sqrt(std::max(result.edge[i], result.point[i]) / std::sqrt(2.0));
        result.flip.push_back(std::pow(result.color[i], 1 - features));
    }
    return result;
}

// Narkowicz's fit of ACES, light times 0.6.
double toneMapped(double light) {
    const double x = 0.6 * std::max(light, 0.0);
    return std::clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}

} // namespace

FlipReference flipReference(const Image& image, const Image& reference, double pixelsPerDegree) {
    return flipOf(pictureOf(image), pictureOf(reference), pixelsPerDegree);
}

HdrFlipReference hdrFlipReference(const Image& image, const Image& reference,
                                  double pixelsPerDegree) {
    const Picture a = pictureOf(image), b = pictureOf(reference);
    std::vector<double> luminances;
    for (const glm::dvec3& pixel : b.pixels)
        luminances.push_back(xyzOf(pixel).y);
    std::sort(luminances.begin(), luminances.end());
    // Where the tone curve is 0.85, by bisection.
    double low = 0, high = 100;
    for (int i = 0; i < 200; ++i) {
        const double middle = (low + high) / 2;
        (toneMapped(middle) < 0.85 ? low : high) = middle;
    }
    HdrFlipReference result;
    result.start = std::log2(low / luminances.back());
    result.stop = std::log2(low / luminances[luminances.size() / 2]);
    result.count = std::max(2, static_cast<int>(std::ceil(result.stop - result.start)));
    result.flip.assign(luminances.size(), 0.0);
    for (int i = 0; i < result.count; ++i) {
        const double exposure =
            result.start + (result.stop - result.start) * i / (result.count - 1);
        const auto displayed = [&](const glm::dvec3& light) {
            const glm::dvec3 exposed = light * std::exp2(exposure);
            return glm::dvec3(toneMapped(exposed.x), toneMapped(exposed.y), toneMapped(exposed.z));
        };
        const FlipReference flip =
            flipOf(mapped(a, displayed), mapped(b, displayed), pixelsPerDegree);
        for (std::size_t k = 0; k < result.flip.size(); ++k)
            result.flip[k] = std::max(result.flip[k], flip.flip[k]);
    }
    return result;
}

std::vector<double> ssimReference(const Image& image, const Image& reference) {
    std::vector<double> result;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
            // Weights of the pixels of the window that are there.
            double weights = 0, meanA = 0, meanB = 0;
            const auto forWindow = [&](const auto& body) {
                for (int dy = -5; dy <= 5; ++dy)
                    for (int dx = -5; dx <= 5; ++dx)
                        if (x + dx >= 0 && x + dx < image.width() && y + dy >= 0 &&
                            y + dy < image.height())
                            body(std::exp(-(dx * dx + dy * dy) / (2 * 1.5 * 1.5)),
                                 static_cast<double>(image.sample(x + dx, y + dy, 0)),
                                 static_cast<double>(reference.sample(x + dx, y + dy, 0)));
            };
            forWindow([&](double w, double a, double b) {
                weights += w;
                meanA += w * a;
                meanB += w * b;
            });
            meanA /= weights;
            meanB /= weights;
            double varianceA = 0, varianceB = 0, covariance = 0;
            forWindow([&](double w, double a, double b) {
                varianceA += w / weights * (a - meanA) * (a - meanA);
                varianceB += w / weights * (b - meanB) * (b - meanB);
                covariance += w / weights * (a - meanA) * (b - meanB);
            });
            result.push_back(
                (2 * meanA * meanB + 1e-4) * (2 * covariance + 9e-4) /
                ((meanA * meanA + meanB * meanB + 1e-4) * (varianceA + varianceB + 9e-4)));
        }
    return result;
}

} // namespace patina::test
