// Scenes of many small parts: each is found by its id, however many there are.
#include "core/bake/document/BakeStaleness.h"
#include "core/bake/local/NearShadows.h"
#include "core/base/ById.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "tests/core/mesh/Shapes.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace patina {
namespace {

constexpr std::size_t kSide = 20, kParts = kSide * kSide;
constexpr Id kFirst = 1000; // ids are no positions

// Balls over a floor of a few vertices more than one thread traces, and two lights.
Document ballsOverFloor() {
    Document document;
    document.materials.emplace_back().id = 1;
    const auto ball = std::make_shared<const Mesh>(test::sanitized(test::sphereMesh(1.0, 6, 4)));
    const auto plane = std::make_shared<const Mesh>(test::sanitized(test::gridMesh(
        12, 12, [](double u, double v) { return glm::dvec3(20.0 * u, 0.0, -20.0 * v); })));
    for (std::size_t i = 0; i < kParts; ++i) {
        MeshInstance& part = document.meshes.emplace_back();
        part.id = kFirst + 7 * static_cast<Id>(i);
        part.mesh = ball;
        part.material = 1;
        part.placement = glm::translate(glm::mat4(1.0f),
                                        {float(i % kSide) + 0.5f, 0.5f, -float(i / kSide) - 0.5f}) *
                         glm::scale(glm::mat4(1.0f), glm::vec3(0.3f));
    }
    MeshInstance& floor = document.meshes.emplace_back();
    floor.id = 7;
    floor.mesh = plane;
    floor.material = 1;
    for (const float x : {4.0f, 15.0f}) {
        Light& light = document.lights.emplace_back();
        light.id = static_cast<Id>(document.lights.size());
        light.type = LightType::Point;
        light.position = {x, 1.2f, -9.0f};
    }
    auto bake = std::make_shared<BakeArtifact>();
    bake->kind = BakeKind::PrtVertex;
    bake->order = 1;
    for (auto mesh = document.meshes.rbegin(); mesh != document.meshes.rend(); ++mesh)
        bake->vertices.push_back(
            {mesh->id, 1, std::vector<float>(mesh->mesh->vertexCount(), 0.2f)});
    document.bakes = {bake};
    document.nextId = kFirst + 7 * kParts;
    return document;
}

TEST(ManyPartsTest, ElementsAreFoundById) {
    const Document document = ballsOverFloor();
    const ById meshes(document.meshes);
    for (const MeshInstance& mesh : document.meshes)
        EXPECT_EQ(meshes.find(mesh.id), &mesh);
    EXPECT_EQ(meshes.find(kFirst + 1), nullptr);
    EXPECT_TRUE(meshes.contains(7));
    const ById bakes(document.bakes.front()->vertices, &VertexBake::mesh);
    EXPECT_EQ(bakes.find(7), &document.bakes.front()->vertices.front());
    // Of those that share an id the first.
    const std::vector<MeshInstance> twice(2, document.meshes.front());
    EXPECT_EQ(ById(twice).find(kFirst), &twice.front());
    EXPECT_EQ(ById<MeshInstance>().find(kFirst), nullptr);
}

// Parts that one thread traces, and the floor that all trace, have the shares that their points
// have when they are asked for alone.
TEST(ManyPartsTest, EachPartHasTheSharesOfItsOwnPoints) {
    const Document document = ballsOverFloor();
    const NearShadowRequest request = nearShadowRequest(document);
    ASSERT_EQ(request.parts.size(), kParts + 1);
    const Result<NearShadowsPtr> traced = traceNearShadows(request, nullptr, 0, {});
    ASSERT_TRUE(traced.ok());
    const Result<BakeScene> scene = BakeScene::build(request.inputs, {});
    ASSERT_TRUE(scene.ok());
    EXPECT_FALSE(scene->passesByChance);
    const std::vector<BakePoint> points = vertexPoints(*scene->geometry, {});
    std::size_t shaded = 0;
    ASSERT_EQ((*traced)->shares.size(), 2u);
    for (std::size_t l = 0; l < 2; ++l) {
        ASSERT_EQ((*traced)->shares[l].size(), kParts + 1);
        std::size_t first = 0;
        for (std::size_t p = 0; p <= kParts; ++p) {
            EXPECT_EQ(request.parts[p].id, document.meshes[p].id);
            const std::size_t count = document.meshes[p].mesh->vertexCount();
            EXPECT_EQ(count > kNearGrain, p == kParts);
            const auto alone = nearVisibility(*scene, std::span(points).subspan(first, count),
                                              request.lights[l].emitter, {});
            ASSERT_TRUE(alone.ok());
            EXPECT_EQ(*(*traced)->shares[l][p], *alone) << "part " << p;
            shaded += static_cast<std::size_t>(std::ranges::count(*alone, 0.0f));
            first += count;
        }
    }
    EXPECT_GT(shaded, kParts);
}

TEST(ManyPartsTest, StalenessNamesThePartsThatDiffer) {
    Document document = ballsOverFloor();
    document.meshes[3].name = "hidden";
    document.meshes[3].visible = false;
    document.meshes[5].name = "other";
    document.meshes[5].mesh = document.meshes.back().mesh;
    MeshInstance added = document.meshes.front();
    added.id = document.takeId();
    added.name = "new";
    document.meshes.push_back(added);
    std::erase_if(document.meshes, [](const MeshInstance& mesh) { return mesh.id == kFirst; });
    const BakeStaleness stale =
        bakeStaleness(*document.bakes.front(), document, hashBytes({}), Hash{});
    EXPECT_EQ(stale.reasons,
              (std::vector<std::string>{"“other” has other vertices", "“hidden” was hidden",
                                        "a mesh was removed", "“new” was added or shown"}));
}

} // namespace
} // namespace patina
