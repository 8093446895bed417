// Where a glTF file's nodes put their meshes, and in which shape: copies, morph targets, skins.
#include "tests/core/worker/ModelFiles.h"

#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <limits>

namespace patina {
namespace {

using nlohmann::json;
using test::GltfBuilder;
using testing::Contains;
using testing::Each;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class GltfPose : public test::ImportTest {
  protected:
    // A triangle whose node has copies by these accessors.
    static void instanced(GltfBuilder& builder, json attributes, json node = json::object()) {
        node["mesh"] = builder.triangle();
        node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = std::move(attributes);
        builder.root["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
        builder.root["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
        builder.node(std::move(node));
    }
    static json& primitive(GltfBuilder& builder) {
        return builder.root["meshes"][0]["primitives"][0];
    }
};

TEST_F(GltfPose, CopiesOfANodeAreAllPlaced) {
    GltfBuilder builder;
    const float half = std::sqrt(0.5f);
    instanced(builder,
              {{"TRANSLATION", builder.floats({0, 0, 0, 2, 0, 0, 0, 0, 3}, 3)},
               {"ROTATION", builder.floats({0, 0, 0, 1, 0, 0, half, half, 0, 0, 0, 1}, 4)},
               {"SCALE", builder.floats({1, 1, 1, 1, 1, 1, 4, 4, 4}, 3)},
               {"_ID", builder.integers<std::uint16_t>({7, 8, 9}, 1)}},
              {{"name", "tree"}, {"translation", {10, 0, 0}}});
    const ImportedModel model = import("a.glb", builder.glb());
    ASSERT_EQ(model.instances.size(), 3u);
    EXPECT_EQ(model.meshes.size(), 1u);
    EXPECT_EQ(model.triangleCount, 3u);
    EXPECT_EQ(model.instances[1].name, "tree 2");
    expectNear(corners(model, 0)[1], {11, 0, 0});
    expectNear(corners(model, 1)[1], {12, 1, 0}); // turned 90 degrees about +Z
    expectNear(corners(model, 2)[1], {14, 0, 3});
    EXPECT_THAT(model.warnings, Each(Not(HasSubstr("EXT_mesh_gpu_instancing"))));
}

TEST_F(GltfPose, CopiesMayBeTurnedByIntegers) {
    GltfBuilder builder;
    instanced(builder,
              {{"ROTATION", builder.integers<std::int16_t>({0, 0, 23170, 23170}, 4, true)}});
    const ImportedModel model = import("a.glb", builder.glb());
    ASSERT_EQ(model.instances.size(), 1u);
    expectNear(corners(model)[1], {0, 1, 0}, 1e-4f);
}

TEST_F(GltfPose, CopiesBeyondAllMeasureAreRefused) {
    GltfBuilder different;
    instanced(different, {{"TRANSLATION", different.floats({0, 0, 0, 2, 0, 0}, 3)},
                          {"SCALE", different.floats({1, 1, 1}, 3)}});
    EXPECT_THAT(importError("a.glb", different.glb()).detail, HasSubstr("differ in length"));

    // Zeros that take no bytes.
    GltfBuilder many;
    many.root["accessors"].push_back(
        {{"componentType", 5126}, {"count", 900000}, {"type", "VEC3"}});
    instanced(many, {{"TRANSLATION", 0}});
    EXPECT_THAT(importError("a.glb", many.glb()).message, HasSubstr("900000 copies"));

    // Few copies of a mesh of many parts, and plain nodes likewise.
    GltfBuilder parts;
    parts.root["accessors"].push_back({{"componentType", 5126}, {"count", 2000}, {"type", "VEC3"}});
    instanced(parts, {{"TRANSLATION", 0}});
    const json part = primitive(parts);
    for (int i = 0; i < 60; ++i)
        parts.root["meshes"][0]["primitives"].push_back(part);
    EXPECT_THAT(importError("a.glb", parts.glb()).message, HasSubstr("100000 objects"));
    parts.root["nodes"][0].erase("extensions");
    for (int i = 0; i < 2000; ++i)
        parts.node({{"mesh", 0}});
    EXPECT_THAT(importError("a.glb", parts.glb()).message, HasSubstr("100000 objects"));
}

TEST_F(GltfPose, TransformsWithoutEndAreLeftOutAndCounted) {
    GltfBuilder builder;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    instanced(builder, {{"TRANSLATION", builder.floats({0, 0, 0, nan, 0, 0, 0, 0, 3}, 3)}});
    builder.node({{"mesh", 0}, {"translation", {1e300, 0, 0}}});
    const ImportedModel model = import("a.glb", builder.glb());
    EXPECT_EQ(model.instances.size(), 2u);
    EXPECT_THAT(model.warnings, Contains(HasSubstr("2 objects whose transforms are not finite")));
}

TEST_F(GltfPose, DefaultWeightsMorph) {
    GltfBuilder builder;
    builder.triangle();
    primitive(builder)["attributes"]["TANGENT"] =
        builder.floats({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, 4);
    primitive(builder)["targets"] = {
        {{"POSITION", builder.floats({0, 0, 0, 4, 0, 0, 0, 0, 0}, 3)}},
        {{"POSITION", builder.floats({0, 0, 2, 0, 0, 2, 0, 0, 2}, 3)},
         {"NORMAL", builder.floats({0, 1, -1, 0, 1, -1, 0, 1, -1}, 3)},
         {"TANGENT", builder.floats({-2, 0, 0, -2, 0, 0, -2, 0, 0}, 3)}}};
    builder.root["meshes"][0]["weights"] = {0.5, 0};
    builder.node({{"mesh", 0}});
    builder.node({{"mesh", 0}, {"weights", {0, 1}}});
    builder.node({{"mesh", 0}, {"weights", {0, 0}}});
    builder.node({{"mesh", 0}});
    const ImportedModel model = import("a.glb", builder.glb());
    ASSERT_EQ(model.instances.size(), 4u);
    EXPECT_EQ(model.meshes.size(), 3u) << "nodes of the same weights share one";
    const auto mesh = [&](std::size_t i) -> const Mesh& {
        return *model.meshes[static_cast<std::size_t>(model.instances[i].mesh)];
    };
    expectNear(corners(model, 0)[1], {3, 0, 0});
    expectNear(mesh(0).normals[0], {0, 0, 1});
    expectNear(corners(model, 1)[1], {1, 0, 2});
    expectNear(mesh(1).normals[0], {0, 1, 0});
    expectNear(glm::vec3(mesh(1).tangents[0]), {-1, 0, 0});
    EXPECT_EQ(mesh(1).tangents[0].w, 1.0f);
    expectNear(corners(model, 2)[1], {1, 0, 0});
    EXPECT_EQ(model.instances[0].mesh, model.instances[3].mesh);
    EXPECT_THAT(model.warnings, IsEmpty());
}

// Targets mostly move a few vertices, as sparse accessors without a view. Their zeros do not count
// as geometry out of nothing.
TEST_F(GltfPose, SparseTargetsMorph) {
    GltfBuilder builder;
    constexpr std::size_t kVertices = 60000;
    std::vector<float> positions;
    for (std::size_t i = 0; i < kVertices; ++i)
        positions.insert(positions.end(), {static_cast<float>(i), 0.0f, i % 2 == 0 ? 0.0f : 1.0f});
    const int index = builder.view(std::string("\x02\0\0\0", 4));
    const int value = builder.floats({0, 5, 0}, 3);
    const int valueView = builder.root["accessors"][static_cast<std::size_t>(value)]["bufferView"];
    json targets = json::array();
    json weights = json::array();
    for (int i = 0; i < 20; ++i) {
        builder.root["accessors"].push_back(
            {{"componentType", 5126},
             {"count", kVertices},
             {"type", "VEC3"},
             {"sparse",
              {{"count", 1},
               {"indices", {{"bufferView", index}, {"componentType", 5125}}},
               {"values", {{"bufferView", valueView}}}}}});
        targets.push_back({{"POSITION", builder.root["accessors"].size() - 1}});
        weights.push_back(0.05);
    }
    builder.root["meshes"] = {{{"weights", weights},
                               {"primitives",
                                {{{"mode", 5},
                                  {"attributes", {{"POSITION", builder.floats(positions, 3)}}},
                                  {"targets", targets}}}}}};
    builder.node({{"mesh", 0}});
    const ImportedModel model = import("a.glb", builder.glb());
    expectNear(corners(model)[2], {2, 5, 0}, 1e-4f);
}

TEST_F(GltfPose, TargetsThatDoNotFitAreNamed) {
    GltfBuilder builder;
    builder.triangle();
    primitive(builder)["targets"] = {{{"POSITION", builder.floats({0, 0, 0, 4, 0, 0}, 3)}}};
    builder.root["meshes"][0]["weights"] = {1.0, 1.0};
    builder.node({{"mesh", 0}});
    builder.node({{"mesh", 0}, {"weights", {1e300}}});
    const ImportedModel model = import("a.glb", builder.glb());
    ASSERT_EQ(model.instances.size(), 2u);
    expectNear(corners(model)[1], {1, 0, 0});
    EXPECT_THAT(model.warnings, Contains(HasSubstr("\"triangle\": a morph target that does not")));
    EXPECT_THAT(model.warnings, Contains(HasSubstr("more weights than morph targets")));
    EXPECT_THAT(model.warnings, Contains(HasSubstr("weight is not finite")));
}

} // namespace
} // namespace patina
