#include "tests/core/math/SamplerCheck.h"

#include "core/math/Sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace patina {

namespace {
using std::numbers::pi;
} // namespace

void checkSampler(const std::string& name, const std::function<glm::vec3(glm::vec2)>& sample,
                  const std::function<double(const glm::dvec3&)>& pdf, double zMin, double mass) {
    constexpr int kZ = 12, kPhi = 16, kSub = 40;
    constexpr int kSamples = 1 << 17;
    std::vector<double> expected(kZ * kPhi, 0.0), observed(kZ * kPhi, 0.0);
    double outside = 0.0;

    double total = 0.0;
    for (int i = 0; i < kZ * kSub; ++i)
        for (int j = 0; j < kPhi * kSub; ++j) {
            const double z = zMin + (1.0 - zMin) * (i + 0.5) / (kZ * kSub);
            const double phi = 2.0 * pi * (j + 0.5) / (kPhi * kSub);
            const double r = std::sqrt(1.0 - z * z);
            const double weight = (1.0 - zMin) / (kZ * kSub) * 2.0 * pi / (kPhi * kSub);
            const double p = pdf({r * std::cos(phi), r * std::sin(phi), z}) * weight;
            expected[(i / kSub) * kPhi + j / kSub] += p * kSamples;
            total += p;
        }
    EXPECT_NEAR(total, mass, 2e-3) << name;

    // Independent random numbers: stratified ones would make χ² too small to mean anything.
    std::uint32_t state = 12345;
    const auto next = [&state] { return static_cast<float>(hash32(state++) >> 8) * 0x1p-24f; };
    for (int n = 0; n < kSamples; ++n) {
        const float u = next();
        const glm::vec3 d = sample({u, next()});
        ASSERT_NEAR(glm::length(d), 1.0f, 1e-4f) << name;
        if (d.z < zMin) {
            ++outside;
            continue;
        }
        double phi = std::atan2(d.y, d.x);
        if (phi < 0.0)
            phi += 2.0 * pi;
        const int i = std::min(static_cast<int>((d.z - zMin) / (1.0 - zMin) * kZ), kZ - 1);
        observed[i * kPhi + std::min(static_cast<int>(phi / (2.0 * pi) * kPhi), kPhi - 1)] += 1;
    }
    double chi2 = 0.0, pooledExpected = kSamples * (1.0 - total), pooledObserved = outside;
    int cells = 0;
    for (std::size_t c = 0; c < expected.size(); ++c) {
        if (expected[c] < 5.0) {
            pooledExpected += expected[c];
            pooledObserved += observed[c];
            continue;
        }
        chi2 += (observed[c] - expected[c]) * (observed[c] - expected[c]) / expected[c];
        ++cells;
    }
    if (pooledExpected >= 5.0) {
        chi2 +=
            (pooledObserved - pooledExpected) * (pooledObserved - pooledExpected) / pooledExpected;
        ++cells;
    } else
        EXPECT_LT(pooledObserved, 30.0) << name;
    const double freedom = cells - 1;
    EXPECT_LT(chi2, freedom + 5.0 * std::sqrt(2.0 * freedom)) << name << " " << freedom;
}

} // namespace patina
