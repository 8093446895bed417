#include "core/bake/BakeMemory.h"
#include "core/base/ProcessMemory.h"
#include "tests/core/bake/BakeTestScene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace patina;
using namespace patina::test;
using ::testing::HasSubstr;

namespace {

BakeInputs plane(int cells) {
    return sceneOf({planeMesh(1.0, cells)});
}

std::uint64_t bytes(const BakeRequest& request, const BakeInputs& inputs) {
    return estimateBake(request, inputs).bytes;
}

TEST(BakeMemory, CountsElementsAndRays) {
    BakeRequest request;
    request.prt.samples = 256;
    request.prt.fitted = false;
    const BakeInputs inputs = plane(10);
    const std::uint64_t vertices = inputs.meshes[0].mesh->vertexCount();
    EXPECT_EQ(estimateBake(request, inputs).elements, vertices);
    EXPECT_EQ(estimateBake(request, inputs).rays, vertices * 256);
    request.prt.transfer = TransferKind::Interreflected;
    request.prt.bounceSamples = 64;
    EXPECT_EQ(estimateBake(request, inputs).rays, vertices * (256 + 64));
    request.prt.fitted = true; // as many points on triangles, or 8192
    EXPECT_EQ(estimateBake(request, inputs).rays, vertices * (256 + 64) + 8192 * 256);
    EXPECT_EQ(estimateBake(request, plane(100)).rays, 101u * 101u * (2 * 256 + 64));
    EXPECT_EQ(estimateBake(request, inputs).elements, vertices);
    const std::uint64_t fitted = bytes(request, inputs);
    request.prt.fitted = false;
    EXPECT_GT(fitted, bytes(request, inputs) + 8192 * 11 * sizeof(float));
    request.prt.transfer = TransferKind::Unshadowed;
    EXPECT_EQ(estimateBake(request, inputs).rays, 0u);
    request.kind = BakeKind::AoTexel;
    request.ao.size = 64;
    request.ao.samples = 32;
    EXPECT_EQ(estimateBake(request, inputs).elements, 64u * 64u);
    EXPECT_EQ(estimateBake(request, inputs).rays, 64u * 64u * 32u);
}

// At least what the values alone take, and no more than the issue allows a large mesh.
TEST(BakeMemory, GrowsWithWhatIsStored) {
    BakeRequest request;
    const BakeInputs inputs = plane(100);
    const std::uint64_t vertices = inputs.meshes[0].mesh->vertexCount();
    std::uint64_t last = 0;
    for (int order = 1; order <= 8; ++order) {
        request.prt.order = order;
        const std::uint64_t now = bytes(request, inputs);
        EXPECT_GT(now, last);
        EXPECT_GE(now, vertices * static_cast<std::uint64_t>(order * order) * sizeof(float));
        last = now;
    }
    request.prt.order = 4;
    const std::uint64_t shadowed = bytes(request, inputs);
    EXPECT_LT(static_cast<double>(shadowed) / static_cast<double>(vertices) * 1e6,
              6.0 * 1024 * 1024 * 1024)
        << "a million vertices at order 4";
    request.prt.transfer = TransferKind::Interreflected;
    const std::uint64_t hits = 8 * 64 * vertices;
    EXPECT_GT(bytes(request, inputs), shadowed + hits);
    request.prt.hitBudget = hits / 2;
    const std::uint64_t limited = bytes(request, inputs);
    request.prt.hitBudget = 0;
    EXPECT_GT(limited, bytes(request, inputs));
}

TEST(BakeMemory, WhatDoesNotFitIsRefusedWithWhatWould) {
    BakeRequest request;
    request.prt.order = 8;
    const BakeInputs inputs = plane(60);
    EXPECT_TRUE(checkBakeMemory(request, inputs, 0).ok()) << "unknown";
    EXPECT_TRUE(checkBakeMemory(request, inputs, bytes(request, inputs)).ok());
    BakeRequest smaller = request;
    smaller.prt.order = 5;
    const Result<void> bands = checkBakeMemory(request, inputs, bytes(smaller, inputs));
    ASSERT_FALSE(bands.ok());
    EXPECT_EQ(bands.error().kind, ErrorKind::Usage);
    EXPECT_THAT(bands.error().message, HasSubstr("With 5 bands"));

    request.prt.transfer = TransferKind::Interreflected;
    EXPECT_THAT(checkBakeMemory(request, inputs, bytes(request, inputs) - 1).error().message,
                HasSubstr("hit memory 0"));
    EXPECT_THAT(checkBakeMemory(request, inputs, 1000).error().message, HasSubstr("Hide meshes"));

    request.kind = BakeKind::AoTexel;
    request.ao.size = request.prt.size = 2048;
    smaller = request;
    smaller.ao.size = 512;
    EXPECT_THAT(checkBakeMemory(request, inputs, bytes(smaller, inputs)).error().message,
                HasSubstr("512 × 512"));
}

TEST(BakeMemory, ThisMachineHasSome) {
    EXPECT_GT(availableMemory(), std::uint64_t{1} << 20);
    EXPECT_LT(availableMemory(), std::uint64_t{1} << 50);
}

TEST(BakeMemory, TextsAreShort) {
    EXPECT_EQ(memoryText(0), "1 MiB");
    EXPECT_EQ(memoryText(std::uint64_t{640} << 20), "640 MiB");
    EXPECT_EQ(memoryText((std::uint64_t{3} << 30) / 2), "1.5 GiB");
}

} // namespace
