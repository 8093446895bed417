// Shadows of local lights against closed forms.
#include "core/bake/local/NearLightAt.h"
#include "core/bake/local/NearShadows.h"
#include "core/job/Parallel.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/math/Shading.h"
#include "tests/core/bake/BakeTestScene.h"

#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>

using namespace patina;
using namespace patina::test;

namespace {

using Shape = NearEmitter::Shape;

NearEmitter pointAt(const glm::vec3& position) {
    NearEmitter emitter;
    emitter.position = position;
    return emitter;
}

NearEmitter sphereAt(const glm::vec3& position, float radius) {
    NearEmitter emitter = pointAt(position);
    emitter.shape = Shape::Sphere;
    emitter.radius = radius;
    return emitter;
}

// Shines down.
NearEmitter rectangleAt(const glm::vec3& position, float halfWidth, float halfDepth) {
    NearEmitter emitter = pointAt(position);
    emitter.shape = Shape::Rectangle;
    emitter.halfX = {halfWidth, 0, 0};
    emitter.halfY = {0, 0, -halfDepth};
    EXPECT_LT(glm::cross(emitter.halfY, emitter.halfX).y, 0.0f);
    return emitter;
}

// x from `low` to `high` at this height, and from -half to half along z.
Mesh strip(double low, double high, double height, double half = 50.0) {
    return gridMesh(1, 1, [=](double u, double v) {
        return glm::dvec3(low + (high - low) * u, height, half * (1 - 2 * v));
    });
}

// A scene to cast rays in, and points of it in metres.
class NearVisibility : public testing::Test {
  protected:
    void build(std::vector<Mesh> meshes) { build(sceneOf(std::move(meshes))); }
    void build(const BakeInputs& inputs) {
        Result<BakeScene> built = BakeScene::build(inputs, {});
        ASSERT_TRUE(built.ok());
        m_scene = std::make_unique<BakeScene>(std::move(*built));
    }
    BakePoint point(const glm::vec3& place, const glm::vec3& normal = {0, 1, 0}) const {
        const BakeGeometry& geometry = *m_scene->geometry;
        const glm::vec3 origin((glm::dvec3(place) - geometry.centre) * geometry.unitsPerMetre);
        return {origin + kRayOffset * normal, normal};
    }
    std::vector<float> shares(std::vector<BakePoint> points, const NearEmitter& emitter) const {
        auto result = nearVisibility(*m_scene, points, emitter, {});
        EXPECT_TRUE(result.ok());
        return std::move(result).value();
    }
    float share(const glm::vec3& place, const NearEmitter& emitter,
                const glm::vec3& normal = {0, 1, 0}) const {
        return shares({point(place, normal)}, emitter)[0];
    }
    // Over many points in the same light and shadow, whose samples differ: mean and RMS error.
    void expectShare(double truth, const NearEmitter& emitter, double tolerance) const {
        const std::vector<float> all =
            shares(std::vector<BakePoint>(256, point(glm::vec3(0.0f))), emitter);
        double sum = 0.0, squares = 0.0;
        for (const float s : all) {
            sum += s;
            squares += (s - truth) * (s - truth);
        }
        std::printf("[ figures  ] share %.4f: %.4f RMS off, %.5f in the mean\n", truth,
                    std::sqrt(squares / 256.0), sum / 256.0 - truth);
        EXPECT_NEAR(sum / 256.0, truth, 0.002);
        EXPECT_LT(std::sqrt(squares / 256.0), tolerance);
        EXPECT_GT(truth, 0.02);
        EXPECT_LT(truth, 0.98);
    }
    const BakeScene& scene() const { return *m_scene; }

