#include "core/export/NodeTransform.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>
#include <limits>
#include <random>

using namespace patina;

namespace {

glm::dmat4 product(const std::vector<NodeTransform>& chain) {
    glm::dmat4 result(1.0);
    for (const NodeTransform& t : chain)
        result = result * t.matrix();
    return result;
}

double distance(const glm::dmat4& a, const glm::dmat4& b) {
    double most = 0;
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            most = std::max(most, std::abs(a[column][row] - b[column][row]));
    return most;
}

} // namespace

TEST(NodeTransform, OrdinaryPlacementsAreOneNode) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> any(-3.0f, 3.0f);
    for (int i = 0; i < 500; ++i) {
        const glm::vec3 axis = glm::normalize(glm::vec3(any(random), any(random), any(random)));
        glm::vec3 scale(any(random), any(random), any(random));
        scale += glm::sign(scale) * 0.1f;
        glm::mat4 matrix(1.0f);
        matrix = glm::translate(matrix, {any(random), any(random), any(random)});
        matrix = glm::rotate(matrix, any(random), axis);
        matrix = glm::scale(matrix, scale);
        const std::vector<NodeTransform> chain = decomposeMatrix(matrix);
        ASSERT_EQ(chain.size(), 1u) << "seed 7, number " << i;
        EXPECT_LT(distance(product(chain), glm::dmat4(matrix)), 5e-6) << "seed 7, number " << i;
        EXPECT_NEAR(glm::length(chain[0].rotation), 1.0, 1e-12);
    }
}

TEST(NodeTransform, IdentityIsExact) {
    const std::vector<NodeTransform> chain = decomposeMatrix(glm::mat4(1.0f));
    ASSERT_EQ(chain.size(), 1u);
    EXPECT_EQ(chain[0].scale, glm::dvec3(1.0));
    EXPECT_EQ(chain[0].rotation, glm::dquat(1.0, 0.0, 0.0, 0.0));
}

TEST(NodeTransform, ShearedAndMirroredMatricesAreTwoNodes) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> any(-2.0f, 2.0f);
    int mirrored = 0;
    for (int i = 0; i < 500; ++i) {
        glm::mat4 matrix(1.0f);
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 3; ++row)
                matrix[column][row] = any(random);
        if (std::abs(glm::determinant(matrix)) < 0.01f)
            continue;
        mirrored += glm::determinant(matrix) < 0 ? 1 : 0;
        const std::vector<NodeTransform> chain = decomposeMatrix(matrix);
        ASSERT_EQ(chain.size(), 2u) << "seed 11, number " << i;
        EXPECT_LT(distance(product(chain), glm::dmat4(matrix)), 1e-12) << "seed 11, number " << i;
        // A node's scale may mirror, its rotation may not.
        EXPECT_NEAR(glm::determinant(glm::mat3_cast(chain[0].rotation)), 1.0, 1e-9);
        EXPECT_NEAR(glm::determinant(glm::mat3_cast(chain[1].rotation)), 1.0, 1e-9);
    }
    EXPECT_GT(mirrored, 100);
}

TEST(NodeTransform, FlatAndInvalidMatricesAreRefused) {
    EXPECT_TRUE(decomposeMatrix(glm::scale(glm::mat4(1.0f), {1, 0, 1})).empty());
    glm::mat4 flat(1.0f);
    flat[2] = flat[0] + flat[1]; // columns of length, but in one plane
    EXPECT_TRUE(decomposeMatrix(flat).empty());
    glm::mat4 invalid(1.0f);
    invalid[3][0] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(decomposeMatrix(invalid).empty());
    EXPECT_EQ(decomposeMatrix(glm::scale(glm::mat4(1.0f), glm::vec3(1e-6f))).size(), 1u);
}

TEST(NodeTransform, LightsShineAlongTheirDirection) {
    for (const glm::dvec3& direction :
         {glm::dvec3(0, 0, -1), glm::dvec3(0, 0, 1), glm::dvec3(0, -1, 0), glm::dvec3(1, 0, 0),
          glm::normalize(glm::dvec3(1, -2, 3))}) {
        const glm::dvec3 shines = rotationFromMinusZ(direction) * glm::dvec3(0, 0, -1);
        EXPECT_LT(glm::length(shines - direction), 1e-9);
    }
}
