#include "core/bracket/ResponseCurve.h"

#include "core/base/Check.h"
#include "core/image/Srgb.h"

#include <algorithm>
#include <cmath>

namespace patina {
namespace {

// Between these the response of two pictures is compared: beyond them a code says little.
constexpr std::size_t kComparedFrom = 16, kComparedTo = 240;

// Dense, symmetric, positive definite: A x = b by Cholesky's A = L Lᵀ, in place.
class Normal {
  public:
    double& a(std::size_t row, std::size_t column) { return m_a[row * kCodes + column]; }
    double& b(std::size_t row) { return m_b[row]; }

    LogResponse solve() {
        for (std::size_t j = 0; j < kCodes; ++j) {
            for (std::size_t k = 0; k < j; ++k)
                a(j, j) -= a(j, k) * a(j, k);
            CHECK(a(j, j) > 0.0);
            a(j, j) = std::sqrt(a(j, j));
            for (std::size_t i = j + 1; i < kCodes; ++i) {
                double sum = a(i, j);
                for (std::size_t k = 0; k < j; ++k)
                    sum -= a(i, k) * a(j, k);
                a(i, j) = sum / a(j, j);
            }
        }
        LogResponse x{};
        for (std::size_t i = 0; i < kCodes; ++i) {
            x[i] = m_b[i];
            for (std::size_t k = 0; k < i; ++k)
                x[i] -= a(i, k) * x[k];
            x[i] /= a(i, i);
        }
        for (std::size_t i = kCodes; i-- > 0;) {
            for (std::size_t k = i + 1; k < kCodes; ++k)
                x[i] -= a(k, i) * x[k];
            x[i] /= a(i, i);
        }
        return x;
    }

  private:
    std::vector<double> m_a = std::vector<double>(kCodes * kCodes);
    std::array<double, kCodes> m_b{};
};

// A code as a mix of the two whole ones beside it.
struct Mix {
    std::size_t at = 0;
    double second = 0.0; // share of at + 1
};

Mix mixOf(double code) {
    const double clamped = std::clamp(code, 0.0, static_cast<double>(kTopCode));
    const auto at = std::min(static_cast<std::size_t>(clamped), kCodes - 2);
    return {at, clamped - static_cast<double>(at)};
}

double valueAt(const LogResponse& curve, const Mix& mix) {
    return (1.0 - mix.second) * curve[mix.at] + mix.second * curve[mix.at + 1];
}

double slopeAt(const LogResponse& curve, const Mix& mix) {
    return curve[mix.at + 1] - curve[mix.at];
}

// How much the sightings of a sample count, together with the hat weight.
using Trust = std::vector<std::vector<double>>;

// The least-squares problem of the paper's equation 3, after the radiances were eliminated: for
// each sample the best ln E is the weighted mean of g(z) - ln t, so that what remains has kCodes
// unknowns whatever the number of samples is.
LogResponse solveOnce(const std::vector<ResponseSample>& samples, const Trust& trust) {
    Normal normal;
    double total = 0.0;
    std::array<double, kCodes> row{};
    std::vector<std::size_t> touched;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        double sum = 0.0, sumLog = 0.0;
        row.fill(0.0);
        touched.clear();
        for (std::size_t j = 0; j < samples[i].seen.size(); ++j) {
            const auto& seen = samples[i].seen[j];
            const double hat = hatWeight(seen.code);
            const double weight = hat * hat * trust[i][j]; // squared, as in the paper's equation
            if (weight <= 0.0)
                continue;
            const Mix mix = mixOf(seen.code);
            const std::array<double, 2> part{1.0 - mix.second, mix.second};
            for (std::size_t p = 0; p < 2; ++p) {
                for (std::size_t q = 0; q < 2; ++q)
                    normal.a(mix.at + p, mix.at + q) += weight * part[p] * part[q];
                normal.b(mix.at + p) += weight * part[p] * seen.logExposure;
                row[mix.at + p] += weight * part[p];
                touched.push_back(mix.at + p);
            }
            sum += weight;
            sumLog += weight * seen.logExposure;
        }
        if (sum <= 0.0)
            continue;
        std::sort(touched.begin(), touched.end());
        touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
        for (const std::size_t p : touched) {
            for (const std::size_t q : touched)
                normal.a(p, q) -= row[p] * row[q] / sum;
            normal.b(p) -= row[p] * sumLog / sum;
        }
        total += sum;
    }

