// Ambient occlusion against closed forms. Rays are finite: 4096 scrambled Sobol' points have an RMS
// error near 0.001, so single vertices are asserted to 0.01.
#include "tests/core/bake/BakeTestScene.h"

#include <gtest/gtest.h>
#include <numeric>

using namespace patina;
using namespace patina::test;

namespace {
constexpr int kSamples = 4096;
constexpr float kTolerance = 0.01f;
} // namespace

TEST(AmbientOcclusion, OpenSurfacesAreExactlyOpen) {
    const BakeArtifact plane = aoOf(sceneOf({planeMesh(1.0, 10)}), 256);
    ASSERT_EQ(plane.vertices.size(), 1u);
    for (const float value : plane.vertices[0].values)
        EXPECT_EQ(value, 1.0f);
    // Convex: each vertex sees nothing of its own mesh, also at a corner shared by three faces.
    for (Mesh mesh : {sphereMesh(1.0, 24, 12), sphereMesh(1.0, 200, 100), cubeMesh()})
        for (const float value : aoValues(sceneOf({std::move(mesh)}), 64))
            EXPECT_EQ(value, 1.0f);
}

// AO = h² / (R² + h²) below the centre of a disc.
TEST(AmbientOcclusion, DiscAbove) {
    for (const auto& [radius, height] : {std::pair{1.0, 1.0}, {1.0, 2.0}, {2.0, 1.0}}) {
        const BakeInputs inputs = sceneOf({planeMesh(0.01, 2), discMesh(radius, height)});
        const double expected = height * height / (radius * radius + height * height);
        EXPECT_NEAR(valueAt(aoOf(inputs, kSamples), inputs, 0, {0, 0, 0}), expected, kTolerance);
    }
}

// AO = 1 - r² d / (x² + d²)^1.5 at distance x from the foot of a sphere with its centre at height
// d.
TEST(AmbientOcclusion, SphereAboveAndRestingOnAPlane) {
    for (const double d : {1.5, 1.0}) {
        const BakeInputs inputs = sceneOf({planeMesh(4.0, 32), sphereMesh(1.0, 96, 48, {0, d, 0})});
        const BakeArtifact artifact = aoOf(inputs, 1024);
        for (const double x : {0.0, 0.25, 0.5, 1.0, 2.0, 4.0}) {
            const double expected = 1.0 - d / std::pow(x * x + d * d, 1.5);
            EXPECT_NEAR(valueAt(artifact, inputs, 0, {float(x), 0, 0}), expected, kTolerance)
                << "d " << d << " x " << x;
        }
    }
}

// Any interior point of a sphere sees the open half with form factor 1/2.
TEST(AmbientOcclusion, HemisphericalBowlIsHalfOpenEverywhere) {
    const BakeInputs inputs = sceneOf({bowlMesh(96, 48)});
    const BakeArtifact artifact = aoOf(inputs, 1024);
    const std::vector<float>& values = artifact.vertices.at(0).values;
    double sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        EXPECT_NEAR(values[i], 0.5f, 0.03f) << inputs.meshes[0].mesh->positions[i].y;
        sum += values[i];
    }
    EXPECT_NEAR(sum / double(values.size()), 0.5, 0.005);
}

// The floor at an endless wall is half open, in a corner a quarter; at distance t from a wall of
// height H: (1 + t / sqrt(t² + H²)) / 2. The walls are meshes of their own: the floor's border
// vertices lie exactly in them.
TEST(AmbientOcclusion, FloorVerticesAtWallsStandBeforeTheWall) {
    const auto floor = [] {
        return gridMesh(8, 8, [](double u, double v) { return glm::dvec3(u, 0, 1 - v); });
    };
    const auto wallAtX0 = [](double height, double from) {
        return gridMesh(1, 1, [=](double u, double v) {
            return glm::dvec3(0, height * v, from + (1000 - from) * u);
        });
    };
    const auto wallAtZ0 =
        gridMesh(1, 1, [](double u, double v) { return glm::dvec3(1000 * u, 1000 * v, 0); });
    const BakeInputs one = sceneOf({floor(), wallAtX0(1000, -1000)});
    const BakeArtifact oneWall = aoOf(one, kSamples);
    EXPECT_NEAR(valueAt(oneWall, one, 0, {0, 0, 0.5f}), 0.5f, kTolerance);
    const BakeInputs two = sceneOf({floor(), wallAtX0(1000, 0), wallAtZ0});
    const BakeArtifact corner = aoOf(two, kSamples);
    EXPECT_NEAR(valueAt(corner, two, 0, {0, 0, 0}), 0.25f, kTolerance);
    EXPECT_NEAR(valueAt(corner, two, 0, {0, 0, 0.5f}), 0.25f, kTolerance); // endless: the same
    const BakeInputs low = sceneOf({floor(), wallAtX0(1, -1000)});
    const BakeArtifact lowWall = aoOf(low, kSamples);
    EXPECT_NEAR(valueAt(lowWall, low, 0, {1, 0, 0.5f}), 0.8535534f, kTolerance);
}

