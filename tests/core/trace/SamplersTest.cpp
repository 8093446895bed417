// Directions that rays are sent in: as dense as they say they are.
#include "core/trace/path/EnvironmentSampler.h"
#include "core/trace/path/LightSampler.h"

#include "core/math/Sampling.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace patina {
namespace {

constexpr int kSamples = 250'000;
constexpr float kEndless = std::numeric_limits<float>::infinity();

// Cells of equal solid angle.
constexpr int kColumns = 32, kRows = 16;
int cellOf(const glm::vec3& d) {
    const float u = 0.5f + std::atan2(d.x, d.z) / (2.0f * shading::kPi);
    const int x = std::min(static_cast<int>(u * kColumns), kColumns - 1);
    const int y = std::min(static_cast<int>((0.5f - 0.5f * d.y) * kRows), kRows - 1);
    return y * kColumns + x;
}

// The statistic of Pearson 1900, cells of fewer than 5 put together; returns how far it is beyond
// what it is by chance, in standard deviations (Wilson & Hilferty 1931).
double chiSquareExcess(const std::vector<double>& expected, const std::vector<double>& found) {
    double chi2 = 0.0, restExpected = 0.0, restFound = 0.0;
    int cells = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        if (expected[i] < 5.0) {
            restExpected += expected[i];
            restFound += found[i];
            continue;
        }
        chi2 += (found[i] - expected[i]) * (found[i] - expected[i]) / expected[i];
        ++cells;
    }
    if (restExpected >= 5.0) {
        chi2 += (restFound - restExpected) * (restFound - restExpected) / restExpected;
        ++cells;
    } else {
        EXPECT_LT(restFound, 5.0 + 5.0 * std::sqrt(restExpected + 1.0));
    }
    EXPECT_GT(cells, 1);
    const double k = cells - 1;
    return (std::cbrt(chi2 / k) - (1.0 - 2.0 / (9.0 * k))) / std::sqrt(2.0 / (9.0 * k));
}

// alpha = .01 by Šidák for the tests of this file: 1 - .99^(1/12) one-sided is 3.14 deviations.
constexpr double kLimit = 3.14;

// `sample(u)`: direction, or nothing where the density is zero; `density(direction)`.
template <class Sample, class Density>
void expectDensity(Sample sample, Density density, std::uint32_t seed) {
    std::vector<double> expected(kColumns * kRows), found(kColumns * kRows);
    // Independent numbers: the statistic is that of independent samples.
    std::uint32_t state = seed;
    const auto next = [&] {
        state = state * 747796405u + 2891336453u;
        return detail::unitFloat(hash32(state));
    };
    for (int i = 0; i < kSamples; ++i) {
        const float x = next(), y = next();
        found[static_cast<std::size_t>(cellOf(sample(glm::vec2(x, y))))] += 1.0;
    }
    constexpr int kFine = 64; // a side, of a cell
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < kColumns; ++column) {
            double sum = 0.0;
            for (int i = 0; i < kFine; ++i)
                for (int j = 0; j < kFine; ++j) {
                    const double y = 1.0 - 2.0 * (row + (i + 0.5) / kFine) / kRows;
                    const double phi =
                        2.0 * std::acos(-1.0) * ((column + (j + 0.5) / kFine) / kColumns - 0.5);
                    const double side = std::sqrt(1.0 - y * y);
                    sum += static_cast<double>(density(
                        glm::vec3(glm::dvec3(side * std::sin(phi), y, side * std::cos(phi)))));
                }
            expected[static_cast<std::size_t>(row * kColumns + column)] =
                sum / (kFine * kFine) * 4.0 * std::acos(-1.0) / (kColumns * kRows) * kSamples;
        }
    double total = 0.0;
    for (const double cell : expected)
        total += cell;
    EXPECT_NEAR(total / kSamples, 1.0, 3e-3) << "the density is that of something";
    for (double& cell : expected) // the quadrature's own error is not the sampler's
        cell *= kSamples / total;
    EXPECT_LT(chiSquareExcess(expected, found), kLimit);
}

} // namespace

TEST(EnvironmentSampler, IsAsDenseAsItSays) {
    Image image(64, 32, 3, PixelType::F32, ColorEncoding::Linear);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x)
            for (int c = 0; c < 3; ++c)
                image.f32()[static_cast<std::size_t>((y * 64 + x) * 3 + c)] =
                    y < 16 ? 0.2f + 0.1f * static_cast<float>((x * 7 + y * 3 + c) % 5)
                           : static_cast<float>(x % 16 == 3 && y == 20);
    const ImagePtr picture = std::make_shared<const Image>(image);
    for (const Orientation& stands : {Orientation(), Orientation(77.0f), {30.0f, 40.0f, -65.0f}}) {
        const EnvironmentSampler sampler({picture, stands, {1.0f, 2.0f, 0.5f}});
        expectDensity([&](const glm::vec2& u) { return sampler.sample(u).direction; },
                      [&](const glm::vec3& d) { return sampler.pdf(d); }, 3);
        // Radiance over density is the mean light from everywhere, whatever is chosen.
        double sum = 0.0;
        for (std::uint32_t i = 0; i < 65536; ++i) {
            const EnvironmentSampler::Sample sample = sampler.sample(sobolOwen2D(i, 5));
            EXPECT_NEAR(sample.pdf, sampler.pdf(sample.direction), 0.02f * sample.pdf);
            EXPECT_LT(glm::distance(sample.radiance, sampler.radiance(sample.direction)),
                      0.02f * glm::length(sample.radiance) + 1e-4f);
            sum += static_cast<double>(shading::luminance(sample.radiance) / sample.pdf) / 65536.0;
        }
        EXPECT_NEAR(sum, sampler.power(), 2e-3 * sampler.power());
    }
}

