// Cubemaps: orientation, solid angles and the energy of what is resampled into them.
#include "core/light/Cubemap.h"

#include "core/math/Sampling.h"
#include "tests/core/light/LatLongPicture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace patina {
namespace {

constexpr double kFourPi = 4.0 * M_PI;

glm::dvec3 integral(const CubeLevel& level) {
    const std::vector<float> omega = cubeSolidAngles(level.size);
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < level.texels.size(); ++i)
        sum += glm::dvec3(level.texels[i]) * static_cast<double>(omega[i % omega.size()]);
    return sum;
}

TEST(Cube, FacesFollowOpenGl) {
    // Directions at (s, t) = (0.75, 0.5): OpenGL 4.6, table 8.19, inverted.
    const float a = 0.894427191f, b = 0.4472135955f;
    const glm::vec3 expected[6] = {{a, 0, -b}, {-a, 0, b}, {b, a, 0},
                                   {b, -a, 0}, {b, 0, a},  {-b, 0, -a}};
    for (int face = 0; face < 6; ++face)
        EXPECT_LT(glm::length(glm::normalize(cubeDirection(face, 0.75f, 0.5f)) - expected[face]),
                  1e-6f)
            << face;
    // The first row of the sides is up.
    for (const int face : {0, 1, 4, 5})
        EXPECT_GT(cubeDirection(face, 0.5f, 0.1f).y, 0.0f);
    const CubePosition p = cubePosition({0.26726124f, 0.53452248f, 0.80178373f});
    EXPECT_EQ(p.face, 4);
    EXPECT_NEAR(p.s, 2.0f / 3.0f, 1e-6f);
    EXPECT_NEAR(p.t, 1.0f / 6.0f, 1e-6f);

    for (std::uint32_t i = 0; i < 5000; ++i) {
        const glm::vec3 d = uniformSphere(sobolOwen2D(i, 8));
        const CubePosition at = cubePosition(d);
        ASSERT_LT(glm::length(glm::normalize(cubeDirection(at.face, at.s, at.t)) - d), 2e-6f);
    }
}

TEST(Cube, SolidAnglesAreExact) {
    const struct {
        int size;
        double corner, centre;
    } cases[] = {{1, 2.09439510239, 2.09439510239},
                 {2, 0.523598775598, 0.523598775598},
                 {8, 0.0155686078666, 0.0588575059471},
                 {64, 0.000193931510235, 0.000975609910864}};
    for (const auto& c : cases) {
        const std::vector<float> omega = cubeSolidAngles(c.size);
        EXPECT_NEAR(omega[0] / c.corner, 1.0, 1e-6);
        const int middle = c.size / 2;
        EXPECT_NEAR(omega[static_cast<std::size_t>(middle) * c.size + middle] / c.centre, 1.0,
                    1e-6);
        double sum = 0.0;
        for (const float o : omega)
            sum += o;
        EXPECT_NEAR(6.0 * sum / kFourPi, 1.0, 1e-6);
    }
}

TEST(CubeFromLatLong, PutsEveryDirectionInItsPlace) {
    const Image image =
        test::latLongImage(256, 128, [](glm::vec3 d) { return d + glm::vec3(2.0f); });
    for (const int size : {16, 64}) {
        const CubeLevel cube = cubeFromLatLong(image, size, {});
        ASSERT_EQ(cube.texels.size(), 6u * size * size);
        for (int face = 0; face < 6; ++face)
            for (int y = 0; y < size; ++y)
                for (int x = 0; x < size; ++x) {
                    const glm::vec3 d =
                        glm::normalize(cubeDirection(face, (x + 0.5f) / static_cast<float>(size),
                                                     (y + 0.5f) / static_cast<float>(size)));
                    const glm::vec3 texel = cube.texels[(face * size + y) * size + x];
                    ASSERT_LT(glm::length(texel - d - glm::vec3(2.0f)), 0.012f)
                        << face << " " << x << " " << y;
                }
    }
}

TEST(CubeFromLatLong, KeepsTheEnergyOfSmoothLight) {
    // ∫ 1 = 4pi, ∫ max(0, z) = pi, ∫ (1 + z)² = 16pi / 3.
    const Image image = test::latLongImage(512, 256, [](glm::vec3 d) {
        return glm::vec3(1.0f, std::max(d.z, 0.0f), (1.0f + d.z) * (1.0f + d.z));
    });
    const glm::dvec3 sum = integral(cubeFromLatLong(image, 64, {}));
    EXPECT_NEAR(sum.x / kFourPi, 1.0, 1e-6);
    EXPECT_NEAR(sum.y / M_PI, 1.0, 2e-4);
    EXPECT_NEAR(sum.z / (16.0 * M_PI / 3.0), 1.0, 2e-4);
}

TEST(CubeFromLatLong, KeepsTheEnergyOfASunAnywhere) {
    // One texel of radiance 1e5 holds 1e5 (2pi / W)(cos theta_j - cos theta_j+1), also at the pole,
    // across faces, and when the image is much finer or coarser than the cube.
    for (const int width : {128, 1024})
        for (const int size : {16, 64})
            for (const int row : {0, width / 64, width / 8, width / 4, width / 2 - 1})
                for (const int column : {0, width / 8, 3 * width / 10}) {
                    const int height = width / 2;
                    Image image(width, height, 3, PixelType::F32, ColorEncoding::Linear);
                    image.f32()[(static_cast<std::size_t>(row) * width + column) * 3] = 1e5f;
                    const double omega =
                        2.0 * M_PI / width *
                        (std::cos(M_PI * row / height) - std::cos(M_PI * (row + 1) / height));
                    const glm::dvec3 sum = integral(cubeFromLatLong(image, size, {}));
                    EXPECT_NEAR(sum.x / (1e5 * omega), 1.0, 1e-3)
                        << width << " " << size << " " << row << " " << column;
                    EXPECT_EQ(sum.y, 0.0);
                }
}

TEST(HalveCube, KeepsTheIntegral) {
    CubeLevel level;
    level.size = 32;
    for (std::uint32_t i = 0; i < 6u * 32 * 32; ++i)
        level.texels.push_back(glm::vec3(static_cast<float>(hash32(i) % 1000), 1.0f, 0.0f));
    const glm::dvec3 before = integral(level);
    while (level.size > 1) {
        level = halveCube(level);
        const glm::dvec3 after = integral(level);
        EXPECT_NEAR(after.x / before.x, 1.0, 1e-5) << level.size;
        for (const glm::vec3& texel : level.texels)
            ASSERT_NEAR(texel.y, 1.0f, 1e-6f);
    }
}

} // namespace
} // namespace patina