  private:
    std::unique_ptr<BakeScene> m_scene;
};

// --- Umbra and open surface
// ----------------------------------------------------------------------

TEST_F(NearVisibility, IsExactlyZeroInTheUmbraAndOneInTheOpen) {
    build({planeMesh(4.0), strip(-1.0, 1.0, 1.0, 1.0)}); // a board over the floor
    for (const NearEmitter& emitter :
         {pointAt({0, 3, 0}), sphereAt({0, 3, 0}, 0.3f), rectangleAt({0, 3, 0}, 0.3f, 0.2f)}) {
        for (const float x : {-0.9f, -0.4f, 0.0f, 0.3f, 0.9f})
            EXPECT_EQ(share({x, 0, 0.5f * x}, emitter), 0.0f) << x;
        for (const float x : {-3.5f, -2.6f, 2.6f, 3.5f})
            EXPECT_EQ(share({x, 0, 0.3f}, emitter), 1.0f) << x;
    }
}

TEST_F(NearVisibility, IsOneWhereNothingWouldArriveAnyway) {
    build({planeMesh(4.0), strip(-1.0, 1.0, 1.0, 1.0)});
    // Facing away; behind a rectangle's lit side.
    EXPECT_EQ(share({0, 0, 0}, pointAt({0, 3, 0}), {0, -1, 0}), 1.0f);
    EXPECT_EQ(share({0, 0, 0}, sphereAt({0, 3, 0}, 0.2f), {0, -1, 0}), 1.0f);
    NearEmitter up = rectangleAt({0, 3, 0}, 0.3f, 0.2f);
    up.halfY = -up.halfY;
    EXPECT_EQ(share({0, 0, 0}, up), 1.0f);
}

TEST_F(NearVisibility, WhatIsBehindALightCastsNoShadow) {
    build({planeMesh(4.0), strip(-4.0, 4.0, 2.0)}); // a ceiling
    for (const float x : {-3.0f, 0.0f, 2.0f}) {
        EXPECT_EQ(share({x, 0, 0}, pointAt({0, 1.9f, 0})), 1.0f) << x;
        EXPECT_EQ(share({x, 0, 0}, sphereAt({0, 1.5f, 0}, 0.4f)), 1.0f) << x;
        // In the ceiling's own plane, as panels are placed.
        EXPECT_EQ(share({x, 0, 0}, rectangleAt({0, 2.0f, 0}, 0.5f, 0.5f)), 1.0f) << x;
        EXPECT_EQ(share({x, 0, 0}, pointAt({0, 2.1f, 0})), 0.0f) << x;
    }
    // Nor what is in front of a surface that lies within a sphere of light, but outside of it.
    EXPECT_EQ(share({0, 0, 0}, sphereAt({0, 0.5f, 0}, 1.0f)), 1.0f);
}

// --- Penumbra
// ------------------------------------------------------------------------------------

// A half-plane hides the part of the rectangle on one side of a line: the form factors of both.
TEST_F(NearVisibility, APenumbraOfARectangleHasTheShareOfItsVisiblePart) {
    build({planeMesh(4.0), strip(-50.0, 0.12, 1.0)});
    const NearEmitter emitter = rectangleAt({0.1f, 2.0f, 0.3f}, 0.5f, 0.4f);
    const auto formFactor = [&](float low, float high) {
        // In the frame of the surface, z its normal.
        const glm::vec3 a(low, -0.1f, 2), b(high, -0.1f, 2), c(high, 0.7f, 2), d(low, 0.7f, 2);
        return static_cast<double>(
            std::max(shading::quadFormFactor(a, b, c, d), shading::quadFormFactor(d, c, b, a)));
    };
    expectShare(formFactor(0.24f, 0.6f) / formFactor(-0.4f, 0.6f), emitter, 0.015);
}

// Irradiance is the area of the light's image on the hemisphere, projected to the surface
// (Nusselt): a disc of radius sin α, cut by the ellipse that the edge's plane makes.
TEST_F(NearVisibility, APenumbraOfASphereHasTheShareOfItsProjection) {
    for (const double edge : {0.0, 0.1, -0.15}) {
        build({planeMesh(4.0), strip(-50.0, edge, 1.0)});
        const double sine = 0.3, tilt = edge / std::hypot(edge, 1.0);
        double lit = 0.0;
        constexpr int kSteps = 20000;
        for (int i = 0; i < kSteps; ++i) {
            const double y = sine * (2.0 * (i + 0.5) / kSteps - 1.0);
            const double half = std::sqrt(sine * sine - y * y);
            lit += std::clamp(half - tilt * std::sqrt(1.0 - y * y), 0.0, 2.0 * half);
        }
        lit *= 2.0 * sine / kSteps;
        expectShare(lit / (kPi * sine * sine), sphereAt({0, 3, 0}, 0.9f), 0.015);
    }
}

// Light that passes a surface by chance does so in the mean, of points, too.
TEST_F(NearVisibility, ABlendedSurfaceLetsItsShareThrough) {
    BakeInputs inputs = sceneOf({planeMesh(4.0), strip(-2.0, 2.0, 1.0)});
    Mesh mapped = *inputs.meshes[1].mesh;
    mapped.uvs.assign(mapped.positions.size(), glm::vec2(0.0f));
    inputs.meshes[1].mesh = std::make_shared<const Mesh>(std::move(mapped));
    inputs.meshes[1].surface.alphaMode = AlphaMode::Blend;
    inputs.meshes[1].surface.opacity = 0.25f;
    build(inputs);
    std::vector<BakePoint> points;
    for (int i = 0; i < 200; ++i)
        points.push_back(point({-1.0f + 0.01f * float(i), 0, 0.1f}));
    for (const NearEmitter& emitter : {pointAt({0, 3, 0}), sphereAt({0, 3, 0}, 0.2f)}) {
        double mean = 0.0;
        for (const float s : shares(points, emitter)) {
            EXPECT_NEAR(s, 0.75f, 0.15f);
            mean += s / 200.0;
        }
        EXPECT_NEAR(mean, 0.75, 0.01);
    }
}

// --- Independence
// --------------------------------------------------------------------------------

TEST_F(NearVisibility, DependsOnNeitherThreadsNorRanges) {
    build({planeMesh(4.0), sphereMesh(1.0, 48, 24, {0, 1.2, 0})});
    std::vector<BakePoint> points;
    for (int i = 0; i < 40; ++i)
        for (int j = 0; j < 40; ++j)
            points.push_back(point({-3.9f + 0.2f * float(i), 0, -3.9f + 0.2f * float(j)}));
    for (const NearEmitter& emitter :
         {pointAt({1, 4, 0}), sphereAt({1, 4, 0}, 0.5f), rectangleAt({1, 4, 0}, 0.6f, 0.3f)}) {
        std::vector<float> alone;
        {
            const ThreadLimit one(1);
            alone = shares(points, emitter);
        }
        const ThreadLimit three(3);
        EXPECT_EQ(shares(points, emitter), alone);
        const auto tail = nearVisibility(scene(), std::span(points).subspan(777), emitter, {}, 777);
        ASSERT_TRUE(tail.ok());
        EXPECT_TRUE(std::equal(tail->begin(), tail->end(), alone.begin() + 777, alone.end()));
        EXPECT_GT(std::ranges::count(alone, 0.0f), 50);
        EXPECT_GT(std::ranges::count(alone, 1.0f), 500);
    }
}

TEST_F(NearVisibility, ACancelLeavesNothing) {
    build({planeMesh(4.0)});
    JobControl control;
    control.cancel();
    const std::vector<BakePoint> points(1000, point(glm::vec3(0.0f)));
    const auto result = nearVisibility(scene(), points, pointAt({0, 1, 0}), control.context());
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().kind, ErrorKind::Cancelled);
}

