// Bounces between texels: against the closed form of the bowl, and against the bounces between the
// vertices of a mesh that is fine enough for them.
#include "core/bake/Bake.h"
#include "core/bake/bounce/Interreflection.h"
#include "core/bake/bounce/TexelBounces.h"
#include "core/job/Parallel.h"
#include "core/math/Shading.h"
#include "tests/core/bake/BakeTestScene.h"

#include <gtest/gtest.h>
#include <numbers>

using namespace patina;
using namespace patina::test;

namespace {

PrtSettings bouncing(int order, int bounces, int size) {
    PrtSettings settings;
    settings.order = order;
    settings.samples = 256;
    settings.transfer = TransferKind::Interreflected;
    settings.bounces = bounces;
    settings.bounceSamples = 256;
    settings.size = size;
    settings.fitted = false;
    return settings;
}

BakeArtifact bake(const BakeInputs& inputs, const PrtSettings& settings) {
    TileSink sink;
    Result<BakeArtifact> artifact = bakePrtTexel(inputs, settings, sink, {});
    EXPECT_TRUE(artifact.ok()) << (artifact.ok() ? "" : artifact.error().text());
    return artifact ? std::move(*artifact) : BakeArtifact{};
}

// A floor of side 2, `cells` a side, with UVs over all of it, +x to +u and +z to +v.
Mesh floorMesh(int cells) {
    Mesh mesh = gridMesh(cells, cells, [](double u, double v) {
        return glm::dvec3(2.0 * u - 1.0, 0.0, 2.0 * v - 1.0);
    });
    mesh.uvs.clear();
    for (const glm::vec3& p : mesh.positions) {
        mesh.uvs.push_back({0.5f * (p.x + 1.0f), 0.5f * (p.z + 1.0f)});
        mesh.normals.push_back({0, 1, 0});
    }
    return mesh;
}

// A wall across its middle, a little above it, where vertices can follow its shadow; the front
// looks to +z. UVs: +x to +u, down to +v.
Mesh wallMesh(int cells) {
    Mesh mesh = gridMesh(
        cells, cells, [](double u, double v) { return glm::dvec3(2.0 * u - 1.0, 1.2 - v, 0.03); });
    mesh.uvs.clear();
    for (const glm::vec3& p : mesh.positions) {
        mesh.uvs.push_back({0.5f * (p.x + 1.0f), 1.2f - p.y});
        mesh.normals.push_back({0, 0, 1});
    }
    return mesh;
}

// The wall is two-sided, of four colours; the upper two are bright.
BakeInputs floorAndWall(int cells) {
    BakeInputs inputs = sceneOf({floorMesh(cells), wallMesh(cells)});
    inputs.meshes[0].surface.baseColor = {0.7f, 0.4f, 0.2f};
    inputs.meshes[1].material = 2;
    inputs.meshes[1].doubleSided = true;
    inputs.meshes[1].surface.baseColor = {0.9f, 0.9f, 0.9f};
    auto image = std::make_shared<Image>(2, 2, 3, PixelType::U8, ColorEncoding::Srgb);
    const std::uint8_t colors[] = {255, 40, 40, 40, 40, 255, 90, 20, 20, 20, 20, 90};
    std::copy(std::begin(colors), std::end(colors), image->u8().begin());
    inputs.meshes[1].surface.baseColorMap.image = image;
    return inputs;
}

} // namespace

// See TheBowlsSeriesHoldsInEveryBandAtEveryPoint of InterreflectionTest.cpp: bounces add
// ρ a_l / 4 Σ (ρ/2)^(n-1) / π at every point.
TEST(TexelBounces, TheBowlsSeriesHoldsAtEveryTexel) {
    Mesh mesh = bowlMesh(64, 32);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) // u about the axis, v to the rim
        mesh.uvs.push_back(
            {static_cast<float>(i % 65) / 64.0f, static_cast<float>(i / 65) / 32.0f});
    BakeInputs inputs = sceneOf({std::move(mesh)});
    inputs.meshes[0].surface.baseColor = {0.25f, 0.5f, 1.0f};
    constexpr int kOrder = 3, kSide = 32;
    // ∫ max(0, cos) Y_l0 about the axis.
    constexpr double a[] = {0.886226925453, 1.02332670795, 0.495415912201};
    for (const int bounces : {1, 3}) {
        const BakeArtifact artifact = bake(inputs, bouncing(kOrder, bounces, kSide));
        ASSERT_EQ(artifact.texels.size(), 1u);
        EXPECT_EQ(artifact.bounces, bounces);
        EXPECT_EQ(artifact.transfer, TransferKind::Interreflected);
        EXPECT_EQ(artifact.albedo, hashBakeAlbedo(inputs));
        const std::vector<float>& bounced = artifact.texels[0].bounced;
        ASSERT_EQ(bounced.size(), std::size_t{kSide * kSide * 27});
        float axis[9];
        shading::shBasis9(glm::vec3(0, 1, 0), axis);
        const double rho[] = {0.25, 0.5, 1.0};
        for (int c = 0; c < 3; ++c) {
            const double half = rho[c] / 2.0;
            const double series = rho[c] / 4.0 * (1.0 - std::pow(half, bounces)) / (1.0 - half);
            const double scale = series * a[0] / std::numbers::pi;
            for (int l = 0; l < kOrder; ++l)
                for (int m = -l; m <= l; ++m) {
                    const int i = l * (l + 1) + m;
                    const double zonal = std::sqrt((2 * l + 1) / (4.0 * std::numbers::pi));
                    const double expected = series * a[l] * axis[i] / zonal / std::numbers::pi;
                    double sum = 0.0, weight = 0.0;
                    for (int y = 0; y < kSide; ++y)
                        for (int x = 0; x < kSide; ++x) {
                            const double value =
                                bounced[std::size_t((y * kSide + x) * 27 + 3 * i + c)];
                            ASSERT_NEAR(value, expected, 0.12 * scale)
                                << "l " << l << " m " << m << " texel " << x << ' ' << y;
                            const double w = std::sin(0.5 * std::numbers::pi * (y + 0.5) / kSide);
                            sum += w * value;
                            weight += w;
                        }
                    EXPECT_NEAR(sum / weight, expected, 0.012 * scale)
                        << "l " << l << " m " << m << " channel " << c;
                }
        }
    }
}

