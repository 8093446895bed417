// The sequence's stratification and the warps' densities.
#include "core/math/Sampling.h"
#include "tests/core/math/SamplerCheck.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

namespace patina {
namespace {

using std::numbers::pi;

// The first 16 points of the unscrambled sequence (Joe & Kuo direction numbers), times 16.
constexpr std::array<std::array<int, 2>, 16> kSobol16 = {{{0, 0},
                                                          {8, 8},
                                                          {4, 12},
                                                          {12, 4},
                                                          {2, 10},
                                                          {10, 2},
                                                          {6, 6},
                                                          {14, 14},
                                                          {1, 15},
                                                          {9, 7},
                                                          {5, 3},
                                                          {13, 11},
                                                          {3, 5},
                                                          {11, 13},
                                                          {7, 9},
                                                          {15, 1}}};

TEST(Sobol, DimensionsMatchTheDirectionNumbers) {
    for (std::uint32_t i = 0; i < 16; ++i) {
        EXPECT_EQ(reverseBits(i) >> 28, static_cast<std::uint32_t>(kSobol16[i][0])) << i;
        EXPECT_EQ(reverseBits(detail::sobolDimension1Reversed(i)) >> 28,
                  static_cast<std::uint32_t>(kSobol16[i][1]))
            << i;
    }
    // Far points against the definition: XOR of v_k = v_k-1 ^ (v_k-1 >> 1) over the set bits.
    for (const std::uint32_t i : {0x12345678u, 0xdeadbeefu, 0xffffffffu, 0x80000001u}) {
        std::uint32_t v = 0x80000000u, expected = 0;
        for (std::uint32_t bits = i; bits != 0; bits >>= 1, v ^= v >> 1)
            if (bits & 1u)
                expected ^= v;
        EXPECT_EQ(reverseBits(detail::sobolDimension1Reversed(i)), expected) << std::hex << i;
    }
}

TEST(Sobol, InFourDimensionsIsEvenInEachAndTheFirstTwoAreANet) {
    for (const std::uint32_t seed : {0u, 77u, 0xffffffffu})
        for (int k = 1; k <= 10; ++k)
            for (std::uint32_t block = 0; block < 3; ++block) {
                const std::uint32_t count = 1u << k;
                const auto boxes = static_cast<float>(count);
                std::array<std::set<int>, 5> taken;
                for (std::uint32_t i = 0; i < count; ++i) {
                    const glm::vec4 p = sobolOwen4D(block * count + i, seed);
                    for (int d = 0; d < 4; ++d)
                        taken[static_cast<std::size_t>(d)].insert(static_cast<int>(p[d] * boxes));
                    const int columns = 1 << (k / 2), rows = static_cast<int>(count) / columns;
                    taken[4].insert(static_cast<int>(p.x * static_cast<float>(columns)) * rows +
                                    static_cast<int>(p.y * static_cast<float>(rows)));
                }
                for (const std::set<int>& boxesTaken : taken)
                    ASSERT_EQ(boxesTaken.size(), count) << seed << " " << k << " " << block;
            }
}

TEST(Sobol, InFourDimensionsKnowsWhatDependsOnAllOfThem) {
    // How often the sum of four numbers is below 2: half of the time. Root mean square errors over
    // many seeds.
    constexpr std::uint32_t kPoints = 1024, kSeeds = 64;
    double together = 0.0, inPairs = 0.0;
    for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
        int below = 0, pairsBelow = 0;
        for (std::uint32_t i = 0; i < kPoints; ++i) {
            const glm::vec4 p = sobolOwen4D(i, seedFor(3, seed));
            below += p.x + p.y + p.z + p.w < 2.0f ? 1 : 0;
            const glm::vec2 a = sobolOwen2D(i, seedFor(4, seed)),
                            b = sobolOwen2D(i, seedFor(5, seed));
            pairsBelow += a.x + a.y + b.x + b.y < 2.0f ? 1 : 0;
        }
        together += std::pow(below / double{kPoints} - 0.5, 2.0);
        inPairs += std::pow(pairsBelow / double{kPoints} - 0.5, 2.0);
    }
    EXPECT_LT(std::sqrt(together / kSeeds), 0.5 * 0.5 / std::sqrt(double{kPoints}))
        << "half of what chance has";
    EXPECT_LT(together, 0.7 * inPairs);
}

TEST(Sobol, EveryAlignedBlockIsANet) {
    // One point in each elementary interval of area 2^-k, for all shapes, blocks and seeds.
    for (const std::uint32_t seed : {0u, 1u, 77u, 0xffffffffu})
        for (int k = 1; k <= 10; ++k)
            for (std::uint32_t block = 0; block < 3; ++block) {
                const std::uint32_t count = 1u << k;
                for (int columnsLog = 0; columnsLog <= k; ++columnsLog) {
                    std::vector<int> hits(count, 0);
                    for (std::uint32_t i = 0; i < count; ++i) {
                        const glm::vec2 p = sobolOwen2D(block * count + i, seed);
                        ASSERT_TRUE(p.x >= 0.0f && p.x < 1.0f && p.y >= 0.0f && p.y < 1.0f);
                        const auto column = static_cast<std::uint32_t>(p.x * (1u << columnsLog));
                        const auto row = static_cast<std::uint32_t>(p.y * (1u << (k - columnsLog)));
                        ++hits[(row << columnsLog) + column];
                    }
                    ASSERT_TRUE(std::ranges::all_of(hits, [](int n) { return n == 1; }))
                        << "seed " << seed << " k " << k << " block " << block << " columns 2^"
                        << columnsLog;
                }
            }
}

TEST(Sobol, SeedsGiveUnrelatedSequences) {
    // The correlation of two sequences at equal indices, ~N(0, 1/n) when they are independent. The
    // shuffled order is what makes padding to more dimensions work.
    constexpr int kCount = 4096;
    for (std::uint32_t element = 0; element < 20; ++element) {
        double sum = 0.0;
        for (std::uint32_t i = 0; i < kCount; ++i)
            sum += (sobolOwen2D(i, seedFor(5, element)).x - 0.5) *
                   (sobolOwen2D(i, seedFor(5, element + 1)).x - 0.5);
        EXPECT_LT(std::abs(sum / kCount * 12.0), 5.0 / std::sqrt(kCount)) << element;
    }
}

TEST(Sobol, ScramblingIsUnbiased) {
    // Over many seeds the first point is uniform: χ² over an 8 × 8 grid, 63 degrees of freedom.
    std::array<int, 64> cells{};
    constexpr int kSeeds = 64 * 200;
    for (std::uint32_t s = 0; s < kSeeds; ++s) {
        const glm::vec2 p = sobolOwen2D(0, seedFor(0, s));
        ++cells[static_cast<int>(p.x * 8) + 8 * static_cast<int>(p.y * 8)];
    }
    double chi2 = 0.0;
    for (const int n : cells)
        chi2 += (n - 200.0) * (n - 200.0) / 200.0;
    EXPECT_LT(chi2, 120.0); // p = 2e-5
    EXPECT_GT(chi2, 25.0);  // and not suspiciously even
}

TEST(Warp, CosineHemisphere) {
    checkSampler(
        "cosine", [](glm::vec2 u) { return cosineHemisphere(u); },
        [](const glm::dvec3& d) { return cosineHemispherePdf(static_cast<float>(d.z)); }, 0.0);
}

TEST(Warp, UniformSphere) {
    checkSampler(
        "sphere", [](glm::vec2 u) { return uniformSphere(u); },
        [](const glm::dvec3&) { return 0.25 / pi; }, -1.0);
}

TEST(Warp, ReflectedVisibleNormals) {
    // The reflected direction may leave the hemisphere below: the density there counts as well.
    for (const float alpha : {0.3f, 0.6f, 1.0f})
        for (const float cosV : {0.9f, 0.5f, 0.2f}) {
            const glm::vec3 wo(std::sqrt(1.0f - cosV * cosV), 0.0f, cosV);
            checkSampler(
                "vndf", [&](glm::vec2 u) { return glm::reflect(-wo, sampleVndfGGX(u, wo, alpha)); },
                [&](const glm::dvec3& wi) {
                    const glm::vec3 h = glm::normalize(wo + glm::vec3(wi));
                    return h.z <= 0.0f ? 0.0
                                       : static_cast<double>(vndfReflectionPdf(cosV, h.z, alpha));
                },
                -1.0);
        }
}

TEST(Warp, ConcentricDiscKeepsAreaAndFillsTheDisc) {
    // Rings and sectors of equal area receive equal numbers of a regular grid's points.
    constexpr int kGrid = 512;
    std::array<int, 4> rings{};
    std::array<int, 8> sectors{};
    for (int i = 0; i < kGrid; ++i)
        for (int j = 0; j < kGrid; ++j) {
            const glm::vec2 p = concentricDisc({(i + 0.5f) / kGrid, (j + 0.5f) / kGrid});
            const float r2 = glm::dot(p, p);
            ASSERT_LE(r2, 1.0f + 1e-6f);
            ++rings[std::min(static_cast<int>(r2 * 4.0f), 3)];
            const double angle = std::atan2(p.y, p.x) + pi;
            ++sectors[std::min(static_cast<int>(angle / (2.0 * pi) * 8.0), 7)];
        }
    for (const int n : rings)
        EXPECT_NEAR(n, kGrid * kGrid / 4, kGrid * kGrid / 400);
    for (const int n : sectors)
        EXPECT_NEAR(n, kGrid * kGrid / 8, kGrid * kGrid / 400);
    EXPECT_EQ(concentricDisc({0.5f, 0.5f}), glm::vec2(0.0f));
}

TEST(Basis, IsRightHandedAndOrthonormal) {
    for (std::uint32_t i = 0; i < 2000; ++i) {
        glm::vec3 n = uniformSphere(sobolOwen2D(i, 3));
        if (i == 0)
            n = {0, 0, -1}; // where other constructions divide by zero
        if (i == 1)
            n = {0, 0, 1};
        glm::vec3 t, b;
        orthonormalBasis(n, t, b);
        ASSERT_NEAR(glm::length(t), 1.0f, 2e-6f);
        ASSERT_NEAR(glm::length(b), 1.0f, 2e-6f);
        ASSERT_NEAR(glm::dot(t, n), 0.0f, 2e-6f);
        ASSERT_LT(glm::length(glm::cross(t, b) - n), 4e-6f);
    }
}

} // namespace
} // namespace patina
