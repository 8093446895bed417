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
    // A triangle that follows joint 0 with the weight 1, as node 0; joints are nodes 1 and 2.
    static void skinned(GltfBuilder& builder, const json& node, const json& joint,
                        const std::vector<float>& inverse = {}) {
        builder.triangle();
        json& attributes = primitive(builder)["attributes"];
        attributes["JOINTS_0"] =
            builder.integers<std::uint8_t>({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 4);
        attributes["WEIGHTS_0"] = builder.floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, 4);
        json skin = {{"joints", {1, 2}}};
        if (!inverse.empty())
            skin["inverseBindMatrices"] = builder.floats(inverse, 16);
        builder.root["skins"] = {skin};
        json shown = node;
        shown["mesh"] = 0;
        shown["skin"] = 0;
        builder.node(shown);
        builder.node(joint);
        builder.node(json::object());
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

// The node of the mesh does not count, nor does its parent; joints by their world transforms do.
TEST_F(GltfPose, ASkinFollowsItsJointsAlone) {
    GltfBuilder builder;
    skinned(builder, {{"translation", {5, 0, 0}}, {"scale", {0.01, 0.01, 0.01}}},
            {{"scale", {100, 100, 100}}, {"translation", {0, 1, 0}}},
            {0.01f, 0, 0, 0, 0, 0.01f, 0, 0, 0, 0, 0.01f, 0, 0, 0, 0, 1, //
             1,     0, 0, 0, 0, 1,     0, 0, 0, 0, 1,     0, 0, 0, 0, 1});
    const ImportedModel model = import("a.glb", builder.glb());
    ASSERT_EQ(model.instances.size(), 1u);
    const auto points = corners(model);
    expectNear(points[0], {0, 1, 0});
    expectNear(points[1], {1, 1, 0});
    expectNear(points[2], {0, 2, 0});
    expectNear(model.meshes[0]->normals[0], {0, 0, 1});
    EXPECT_THAT(model.warnings, IsEmpty());
}

TEST_F(GltfPose, AVertexFollowsSeveralJointsOfSeveralSets) {
    GltfBuilder builder;
    const float half = std::sqrt(0.5f);
    // Joint 0 turns by 90 degrees about +Z within a parent that moves by 8; joint 1 is moved by 2.
    skinned(builder, json::object(), {{"rotation", {0, 0, half, half}}});
    builder.root["nodes"][2] = {{"translation", {2, 0, 0}}};
    builder.root["nodes"].push_back({{"children", {1}}, {"translation", {8, 0, 0}}});
    builder.root["scenes"][0]["nodes"] = {0, 2, 3};
    json& attributes = primitive(builder)["attributes"];
    attributes["WEIGHTS_0"] =
        builder.integers<std::uint8_t>({255, 0, 0, 0, 0, 0, 0, 0, 127, 0, 0, 0}, 4, true);
    attributes["JOINTS_1"] =
        builder.integers<std::uint16_t>({1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0}, 4);
    attributes["WEIGHTS_1"] =
        builder.integers<std::uint8_t>({0, 0, 0, 0, 0, 255, 0, 0, 127, 0, 0, 0}, 4, true);
    const ImportedModel model = import("a.glb", builder.glb());
    const auto points = corners(model);
    expectNear(points[0], {8, 0, 0});
    expectNear(points[1], {3, 0, 0});
    // (0, 1, 0) half by each: (7, 0, 0) and (2, 1, 0), though the weights add up to 254 / 255.
    expectNear(points[2], {4.5f, 0.5f, 0});
}

TEST_F(GltfPose, JointsThatMirrorKeepTheFront) {
    GltfBuilder builder;
    skinned(builder, json::object(), {{"scale", {-1, 1, 1}}});
    const ImportedModel model = import("a.glb", builder.glb());
    expectNear(model.meshes[0]->normals[0], {0, 0, 1});
    EXPECT_GT(areaVector(model).z, 0.0f);
}

TEST_F(GltfPose, AMorphedSkinIsMorphedFirst) {
    GltfBuilder builder;
    skinned(builder, json::object(), {{"scale", {3, 3, 3}}});
    primitive(builder)["targets"] = {
        {{"POSITION", builder.floats({0, 0, 0, 1, 0, 0, 0, 0, 0}, 3)}}};
    builder.root["meshes"][0]["weights"] = {1.0};
    const ImportedModel model = import("a.glb", builder.glb());
    expectNear(corners(model)[1], {6, 0, 0});
}

TEST_F(GltfPose, DamagedSkinsAreRefusedOrNamed) {
    const auto changed = [](const auto& change) {
        GltfBuilder builder;
        skinned(builder, json::object(), json::object());
        change(builder);
        return builder.glb();
    };
    const std::vector<float> identity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    EXPECT_THAT(
        importError("a.glb", changed([](GltfBuilder& b) { b.root["skins"][0]["joints"] = {77}; }))
            .detail,
        HasSubstr("nodes[77]"));
    EXPECT_THAT(importError("a.glb", changed([](GltfBuilder& b) { b.root.erase("skins"); })).detail,
                HasSubstr("skins[0]"));
    EXPECT_THAT(importError("a.glb", changed([&](GltfBuilder& b) {
                                b.root["skins"][0]["inverseBindMatrices"] = b.floats(identity, 16);
                            }))
                    .detail,
                HasSubstr("fewer matrices than joints"));
    EXPECT_THAT(importError("a.glb", changed([](GltfBuilder& b) {
                                primitive(b)["attributes"]["WEIGHTS_0"] = b.floats({1, 0, 0, 0}, 4);
                            }))
                    .detail,
                HasSubstr("differ in length"));
    // Joints in a circle that no scene shows.
    EXPECT_THAT(importError("a.glb", changed([](GltfBuilder& b) {
                                b.root["nodes"][1]["children"] = {2};
                                b.root["nodes"][2]["children"] = {1};
                                b.root["scenes"][0]["nodes"] = {0};
                            }))
                    .message,
                HasSubstr("contains itself"));

    // One triangle stays, and the other follows nothing.
    const auto second = [&](GltfBuilder& b, const std::vector<std::uint8_t>& joints,
                            const std::vector<float>& weights) {
        json part = primitive(b);
        part["attributes"]["JOINTS_0"] = b.integers(joints, 4);
        part["attributes"]["WEIGHTS_0"] = b.floats(weights, 4);
        b.root["meshes"][0]["primitives"].push_back(part);
    };
    const ImportedModel none = import(
        "a.glb", changed([&](GltfBuilder& b) {
            second(b, {9, 0, 0, 0, 9, 0, 0, 0, 9, 0, 0, 0}, {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
        }));
    EXPECT_EQ(none.instances.size(), 1u);
    EXPECT_THAT(none.warnings, Contains(HasSubstr("joints that do not exist")));
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const ImportedModel odd = import("a.glb", changed([&](GltfBuilder& b) {
                                         second(b, {0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0},
                                                {nan, 1, 0, 0, -1, 1, 0, 0, 0, 0, 0, 0});
                                     }));
    EXPECT_EQ(odd.instances.size(), 2u);
    EXPECT_THAT(odd.warnings, Contains(HasSubstr("negative or not finite")));
    EXPECT_THAT(odd.warnings, Contains(HasSubstr("without joint weights")));
    const ImportedModel infinite = import(
        "a.glb", changed([&](GltfBuilder& b) {
            b.root["nodes"][2]["translation"] = {1e300, 0, 0};
            second(b, {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
        }));
    EXPECT_EQ(infinite.instances.size(), 1u);
    EXPECT_THAT(infinite.warnings, Contains(HasSubstr("joint's transform is not finite")));
}

// A skin without joints in the mesh, and joints without a skin: the node counts.
TEST_F(GltfPose, HalfASkinIsNone) {
    GltfBuilder builder;
    skinned(builder, {{"translation", {5, 0, 0}}}, {{"scale", {3, 3, 3}}});
    GltfBuilder noSkin = builder;
    noSkin.root["nodes"][0].erase("skin");
    expectNear(corners(import("a.glb", noSkin.glb()))[1], {6, 0, 0});
    primitive(builder)["attributes"].erase("JOINTS_0");
    expectNear(corners(import("a.glb", builder.glb()))[1], {6, 0, 0});
}

TEST_F(GltfPose, AnimationIsToldOnce) {
    GltfBuilder builder;
    builder.node({{"mesh", builder.triangle()}});
    builder.root["animations"] = json::array();
    EXPECT_THAT(import("a.glb", builder.glb()).warnings, IsEmpty());
    builder.root["animations"] = {json::object(), json::object()};
    EXPECT_THAT(import("a.glb", builder.glb()).warnings,
                testing::ElementsAre(HasSubstr("Animation is not read")));
}

} // namespace
} // namespace patina
