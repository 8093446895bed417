// What the inspector shows of a point, against values that are known.
#include "core/bake/document/TransferPoint.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/document/Document.h"
#include "core/material/Material.h"
#include "tests/core/bake/BakeFileScene.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

using namespace patina;
using namespace patina::test;

namespace {

// A square of 2 m in the plane y = 1, two triangles, facing up.
Document squareDocument() {
    Document document;
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
    instance.placement = glm::translate(glm::mat4(1.0f), {0, 1, 0});
    return document;
}

} // namespace

TEST(TransferPoint, NearestPointLiesInsideOnAnEdgeOrAtACorner) {
    const Document document = squareDocument();
    const Id mesh = document.meshes[0].id;
    const auto at = [&](glm::vec3 p) { return nearestMeshPoint(document, mesh, p).value(); };
    const auto place = [&](const MeshPoint& point) {
        const Mesh& m = *document.meshes[0].mesh;
        glm::vec3 sum(0, 1, 0);
        for (int k = 0; k < 3; ++k)
            sum += point.weights[k] * m.positions[m.indices[3 * point.triangle + std::size_t(k)]];
        return sum;
    };
    const std::pair<glm::vec3, glm::vec3> cases[] = {{{0.5f, 1.2f, -0.25f}, {0.5f, 1, -0.25f}},
                                                     {{-0.5f, 0.2f, 0.25f}, {-0.5f, 1, 0.25f}},
                                                     {{3, 1, 0.5f}, {1, 1, 0.5f}},
                                                     {{-0.5f, 1, 7}, {-0.5f, 1, 1}},
                                                     {{5, 9, 5}, {1, 1, 1}},
                                                     {{-4, 1, -3}, {-1, 1, -1}},
                                                     {{-4, 1, 3}, {-1, 1, 1}},
                                                     {{2, 1, -3}, {1, 1, -1}}};
    for (const auto& [from, to] : cases)
        EXPECT_LT(glm::distance(place(at(from)), to), 1e-6f) << from.x << " " << from.z;
    EXPECT_EQ(at({0.5f, 1, -0.5f}).triangle, 1u);
    EXPECT_FALSE(nearestMeshPoint(document, 99, {0, 0, 0}));
}

TEST(TransferPoint, TransferIsThatOfTheTriangleOrTheTexel) {
    const Document document = squareDocument();
    const Id mesh = document.meshes[0].id;
    const BakeArtifact vertices =
        randomBake(document, BakeKind::PrtVertex, 3, TransferKind::Interreflected);
    const MeshPoint point{mesh, 1, {0.5f, 0.3f, 0.2f}}; // corners 0, 2, 3
    const auto found = pointTransfer(document, vertices, point);
    ASSERT_TRUE(found);
    const VertexBake& bake = vertices.vertices[0];
    const auto mixed = [&](const std::vector<float>& v, std::size_t stride, std::size_t i) {
        return 0.5f * v[i] + 0.3f * v[2 * stride + i] + 0.2f * v[3 * stride + i];
    };
    std::vector<glm::vec3> light(9);
    glm::vec3 both(0.0f);
    for (std::size_t i = 0; i < 9; ++i) {
        EXPECT_NEAR(found->direct[i], mixed(bake.values, 9, i), 1e-6f);
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(found->bounced[i][int(c)], mixed(bake.bounced, 27, 3 * i + c), 1e-6f);
        light[i] = glm::vec3(float(i) + 1.0f, 2.0f, -1.0f);
        if (i == 0 || i >= 4)
            both += light[i] * found->coefficient(i);
    }
    EXPECT_LT(glm::distance(found->radiance(light, 0b101u), both), 1e-5f); // bands 0 and 2
    EXPECT_EQ(found->radiance(light, 0u), glm::vec3(0.0f));

    const BakeArtifact texels = randomBake(document, BakeKind::PrtTexel, 2);
    const auto texel = pointTransfer(document, texels, {mesh, 0, {0.0f, 0.0f, 1.0f}}); // uv 1, 1
    ASSERT_TRUE(texel);
    EXPECT_FLOAT_EQ(texel->direct[1], texels.texels[0].values[1]); // wraps around to the first
    const auto middle = pointTransfer(document, texels, {mesh, 0, {0.5f, 0.0f, 0.5f}});
    EXPECT_FLOAT_EQ(middle->direct[3], texels.texels[0].values[4 * (8 * 17 + 8) + 3]);
}

TEST(TransferPoint, DirectionsAreHiddenByTheSceneAndTheSurfaceItself) {
    Document document = squareDocument();
    // A wall that fills the whole half with x > 0, close by.
    MeshInstance wall = document.meshes[0];
    wall.id = document.takeId();
    wall.placement = glm::translate(glm::mat4(1.0f), {0.01f, 1, 0}) *
                     glm::rotate(glm::mat4(1.0f), glm::radians(90.0f), {0, 0, 1}) *
                     glm::scale(glm::mat4(1.0f), glm::vec3(100.0f));
    document.meshes.push_back(wall);
    const auto visible = visibleDirections(bakeInputs(document),
                                           {document.meshes[0].id, 0, {0.5f, 0.0f, 0.5f}}, 32, {});
    ASSERT_TRUE(visible.ok()) << visible.error().text();
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x) {
            const glm::vec3 d = latLongDirection(x, y, 64, 32);
            if (std::abs(d.x) < 0.05f)
                continue;
            EXPECT_EQ((*visible)[std::size_t(y * 64 + x)], d.y > 0.0f && d.x < 0.0f)
                << x << " " << y;
        }
    EXPECT_LT(glm::distance(latLongDirection(31, 15, 64, 32), glm::vec3(0, 0, -1)), 0.08f);
    EXPECT_GT(latLongDirection(48, 16, 64, 32).x, 0.99f);
}

TEST(TransferPoint, TowardsIsTheSumOfHarmonics) {
    PointTransfer transfer{2, {0.5f, 0.1f, 0.2f, -0.3f}, {}};
    EXPECT_NEAR(transfer.towards({0, 1, 0}, 0b11u), 0.282095f * 0.5f - 0.488603f * 0.1f, 1e-6f);
    EXPECT_NEAR(transfer.towards({0, 0, 1}, 0b10u), 0.488603f * 0.2f, 1e-6f);
    transfer.bounced = {{0.3f, 0.0f, 0.0f}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    EXPECT_NEAR(transfer.towards({0, 0, 1}, 0b01u), 0.282095f * 0.6f, 1e-6f);
}
