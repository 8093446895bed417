#include "core/bake/document/BakeCache.h"
#include "core/bake/domain/BakeHash.h"
#include "tests/core/bake/BakeTestScene.h"
#include "tests/support/TemporaryFolder.h"

#include <fstream>
#include <gtest/gtest.h>

using namespace patina;
using namespace patina::test;

namespace fs = std::filesystem;

namespace {

BakeInputs twoMeshes() {
    BakeInputs inputs = sceneOf({planeMesh(2.0, 4), sphereMesh(1.0, 8, 4, {0, 1, 0})});
    inputs.meshes[1].material = 7;
    return inputs;
}

// Every member away from its default.
BakeArtifact fullBake(const BakeInputs& inputs) {
    BakeArtifact artifact;
    artifact.kind = BakeKind::PrtVertex;
    artifact.inputs = hashBakeInputs(inputs);
    artifact.albedo = {1, 2};
    artifact.settings = {{"samples", "64"}, {"empty", ""}};
    artifact.note = "two\nlines";
    artifact.stopped = true;
    artifact.order = 2;
    artifact.transfer = TransferKind::Interreflected;
    artifact.bounces = 5;
    artifact.samplesDone = 64;
    float next = 0.0f;
    for (const BakeMesh& mesh : inputs.meshes) {
        VertexBake& bake = artifact.vertices.emplace_back();
        bake.mesh = mesh.id;
        bake.stride = 4;
        for (std::size_t v = 0; v < mesh.mesh->vertexCount(); ++v) {
            for (int i = 0; i < 4; ++i)
                bake.values.push_back(next += 0.25f);
            for (int i = 0; i < 12; ++i)
                bake.bounced.push_back(next += 0.25f);
            bake.sky.push_back(next += 0.25f);
            bake.error.push_back(next += 0.25f);
        }
    }
    TexelBake& texel = artifact.texels.emplace_back();
    texel.material = 7;
    texel.side = 2;
    texel.stride = 1;
    texel.values = {1, 2, 3, 4};
    auto image = std::make_shared<Image>(3, 3, 1, PixelType::F32, ColorEncoding::Data);
    image->f32()[4] = 0.5f;
    texel.image = image;
    return artifact;
}

class BakeCacheTest : public ::testing::Test {
  protected:
    TemporaryFolder folder;
    BakeInputs inputs = twoMeshes();
    BakeRequest request;
};

TEST_F(BakeCacheTest, GivesBackWhatItWasGiven) {
    const BakeCache cache(folder.path() / "bakes");
    const Hash key = BakeCache::key(request, inputs);
    EXPECT_FALSE(cache.find(key, inputs));
    BakeArtifact artifact = fullBake(inputs);
    ASSERT_TRUE(cache.store(key, inputs, artifact).ok());
    std::optional<BakeArtifact> found = cache.find(key, inputs);
    ASSERT_TRUE(found);
    ASSERT_TRUE(found->texels[0].image);
    EXPECT_EQ(*found->texels[0].image, *artifact.texels[0].image);
    found->texels[0].image = artifact.texels[0].image;
    EXPECT_EQ(*found, artifact);
}

// A scene that is opened again counts its ids anew.
TEST_F(BakeCacheTest, IdsAreThoseOfTheSceneThatAsks) {
    const BakeCache cache(folder.path());
    const Hash key = BakeCache::key(request, inputs);
    ASSERT_TRUE(cache.store(key, inputs, fullBake(inputs)).ok());
    BakeInputs again = inputs;
    again.meshes[0].id = 41;
    again.meshes[1].id = 40;
    again.meshes[0].material = 9;
    again.meshes[1].material = 8;
    EXPECT_EQ(BakeCache::key(request, again), key);
    const std::optional<BakeArtifact> found = cache.find(key, again);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->vertices[0].mesh, 41u);
    EXPECT_EQ(found->vertices[1].mesh, 40u);
    EXPECT_EQ(found->texels[0].material, 8u);
}

