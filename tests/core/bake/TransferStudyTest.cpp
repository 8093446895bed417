// How light reaches a point by a transfer that is known: nothing is hidden from a square that faces
// up, T_lm = A_l Y_lm(n) / pi.
#include "core/bake/study/TransferStudy.h"
#include "core/bake/local/NearLightAt.h"
#include "core/bake/study/TransferLobe.h"
#include "core/bake/study/TransferStatistics.h"
#include "core/document/Document.h"
#include "core/edit/Edit.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/math/SphericalHarmonics.h"
#include "core/mix/TransferLight.h"
#include "tests/core/light/LatLongPicture.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <numbers>

using namespace patina;
using namespace patina::test;

namespace {

constexpr glm::vec3 kRadiance{1.0f, 2.0f, 0.5f};

class TransferStudies : public testing::Test {
  protected:
    TransferStudies() {
        Mesh mesh;
        mesh.positions = {{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}};
        mesh.normals.assign(4, {0, 1, 0});
        mesh.tangents.assign(4, {1, 0, 0, 1});
        mesh.uvs = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
        mesh.indices = {0, 1, 2, 0, 2, 3};
        Material& material = document.materials.emplace_back();
        material.id = document.takeId();
        MeshInstance& instance = document.meshes.emplace_back();
        instance.id = document.takeId();
        instance.material = material.id;
        instance.mesh = std::make_shared<const Mesh>(mesh);
        document.environment().image = latLong(32, 16, [](const glm::vec3&) { return kRadiance; });
        attachBake(document, openBake(0.0f));
    }
    // `bounced`: red of coefficient 0 alone.
    [[nodiscard]] BakeArtifactPtr openBake(float bounced) const {
        BakeArtifact bake;
        bake.kind = BakeKind::PrtVertex;
        bake.order = 3;
        VertexBake& vertices = bake.vertices.emplace_back();
        vertices.mesh = document.meshes[0].id;
        vertices.stride = 9;
        std::array<float, 9> y{};
        evaluateSh(3, glm::vec3(0, 1, 0), y);
        for (int vertex = 0; vertex < 4; ++vertex)
            for (int l = 0, i = 0; l < 3; ++l)
                for (int m = -l; m <= l; ++m, ++i) {
                    vertices.values.push_back(static_cast<float>(cosineConvolution(l)) / kPi *
                                              y[std::size_t(i)]);
                    if (bounced != 0.0f)
                        vertices.bounced.insert(vertices.bounced.end(),
                                                {i == 0 ? bounced : 0.0f, 0.0f, 0.0f});
                }
        return std::make_shared<const BakeArtifact>(std::move(bake));
    }
    [[nodiscard]] TransferRequest request() const {
        TransferRequest request = transferRequest(document);
        request.mesh = document.meshes[0].id;
        request.position = {0.25f, 0.0f, -0.5f};
        return request;
    }
    [[nodiscard]] TransferStudy study(const TransferRequest& request) {
        Result<TransferStudy> result = studyTransfer(document, request, memory, {});
        EXPECT_TRUE(result.ok()) << result.error().text();
        return *std::move(result);
    }

    Document document;
    TransferMemory memory;
};

} // namespace

TEST_F(TransferStudies, AnOpenPointReflectsAUniformEnvironment) {
    const TransferStudy all = study(request());
    EXPECT_NEAR(all.visibility, 1.0f, 1e-5f);
    EXPECT_LT(glm::distance(all.radiance, kRadiance), 1e-4f);
    EXPECT_EQ(all.all(), all.radiance);
    ASSERT_EQ(all.byBand.size(), 3u);
    EXPECT_LT(glm::distance(all.byBand[0], kRadiance), 1e-4f) << "the other bands are empty";
    EXPECT_LT(glm::length(all.byBand[1]), 1e-4f);
    EXPECT_EQ(all.light.size(), 9u);
    EXPECT_NEAR(all.environment.rms(), std::sqrt((1.0 + 4.0 + 0.25) / 3.0), 1e-5);
    // Three bands of a clamped cosine are 3/32 + z/2 + 15/32 z² over pi, lowest at z = -8/15.
    EXPECT_NEAR(all.function.lowest * std::numbers::pi_v<float>, 3.0f / 32.0f - 2.0f / 15.0f,
                1e-3f);
    EXPECT_NEAR(all.function.highest * std::numbers::pi_v<float>,
                3.0f / 32.0f + 0.5f + 15.0f / 32.0f, 1e-3f);
    // Between its roots, (-8 ± sqrt(19)) / 15, half their difference of the sphere.
    EXPECT_NEAR(all.function.negativeShare, std::sqrt(19.0) / 15.0, 0.01);
    EXPECT_EQ(all.function.values.size(),
              std::size_t(2 * all.function.height * all.function.height));
    EXPECT_EQ(all.function.peak(), all.function.highest);
    EXPECT_TRUE(all.visible.empty());
}