// A sun of one texel, which the lookup spreads over its neighbours: directions are as likely as it
// is bright, so that each of them tells nearly the whole.
TEST(EnvironmentSampler, ASunOfOneTexelBringsNoNoise) {
    Image image(64, 32, 3, PixelType::F32, ColorEncoding::Linear);
    for (float& value : image.f32())
        value = 0.5f;
    for (std::size_t c = 0; c < 3; ++c)
        image.f32()[(7 * 64 + 20) * 3 + c] = 5e4f;
    const EnvironmentSampler sampler(
        {std::make_shared<const Image>(image), 30.0f, glm::vec3(1.0f)});
    double sum = 0.0, squares = 0.0;
    constexpr int kCount = 4096;
    for (std::uint32_t i = 0; i < kCount; ++i) {
        const EnvironmentSampler::Sample sample = sampler.sample(sobolOwen2D(i, 1));
        const double value =
            static_cast<double>(shading::luminance(sample.radiance) / sample.pdf) / sampler.power();
        sum += value / kCount;
        squares += value * value / kCount;
    }
    EXPECT_NEAR(sum, 1.0, 0.01);
    EXPECT_LT(squares - sum * sum, 0.01) << "even within a texel it would be 1.09";
}

TEST(EnvironmentSampler, TurnsAsTheViewportDoes) {
    // One bright texel, whose direction is turned about +Y, counter-clockwise from above.
    Image image(64, 32, 3, PixelType::F32, ColorEncoding::Linear);
    image.f32()[(16 * 64 + 32) * 3 + 1] = 1.0f; // u = .5 + : towards -Z
    const ImagePtr picture = std::make_shared<const Image>(image);
    const EnvironmentSampler straight({picture, 0.0f, glm::vec3(1.0f)});
    EXPECT_LT(straight.sample({0.5f, 0.5f}).direction.z, -0.99f);
    const EnvironmentSampler turned({picture, 90.0f, glm::vec3(1.0f)});
    EXPECT_LT(turned.sample({0.5f, 0.5f}).direction.x, -0.99f) << "-Z turned by 90° is -X";
    EXPECT_GT(turned.radiance(turned.sample({0.5f, 0.5f}).direction).y, 0.5f);
    const Orientation stands(20.0f, 35.0f, -50.0f);
    const EnvironmentSampler tilted({picture, stands, glm::vec3(1.0f)});
    EXPECT_LT(glm::distance(tilted.sample({0.5f, 0.5f}).direction,
                            stands.toWorld(straight.sample({0.5f, 0.5f}).direction)),
              1e-5f);
}

TEST(EnvironmentSampler, ABlackOneHasNoDirections) {
    const EnvironmentSampler black(
        {std::make_shared<const Image>(8, 4, 3, PixelType::F32, ColorEncoding::Linear), 0.0f,
         glm::vec3(1.0f)});
    EXPECT_EQ(black.sample({0.3f, 0.7f}).pdf, 0.0f);
    EXPECT_EQ(black.pdf({0, 1, 0}), 0.0f);
}

TEST(LightSampler, IsAsDenseAsItSays) {
    for (const LightType type : {LightType::Sphere, LightType::Rectangle, LightType::Directional})
        for (const float near : {0.0f, 1.0f}) {
            Light light;
            light.type = type;
            light.position = glm::vec3(0.3f, 1.0f, 0.4f) * (near > 0.0f ? 0.6f : 1.5f);
            light.radius = 0.9f; // the near one holds the point
            light.azimuthDeg = 37.0f;
            light.elevationDeg = 68.0f;
            light.rollDeg = 20.0f;
            light.width = 2.0f;
            light.height = 1.2f;
            light.shadowSoftness = near > 0.0f ? 60.0f : 25.0f;
            const LightSampler sampler(std::span(&light, 1));
            expectDensity(
                [&](const glm::vec2& u) { return sampler.sample(0, glm::vec3(0), u).direction; },
                [&](const glm::vec3& d) {
                    return sampler.along(0, glm::vec3(0.0f), d, kEndless).pdf;
                },
                static_cast<std::uint32_t>(type) + 11);
            for (std::uint32_t i = 0; i < 1000; ++i) {
                const LightSample sent = sampler.sample(0, glm::vec3(0), sobolOwen2D(i, 9));
                const LightSample met = sampler.along(0, glm::vec3(0.0f), sent.direction, kEndless);
                if (met.pdf == 0.0f)
                    continue; // its rim
                EXPECT_NEAR(met.pdf, sent.pdf, 1e-3f * sent.pdf);
                EXPECT_EQ(met.light, sent.light);
                if (!std::isinf(sent.distance)) {
                    EXPECT_NEAR(met.distance, sent.distance, 2e-3f * sent.distance);
                    EXPECT_EQ(
                        sampler.along(0, glm::vec3(0.0f), sent.direction, 0.5f * sent.distance).pdf,
                        0.0f)
                        << "behind a surface";
                }
            }
        }
}

TEST(LightSampler, ChoosesByWhatArrives) {
    std::vector<Light> lights(3);
    lights[0].type = LightType::Point;
    lights[0].position = {0, 1, 0};
    lights[0].intensity = 1.0f;
    lights[1] = lights[0];
    lights[1].position = {0, 2, 0};
    lights[2].type = LightType::Rectangle;
    lights[2].elevationDeg = -90.0f; // it shines upwards
    lights[2].position = {0, 3, 0};
    const LightSampler sampler(lights);
    std::vector<float> choices;
    sampler.choices(glm::vec3(0.0f), choices);
    EXPECT_FLOAT_EQ(choices[0], 0.8f);
    EXPECT_FLOAT_EQ(choices[1], 0.2f);
    EXPECT_EQ(choices[2], 0.0f);
}

} // namespace patina
