// Projection by samples against closed forms, and against plain random sampling.
#include "core/math/ShSampling.h"

#include "core/job/Parallel.h"
#include "core/math/ZonalHarmonics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace patina {
namespace {

const glm::vec3 kAxis = glm::normalize(glm::vec3(1, -2, 2));

glm::vec3 cap(const glm::vec3& d) {
    return glm::dot(d, kAxis) > std::cos(glm::radians(40.0f)) ? glm::vec3(1.0f, 2.0f, 0.0f)
                                                              : glm::vec3(0.0f);
}

std::vector<glm::vec3> exactCap(int order) {
    std::vector<glm::vec3> c(shCount(order), glm::vec3(0.0f));
    addZonal(zonalCap(glm::radians(40.0)), glm::dvec3(kAxis), {1.0, 2.0, 0.0}, c);
    return c;
}

double rms(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += double{glm::dot(a[i] - b[i], a[i] - b[i])};
    return std::sqrt(sum / static_cast<double>(a.size()));
}

TEST(ShSampling, FindsACapWhereItIs) {
    const std::vector<glm::vec3> exact = exactCap(5);
    EXPECT_LT(rms(projectStratified(cap, 5, 128, 1), exact), 2e-3);
    EXPECT_LT(rms(projectSobol(cap, 5, 16384, 1), exact), 2e-3);
}

TEST(ShSampling, RecoversEveryBasisFunction) {
    for (int i = 0; i < 64; ++i) {
        const auto basis = [i](const glm::vec3& d) {
            std::array<double, 64> y{};
            evaluateSh(8, glm::dvec3(d), y);
            return glm::vec3(static_cast<float>(y[i]));
        };
        const auto stratified = projectStratified(basis, 8, 96, 5);
        const auto sobol = projectSobol(basis, 8, 8192, 5);
        for (int k = 0; k < 64; ++k) {
            ASSERT_NEAR(stratified[k].y, i == k ? 1.0 : 0.0, 0.03) << i << " " << k;
            ASSERT_NEAR(sobol[k].y, i == k ? 1.0 : 0.0, 0.03) << i << " " << k;
        }
    }
}

TEST(ShSampling, IsUnbiasedAndBetterThanRandom) {
    // 32 seeds of 1024 samples: the mean is within its error, and the error is a small share of
    // plain random's, sqrt((4pi ∫ (f Y_i)² - c_i²) / N), here of Y_0: variance of a cap's hits.
    const std::vector<glm::vec3> exact = exactCap(3);
    const double share = (1.0 - std::cos(glm::radians(40.0))) / 2.0;
    const double random = std::sqrt(4.0 * M_PI) * std::sqrt(share * (1.0 - share) / 1024.0);
    for (const bool sobol : {false, true}) {
        double mean = 0.0, squares = 0.0;
        constexpr int kSeeds = 32;
        for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
            const auto c =
                sobol ? projectSobol(cap, 3, 1024, seed) : projectStratified(cap, 3, 32, seed);
            const double error = double{c[0].x - exact[0].x};
            mean += error / kSeeds;
            squares += error * error / kSeeds;
        }
        EXPECT_LT(std::sqrt(squares), (sobol ? 0.25 : 0.45) * random) << sobol;
        EXPECT_GT(squares, 0.0); // seeds differ
        EXPECT_LT(std::abs(mean), 4.0 * std::sqrt(squares / kSeeds)) << sobol;
    }
}

TEST(ShSampling, SameBitsForAnyNumberOfThreads) {
    const auto run = [](int threads) {
        const ThreadLimit limit(threads);
        return std::pair(projectStratified(cap, 4, 77, 3), projectSobol(cap, 4, 5001, 3));
    };
    const auto one = run(1);
    EXPECT_EQ(one, run(2));
    EXPECT_EQ(one, run(7));
    EXPECT_NE(one.first, projectStratified(cap, 4, 77, 4));
    EXPECT_NE(one.second, projectSobol(cap, 4, 5001, 4));
}

} // namespace
} // namespace patina
