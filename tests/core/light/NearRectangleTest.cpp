// A rectangle's harmonics in single precision, as the GPU has them, against the closed form in
// double precision; and where it degenerates.
#include "core/light/NearRectangle.h"

#include "core/math/PolygonHarmonics.h"
#include "core/math/Shading.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <random>
#include <utility>
#include <vector>

namespace patina {
namespace {

constexpr std::array<float, 8> kOpen{1, 1, 1, 1, 1, 1, 1, 1};

std::vector<double> polygon(const NearRectangle& r, const glm::vec3& place, int order) {
    const glm::dvec3 center(glm::dvec3(r.center) - glm::dvec3(place));
    const glm::dvec3 x = double(r.halfX) * glm::dvec3(r.x), y = double(r.halfY) * glm::dvec3(r.y);
    // Clockwise as seen from the side that emits.
    const std::array<glm::dvec3, 4> corners{center - x - y, center + x - y, center + x + y,
                                            center - x + y};
    std::vector<double> out(static_cast<std::size_t>(shCount(order)));
    projectPolygon(corners, out);
    return out;
}

// Without the scale that makes up for the bands left out.
std::vector<double> project(const NearRectangle& r, const glm::vec3& place, int order) {
    std::array<float, 64> out{};
    projectRectangle(r, place, order, kOpen, out);
    std::array<float, 8> factor{};
    const auto solidAngle = static_cast<float>(polygon(r, place, 1)[0] * 3.5449077018110322);
    shading::rectangleFactors(std::max(solidAngle, 0.0f), order, kOpen.data(), factor.data());
    std::vector<double> result(static_cast<std::size_t>(shCount(order)));
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = static_cast<double>(out[i]) / static_cast<double>(factor[0]);
    return result;
}

// The parameters of a light allow sides of 0, and floats less than their squares can hold.
TEST(NearRectangle, WithoutAnAreaLightsNothing) {
    for (const float side : {0.0f, 1e-30f, 1e-42f})
        for (const auto& [x, y] : {std::pair(side, 1.0f), {1.0f, side}, {side, side}}) {
            const NearRectangle r = nearRectangle({0.0f, 1.0f, 0.0f}, {x, 0.0f, 0.0f}, {0, 0, y});
            EXPECT_NEAR(glm::length(r.normal), 1.0f, 1e-5f);
            EXPECT_NEAR(glm::dot(r.x, r.y), 0.0f, 1e-5f);
            for (const glm::vec3& place :
                 {glm::vec3(0.0f), glm::vec3(0.0f, 1.0f, 0.0f), glm::vec3(3.0f, -2.0f, 0.5f)}) {
                std::array<float, 64> out{};
                projectRectangle(r, place, 8, kOpen, out);
                if (place == r.center)
                    continue; // which is on it, and sees half of everything
                for (const float value : out)
                    EXPECT_NEAR(value, 0.0f, 1e-6f) << x << " x " << y;
            }
        }
}

TEST(NearRectangle, AgreesWithThePolygonInAllBands) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
    const auto vector = [&] {
        return glm::vec3(uniform(random), uniform(random), uniform(random));
    };
    int lit = 0;
    for (int i = 0; i < 400; ++i) {
        SCOPED_TRACE(i);
        const float size = std::pow(10.0f, 1.7f * uniform(random) - 1.0f);
        const glm::vec3 x = size * glm::normalize(vector());
        const glm::vec3 y = 0.6f * size * glm::normalize(glm::cross(x, vector()));
        const NearRectangle r = nearRectangle(3.0f * vector(), x, y);
        const glm::vec3 place = 0.1f * vector();
        for (const int order : {1, 2, 3, 5, 8}) {
            const std::vector<double> expected = polygon(r, place, order);
            const std::vector<double> actual = project(r, place, order);
            if (expected[0] < 0.0) {
                EXPECT_LT(std::abs(actual[0]), 1e-5);
                continue;
            }
            ++lit;
            for (std::size_t k = 0; k < expected.size(); ++k)
                EXPECT_NEAR(actual[k], expected[k], 2e-6 + 1e-4 * expected[0]) << order << ' ' << k;
        }
    }
    EXPECT_GT(lit, 700);
}

// A hand's breadth above a large one, at its very edge, and along it: where edges fill half of all
// directions or point at us.
TEST(NearRectangle, IsTrueNextToItsEdges) {
    const NearRectangle r = nearRectangle({0, 0, 1}, {1, 0, 0}, {0, 0.5f, 0});
    for (const glm::vec3& place :
         {glm::vec3(0, 0, 0.99f), glm::vec3(1, 0, 0), glm::vec3(0.999f, 0.2f, 0.99f),
          glm::vec3(1, 0.5f, 0.9f), glm::vec3(3, 0.5f, 0.9f), glm::vec3(1, 0.5f, 0.999f)}) {
        const std::vector<double> expected = polygon(r, place, 8);
        const std::vector<double> actual = project(r, place, 8);
        EXPECT_GT(expected[0], 1e-4);
        for (std::size_t k = 0; k < expected.size(); ++k)
            EXPECT_NEAR(actual[k], expected[k], 1e-5 + 1e-5 * expected[0]) << place.x << ' ' << k;
    }
}

// On both sides of the size under which its middle stands for the whole.
TEST(NearRectangle, BecomesAPointOfLight) {
    for (const float half : {0.0034f, 0.0037f, 1e-3f, 1e-4f}) {
        const NearRectangle r = nearRectangle({0.6f, 0, 0.8f}, {half, 0, 0}, {0, half, 0});
        const std::vector<double> expected = polygon(r, {}, 8);
        const std::vector<double> actual = project(r, {}, 8);
        for (std::size_t k = 0; k < expected.size(); ++k)
            EXPECT_NEAR(actual[k], expected[k], 1e-3 * expected[0]) << half << ' ' << k;
    }
}

TEST(NearRectangle, IsDarkFromBehindAndFromItsPlane) {
    const NearRectangle r = nearRectangle({}, {1, 0, 0}, {0, 1, 0});
    for (const glm::vec3& place :
         {glm::vec3(0, 0, 2), glm::vec3(3, 0, 0), glm::vec3(-1, -1, 0), glm::vec3(0, 0, 0)}) {
        std::array<float, 64> out{};
        out.fill(7.0f);
        projectRectangle(r, place, 5, kOpen, out);
        for (std::size_t i = 0; i < 25; ++i)
            EXPECT_EQ(out[i], 0.0f) << i;
        EXPECT_EQ(out[25], 7.0f) << "not asked for";
    }
}

// Bands above 0 vanish in the sum of a box' faces.
TEST(NearRectangle, FacesOfABoxAddUpToTheSphere) {
    std::array<double, 64> sum{};
    const glm::vec3 x(0.5f, 0, 0), y(0, 0.75f, 0), z(0, 0, 1), place(0.2f, -0.3f, 0.4f);
    for (const auto& [out, u, v] :
         {std::tuple(z, x, y), std::tuple(x, y, z), std::tuple(y, z, x), std::tuple(-z, y, x),
          std::tuple(-x, z, y), std::tuple(-y, x, z)}) {
        const auto face = project(nearRectangle(out, u, v), place, 8);
        for (std::size_t i = 0; i < sum.size(); ++i)
            sum[i] += face[i];
    }
    EXPECT_NEAR(sum[0], 3.5449077018110322, 2e-5); // sqrt(4pi)
    for (std::size_t i = 1; i < sum.size(); ++i)
        EXPECT_NEAR(sum[i], 0.0, 5e-6) << i;
}

} // namespace
} // namespace patina