TEST_F(TransferStudies, BandsAreSwitchedOffAndTheEnvironmentIsScaled) {
    document.environment().image =
        latLong(64, 32, [](const glm::vec3& d) { return kRadiance * (1.0f + 0.5f * d.y); });
    document.environment().exposureEv = 1.0f;
    const TransferStudy all = study(request());
    // 2 (L + 2/3 · L/2)
    EXPECT_LT(glm::distance(all.radiance, 2.0f * kRadiance * 4.0f / 3.0f), 1e-3f);
    TransferRequest one = request();
    one.bands = 0b010u;
    const TransferStudy alone = study(one);
    EXPECT_LT(glm::distance(alone.radiance, all.byBand[1]), 1e-6f);
    EXPECT_NEAR(alone.function.negativeShare, 0.5, 0.01);
    EXPECT_NEAR(alone.function.lowest, -alone.function.highest, 1e-4f);
    one.bands = 0b101u;
    EXPECT_LT(glm::distance(study(one).radiance, all.radiance - all.byBand[1]), 1e-4f);
    EXPECT_FALSE(one == request());
}

TEST_F(TransferStudies, LocalLightsArriveByBandsOrByRays) {
    Light light;
    light.id = document.takeId();
    light.type = LightType::Point;
    light.position = {0.25f, 2.0f, -0.5f};
    light.intensity = 10.0f;
    document.lights.push_back(light);
    TransferRequest bands = request();
    ASSERT_EQ(bands.lights.size(), 1u);
    const TransferStudy soft = study(bands);
    EXPECT_EQ(soft.tracedLights, 0u);
    EXPECT_EQ(soft.local, glm::vec3(0.0f));
    std::vector<glm::vec3> expected =
        transferLight(document, 3, [&](const EnvironmentPart&) -> std::span<const glm::vec3> {
            return soft.environment.analysis->bands.coefficients;
        });
    addNearLights(document, bands.position, 3, expected);
    for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_LT(glm::distance(soft.light[i], expected[i]), 1e-5f) << i;

    const Result<NearShadowsPtr> shadows =
        traceNearShadows(nearShadowRequest(document), nullptr, 0, {});
    ASSERT_TRUE(shadows.ok()) << shadows.error().text();
    bands.shadows = *shadows;
    const TransferStudy traced = study(bands);
    EXPECT_EQ(traced.tracedLights, 1u);
    EXPECT_LT(glm::distance(traced.radiance, kRadiance), 1e-4f) << "without the light";
    EXPECT_EQ(traced.local, nearLightAt(document, *shadows,
                                        *nearestMeshPoint(document, bands.mesh, bands.position))
                                .radiance);
    EXPECT_GT(traced.local.x, 0.0f);
    EXPECT_EQ(traced.all(), traced.radiance + traced.local);
}

// What is bounced off other surfaces does arrive from lights whose shadows are traced.
TEST_F(TransferStudies, BouncesOfTracedLightsStayInTheBands) {
    attachBake(document, openBake(0.1f));
    document.environment().enabled = false;
    Light light;
    light.id = document.takeId();
    light.type = LightType::Point;
    light.position = {0.25f, 2.0f, -0.5f};
    light.intensity = 10.0f;
    document.lights.push_back(light);
    TransferRequest traced = request();
    traced.shadows = *traceNearShadows(nearShadowRequest(document), nullptr, 0, {});
    const TransferStudy result = study(traced);
    EXPECT_GT(result.radiance.x, 0.0f);
    EXPECT_EQ(result.radiance.y, 0.0f) << "it bounces off red alone";
}

TEST_F(TransferStudies, RaysFindWhatAnOpenPointSees) {
    TransferRequest traced = request();
    traced.traced = true;
    const TransferStudy result = study(traced);
    const int height = result.visibleHeight;
    ASSERT_EQ(result.visible.size(), std::size_t(2 * height * height));
    for (int y = 0; y < height; ++y)
        EXPECT_EQ(result.visible[std::size_t(2 * height * y)], y < height / 2) << y;
}