// --- Documents
// -----------------------------------------------------------------------------------

// A floor with a board over it, both under transfer, and two lights.
Document boardDocument() {
    Document document;
    auto bake = std::make_shared<BakeArtifact>();
    bake->kind = BakeKind::PrtVertex;
    bake->order = 1;
    for (Mesh mesh : {planeMesh(4.0, 16), strip(-1.0, 1.0, 1.0, 1.0)}) {
        MeshInstance instance;
        instance.id = document.takeId();
        instance.mesh = std::make_shared<const Mesh>(sanitized(std::move(mesh)));
        bake->vertices.push_back(
            {instance.id, 1, std::vector<float>(instance.mesh->vertexCount(), 0.1f), {}, {}, {}});
        document.meshes.push_back(instance);
    }
    document.bakes = {bake};
    for (const LightType type : {LightType::Point, LightType::Sphere, LightType::Directional}) {
        Light light;
        light.id = document.takeId();
        light.type = type;
        light.position = {0, 3, 0};
        document.lights.push_back(light);
    }
    return document;
}

NearShadowsPtr traced(const Document& document, const NearShadowsPtr& before = nullptr) {
    auto result = traceNearShadows(nearShadowRequest(document), before, 0, {});
    EXPECT_TRUE(result.ok());
    return result.ok() ? *result : nullptr;
}

