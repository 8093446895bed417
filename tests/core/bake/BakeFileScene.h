// Documents and bakes with random numbers, for tests of bake files.
#pragma once

#include "core/bake/Bake.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/document/Document.h"
#include "core/material/Material.h"
#include "tests/core/bake/BakeTestScene.h"

#include <gtest/gtest.h>
#include <random>

namespace patina::test {

// Two meshes of one name, one of them with more vertices than a row of the image.
inline Document bakeDocument() {
    Document document;
    for (const char* name : {"Skin", "Skin", ""}) {
        Material& material = document.materials.emplace_back();
        material.id = document.takeId();
        material.name = name;
    }
    const std::vector<Mesh> meshes = {sphereMesh(1.0, 96, 64), torusMesh(1.0, 0.3, 12, 8),
                                      cubeMesh()};
    for (const Mesh& mesh : meshes) {
        MeshInstance& instance = document.meshes.emplace_back();
        instance.id = document.takeId();
        instance.name = document.meshes.size() < 3 ? "Body" : "Body#2";
        instance.mesh = std::make_shared<const Mesh>(sanitized(mesh));
        instance.material = document.materials[document.meshes.size() - 1].id;
    }
    return document;
}

// `transfer` decides what a bake of transfer holds: with Interreflected all there is.
inline BakeArtifact randomBake(const Document& document, BakeKind kind, int order = 0,
                               TransferKind transfer = TransferKind::Shadowed) {
    std::mt19937 random(11);
    BakeArtifact artifact;
    artifact.kind = kind;
    artifact.inputs = hashBakeInputs(bakeInputs(document));
    artifact.settings = {{"samples", "256"}, {"seed", "4294967295"}};
    artifact.note = "a \"note\", 100 %";
    artifact.order = order;
    artifact.samplesDone = 128;
    if (kind == BakeKind::LightMap)
        artifact.light = {0xfedcba9876543210, 7};
    const bool bounced = transfer == TransferKind::Interreflected;
    if (holdsTransfer(kind))
        artifact.transfer = transfer;
    if (bounced) {
        artifact.bounces = 3;
        artifact.albedo = {0x0123456789abcdef, 42};
    }
    const auto fill = [&](std::vector<float>& values, std::size_t count, float low) {
        values.resize(count);
        for (float& value : values)
            value = low + (1.0f - low) * float(random()) / 4294967296.0f;
    };
    const auto fillTransfer = [&](auto& bake, std::size_t count) {
        bake.stride = order * order;
        fill(bake.values, count * std::size_t(bake.stride), -1.0f);
        if (!bounced)
            return;
        fill(bake.bounced, 3 * bake.values.size(), -1.0f);
        fill(bake.sky, count, 0.0f);
        fill(bake.error, count, 0.0f);
    };
    if (isPerTexel(kind)) {
        for (const Material& material : document.materials) {
            TexelBake& bake = artifact.texels.emplace_back();
            bake.material = material.id;
            if (kind == BakeKind::LightMap) {
                bake.side = 5;
                bake.stride = kLightMapNumbers;
                fill(bake.values, std::size_t{25} * kLightMapNumbers, -3.0f);
                continue;
            }
            if (holdsTransfer(kind)) {
                bake.side = 17;
                fillTransfer(bake, 17 * 17);
                continue;
            }
            auto image = std::make_shared<Image>(33, 33, 1, PixelType::F32, ColorEncoding::Data);
            std::vector<float> values;
            fill(values, 33 * 33, 0.0f);
            std::copy(values.begin(), values.end(), image->f32().begin());
            bake.image = std::move(image);
        }
        return artifact;
    }
    for (const MeshInstance& mesh : document.meshes) {
        VertexBake& bake = artifact.vertices.emplace_back();
        bake.mesh = mesh.id;
        if (holdsTransfer(kind))
            fillTransfer(bake, mesh.mesh->vertexCount());
        else
            fill(bake.values, mesh.mesh->vertexCount(), 0.0f);
    }
    return artifact;
}

// Images compare by identity in the artifact; here their content matters.
inline void expectSame(const BakeArtifact& a, const BakeArtifact& b) {
    EXPECT_EQ(a.kind, b.kind);
    EXPECT_EQ(a.inputs, b.inputs);
    EXPECT_EQ(a.settings, b.settings);
    EXPECT_EQ(a.order, b.order);
    EXPECT_EQ(a.samplesDone, b.samplesDone);
    EXPECT_EQ(a.albedo, b.albedo);
    EXPECT_EQ(a.light, b.light);
    EXPECT_EQ(a.transfer, b.transfer);
    EXPECT_EQ(a.bounces, b.bounces);
    EXPECT_EQ(a.vertices, b.vertices);
    ASSERT_EQ(a.texels.size(), b.texels.size());
    for (std::size_t i = 0; i < a.texels.size(); ++i) {
        EXPECT_EQ(a.texels[i].material, b.texels[i].material);
        if (!a.texels[i].image) {
            EXPECT_EQ(a.texels[i], b.texels[i]);
            continue;
        }
        ASSERT_TRUE(b.texels[i].image);
        EXPECT_EQ(*a.texels[i].image, *b.texels[i].image);
    }
}

} // namespace patina::test
