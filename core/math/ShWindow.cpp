#include "core/math/ShWindow.h"

#include "core/base/Check.h"
#include "core/math/SphericalHarmonics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <vector>

namespace patina {

namespace {

// Rounding to float moves irradiance by less: below zero by no more is not below zero.
constexpr double kTolerance = 1e-6;

using Bands = std::array<glm::dvec3, kMaxShOrder>;
using Factors = std::array<double, kMaxShOrder>;

constexpr Factors kUnchanged = {1, 1, 1, 1, 1, 1, 1, 1};

Factors factorsOf(const ShWindow& window) {
    Factors factors{};
    for (int l = 0; l < kMaxShOrder; ++l)
        factors[l] = window.factor(l);
    return factors;
}

// The irradiance of radiance coefficients, band by band, so that windows cost a few products.
class Irradiance {
  public:
    explicit Irradiance(std::span<const glm::vec3> radiance)
        : m_order(shOrderOf(radiance.size()))
        , m_coefficients(radiance.size()) {
        for (int l = 0; l < m_order; ++l)
            for (int m = -l; m <= l; ++m)
                m_coefficients[shIndex(l, m)] =
                    cosineConvolution(l) * glm::dvec3(radiance[shIndex(l, m)]);
        // A Fibonacci lattice: neighbours are 4.5° apart, a ninth of the shortest wave.
        constexpr int kNormals = 2048;
        m_normals.reserve(kNormals);
        for (int i = 0; i < kNormals; ++i) {
            const double z = 1.0 - (2.0 * i + 1.0) / kNormals, r = std::sqrt(1.0 - z * z);
            const double phi = 2.0 * std::numbers::pi * i / std::numbers::phi;
            add({r * std::cos(phi), r * std::sin(phi), z});
        }
    }

    void add(const glm::dvec3& normal) {
        m_normals.push_back(normal);
        m_bands.push_back(at(normal));
    }
    [[nodiscard]] double mean(int channel) const {
        return m_coefficients[0][channel] * std::sqrt(1.0 / (4.0 * std::numbers::pi));
    }

    // Lowest at the normals held.
    [[nodiscard]] LowestIrradiance lowestHeld(const Factors& factors, int channel) const {
        LowestIrradiance lowest{std::numeric_limits<double>::infinity(), {}, channel};
        for (std::size_t i = 0; i < m_bands.size(); ++i) {
            const double value = sumOf(factors, m_bands[i], channel);
            if (value < lowest.value)
                lowest = {value, m_normals[i], channel};
        }
        return lowest;
    }

    // Lowest of all normals: descent from every held normal beside which it may be.
    [[nodiscard]] LowestIrradiance lowest(const Factors& factors, int channel) const {
        // Along a great circle band l is a trigonometric polynomial of degree l: its second
        // derivative is at most l² times its peak, itself at most sqrt((2l + 1) / 4pi) |c_l|. So
        // the held normal next to the lowest of all, at most 0.06 away, is lower than this.
        double margin = 0.0, all = 0.0;
        for (int l = 0; l < m_order; ++l) {
            double squares = 0.0;
            for (int m = -l; m <= l; ++m)
                squares += std::pow(factors[l] * m_coefficients[shIndex(l, m)][channel], 2.0);
            margin += 0.5 * 0.06 * 0.06 * l * l *
                      std::sqrt((2.0 * l + 1.0) / (4.0 * std::numbers::pi) * squares);
            all += squares;
        }
        const double worth = 1e-3 * std::sqrt(all / (4.0 * std::numbers::pi));
        LowestIrradiance best = lowestHeld(factors, channel);
        const double limit = best.value + margin;
        std::vector<LowestIrradiance> starts;
        for (std::size_t i = 0; i < m_bands.size(); ++i)
            if (const double value = sumOf(factors, m_bands[i], channel); value <= limit)
                starts.push_back({value, m_normals[i], channel});
        std::sort(starts.begin(), starts.end(),
                  [](const auto& a, const auto& b) { return a.value < b.value; });
        std::vector<glm::dvec3> taken; // one of each group: dips are further than 8° from another
        for (const LowestIrradiance& start : starts) {
            if (std::any_of(taken.begin(), taken.end(), [&](const glm::dvec3& other) {
                    return glm::dot(other, start.normal) > 0.99;
                }))
                continue;
            taken.push_back(start.normal);
            if (const auto found = descend(start, factors, worth); found.value < best.value)
                best = found;
        }
        return best;
    }

    // 4pi times the mean square of what a window takes away, all channels together.
    [[nodiscard]] double change(const Factors& factors) const {
        double sum = 0.0;
        for (int l = 0; l < m_order; ++l)
            for (int m = -l; m <= l; ++m) {
                const glm::dvec3 lost = (1.0 - factors[l]) * m_coefficients[shIndex(l, m)];
                sum += glm::dot(lost, lost);
            }
        return sum;
    }

  private:
    [[nodiscard]] double sumOf(const Factors& factors, const Bands& bands, int channel) const {
        double value = 0.0;
        for (int l = 0; l < m_order; ++l)
            value += factors[l] * bands[l][channel];
        return value;
    }