    // Smoothness. Where all exposures are the same number of stops apart, waves of that period can
    // be added to g and nothing in the photos tells: only this term does, and what it takes for
    // smooth is what is found. The paper's second differences of g itself make waves where g bends,
    // as each power of the exposure does in the dark; so here they are third differences, and of g
    // less the sRGB curve's, which most cameras are near to. By the hat weight, twice: codes at the
    // ends are free. Chosen by simulated cameras; docs/maths/bracket.md has the figures.
    constexpr double kSmoothness = 1e6;
    constexpr std::array<double, 4> kDifference{-1.0, 3.0, -3.0, 1.0};
    const LogResponse usual = srgbResponse();
    const double smoothness = kSmoothness * std::max(total, 1.0) / static_cast<double>(kCodes);
    for (std::size_t z = 0; z + 3 < kCodes; ++z) {
        const double hat = hatWeight(static_cast<float>(z) + 1.5f);
        const double weight = smoothness * hat * hat * hat * hat;
        double bend = 0.0;
        for (std::size_t p = 0; p < 4; ++p)
            bend += kDifference[p] * usual[z + p];
        for (std::size_t p = 0; p < 4; ++p) {
            for (std::size_t q = 0; q < 4; ++q)
                normal.a(z + p, z + q) += weight * kDifference[p] * kDifference[q];
            normal.b(z + p) += weight * kDifference[p] * bend;
        }
    }
    // Where photos contradict their exposures wholly nothing but this holds the tilt of g.
    constexpr double kRidge = 1e-9;
    for (std::size_t z = 0; z < kCodes; ++z)
        normal.a(z, z) += kRidge * std::max(total, 1.0);
    // g is known up to a constant: a weight of any size makes it g(kMidCode) = 0.
    normal.a(kMidCode, kMidCode) += std::max(total, 1.0);
    LogResponse g = normal.solve();
    const double mid = g[kMidCode]; // but for rounding
    for (double& value : g)
        value -= mid;
    return g;
}

// Of each sighting by how many codes it is off; returns the robust standard deviation.
double residuals(const std::vector<ResponseSample>& samples, const LogResponse& curve,
                 const Trust& trust, Trust& off) {
    std::vector<double> sizes;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        double sum = 0.0, sumLog = 0.0;
        for (std::size_t j = 0; j < samples[i].seen.size(); ++j) {
            const auto& seen = samples[i].seen[j];
            const double weight = hatWeight(seen.code) * trust[i][j];
            sum += weight;
            sumLog += weight * (valueAt(curve, mixOf(seen.code)) - seen.logExposure);
        }
        for (std::size_t j = 0; j < samples[i].seen.size(); ++j) {
            const auto& seen = samples[i].seen[j];
            off[i][j] = 0.0;
            if (sum <= 0.0 || hatWeight(seen.code) <= 0.0f)
                continue;
            const Mix mix = mixOf(seen.code);
            // Where the curve is flat, as many codes stand for one exposure: the slope of a curve
            // that rises by a factor of e over all codes.
            const double slope = std::max(slopeAt(curve, mix), 1.0 / kCodes);
            off[i][j] = std::abs(valueAt(curve, mix) - seen.logExposure - sumLog / sum) / slope;
            sizes.push_back(off[i][j]);
        }
    }
    if (sizes.empty())
        return kLeastNoise;
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    constexpr double kSigmaPerMedian = 1.4826; // of a normal distribution
    return std::max(kSigmaPerMedian * *middle, kLeastNoise);
}

} // namespace

double logResponseAt(const LogResponse& response, double code) {
    return valueAt(response, mixOf(code));
}

LogResponse srgbResponse() {
    const std::array<float, 256>& table = srgbTable8();
    LogResponse result{};
    for (std::size_t z = 0; z < kCodes; ++z) {
        const double value = z == 0 ? 0.25 * table[1] : table[z];
        result[z] = std::log(value / table[kMidCode]);
    }
    return result;
}

double responseDifference(const LogResponse& a, const LogResponse& b) {
    double largest = 0.0;
    for (std::size_t z = kComparedFrom; z <= kComparedTo; ++z)
        largest = std::max(largest, std::abs(a[z] - b[z]));
    return std::expm1(largest);
}

RecoveredResponse recoverResponse(const std::vector<ResponseSample>& samples) {
    CHECK(samples.size() >= kLeastSamples);
    Trust trust, off;
    for (const ResponseSample& sample : samples) {
        trust.emplace_back(sample.seen.size(), 1.0);
        off.emplace_back(sample.seen.size(), 0.0);
    }
    RecoveredResponse result;
    constexpr int kRounds = 4;
    for (int round = 0; round < kRounds; ++round) {
        result.curve = solveOnce(samples, trust);
        result.noiseCodes = residuals(samples, result.curve, trust, off);
        // Tukey's biweight: what is off by more than some sigmas has no say in the next round.
        const double limit = 4.685 * result.noiseCodes; // his constant, for 95 % efficiency
        for (std::size_t i = 0; i < samples.size(); ++i)
            for (std::size_t j = 0; j < off[i].size(); ++j) {
                const double r = std::min(off[i][j] / limit, 1.0);
                trust[i][j] = (1.0 - r * r) * (1.0 - r * r);
            }
    }
    // More light never gives a lower code; beyond the samples noise could say so.
    LogResponse& g = result.curve;
    for (std::size_t z = kMidCode; z + 1 < kCodes; ++z)
        g[z + 1] = std::max(g[z + 1], g[z]);
    for (std::size_t z = kMidCode; z-- > 0;)
        g[z] = std::min(g[z], g[z + 1]);
    return result;
}

} // namespace patina
