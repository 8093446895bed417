#include "core/bake/Bake.h"
#include "core/bake/domain/GutterFill.h"
#include "core/math/SphericalHarmonics.h"
#include "core/mesh/UvUnwrap.h"
#include "tests/core/bake/BakeTestScene.h"

#include <gtest/gtest.h>
#include <set>

using namespace patina;
using namespace patina::test;

namespace {

// A square floor of side 2 whose UVs run from 0 to `repeats`.
Mesh uvFloor(float repeats = 1.0f) {
    Mesh mesh = planeMesh(1.0, 4);
    for (const glm::vec3& p : mesh.positions)
        mesh.uvs.push_back(repeats * glm::vec2(0.5f * (p.x + 1), 0.5f * (p.z + 1)));
    return mesh;
}

BakeArtifact texelAo(const BakeInputs& inputs, int size, int samples, TileSink& sink) {
    AoSettings settings;
    settings.size = size;
    settings.samples = samples;
    Result<BakeArtifact> artifact = bakeAoTexel(inputs, settings, sink, {});
    EXPECT_TRUE(artifact.ok());
    return artifact ? std::move(*artifact) : BakeArtifact{};
}

} // namespace

// AO = 1 - r³ / (x² + r²)^1.5 around the foot of a resting sphere.
TEST(TexelBake, FloorUnderASphereIsExactPerTexel) {
    BakeInputs inputs = sceneOf({uvFloor(), sphereMesh(0.4, 96, 48, {0, 0.4, 0})});
    inputs.meshes[1].material = 2;
    TileSink sink;
    constexpr int kSize = 48;
    const BakeArtifact artifact = texelAo(inputs, kSize, 1024, sink);
    ASSERT_EQ(artifact.texels.size(), 2u);
    EXPECT_EQ(artifact.texels[0].material, 1u);
    EXPECT_EQ(artifact.texels[1].material, 2u);
    EXPECT_EQ(artifact.note, "");
    const Image& image = *artifact.texels[0].image;
    ASSERT_EQ(image.width(), kSize);
    EXPECT_EQ(image.channels(), 1);
    EXPECT_EQ(image.encoding(), ColorEncoding::Data);
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            const double px = 2 * (x + 0.5) / kSize - 1, pz = 2 * (y + 0.5) / kSize - 1;
            const double expected =
                1.0 - std::pow(0.4, 3.0) / std::pow(px * px + pz * pz + 0.16, 1.5);
            ASSERT_NEAR(image.sample(x, y, 0), expected, 0.02) << x << ' ' << y;
        }
}

TEST(TexelBake, CoarseSmoothMeshesDoNotShadowThemselves) {
    TileSink sink;
    const BakeArtifact artifact = texelAo(sceneOf({sphereMesh(1.0, 12, 8)}), 128, 64, sink);
    const std::span<const float> values = artifact.texels.at(0).image->f32();
    EXPECT_GT(*std::min_element(values.begin(), values.end()), 0.97f);
}

TEST(TexelBake, ClosedRoomsAreDarkAlsoAlongTheirEdges) {
    // Inside a closed room everything is dark, also along its edges and in the gutters.
    Mesh room = cubeMesh();
    for (std::size_t i = 0; i < room.indices.size(); i += 3)
        std::swap(room.indices[i + 1], room.indices[i + 2]);
    TileSink sink;
    const BakeArtifact artifact = texelAo(sceneOf({room}), 64, 64, sink);
    for (const float value : artifact.texels.at(0).image->f32())
        ASSERT_LT(value, 0.02f);
}

TEST(TexelBake, SinkGetsEveryBakedTexelAndTheImageAgrees) {
    const BakeInputs inputs = sceneOf({torusMesh(1.0, 0.4, 32, 16)});
    Recorder recorder;
    const BakeArtifact artifact = texelAo(inputs, 64, 64, recorder);
    EXPECT_EQ(recorder.m_passes, (std::vector<int>{32, 64}));
    const Image& image = *artifact.texels.at(0).image;
    const std::map<int, float>& sent = recorder.m_texels.at(1);
    EXPECT_GT(sent.size(), 64u * 64u / 4u);
    EXPECT_LT(sent.size(), 64u * 64u);
    for (const auto& [texel, value] : sent)
        EXPECT_EQ(image.sample(texel % 64, texel / 64, 0), value);
    for (const float value : image.f32()) { // gutters are filled with something like the surface
        EXPECT_GE(value, 0.3f);
        EXPECT_LE(value, 1.0f);
    }
}