    // By steps on the tangent plane that halve when none of eight leads down by `worth` times the
    // step's square; without that, rounding would lead it round and round where the lowest normals
    // are a circle.
    [[nodiscard]] LowestIrradiance descend(LowestIrradiance best, const Factors& factors,
                                           double worth) const {
        const int channel = best.channel;
        for (double step = 0.05; step > 1e-5;) {
            const glm::dvec3 n = best.normal;
            const glm::dvec3 side = std::abs(n.z) < 0.7 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
            const glm::dvec3 x = glm::normalize(glm::cross(side, n)), y = glm::cross(n, x);
            const double before = best.value;
            for (int k = 0; k < 8; ++k) {
                const double phi = std::numbers::pi / 4.0 * k;
                const glm::dvec3 to =
                    glm::normalize(n + step * (std::cos(phi) * x + std::sin(phi) * y));
                const double value = sumOf(factors, at(to), channel);
                if (value < best.value)
                    best = {value, to, channel};
            }
            if (best.value > before - worth * step * step)
                step *= 0.5;
        }
        return best;
    }

    [[nodiscard]] Bands at(const glm::dvec3& normal) const {
        std::array<double, kMaxShOrder * kMaxShOrder> y{};
        evaluateSh(m_order, normal, y);
        Bands bands{};
        for (int l = 0; l < m_order; ++l)
            for (int m = -l; m <= l; ++m)
                bands[l] += y[shIndex(l, m)] * m_coefficients[shIndex(l, m)];
        return bands;
    }

    int m_order;
    std::vector<glm::dvec3> m_coefficients;
    std::vector<glm::dvec3> m_normals;
    std::vector<Bands> m_bands; // at the normals
};

} // namespace

double hannWindow(int l, double width) {
    CHECK(l >= 0 && width > 0.0);
    return l < width ? 0.5 * (1.0 + std::cos(std::numbers::pi * l / width)) : 0.0;
}

double lanczosWindow(int l, double width) {
    CHECK(l >= 0 && width > 0.0);
    if (l == 0)
        return 1.0;
    return l < width ? std::sin(std::numbers::pi * l / width) / (std::numbers::pi * l / width)
                     : 0.0;
}

double laplacianWindow(int l, double lambda) {
    CHECK(l >= 0 && lambda >= 0.0);
    return 1.0 / (1.0 + lambda * l * l * (l + 1.0) * (l + 1.0));
}

double ShWindow::factor(int l) const {
    switch (type) {
    case ShWindowType::None:
        return 1.0;
    case ShWindowType::Hann:
        return hannWindow(l, width);
    case ShWindowType::Lanczos:
        return lanczosWindow(l, width);
    }
    return 1.0;
}

void applyWindow(const ShWindow& window, std::span<glm::vec3> coefficients) {
    const int order = shOrderOf(coefficients.size());
    for (int l = 0; l < order; ++l)
        for (int m = -l; m <= l; ++m)
            coefficients[shIndex(l, m)] *= static_cast<float>(window.factor(l));
}

LowestIrradiance lowestIrradiance(std::span<const glm::vec3> radiance) {
    const Irradiance irradiance(radiance);
    LowestIrradiance lowest = irradiance.lowest(kUnchanged, 0);
    for (int channel = 1; channel < 3; ++channel)
        if (const auto other = irradiance.lowest(kUnchanged, channel); other.value < lowest.value)
            lowest = other;
    return lowest;
}

ShWindow deringIrradiance(std::span<const glm::vec3> radiance, ShWindowType type) {
    Irradiance irradiance(radiance);
    const auto goesBelow = [&](const LowestIrradiance& lowest, double share) {
        return lowest.value < -share * irradiance.mean(lowest.channel);
    };
    std::vector<int> channels;
    bool needed = false;
    for (int channel = 0; channel < 3; ++channel)
        if (irradiance.mean(channel) > 0.0) {
            channels.push_back(channel);
            needed |= goesBelow(irradiance.lowest(kUnchanged, channel), kTolerance);
        }
    if (!needed || type == ShWindowType::None)
        return {};

    // At width 1 only the mean is left, so that it passes; the widest that does by bisection on
    // 1 / width. It is sought at the normals held; where the lowest of all normals then turns out
    // to be lower still, that one is held as well and the search goes on from there.
    double passes = 1.0, fails = 0.0;
    while (true) {
        const auto heldBelow = [&](double inverse) {
            const Factors factors = factorsOf({type, 1.0 / inverse});
            return std::any_of(channels.begin(), channels.end(), [&](int channel) {
                return goesBelow(irradiance.lowestHeld(factors, channel), 0.0);
            });
        };
        double low = fails, high = 1.0;
        for (int i = 0; i < 40; ++i) {
            const double middle = 0.5 * (low + high);
            (heldBelow(middle) ? low : high) = middle;
        }
        passes = high;
        const Factors factors = factorsOf({type, 1.0 / passes});
        bool again = false;
        for (const int channel : channels)
            if (const auto lowest = irradiance.lowest(factors, channel);
                goesBelow(lowest, 0.5 * kTolerance)) {
                irradiance.add(lowest.normal);
                again = true;
            }
        if (!again)
            return {type, 1.0 / passes};
        fails = passes;
    }
}

ShWindow deringIrradiance(std::span<const glm::vec3> radiance) {
    const ShWindow hann = deringIrradiance(radiance, ShWindowType::Hann);
    const ShWindow lanczos = deringIrradiance(radiance, ShWindowType::Lanczos);
    const Irradiance irradiance(radiance);
    return irradiance.change(factorsOf(lanczos)) < irradiance.change(factorsOf(hann)) ? lanczos
                                                                                      : hann;
}

} // namespace patina