TEST(NearShadows, HoldAShareForEachLightAndVertex) {
    const Document document = boardDocument();
    const NearShadowsPtr shadows = traced(document);
    ASSERT_TRUE(shadows);
    ASSERT_EQ(shadows->request.lights.size(), 2u); // a directional light is not local
    ASSERT_EQ(shadows->request.parts.size(), 2u);
    const MeshPtr& floor = document.meshes[0].mesh;
    for (const std::vector<NearShares>& ofLight : shadows->shares) {
        ASSERT_EQ(ofLight.size(), 2u);
        ASSERT_EQ(ofLight[0]->size(), floor->vertexCount());
        EXPECT_EQ(ofLight[0]->at(vertexAt(*floor, {0, 0, 0})), 0.0f);
        EXPECT_EQ(ofLight[0]->at(vertexAt(*floor, {0.5f, 0, 0.5f})), 0.0f);
        EXPECT_EQ(ofLight[0]->at(vertexAt(*floor, {3, 0, 0})), 1.0f);
        for (const float share : *ofLight[1]) // the board's upper side
            EXPECT_EQ(share, 1.0f);
    }
}

TEST(NearShadows, TraceWhatHasChangedAlone) {
    Document document = boardDocument();
    const NearShadowsPtr first = traced(document);
    document.lights[0].intensity = 7.0f; // of no concern for rays
    document.lights[0].range = 2.0f;
    document.materials.emplace_back().baseColor = {1, 0, 0};
    EXPECT_TRUE(nearShadowRequest(document) == first->request);
    document.lights[1].position.x = 1.0f;
    EXPECT_FALSE(nearShadowRequest(document) == first->request);
    const NearShadowsPtr second = traced(document, first);
    EXPECT_EQ(second->scene, first->scene);
    EXPECT_EQ(second->shares[0], first->shares[0]);
    EXPECT_NE(*second->shares[1][0], *first->shares[1][0]);
    EXPECT_EQ(*second->shares[1][0], *traced(document)->shares[1][0]);

    glm::vec3 board = document.meshes[1].placement.position();
    board.x = 2.5f;
    document.meshes[1].placement.setPosition(board);
    const NearShadowsPtr third = traced(document, second);
    EXPECT_NE(third->scene, second->scene);
    EXPECT_NE(*third->shares[0][0], *second->shares[0][0]);
    document.meshes[1].visible = false;
    const NearShadowsPtr fourth = traced(document, third);
    for (const float share : *fourth->shares[0][0])
        EXPECT_EQ(share, 1.0f);
    // Nothing under transfer, or no light: nothing to do.
    document.bakes.clear();
    EXPECT_TRUE(nearShadowRequest(document).empty());
    EXPECT_TRUE(traced(document)->shares.empty());
}

TEST(NearShadows, SayWhatTheyNeedWhereMemoryIsShort) {
    const NearShadowRequest request = nearShadowRequest(boardDocument());
    const auto refused = traceNearShadows(request, nullptr, 1000, {});
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().kind, ErrorKind::Usage);
    EXPECT_NE(refused.error().message.find("2 local lights"), std::string::npos);
    EXPECT_TRUE(traceNearShadows(request, nullptr, nearShadowBytes(request), {}).ok());
}

// A cube stands on the floor: vertices below it are dark, but the floor beside it, on the side of
// the light, is lit up to it, and on the other side dark.
TEST(NearShadows, AFloorIsLitUpToABoxThatStandsOnIt) {
    Document document = boardDocument();
    Mesh cube; // with edges, its bottom below the floor
    const Mesh round = cubeMesh(1.1);
    for (const std::uint32_t i : round.indices) {
        cube.indices.push_back(static_cast<std::uint32_t>(cube.positions.size()));
        cube.positions.push_back(round.positions[i] + glm::vec3(0.0f, 1.05f, 0.0f));
    }
    for (std::size_t i = 0; i < cube.positions.size(); ++i) {
        const glm::vec3* corner = cube.positions.data() + i / 3 * 3;
        cube.normals.push_back(
            glm::normalize(glm::cross(corner[1] - corner[0], corner[2] - corner[0])));
    }
    document.meshes[1].mesh = std::make_shared<const Mesh>(sanitized(std::move(cube)));
    document.lights[0].position = {-3.5f, 2.5f, 0.1f};
    const NearShadowsPtr shadows = traced(document);
    const MeshPtr& floor = document.meshes[0].mesh;
    const auto share = [&](float x, float z) {
        return shadows->shares[0][0]->at(vertexAt(*floor, {x, 0, z}));
    };
    EXPECT_EQ(share(-1.5f, 0.0f), 1.0f); // before the cube
    EXPECT_GT(share(-1.0f, 0.0f), 0.9f); // the first row below it
    EXPECT_EQ(share(0.0f, 0.0f), 0.0f);
    EXPECT_EQ(share(1.0f, 0.0f), 0.0f); // the last row below it
    EXPECT_EQ(share(1.5f, 0.0f), 0.0f);
}

