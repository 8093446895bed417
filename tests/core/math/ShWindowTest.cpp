// Windows against their formulas; the automatic choice against a fine search of its own.
#include "core/math/ShWindow.h"

#include "core/math/Sampling.h"
#include "core/math/ZonalHarmonics.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <random>
#include <vector>

namespace patina {
namespace {

TEST(ShWindow, Values) {
    // Sloan 2008, "Stupid SH Tricks": widths 3, 4 and 6, bands 0 … 5; lambda 0.01 and 0.05.
    constexpr double kWidths[3] = {3.0, 4.0, 6.0};
    constexpr double kHann[3][6] = {{1.0, 0.75, 0.25, 0.0, 0.0, 0.0},
                                    {1.0, 0.853553390593, 0.5, 0.146446609407, 0.0, 0.0},
                                    {1.0, 0.933012701892, 0.75, 0.5, 0.25, 0.0669872981078}};
    constexpr double kLanczos[3][6] = {
        {1.0, 0.826993343133, 0.413496671566, 0.0, 0.0, 0.0},
        {1.0, 0.900316316157, 0.636619772368, 0.300105438719, 0.0, 0.0},
        {1.0, 0.954929658551, 0.826993343133, 0.636619772368, 0.413496671566, 0.19098593171}};
    constexpr double kLambdas[2] = {0.01, 0.05};
    constexpr double kLaplacian[2][6] = {
        {1.0, 0.961538461538, 0.735294117647, 0.409836065574, 0.2, 0.1},
        {1.0, 0.833333333333, 0.357142857143, 0.121951219512, 0.047619047619, 0.0217391304348}};
    for (int l = 0; l < 6; ++l) {
        for (int k = 0; k < 3; ++k) {
            EXPECT_NEAR(hannWindow(l, kWidths[k]), kHann[k][l], 1e-10) << l << " " << kWidths[k];
            EXPECT_NEAR(lanczosWindow(l, kWidths[k]), kLanczos[k][l], 1e-10)
                << l << " " << kWidths[k];
            EXPECT_EQ((ShWindow{ShWindowType::Hann, kWidths[k]}.factor(l)),
                      hannWindow(l, kWidths[k]));
            EXPECT_EQ((ShWindow{ShWindowType::Lanczos, kWidths[k]}.factor(l)),
                      lanczosWindow(l, kWidths[k]));
        }
        for (int k = 0; k < 2; ++k)
            EXPECT_NEAR(laplacianWindow(l, kLambdas[k]), kLaplacian[k][l], 1e-10) << l;
        EXPECT_EQ(ShWindow{}.factor(l), 1.0);
    }
}

TEST(ShWindow, AppliesBandByBand) {
    std::vector<glm::vec3> c;
    for (int i = 0; i < 25; ++i)
        c.emplace_back(1.0f + static_cast<float>(i), -2.0f, 0.5f);
    const std::vector<glm::vec3> before = c;
    const ShWindow window{ShWindowType::Hann, 4.0};
    applyWindow(window, c);
    for (int l = 0; l < 5; ++l)
        for (int m = -l; m <= l; ++m)
            for (int k = 0; k < 3; ++k)
                EXPECT_FLOAT_EQ(c[shIndex(l, m)][k],
                                before[shIndex(l, m)][k] * static_cast<float>(hannWindow(l, 4.0)));
}

// The lowest irradiance at 100,000 normals, relative to the channel's mean.
double lowestShare(std::vector<glm::vec3> radiance, int channel) {
    const int order = static_cast<int>(std::lround(std::sqrt(double(radiance.size()))));
    convolveWithCosine(radiance);
    std::array<double, 64> y{};
    double lowest = 1e300;
    for (std::uint32_t i = 0; i < 100'000; ++i) {
        evaluateSh(order, glm::normalize(glm::dvec3(uniformSphere(sobolOwen2D(i, 4)))), y);
        double sum = 0.0;
        for (int k = 0; k < shCount(order); ++k)
            sum += y[k] * radiance[k][channel];
        lowest = std::min(lowest, sum);
    }
    return lowest / (radiance[0][channel] * y[0]);
}

std::vector<glm::vec3> sunAndSky(int order) {
    std::vector<glm::vec3> c(shCount(order), glm::vec3(0.0f));
    addZonal(zonalCap(glm::radians(2.0)), glm::normalize(glm::dvec3(1, 2, 3)), {900.0, 800, 500},
             c);
    addZonal(zonalCap(glm::radians(50.0)), {0, 1, 0}, {0.02, 0.04, 0.1}, c);
    return c;
}

TEST(ShWindow, FindsTheLowestIrradiance) {
    // Nine coefficients of a directional light: -0.0395833 at z = -8/15 of it.
    const glm::dvec3 d = glm::normalize(glm::dvec3(1, 2, 3));
    std::vector<glm::vec3> c(9, glm::vec3(0.0f));
    addZonal(zonalDirectional(), d, {0.5, 3.0, 1.0}, c);
    const LowestIrradiance lowest = lowestIrradiance(c);
    EXPECT_NEAR(lowest.value, 3.0 * -0.0395833333333, 1e-6);
    EXPECT_NEAR(glm::dot(lowest.normal, d), -8.0 / 15.0, 1e-3);
    EXPECT_EQ(lowest.channel, 1);
    // And of lights without symmetry: as low as a fine search.
    for (const int order : {3, 5, 8}) {
        const std::vector<glm::vec3> sky = sunAndSky(order);
        const LowestIrradiance found = lowestIrradiance(sky);
        const double mean = cosineConvolution(0) * double{sky[0][found.channel]} * 0.282094791774;
        const double fine = lowestShare(sky, found.channel);
        EXPECT_LE(found.value / mean, fine + 1e-9) << order;
        EXPECT_NEAR(found.value / mean, fine, 2e-4) << order;
    }
}

TEST(ShWindow, AutomaticKeepsIrradianceFromGoingBelowZeroAndNoMore) {
    for (const int order : {3, 4, 5, 6, 8})
        for (const ShWindowType type : {ShWindowType::Hann, ShWindowType::Lanczos}) {
            const std::vector<glm::vec3> light = sunAndSky(order);
            ASSERT_LT(lowestIrradiance(light).value, 0.0) << order; // it rings
            const ShWindow window = deringIrradiance(light, type);
            ASSERT_EQ(window.type, type) << order;
            std::vector<glm::vec3> windowed = light;
            applyWindow(window, windowed);
            double lowest = 1.0;
            for (int channel = 0; channel < 3; ++channel)
                lowest = std::min(lowest, lowestShare(windowed, channel));
            EXPECT_GE(lowest, -2e-6) << order;
            EXPECT_LE(lowest, 1e-3) << order; // it just touches
            // A little less of it would not do.
            std::vector<glm::vec3> wider = light;
            applyWindow({type, 1.02 * window.width}, wider);
            EXPECT_LT(lowestIrradiance(wider).value, 0.0) << order;
        }
}

TEST(ShWindow, AutomaticHoldsForRandomLights) {
    std::mt19937 random(7);
    const auto uniform = [&] { return static_cast<double>(random() >> 8) * 0x1p-24; };
    for (int round = 0; round < 12; ++round) {
        SCOPED_TRACE(round);
        const int order = 2 + round % 7;
        std::vector<glm::vec3> light(shCount(order), glm::vec3(0.0f));
        for (int k = 0; k < 1 + round % 4; ++k)
            addZonal(zonalCap(0.02 + 0.3 * uniform()),
                     glm::normalize(glm::dvec3(uniform(), uniform(), uniform()) - 0.5),
                     {uniform(), uniform(), k == 0 ? 1.0 : 0.0}, light);
        const ShWindow window = deringIrradiance(light);
        std::vector<glm::vec3> windowed = light;
        applyWindow(window, windowed);
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_GE(lowestShare(windowed, channel), -2e-6) << channel;
    }
}

TEST(ShWindow, AutomaticLeavesAloneWhatDoesNotRing) {
    // A constant; half a sphere, whose irradiance touches zero; black; a channel below zero.
    for (const double halfAngle : {180.0, 90.0}) {
        std::vector<glm::vec3> c(25, glm::vec3(0.0f));
        addZonal(zonalCap(glm::radians(halfAngle)), {0, 0, 1}, {1.0, 2.0, 3.0}, c);
        EXPECT_EQ(deringIrradiance(c), ShWindow{}) << halfAngle;
    }
    EXPECT_EQ(deringIrradiance(std::vector<glm::vec3>(9, glm::vec3(0.0f))), ShWindow{});
    std::vector<glm::vec3> c(9, glm::vec3(0.0f));
    addZonal(zonalDirectional(), {0, 0, 1}, {0.0, -1.0, 0.0}, c);
    EXPECT_EQ(deringIrradiance(c), ShWindow{});
    EXPECT_EQ(deringIrradiance(sunAndSky(5), ShWindowType::None), ShWindow{});
}

TEST(ShWindow, AutomaticTakesTheTypeThatChangesLess) {
    const auto changeBy = [](const std::vector<glm::vec3>& light, const ShWindow& window) {
        std::vector<glm::vec3> before = light, after = light;
        applyWindow(window, after);
        convolveWithCosine(before);
        convolveWithCosine(after);
        double sum = 0.0;
        for (std::size_t i = 0; i < before.size(); ++i)
            sum += double{glm::dot(after[i] - before[i], after[i] - before[i])};
        return sum;
    };
    for (const int order : {3, 5, 6}) {
        const std::vector<glm::vec3> light = sunAndSky(order);
        const double hann = changeBy(light, deringIrradiance(light, ShWindowType::Hann));
        const double lanczos = changeBy(light, deringIrradiance(light, ShWindowType::Lanczos));
        const double chosen = changeBy(light, deringIrradiance(light));
        EXPECT_NEAR(chosen, std::min(hann, lanczos), 1e-12 * chosen) << order;
        EXPECT_NE(hann, lanczos);
    }
}

} // namespace
} // namespace patina
