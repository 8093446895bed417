#include "core/document/Placement.h"

#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>
#include <random>

namespace patina {
namespace {

constexpr glm::mat4 kOne(1.0f);

float difference(const glm::mat4& a, const glm::mat4& b) {
    float most = 0.0f;
    for (int i = 0; i < 16; ++i)
        most = std::max(most, std::abs(a[i / 4][i % 4] - b[i / 4][i % 4]));
    return most;
}

glm::mat4 trs(const glm::vec3& position, const glm::vec3& degrees, const glm::vec3& scale) {
    glm::mat4 m = glm::translate(kOne, position);
    m = glm::rotate(m, glm::radians(degrees.z), {0, 0, 1});
    m = glm::rotate(m, glm::radians(degrees.y), {0, 1, 0});
    m = glm::rotate(m, glm::radians(degrees.x), {1, 0, 0});
    return glm::scale(m, scale);
}

TEST(PlacementTest, SaysWhatTheMatrixOfAFileDoes) {
    const Placement placement = trs({1, 2, 3}, {20, -35, 110}, {0.5f, 2, 3});
    EXPECT_EQ(placement.position(), glm::vec3(1, 2, 3));
    EXPECT_LT(glm::distance(placement.rotationDeg(), {20, -35, 110}), 2e-4f);
    EXPECT_LT(glm::distance(placement.scale(), {0.5f, 2, 3}), 1e-5f);
    EXPECT_TRUE(placement.isAsRead());
}

TEST(PlacementTest, UntouchedItIsTheMatrixToTheBit) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> number(-3.0f, 3.0f);
    for (int i = 0; i < 200; ++i) {
        glm::mat4 m(1.0f);
        for (int k = 0; k < 12; ++k)
            m[k / 3][k % 3] = number(random); // sheared and mirrored ones among them
        Placement placement = m;
        EXPECT_EQ(placement.matrix(), m);
        const glm::vec3 position = placement.position(), angles = placement.rotationDeg();
        const glm::vec3 scale = placement.scale();
        placement.setPosition({9, 9, 9});
        placement.setRotationDeg({10, 20, 30});
        placement.setScale({2, 3, 4});
        EXPECT_NE(placement.matrix(), m);
        placement.setScale(scale);
        placement.setRotationDeg(angles);
        placement.setPosition(position);
        EXPECT_EQ(placement.matrix(), m) << "back again";
        EXPECT_EQ(placement, Placement(m));
    }
}

TEST(PlacementTest, MovesRotatesAndScalesWhatIsThere) {
    // Mirrored and sheared: what position, rotation and scale cannot say is kept.
    const glm::mat4 file(glm::vec4(-1, 0.3f, 0, 0), glm::vec4(0, 1, 0.2f, 0), glm::vec4(0, 0, 2, 0),
                         glm::vec4(0, 1, 0, 1));
    Placement placement = file;
    placement.setPosition({5, 0, 0});
    EXPECT_EQ(placement.matrix()[3], glm::vec4(5, 0, 0, 1));
    EXPECT_EQ(glm::mat3(placement.matrix()), glm::mat3(file));
    placement.setPosition({0, 1, 0});
    // About a point of the world, which stays: M' = T R T⁻¹ M.
    const glm::vec3 pivot(0.3f, -0.4f, 2);
    const glm::mat4 turn = glm::rotate(kOne, 0.7f, glm::normalize(glm::vec3(1, 2, 3)));
    Placement turned = placement;
    turned.rotateAbout(pivot, glm::mat3(turn));
    const glm::mat4 expected =
        glm::translate(kOne, pivot) * turn * glm::translate(kOne, -pivot) * file;
    EXPECT_LT(difference(turned.matrix(), expected), 1e-5f);
    EXPECT_LT(glm::determinant(glm::mat3(turned.matrix())), 0.0f) << "the mirror is kept";
    // Alike along all axes: M' = T S T⁻¹ M.
    Placement larger = turned;
    larger.scaleAbout(pivot, glm::vec3(1.5f));
    const glm::mat4 scaled = glm::translate(kOne, pivot) * glm::scale(kOne, glm::vec3(1.5f)) *
                             glm::translate(kOne, -pivot) * turned.matrix();
    EXPECT_LT(difference(larger.matrix(), scaled), 1e-5f);
}

TEST(PlacementTest, ScalesAlongTheAxesOfTheMesh) {
    Placement placement = trs({1, 0, 0}, {0, 90, 0}, {1, 1, 1});
    placement.setScale({2, 1, 1}); // its X looks along -Z
    EXPECT_LT(glm::distance(glm::vec3(placement.matrix()[0]), {0, 0, -2}), 1e-5f);
    EXPECT_LT(glm::distance(placement.axes()[0], {0, 0, -1}), 1e-5f);
    // The pivot stays where it is.
    const glm::vec3 pivot(1, 0.5f, -3);
    const glm::vec4 local = glm::inverse(placement.matrix()) * glm::vec4(pivot, 1);
    placement.scaleAbout(pivot, {3, 0.5f, 1});
    EXPECT_LT(glm::distance(glm::vec3(placement.matrix() * local), pivot), 1e-4f);
}

TEST(PlacementTest, AnglesSayTheRotationEvenWhereTwoOfThemAgree) {
    for (const float y : {90.0f, -90.0f, 89.999f, 45.0f})
        for (const float x : {-170.0f, -30.0f, 0.0f, 75.0f})
            for (const float z : {-120.0f, 0.0f, 15.0f}) {
                const glm::mat4 m = trs({}, {x, y, z}, glm::vec3(1));
                Placement placement = m;
                // Composed anew from its angles, not as read.
                placement.setPosition({1, 0, 0});
                placement.setScale(glm::vec3(1.5f));
                placement.setPosition({});
                EXPECT_LT(difference(placement.matrix(), glm::scale(m, glm::vec3(1.5f))), 2e-5f)
                    << x << " " << y << " " << z;
                EXPECT_LT(difference(trs({}, placement.rotationDeg(), glm::vec3(1)), m), 2e-5f);
            }
}

TEST(PlacementTest, FlatMatricesHaveAPlaceToo) {
    Placement placement = glm::scale(kOne, glm::vec3(1, 0, 1));
    EXPECT_EQ(placement.scale(), glm::vec3(1));
    placement.setPosition({0, 3, 0});
    placement.setRotationDeg({0, 30, 0});
    EXPECT_TRUE(std::isfinite(placement.matrix()[0][0]));
    EXPECT_EQ(placement.matrix()[1], glm::vec4(0)) << "it stays flat";
}

TEST(PlacementTest, StaysWithinItsRanges) {
    Placement placement;
    placement.setPosition({1e20f, -1e20f, 0});
    placement.setScale({0, -1, 1e20f});
    EXPECT_EQ(placement.position(), glm::vec3(kMaxPosition, -kMaxPosition, 0));
    EXPECT_EQ(placement.scale(), glm::vec3(kMinScale, kMinScale, kMaxScale));
}

} // namespace
} // namespace patina