// One point, as the picture has it: between vertices what these send out is interpolated.
TEST(NearShadows, OnePointSeesTheOpenLightTimesItsShares) {
    Document document = boardDocument();
    const NearShadowsPtr shadows = traced(document);
    const Id floor = document.meshes[0].id;
    const auto at = [&](const glm::vec3& place) {
        return nearLightAt(document, shadows, *nearestMeshPoint(document, floor, place));
    };
    const glm::vec3 lit(3.0f, 0.0f, 0.5f); // a vertex
    const NearLightAt open = at(lit);
    EXPECT_EQ(open.lights.size(), 2u);
    glm::vec3 expected(0.0f);
    for (const Light& light : document.lights)
        expected += openNearLight(light, lit, {0, 1, 0});
    EXPECT_GT(expected.x, 0.01f);
    EXPECT_LT(glm::distance(open.radiance, expected), 1e-5f * expected.x);
    EXPECT_EQ(at({0.3f, 0, 0.2f}).radiance, glm::vec3(0.0f));
    // Lux of a candela over the square of the distance, and its cosine.
    const glm::vec3 d = document.lights[0].position - lit;
    EXPECT_NEAR(openNearLight(document.lights[0], lit, {0, 1, 0}).x * float(kPi),
                3.0f * d.y / std::pow(glm::length(d), 3.0f), 1e-5f);
    document.lights[1].enabled = false;
    EXPECT_EQ(at(lit).lights, std::vector<Id>{document.lights[0].id});
    EXPECT_TRUE(
        nearLightAt(document, nullptr, *nearestMeshPoint(document, floor, lit)).lights.empty());
}

// Texels: the floor's texture, with gutters; two sides of a sheet that share their texels have
// none.
TEST(NearShadows, TexelsHaveSharesUnlessTheirPlacesFaceDifferentWays) {
    Document document = boardDocument();
    for (MeshInstance& instance : document.meshes) {
        Mesh mesh = *instance.mesh;
        mesh.uvs.clear();
        for (const glm::vec3& p : mesh.positions)
            mesh.uvs.push_back(
                {0.1f + 0.8f * (p.x + 4.0f) / 8.0f, 0.1f + 0.8f * (p.z + 4.0f) / 8.0f});
        instance.mesh = std::make_shared<const Mesh>(std::move(mesh));
        instance.material = document.takeId();
        document.materials.emplace_back().id = instance.material;
    }
    auto bake = std::make_shared<BakeArtifact>();
    bake->kind = BakeKind::PrtTexel;
    bake->order = 1;
    TexelBake texels;
    texels.material = document.meshes[0].material;
    texels.side = 64;
    texels.stride = 1;
    texels.values.assign(64 * 64, 0.1f);
    bake->texels = {texels};
    document.bakes.push_back(bake); // the board stays per vertex
    NearShadowsPtr shadows = traced(document);
    ASSERT_EQ(shadows->request.parts.size(), 2u);
    EXPECT_EQ(shadows->request.parts[0], (NearPart{texels.material, 64}));
    const std::vector<float>& shares = *shadows->shares[0][0];
    ASSERT_EQ(shares.size(), std::size_t{64 * 64});
    EXPECT_EQ(shares[32 * 64 + 32], 0.0f);
    EXPECT_EQ(shares[32 * 64 + 10], 1.0f);
    EXPECT_EQ(shares[5 * 64 + 4], 1.0f); // in the gutter
    EXPECT_EQ(shadows->note, "");

    // The same texels for a floor that faces down.
    MeshInstance below = document.meshes[0];
    below.id = document.takeId();
    Mesh turned = *below.mesh;
    for (glm::vec3& normal : turned.normals)
        normal = -normal;
    for (std::size_t i = 0; i < turned.indices.size(); i += 3)
        std::swap(turned.indices[i + 1], turned.indices[i + 2]);
    below.mesh = std::make_shared<const Mesh>(std::move(turned));
    glm::vec3 lower = below.placement.position();
    lower.y = -0.5f;
    below.placement.setPosition(lower);
    document.meshes.push_back(below);
    shadows = traced(document);
    EXPECT_LT(shadows->shares[0][0]->at(32 * 64 + 32), 0.0f);
    EXPECT_NE(shadows->note.find("On 100 % of the texels"), std::string::npos);
}

} // namespace
