// An environment as one light: direction, strength, and the limits.
#include "core/light/DominantLight.h"
#include "core/math/SphericalHarmonics.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <numbers>

namespace patina {
namespace {

using Coefficients = std::array<glm::vec3, 9>;

// E(n) of a directional light.
Coefficients directional(const glm::vec3& toLight, const glm::vec3& irradiance) {
    std::array<float, 9> y{};
    evaluateSh(3, toLight, std::span<float>(y));
    Coefficients result{};
    for (std::size_t i = 0; i < 9; ++i)
        result[i] = irradiance * y[i];
    convolveWithCosine(result);
    return result;
}

// Three bands hold 1 - 1/128 of the clamped cosine's energy (Ramamoorthi & Hanrahan 2001: 99.22 %).
TEST(DominantLight, IsTheLightThatTheCoefficientsWereMadeOf) {
    for (const glm::vec3& d : {glm::vec3(0, 0, 1), glm::vec3(1, 0, 0), glm::vec3(0, -1, 0),
                               glm::normalize(glm::vec3(-2, 1, -2))}) {
        const glm::vec3 E(3.0f, 2.0f, 0.5f);
        const DominantLight light = dominantLight(directional(d, E));
        EXPECT_LT(glm::length(light.toLight - d), 1e-5f);
        EXPECT_LT(glm::length(light.irradiance - 0.9921875f * E), 1e-4f);
    }
}

// <pi L, max(0, z)> / <max(0, z), max(0, z)> = pi · pi / (2 pi / 3).
TEST(DominantLight, AUniformEnvironmentLightsFromAbove) {
    Coefficients even{};
    even[0] = glm::vec3(std::numbers::pi_v<float> * std::sqrt(4.0f * std::numbers::pi_v<float>));
    const DominantLight light = dominantLight(even);
    EXPECT_EQ(light.toLight, glm::vec3(0.0f, 1.0f, 0.0f));
    EXPECT_NEAR(light.irradiance.y, 1.5f * std::numbers::pi_v<float>, 1e-4f);
    EXPECT_EQ(directionality(even), 0.0f);
}

// One direction is all of it; two alike opposite each other are none, at right angles sqrt(1/2).
TEST(DominantLight, DirectionalityIsTheLengthOfTheMeanDirection) {
    const Coefficients one = directional({0.6f, 0.0f, -0.8f}, {2.0f, 1.0f, 3.0f});
    EXPECT_NEAR(directionality(one), 1.0f, 1e-5f);
    const auto both = [&](const glm::vec3& other) {
        Coefficients sum = one;
        const Coefficients more = directional(other, {2.0f, 1.0f, 3.0f});
        for (std::size_t i = 0; i < 9; ++i)
            sum[i] += more[i];
        return directionality(sum);
    };
    EXPECT_NEAR(both({-0.6f, 0.0f, 0.8f}), 0.0f, 1e-5f);
    EXPECT_NEAR(both({0.8f, 0.0f, 0.6f}), std::sqrt(0.5f), 1e-5f);
    EXPECT_EQ(directionality(Coefficients{}), 0.0f);
}

TEST(DominantLight, BrighterLightWinsAndNothingIsNegative) {
    Coefficients both = directional({1, 0, 0}, {5.0f, 0.0f, 0.0f}); // L = 1.06
    const Coefficients green = directional({-1, 0, 0}, {0.0f, 5.0f, 0.0f});
    for (std::size_t i = 0; i < 9; ++i)
        both[i] += green[i];
    const DominantLight light = dominantLight(both);
    EXPECT_LT(glm::length(light.toLight - glm::vec3(-1, 0, 0)), 1e-5f);
    EXPECT_GT(light.irradiance.g, 4.9f);
    EXPECT_GE(light.irradiance.r, 0.0f);
    const DominantLight none = dominantLight(Coefficients{});
    EXPECT_EQ(none.irradiance, glm::vec3(0.0f));
    EXPECT_EQ(none.toLight, glm::vec3(0.0f, 1.0f, 0.0f));
}

} // namespace
} // namespace patina