// Crossed strings: local AO at distance x from the apex of a V-groove with walls of width 1.
TEST(AmbientOcclusion, VGroove) {
    const std::map<double, std::vector<std::pair<float, float>>> truth = {
        {60.0, {{0.25f, 0.361324950944f}, {0.5f, 0.5f}, {0.75f, 0.638675049056f}}},
        {90.0, {{0.25f, 0.621267812518f}, {0.5f, 0.72360679775f}, {0.75f, 0.8f}}},
        {120.0, {{0.25f, 0.827326835354f}, {0.5f, 0.877964473009f}, {0.75f, 0.910997468263f}}}};
    for (const auto& [degrees, expected] : truth) {
        const double half = 0.5 * degrees * kPi / 180.0;
        const auto wall = [&](double side) {
            return gridMesh(4, 2, [=](double u, double v) {
                const double x = side > 0 ? u : 1 - u;
                return glm::dvec3(side * x * std::sin(half), x * std::cos(half), 100 - 200 * v);
            });
        };
        const BakeInputs inputs = sceneOf({wall(1), wall(-1)});
        const BakeArtifact artifact = aoOf(inputs, kSamples);
        for (const auto& [x, value] : expected)
            for (const std::size_t m : {0u, 1u})
                EXPECT_NEAR(valueAt(artifact, inputs, m,
                                    {(m == 0 ? 1 : -1) * x * float(std::sin(half)),
                                     x * float(std::cos(half)), 0}),
                            value, kTolerance)
                    << degrees << " degrees, x " << x;
    }
}

TEST(AmbientOcclusion, DistanceIsInMetres) {
    const BakeInputs inputs = sceneOf({planeMesh(0.01, 2), discMesh(1.0, 1.0)});
    EXPECT_EQ(valueAt(aoOf(inputs, 256, 0.99f), inputs, 0, {0, 0, 0}), 1.0f);
    EXPECT_NEAR(valueAt(aoOf(inputs, 256, 1.5f), inputs, 0, {0, 0, 0}), 0.5f, 0.02f);
    // Up to the distance d only the part of the disc within it occludes: h² / d².
    EXPECT_NEAR(valueAt(aoOf(inputs, kSamples, 1.25f), inputs, 0, {0, 0, 0}), 0.64f, kTolerance);
}

TEST(AmbientOcclusion, BackFacesAndInsidesOcclude) {
    // A disc seen from its back occludes as one seen from its front.
    Mesh disc = discMesh(1.0, 1.0);
    for (std::size_t i = 0; i < disc.indices.size(); i += 3)
        std::swap(disc.indices[i + 1], disc.indices[i + 2]);
    const BakeInputs inputs = sceneOf({planeMesh(0.01, 2), disc});
    EXPECT_NEAR(valueAt(aoOf(inputs, kSamples), inputs, 0, {0, 0, 0}), 0.5f, kTolerance);
    // What is enclosed is dark.
    const BakeInputs inside = sceneOf({sphereMesh(0.2), sphereMesh(1.0)});
    for (const float value : aoValues(inside, 64))
        EXPECT_EQ(value, 0.0f);
}

TEST(AmbientOcclusion, TransformsApplyMirrorsToo) {
    const Mesh bowl = bowlMesh(48, 24);
    for (const glm::mat4& transform :
         {glm::scale(glm::mat4(1.0f), {-2.0f, 2.0f, 2.0f}),
          glm::translate(glm::mat4(1.0f), {1000.0f, -500.0f, 3.0f}),
          glm::rotate(glm::mat4(1.0f), 1.0f, glm::vec3(0.6f, 0.0f, 0.8f))}) {
        const BakeArtifact artifact = aoOf(sceneOf({bowl}, transform), 256);
        double sum = 0.0;
        for (const float value : artifact.vertices.at(0).values)
            sum += value;
        EXPECT_NEAR(sum / double(artifact.vertices[0].values.size()), 0.5, 0.01);
    }
    // Non-uniform scale: a sphere squashed to a disc-like ellipsoid stays convex and open.
    for (const float value :
         aoValues(sceneOf({sphereMesh(1.0)}, glm::scale(glm::mat4(1.0f), {1, .1f, 1})), 64))
        EXPECT_EQ(value, 1.0f);
}

TEST(AmbientOcclusion, SizeDoesNotMatter) {
    const auto at = [](float scale) {
        return aoOf(sceneOf({planeMesh(4.0, 8), sphereMesh(1.0, 32, 16, {0, 1, 0})},
                            glm::scale(glm::mat4(1.0f), glm::vec3(scale))),
                    64)
            .vertices;
    };
    const std::vector<VertexBake> metres = at(1.0f);
    EXPECT_EQ(at(0x1p-40f), metres); // powers of two: to the last bit
    EXPECT_EQ(at(0x1p+60f), metres);
}