TEST(TexelBake, OverlappingUvsGiveTheMeanAndANote) {
    // Two floors share one UV square: one is open, the other lies under a lid.
    BakeInputs inputs = sceneOf({uvFloor(), uvFloor(), planeMesh(50.0)});
    inputs.meshes[1].transform = glm::translate(glm::mat4(1.0f), {0, -10, 0});
    inputs.meshes[2].transform = glm::translate(glm::mat4(1.0f), {0, -9.99f, 0});
    inputs.meshes[2].material = 2;
    TileSink sink;
    const BakeArtifact artifact = texelAo(inputs, 32, 32, sink);
    EXPECT_NE(artifact.note.find("overlap"), std::string::npos);
    EXPECT_NEAR(artifact.texels.at(0).image->sample(16, 16, 0), 0.5f, 0.01f);
    EXPECT_NEAR(artifact.texels.at(0).image->sample(2, 29, 0), 0.5f, 0.01f);
}

TEST(TexelBake, TiledAndAbsurdUvsAreBoundedAndNoted) {
    TileSink sink;
    const BakeArtifact tiled = texelAo(sceneOf({uvFloor(8.0f)}), 32, 32, sink);
    EXPECT_NE(tiled.note, "");
    for (const float value : tiled.texels.at(0).image->f32())
        EXPECT_EQ(value, 1.0f);
    const BakeArtifact absurd = texelAo(sceneOf({uvFloor(1e7f)}), 32, 32, sink);
    EXPECT_NE(absurd.note.find("32 triangles"), std::string::npos);
    for (const float value : absurd.texels.at(0).image->f32())
        EXPECT_EQ(value, 1.0f);
}

TEST(TexelBake, OtherTilesOfTheImageAreTheSameTexels) {
    Mesh shifted = uvFloor();
    for (glm::vec2& uv : shifted.uvs)
        uv += glm::vec2(3.0f, -2.0f);
    TileSink sink;
    const Mesh lid = planeMesh(0.3, 1, 0.2);
    BakeInputs a = sceneOf({uvFloor(), lid}), b = sceneOf({shifted, lid});
    a.meshes[1].material = b.meshes[1].material = 2;
    const BakeArtifact one = texelAo(a, 32, 64, sink), other = texelAo(b, 32, 64, sink);
    EXPECT_EQ(one.texels[0].image->f32()[16 * 32 + 16], other.texels[0].image->f32()[16 * 32 + 16]);
    EXPECT_EQ(other.note, "");
}

TEST(TexelBake, TinyTrianglesGetTheirTexelToo) {
    // All UVs within one texel that covers no centre: the nearest point stands for it.
    Mesh mesh = uvFloor();
    for (glm::vec2& uv : mesh.uvs)
        uv = glm::vec2(5.1f / 16, 7.1f / 16) + uv * 1e-4f;
    Recorder recorder;
    (void)texelAo(sceneOf({mesh}), 16, 32, recorder);
    EXPECT_TRUE(recorder.m_texels.at(1).contains(7 * 16 + 5));
}

// Transfer of the floor under a resting sphere: band 0 is the closed form above, and every texel of
// an open floor holds T_lm = A_l Y_lm(n) / pi, gutters included.
TEST(TexelTransfer, HoldsTheCoefficientsOfEveryTexel) {
    PrtSettings settings;
    settings.order = 3;
    settings.samples = 1024;
    settings.size = 24;
    TileSink sink;
    BakeInputs inputs = sceneOf({uvFloor(), sphereMesh(0.4, 96, 48, {0, 0.4, 0})});
    inputs.meshes[1].material = 2;
    const Result<BakeArtifact> artifact = bakePrtTexel(inputs, settings, sink, {});
    ASSERT_TRUE(artifact.ok());
    EXPECT_EQ(artifact->kind, BakeKind::PrtTexel);
    EXPECT_EQ(artifact->order, 3);
    EXPECT_EQ(artifact->settings.at("size"), "24");
    ASSERT_EQ(artifact->texels.size(), 2u);
    const TexelBake& floor = artifact->texels[0];
    EXPECT_EQ(floor.material, 1u);
    EXPECT_EQ(floor.side, 24);
    EXPECT_EQ(floor.stride, 9);
    EXPECT_EQ(floor.sky.size(), 24u * 24u);
    EXPECT_EQ(floor.error.size(), 24u * 24u);
    ASSERT_EQ(floor.values.size(), 24u * 24u * 9u);
    const double y00 = 0.5 / std::sqrt(kPi);
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 24; ++x) {
            const double px = 2 * (x + 0.5) / 24 - 1, pz = 2 * (y + 0.5) / 24 - 1;
            const double ao = 1.0 - std::pow(0.4, 3.0) / std::pow(px * px + pz * pz + 0.16, 1.5);
            ASSERT_NEAR(floor.values[std::size_t(y * 24 + x) * 9], ao * y00, 0.02 * y00)
                << x << ' ' << y;
        }

    const Result<BakeArtifact> open = bakePrtTexel(sceneOf({uvFloor(0.5f)}), settings, sink, {});
    ASSERT_TRUE(open.ok());
    std::vector<double> basis(9);
    evaluateSh(3, {0, 1, 0}, basis);
    const std::vector<float>& values = open->texels.at(0).values;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const int l = i % 9 == 0 ? 0 : i % 9 < 4 ? 1 : 2;
        ASSERT_NEAR(values[i], cosineConvolution(l) * basis[i % 9] / kPi, 0.01) << i;
    }
}