// Two triangles a surface are enough for texels: the colours of a mapped, two-sided wall bleed on
// the floor before it and behind it as they do between the vertices of a fine mesh.
TEST(TexelBounces, CoarseMeshesBounceAsFineOnesDoPerVertex) {
    constexpr int kSide = 32, kBlock = 8;
    const BakeArtifact texels = bake(floorAndWall(1), bouncing(2, 2, kSide));
    TileSink sink;
    const Result<BakeArtifact> vertices =
        bakePrtVertex(floorAndWall(kSide), bouncing(2, 2, kSide), sink, {});
    ASSERT_TRUE(vertices.ok());
    ASSERT_EQ(texels.texels.size(), 2u);
    for (std::size_t surface = 0; surface < 2; ++surface) {
        const std::vector<float>& fine = vertices->vertices[surface].bounced;
        const std::vector<float>& coarse = texels.texels[surface].bounced;
        ASSERT_EQ(coarse.size(), std::size_t{kSide * kSide * 12});
        double strongest = 0.0, difference = 0.0;
        for (std::size_t k = 0; k < 12; ++k)
            for (int by = 0; by < kSide; by += kBlock)
                for (int bx = 0; bx < kSide; bx += kBlock) {
                    double a = 0.0, b = 0.0;
                    for (int y = by; y < by + kBlock; ++y)
                        for (int x = bx; x < bx + kBlock; ++x) {
                            a += coarse[std::size_t(y * kSide + x) * 12 + k];
                            for (const int corner : {0, 1, kSide + 1, kSide + 2})
                                b +=
                                    0.25 * fine[std::size_t(y * (kSide + 1) + x + corner) * 12 + k];
                        }
                    strongest = std::max(strongest, std::abs(b));
                    difference = std::max(difference, std::abs(a - b));
                }
        EXPECT_LT(difference, 0.05 * strongest) << "surface " << surface;
        EXPECT_GT(strongest, 0.5);
    }
}

TEST(TexelBounces, AreTheSameForAnyThreadCountAndWithoutKeptHits) {
    const BakeInputs inputs = floorAndWall(2);
    PrtSettings settings = bouncing(4, 2, 24);
    settings.samples = settings.bounceSamples = 16;
    const BakeArtifact reference = bake(inputs, settings);
    ASSERT_FALSE(reference.texels.empty());
    for (const int threads : {1, 2, 7}) {
        const ThreadLimit limit(threads);
        EXPECT_EQ(bake(inputs, settings), reference) << threads;
    }
    settings.hitBudget = 0;
    EXPECT_EQ(bake(inputs, settings), reference);
}

TEST(TexelBounces, EndWhenTheyAreCancelled) {
    const BakeInputs inputs = floorAndWall(2);
    const Result<BakeGeometry> geometry = makeBakeGeometry(inputs, {});
    const Result<RayScene> scene = RayScene::build(*geometry, {});
    const PrtSettings settings = bouncing(1, 2, 8);
    const Result<TexelLayout> layout = texelLayout(*geometry, 8, {});
    ASSERT_TRUE(layout.ok());
    PassState direct;
    direct.values.assign(layout->points.size(), 0.25f);
    JobControl control;
    control.cancel();
    BakeArtifact artifact;
    const std::optional<Error> error = addTexelInterreflection(
        artifact, inputs, *geometry, *scene, *layout, direct, settings, control.context());
    ASSERT_TRUE(error.has_value());
    EXPECT_EQ(error->kind, ErrorKind::Cancelled);
    EXPECT_EQ(artifact, BakeArtifact{});
}