TEST_F(BakeCacheTest, AnythingThatShapesTheResultIsAnotherBake) {
    const Hash key = BakeCache::key(request, inputs);
    BakeRequest other = request;
    other.prt.samples = 512;
    EXPECT_NE(BakeCache::key(other, inputs), key);
    other.prt.samples = 1000; // traced as 1024, the default
    EXPECT_EQ(BakeCache::key(other, inputs), key);
    other = request;
    other.prt.hitBudget = 0; // slower, and the same
    EXPECT_EQ(BakeCache::key(other, inputs), key);
    other = request;
    other.kind = BakeKind::PrtTexel;
    EXPECT_NE(BakeCache::key(other, inputs), key);
    BakeInputs moved = inputs;
    moved.meshes[0].transform[3][1] = 0.5f;
    EXPECT_NE(BakeCache::key(request, moved), key);

    // Albedo counts where light bounces off it.
    BakeInputs twoSided = inputs;
    twoSided.meshes[0].doubleSided = true;
    EXPECT_EQ(BakeCache::key(request, twoSided), key);
    request.prt.transfer = TransferKind::Interreflected;
    EXPECT_NE(BakeCache::key(request, twoSided), BakeCache::key(request, inputs));
}

TEST_F(BakeCacheTest, DamagedFilesAreDroppedAndTheirPlaceTaken) {
    const BakeCache cache(folder.path());
    const Hash key = BakeCache::key(request, inputs);
    const BakeArtifact artifact = fullBake(inputs);
    ASSERT_TRUE(cache.store(key, inputs, artifact).ok());
    const auto size = fs::file_size(cache.file(key));
    for (const std::uintmax_t left : {std::uintmax_t{0}, std::uintmax_t{7}, size - 1}) {
        fs::resize_file(cache.file(key), left);
        EXPECT_FALSE(cache.find(key, inputs)) << left;
        EXPECT_FALSE(fs::exists(cache.file(key))) << left;
        ASSERT_TRUE(cache.store(key, inputs, artifact).ok());
    }
    {
        std::fstream file(cache.file(key), std::ios::in | std::ios::out | std::ios::binary);
        file.seekp(static_cast<std::streamoff>(size / 2));
        file.put('\x5a');
    }
    EXPECT_FALSE(cache.find(key, inputs));
    EXPECT_FALSE(fs::exists(cache.file(key)));
}

TEST_F(BakeCacheTest, ABakeOfFewerMeshesIsNotRead) {
    const BakeCache cache(folder.path());
    const Hash key = BakeCache::key(request, inputs);
    ASSERT_TRUE(cache.store(key, inputs, fullBake(inputs)).ok());
    BakeInputs fewer = inputs;
    fewer.meshes.pop_back();
    EXPECT_FALSE(cache.find(key, fewer));
}

TEST_F(BakeCacheTest, WhatWasUsedLongestAgoGoes) {
    const BakeArtifact artifact = fullBake(inputs);
    std::uint64_t size = 0;
    {
        const BakeCache cache(folder.path());
        ASSERT_TRUE(cache.store({1, 1}, inputs, artifact).ok());
        size = fs::file_size(cache.file({1, 1}));
    }
    const BakeCache cache(folder.path(), 2 * size + size / 2);
    const auto now = fs::file_time_type::clock::now();
    fs::last_write_time(cache.file({1, 1}), now - std::chrono::hours(3));
    ASSERT_TRUE(cache.store({2, 2}, inputs, artifact).ok());
    fs::last_write_time(cache.file({2, 2}), now - std::chrono::hours(2));
    ASSERT_TRUE(cache.find({1, 1}, inputs)); // used now
    ASSERT_TRUE(cache.store({3, 3}, inputs, artifact).ok());
    EXPECT_TRUE(fs::exists(cache.file({1, 1})));
    EXPECT_FALSE(fs::exists(cache.file({2, 2})));
    EXPECT_TRUE(fs::exists(cache.file({3, 3})));
}

} // namespace