TEST_F(TransferStudies, WhatCannotBeStudiedIsAnError) {
    TransferRequest other = request();
    other.mesh = 99;
    const Result<TransferStudy> gone = studyTransfer(document, other, memory, {});
    ASSERT_FALSE(gone.ok());
    EXPECT_EQ(gone.error().kind, ErrorKind::InputBroken);
    JobControl control;
    control.cancel();
    TransferMemory nothing;
    const Result<TransferStudy> stopped =
        studyTransfer(document, request(), nothing, control.context());
    ASSERT_FALSE(stopped.ok());
    EXPECT_EQ(stopped.error().kind, ErrorKind::Cancelled);
    EXPECT_EQ(nothing.analysis, nullptr);
    EXPECT_LT(
        glm::distance(studyTransfer(document, request(), nothing, {}).value().radiance, kRadiance),
        1e-4f)
        << "the memory serves on";
    document.bakes.clear();
    EXPECT_EQ(transferRequest(document).bake, nullptr);
}

TEST_F(TransferStudies, TheLobeReachesAsFarAsLightIsLetThrough) {
    const TransferStudy all = study(request());
    const TransferColors colors{{0, 1, 0}, {1, 0, 1}};
    const LobeMesh lobe = transferLobe(all.transfer, ~0u, all.function.highest, colors);
    ASSERT_EQ(lobe.positions.size(), lobe.normals.size());
    ASSERT_EQ(lobe.positions.size(), lobe.colors.size());
    float farthest = 0.0f;
    for (std::size_t i = 0; i < lobe.positions.size(); ++i) {
        const glm::vec3& p = lobe.positions[i];
        const float length = glm::length(p);
        farthest = std::max(farthest, length);
        EXPECT_NEAR(glm::length(lobe.normals[i]), 1.0f, 1e-4f) << i;
        if (length < 1e-3f)
            continue;
        const float value = all.transfer.towards(p / length, ~0u);
        EXPECT_NEAR(length, std::abs(value) / all.function.highest, 1e-4f) << i;
        EXPECT_EQ(lobe.colors[i], value < 0.0f ? colors.negative : colors.positive) << i;
    }
    EXPECT_NEAR(farthest, 1.0f, 1e-3f);
    for (const std::uint32_t i : lobe.triangles)
        ASSERT_LT(i, lobe.positions.size());
}

TEST(TransferStatistics, AreThoseOfElementsThatLightReaches) {
    // Three elements of two bands: open, half, dark.
    const float open = 0.2820948f; // T_00 of visibility 1: Y_00
    const std::vector<float> values{open, 0.0f, 0.3f, 0.0f, 0.5f * open, 0.1f,
                                    0.0f, 0.0f, 0.0f, 0.0f, 0.0f,        0.0f};
    const TransferStatistics s = transferStatistics(values, {}, 2);
    EXPECT_EQ(s.elements, 3u);
    EXPECT_EQ(s.dark, 1u);
    EXPECT_NEAR(s.lowestVisibility, 0.5f, 1e-5f);
    EXPECT_NEAR(s.highestVisibility, 1.0f, 1e-5f);
    EXPECT_NEAR(s.meanVisibility, 0.75, 1e-5);
    ASSERT_EQ(s.bandShares.size(), 2u);
    const double first = 1.25 * double{open} * double{open}, second = 0.09 + 0.01;
    EXPECT_NEAR(s.bandShares[0], first / (first + second), 1e-6);
    EXPECT_NEAR(s.bandShares[1], second / (first + second), 1e-6);

    // Bounces add to the coefficients, and light an element that is dark without.
    std::vector<float> bounced(3 * values.size(), 0.0f);
    bounced[3 * 8] = 0.3f;
    const TransferStatistics more = transferStatistics(values, bounced, 2);
    EXPECT_EQ(more.dark, 0u);
    EXPECT_EQ(more.lowestVisibility, 0.0f);
    EXPECT_NEAR(more.bandShares[0], (first + 0.01) / (first + 0.01 + second), 1e-6);

    const TransferStatistics none = transferStatistics(std::vector<float>(4, 0.0f), {}, 2);
    EXPECT_EQ(none.dark, 1u);
    EXPECT_EQ(none.meanVisibility, 0.0);
    EXPECT_EQ(none.bandShares, std::vector<double>(2, 0.0));
}
