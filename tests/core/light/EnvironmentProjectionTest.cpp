#include "core/light/EnvironmentProjection.h"

#include "core/math/SphericalHarmonics.h"
#include "tests/support/KnownRadiance.h"

#include <gtest/gtest.h>

using namespace patina;

// 2 + d has two bands: c_00 = 2 sqrt(4 pi), and sqrt(4 pi / 3) of each component, with the signs of
// Y_1m = sqrt(3 / 4 pi) (-y, z, -x).
TEST(EnvironmentProjection, EveryMethodFindsTheSameCoefficients) {
    const Image image = test::latLongImage(test::linearRadiance);
    const float zero = 2.0f * 3.5449077f, one = 2.0466534f;
    const glm::vec3 expected[] = {{zero, zero, zero}, {0, -one, 0}, {0, 0, one}, {-one, 0, 0}};
    for (const auto& [method, samples, tolerance] :
         {std::tuple(ShMethod::Exact, 1, 0.001f), std::tuple(ShMethod::Qmc, 1 << 14, 0.01f),
          std::tuple(ShMethod::Stratified, 200 * 200, 0.02f)}) {
        const std::vector<glm::vec3> found = projectEnvironment(image, 3, method, samples);
        ASSERT_EQ(found.size(), 9u);
        for (std::size_t i = 0; i < 9; ++i)
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(found[i][c], i < 4 ? expected[i][c] : 0.0f, tolerance)
                    << int(method) << " coefficient " << i << " channel " << c;
    }
    EXPECT_NE(projectEnvironment(image, 3, ShMethod::Qmc, 64),
              projectEnvironment(image, 3, ShMethod::Stratified, 64));
}

TEST(EnvironmentProjection, StratifiedSamplesAreSquares) {
    EXPECT_EQ(environmentSamples(ShMethod::Stratified, 40000), 40000);
    EXPECT_EQ(environmentSamples(ShMethod::Stratified, 39602), 40000);
    EXPECT_EQ(environmentSamples(ShMethod::Stratified, 1), 1);
    EXPECT_EQ(environmentSamples(ShMethod::Qmc, 39602), 39602);
}