TEST(TexelTransfer, MeshesWithoutUvsAndAbsurdSizesAreRefused) {
    TileSink sink;
    PrtSettings settings;
    BakeInputs inputs = sceneOf({uvFloor()});
    for (const int size : {0, -4, 8193}) {
        settings.size = size;
        const Result<BakeArtifact> refused = bakePrtTexel(inputs, settings, sink, {});
        ASSERT_FALSE(refused.ok());
        EXPECT_EQ(refused.error().kind, ErrorKind::Usage);
    }
    settings.size = 16;
    Mesh bare = *inputs.meshes[0].mesh;
    bare.uvs.clear();
    inputs.meshes[0].mesh = std::make_shared<const Mesh>(bare);
    const Result<BakeArtifact> refused = bakePrtTexel(inputs, settings, sink, {});
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().kind, ErrorKind::InputBroken);
}

TEST(FillGutters, KeepsTheFloatsOfATexelTogether) {
    std::vector<float> values(8 * 8 * 2, -1.0f);
    std::vector<std::uint8_t> known(64, 0);
    values[2 * 9] = 0.25f;
    values[2 * 9 + 1] = 0.5f;
    known[9] = 1;
    constexpr float kNone[] = {0.0f, 0.0f};
    fillGutters(values, known, 8, kNone);
    for (std::size_t i = 0; i < values.size(); ++i)
        EXPECT_EQ(values[i], i % 2 == 0 ? 0.25f : 0.5f) << i;
    std::vector<float> nothing(2 * 4, -1.0f);
    constexpr float kTwo[] = {1.0f, 2.0f};
    fillGutters(nothing, std::vector<std::uint8_t>(4, 0), 2, kTwo);
    EXPECT_EQ(nothing, (std::vector<float>{1, 2, 1, 2, 1, 2, 1, 2}));
}

TEST(FillGutters, KeepsKnownValuesAndFillsFromTheNearest) {
    constexpr int kSide = 37;
    std::vector<float> values(kSide * kSide, -1.0f);
    std::vector<std::uint8_t> known(values.size(), 0);
    for (int y = 10; y < 14; ++y)
        for (int x = 10; x < 14; ++x) {
            values[std::size_t(y * kSide + x)] = 0.25f;
            known[std::size_t(y * kSide + x)] = 1;
        }
    values[30 * kSide + 30] = 0.75f;
    known[30 * kSide + 30] = 1;
    constexpr float kNone[] = {0.0f}, kOpen[] = {1.0f};
    fillGutters(values, known, kSide, kNone);
    EXPECT_EQ(values[12 * kSide + 12], 0.25f);
    EXPECT_EQ(values[30 * kSide + 30], 0.75f);
    EXPECT_EQ(values[12 * kSide + 16], 0.25f);
    EXPECT_EQ(values[31 * kSide + 31], 0.75f);
    for (const float value : values) {
        EXPECT_GE(value, 0.25f);
        EXPECT_LE(value, 0.75f);
    }
    std::vector<float> nothing(9, -1.0f);
    fillGutters(nothing, std::vector<std::uint8_t>(9, 0), 3, kOpen);
    EXPECT_EQ(nothing, std::vector<float>(9, 1.0f));
}
