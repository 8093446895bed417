#include "core/light/CubeSampling.h"
#include "core/light/Cubemap.h"
#include "core/light/OrientedEnvironment.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <numbers>

using namespace patina;

namespace {

CubeLevel cubeOf(int size, glm::vec3 (*value)(const glm::vec3& unit)) {
    CubeLevel level;
    level.size = size;
    for (int face = 0; face < 6; ++face)
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x)
                level.texels.push_back(value(glm::normalize(
                    cubeDirection(face, (static_cast<float>(x) + 0.5f) / static_cast<float>(size),
                                  (static_cast<float>(y) + 0.5f) / static_cast<float>(size)))));
    return level;
}

} // namespace

TEST(CubeSampling, ReturnsTexelsAtTheirCentres) {
    const CubeLevel level = cubeOf(4, [](const glm::vec3& d) { return d; });
    for (int face = 0; face < 6; ++face)
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 4; ++x) {
                const glm::vec3 d = cubeDirection(face, (static_cast<float>(x) + 0.5f) / 4.0f,
                                                  (static_cast<float>(y) + 0.5f) / 4.0f);
                const glm::vec3 at = sampleCube(level, d);
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(at[c], glm::normalize(d)[c], 1e-5f) << face << ' ' << x << ' ' << y;
            }
}

// Two points a hair apart on both sides of an edge: the same value, wherever the edge is.
TEST(CubeSampling, HasNoSeams) {
    const CubeLevel level = cubeOf(8, [](const glm::vec3& d) {
        return glm::vec3(1.0f + d.x * d.y, std::sin(5.0f * d.z), d.y + 0.5f * d.x);
    });
    int edges = 0;
    for (const glm::vec3& edge :
         {glm::vec3(1, 1, 0), glm::vec3(1, -1, 0), glm::vec3(-1, 1, 0), glm::vec3(-1, -1, 0),
          glm::vec3(1, 0, 1), glm::vec3(1, 0, -1), glm::vec3(-1, 0, 1), glm::vec3(-1, 0, -1),
          glm::vec3(0, 1, 1), glm::vec3(0, 1, -1), glm::vec3(0, -1, 1), glm::vec3(0, -1, -1)})
        for (const float along : {-0.8f, -0.3f, 0.0f, 0.4f, 0.85f}) {
            const glm::vec3 free(edge.x == 0.0f, edge.y == 0.0f, edge.z == 0.0f);
            const glm::vec3 at = edge + along * free;
            // Towards one face and towards the other: scale one of the edge's two components.
            const glm::vec3 first(edge.x != 0.0f, edge.x == 0.0f, 0.0f);
            const CubePosition a = cubePosition(at + 1e-4f * edge * first);
            const CubePosition b = cubePosition(at - 1e-4f * edge * first);
            EXPECT_NE(a.face, b.face);
            const glm::vec3 difference = sampleCube(level, at + 1e-4f * edge * first) -
                                         sampleCube(level, at - 1e-4f * edge * first);
            // Bilinear on both sides; half a texel in, the neighbour's centre is a little off.
            EXPECT_LT(std::abs(difference.x) + std::abs(difference.y) + std::abs(difference.z),
                      0.08f)
                << edge.x << ' ' << edge.y << ' ' << edge.z << " at " << along;
            ++edges;
        }
    EXPECT_EQ(edges, 60);
}

TEST(CubeSampling, UnrollsTheWayEnvironmentsAreRead) {
    const CubeLevel level = cubeOf(32, [](const glm::vec3& d) { return 2.0f + d; });
    const Image image = latLongFromCube(level, JobContext());
    ASSERT_EQ(image.width(), 128);
    ASSERT_EQ(image.height(), 64);
    const CubeLevel back = cubeFromLatLong(image, 32, JobContext());
    float worst = 0.0f;
    for (std::size_t i = 0; i < level.texels.size(); ++i)
        for (int c = 0; c < 3; ++c)
            worst = std::max(worst, std::abs(back.texels[i][c] - level.texels[i][c]));
    EXPECT_LT(worst, 0.004f);
}

TEST(OrientedEnvironment, TurnsCounterClockwiseFromAbove) {
    // One bright pixel; the middle is -Z. A quarter turn brings -Z to -X, a quarter to the left.
    Image image(8, 2, 3, PixelType::F32, ColorEncoding::Linear);
    image.f32()[3 * 4 + 1] = 5.0f;
    const Image turned = orientEnvironment(image, 90.0f, 0.0f);
    for (int x = 0; x < 8; ++x)
        EXPECT_EQ(turned.sample(x, 0, 1), x == 2 ? 5.0f : 0.0f) << x;
    const Image back = orientEnvironment(turned, -90.0f, 0.0f);
    EXPECT_EQ(back, image);
    EXPECT_EQ(orientEnvironment(image, 360.0f, 0.0f), image);
    // The rotation environments are looked up with: texture direction = R(-angle) · direction.
    const Image third = orientEnvironment(image, -135.0f, 0.0f);
    EXPECT_EQ(third.sample(7, 0, 1), 5.0f);
}

TEST(OrientedEnvironment, KeepsTheFluxOfARowBetweenPixels) {
    Image image(8, 1, 3, PixelType::F32, ColorEncoding::Linear);
    for (std::size_t i = 0; i < image.f32().size(); ++i)
        image.f32()[i] = static_cast<float>(i * i % 7);
    const Image turned = orientEnvironment(image, 17.0f, 1.0f);
    for (int c = 0; c < 3; ++c) {
        double before = 0.0, after = 0.0;
        for (int x = 0; x < 8; ++x) {
            before += image.sample(x, 0, c);
            after += turned.sample(x, 0, c);
        }
        EXPECT_NEAR(after, 2.0 * before, 1e-5 * before);
    }
}

TEST(OrientedEnvironment, StaysFinite) {
    Image image(2, 1, 3, PixelType::F32, ColorEncoding::Linear);
    image.f32()[0] = 1e38f;
    EXPECT_TRUE(std::isfinite(orientEnvironment(image, 0.0f, 24.0f).f32()[0]));
}
