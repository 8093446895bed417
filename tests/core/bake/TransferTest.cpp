// Radiance transfer against closed forms. The definitions there are T_i = ∫ V cos Y_i dω; ours are
// divided by pi (core/bake/domain/BakeArtifact.h).
#include "core/math/ShRotation.h"
#include "core/math/SphericalHarmonics.h"
#include "tests/core/bake/BakeTestScene.h"

#include <array>
#include <gtest/gtest.h>

using namespace patina;
using namespace patina::test;

namespace {

std::vector<double> transferAt(const BakeArtifact& artifact, const BakeInputs& inputs,
                               std::size_t m, const glm::vec3& point) {
    const VertexBake& bake = artifact.vertices.at(m);
    const auto first =
        bake.values.begin() +
        static_cast<std::ptrdiff_t>(vertexAt(*inputs.meshes.at(m).mesh, point)) * bake.stride;
    return {first, first + bake.stride};
}

// A floor that faces +z and ends at a wall in the plane x = 0, which blocks all of x < 0.
BakeInputs quarterSphere(const glm::mat4& transform = glm::mat4(1.0f)) {
    Mesh floor = gridMesh(4, 4, [](double u, double v) { return glm::dvec3(u, v - 0.5, 0); });
    Mesh wall =
        gridMesh(1, 1, [](double u, double v) { return glm::dvec3(0, 1000 - 2000 * u, 1000 * v); });
    return sceneOf({std::move(floor), std::move(wall)}, transform);
}

} // namespace

TEST(Transfer, OpenSurfaceIsTheClampedCosine) {
    // T_lm = A_l Y_lm(n) / pi.
    const glm::dvec3 normal = glm::normalize(glm::dvec3(1, 2, 3));
    const glm::dvec3 axis = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), normal));
    const double angle = std::acos(normal.y);
    const BakeInputs inputs =
        sceneOf({planeMesh(1.0, 2)}, glm::mat4(glm::rotate(glm::dmat4(1.0), angle, axis)));
    for (int order = 1; order <= 8; ++order) {
        const BakeArtifact artifact = prtOf(inputs, order, 4096);
        ASSERT_EQ(artifact.order, order);
        ASSERT_EQ(artifact.vertices.at(0).stride, order * order);
        std::vector<double> basis(std::size_t(shCount(order)));
        evaluateSh(order, normal, basis);
        const std::vector<double> t = transferAt(artifact, inputs, 0, {0, 0, 0});
        for (int l = 0; l < order; ++l)
            for (int m = -l; m <= l; ++m)
                EXPECT_NEAR(t[std::size_t(shIndex(l, m))],
                            cosineConvolution(l) * basis[std::size_t(shIndex(l, m))] / kPi, 0.003)
                    << "order " << order << " l " << l << " m " << m;
    }
}

TEST(Transfer, QuarterSphere) {
    const std::array<double, 16> truth = {0.443113462726,
                                          0,
                                          0.511663353973,
                                          -0.325735007935,
                                          0,
                                          0,
                                          0.2477079561,
                                          -0.429042765405,
                                          0,
                                          0,
                                          0,
                                          0,
                                          0,
                                          -0.304697199643,
                                          0,
                                          0.0786724786569};
    const BakeInputs inputs = quarterSphere();
    const std::vector<double> t = transferAt(prtOf(inputs, 4, 4096), inputs, 0, {0, 0, 0});
    for (std::size_t i = 0; i < truth.size(); ++i)
        EXPECT_NEAR(t[i], truth[i] / kPi, 0.004) << i;
}

// An occluder over the cone of half-angle b about the normal: T_l0 = 2 pi K_l ∫ z P_l dz up to
// cos b, evaluated in closed form.
TEST(Transfer, DiscOccluder) {
    const std::map<double, std::array<double, 5>> truth = {
        {30.0, {0.66467019409, 0.66467019409, 0.0928904835376, -0.380737684575, -0.420611607197}},
        {60.0,
         {0.221556731363, 0.127915838493, -0.154817472563, -0.21981900468, -0.00173091196377}}};
    for (const auto& [degrees, zonal] : truth) {
        // Up is y: turned so that the zonal axis of the basis is the normal.
        const BakeInputs inputs =
            sceneOf({planeMesh(0.01, 2), discMesh(std::tan(degrees * kPi / 180.0), 1.0)},
                    glm::rotate(glm::mat4(1.0f), float(0.5 * kPi), glm::vec3(1, 0, 0)));
        const std::vector<double> t = transferAt(prtOf(inputs, 5, 4096), inputs, 0, {0, 0, 0});
        for (int l = 0; l < 5; ++l)
            for (int m = -l; m <= l; ++m)
                EXPECT_NEAR(t[std::size_t(shIndex(l, m))],
                            m == 0 ? zonal[std::size_t(l)] / kPi : 0.0, 0.005)
                    << degrees << " degrees, l " << l << " m " << m;
    }
}

