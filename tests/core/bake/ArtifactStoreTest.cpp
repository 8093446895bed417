#include "core/bake/document/ArtifactStore.h"

#include <gtest/gtest.h>
#include <memory>

namespace patina {
namespace {

BakeArtifactPtr bakeOf(BakeKind kind, std::uint64_t inputs, std::size_t numbers) {
    auto bake = std::make_shared<BakeArtifact>();
    bake->kind = kind;
    bake->inputs = Hash{inputs, 0};
    VertexBake vertices;
    vertices.values.resize(numbers / 2);
    vertices.sky.resize(numbers - numbers / 2);
    bake->vertices.push_back(vertices);
    return bake;
}

TEST(ArtifactStore, FindsABakeByKindAndInputs) {
    ArtifactStore store;
    const BakeArtifactPtr one = bakeOf(BakeKind::AoVertex, 1, 10);
    const BakeArtifactPtr two = bakeOf(BakeKind::AoVertex, 2, 10);
    const BakeArtifactPtr transfer = bakeOf(BakeKind::PrtVertex, 1, 10);
    for (const BakeArtifactPtr& bake : {one, two, transfer})
        store.keep(bake);
    EXPECT_EQ(store.find(BakeKind::AoVertex, Hash{1, 0}), one);
    EXPECT_EQ(store.find(BakeKind::AoVertex, Hash{2, 0}), two);
    EXPECT_EQ(store.find(BakeKind::PrtVertex, Hash{1, 0}), transfer);
    EXPECT_EQ(store.find(BakeKind::PrtVertex, Hash{2, 0}), nullptr);
    EXPECT_EQ(store.bytes(), 3 * 10 * sizeof(float));
    store.clear();
    EXPECT_EQ(store.find(BakeKind::AoVertex, Hash{1, 0}), nullptr);
    EXPECT_EQ(store.bytes(), 0u);
}

TEST(ArtifactStore, TheNewestOfTheSameInputsIsTheOneThatIsKept) {
    ArtifactStore store;
    store.keep(bakeOf(BakeKind::AoVertex, 1, 10));
    const BakeArtifactPtr newer = bakeOf(BakeKind::AoVertex, 1, 20);
    store.keep(newer);
    EXPECT_EQ(store.find(BakeKind::AoVertex, Hash{1, 0}), newer);
    EXPECT_EQ(store.bytes(), 20 * sizeof(float));
}

TEST(ArtifactStore, WhatWasKeptLongestAgoGoesFirst) {
    ArtifactStore store(100 * sizeof(float));
    for (const std::uint64_t inputs : {1, 2, 3})
        store.keep(bakeOf(BakeKind::AoVertex, inputs, 40));
    EXPECT_EQ(store.find(BakeKind::AoVertex, Hash{1, 0}), nullptr);
    EXPECT_NE(store.find(BakeKind::AoVertex, Hash{2, 0}), nullptr);
    EXPECT_EQ(store.bytes(), 80 * sizeof(float));
    store.keep(bakeOf(BakeKind::AoVertex, 4, 101));
    EXPECT_EQ(store.find(BakeKind::AoVertex, Hash{4, 0}), nullptr) << "larger than the store";
    EXPECT_NE(store.find(BakeKind::AoVertex, Hash{2, 0}), nullptr) << "and nothing went for it";
}

} // namespace
} // namespace patina