// A disc light of half-angle 20 degrees behind the wall gives nothing; what a correct transfer of a
// given order returns for it (the truncation error) is part of the truth.
TEST(Transfer, RelightingTruncatesAsItMust) {
    struct Case {
        glm::dvec3 direction;
        std::array<double, 4> irradiance; // orders 2…5
    };
    const double s = std::sqrt(0.5);
    const std::vector<Case> cases = {
        {{s, 0, s}, {0.153688017063, 0.248115221663, 0.289310743802, 0.286494609807}},
        {{0, 0, 1}, {0.13923943722, 0.193197839848, 0.193197839848, 0.180324084445}},
        {{-s, 0, s}, {0.0709722366795, 0.00352423339341, -0.037671288745, -0.0243953}}};
    const double z = std::cos(20.0 * kPi / 180.0);
    const std::array<double, 6> legendre = {1.0,
                                            z,
                                            0.5 * (3 * z * z - 1),
                                            0.5 * (5 * z * z * z - 3 * z),
                                            (35 * z * z * z * z - 30 * z * z + 3) / 8,
                                            (63 * std::pow(z, 5) - 70 * z * z * z + 15 * z) / 8};
    const BakeInputs inputs = quarterSphere();
    for (int order = 2; order <= 5; ++order) {
        const std::vector<double> t = transferAt(prtOf(inputs, order, 4096), inputs, 0, {0, 0, 0});
        for (const Case& light : cases) {
            std::vector<double> basis(std::size_t(shCount(order)));
            evaluateSh(order, light.direction, basis);
            double sum = 0.0;
            for (int l = 0; l < order; ++l) {
                // Zonal coefficients of a cap, turned to its direction.
                const double cap =
                    l == 0 ? std::sqrt(kPi) * (1 - z)
                           : std::sqrt(kPi / (2 * l + 1)) *
                                 (legendre[std::size_t(l) - 1] - legendre[std::size_t(l) + 1]);
                for (int m = -l; m <= l; ++m)
                    sum += cap * std::sqrt(4 * kPi / (2 * l + 1)) *
                           basis[std::size_t(shIndex(l, m))] * t[std::size_t(shIndex(l, m))];
            }
            EXPECT_NEAR(kPi * sum, light.irradiance[std::size_t(order) - 2], 0.006)
                << "order " << order << " x " << light.direction.x;
        }
    }
}

TEST(Transfer, TurnsWithTheScene) {
    const glm::dvec3 axis = glm::normalize(glm::dvec3(1, 2, -0.5));
    const BakeInputs still = quarterSphere();
    const BakeInputs turned = quarterSphere(glm::mat4(glm::rotate(glm::dmat4(1.0), 0.7, axis)));
    const std::vector<double> before = transferAt(prtOf(still, 5, 4096), still, 0, {0, 0, 0});
    const std::vector<double> after = transferAt(prtOf(turned, 5, 4096), turned, 0, {0, 0, 0});
    const std::vector<float> given(before.begin(), before.end());
    std::vector<float> expected(given.size());
    ShRotation::aboutAxis(axis, 0.7, 5).apply(given, expected);
    for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_NEAR(after[i], expected[i], 0.006) << i;
}

TEST(Transfer, BandZeroIsAmbientOcclusion) {
    // T_00 = AO Y_00, ray for ray.
    const BakeInputs inputs = sceneOf({planeMesh(4.0, 8), sphereMesh(1.0, 32, 16, {0, 1, 0})});
    const BakeArtifact ao = aoOf(inputs, 256), prt = prtOf(inputs, 3, 256);
    for (std::size_t m = 0; m < 2; ++m)
        for (std::size_t v = 0; v < ao.vertices[m].values.size(); ++v)
            EXPECT_NEAR(prt.vertices[m].values[9 * v], 0.282094791773878 * ao.vertices[m].values[v],
                        1e-5);
}
