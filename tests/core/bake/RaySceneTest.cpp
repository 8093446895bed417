#include "core/trace/RayScene.h"

#include "core/material/Material.h"
#include "core/math/Sampling.h"
#include "tests/core/bake/BakeTestScene.h"

#include <array>
#include <gtest/gtest.h>
#include <random>

using namespace patina;
using namespace patina::test;

namespace {

OcclusionRay rayFrom(const glm::vec3& origin, const glm::vec3& direction) {
    OcclusionRay ray;
    ray.origin = origin;
    ray.direction = direction;
    return ray;
}

} // namespace

TEST(RayScene, AgreesWithTheSphereEquationForAnyStreamLength) {
    // Radius 1 is the scene's unit already.
    const Result<BakeGeometry> geometry =
        makeBakeGeometry(sceneOf({sphereMesh(1.0, 256, 128)}), {});
    ASSERT_TRUE(geometry.ok());
    EXPECT_EQ(geometry->unitsPerMetre, 1.0);
    const Result<RayScene> scene = RayScene::build(*geometry, {});
    ASSERT_TRUE(scene.ok());
    EXPECT_GT(scene->memoryBytes(), 1'000'000u);
    std::mt19937 random(3);
    const auto number = [&] { return float(random() / 4294967296.0 * 4.0 - 2.0); };
    for (const std::size_t length : {1u, 7u, 31u, 32u, 333u, 2048u}) {
        std::vector<OcclusionRay> rays;
        for (std::size_t i = 0; i < length; ++i)
            rays.push_back(rayFrom({number(), number(), 3.0f}, {0, 0, -1}));
        const std::vector<OcclusionRay> before = rays;
        EXPECT_EQ(scene->occlude(rays), 0u);
        for (std::size_t i = 0; i < length; ++i) {
            const float r = std::hypot(before[i].origin.x, before[i].origin.y);
            if (std::abs(r - 1.0f) > 0.001f) {
                EXPECT_EQ(rays[i].occluded(), r < 1.0f) << r;
            }
        }
    }
}

TEST(RayScene, DistancesBoundTheRay) {
    const Result<BakeGeometry> geometry = makeBakeGeometry(sceneOf({sphereMesh(1.0)}), {});
    ASSERT_TRUE(geometry.ok());
    const Result<RayScene> scene = RayScene::build(*geometry, {});
    ASSERT_TRUE(scene.ok());
    std::vector<OcclusionRay> rays(3, rayFrom({0.1f, 0.1f, 3.0f}, {0, 0, -1}));
    rays[0].maxDistance = 1.5f; // ends before the sphere
    rays[1].maxDistance = 2.5f;
    rays[2].minDistance = 5.0f; // starts behind it
    EXPECT_EQ(scene->occlude(rays), 0u);
    EXPECT_FALSE(rays[0].occluded());
    EXPECT_TRUE(rays[1].occluded());
    EXPECT_FALSE(rays[2].occluded());
}

TEST(RayScene, RaysThatAreNotFiniteAreLeftOutAndTheRestIsAnswered) {
    const Result<BakeGeometry> geometry = makeBakeGeometry(sceneOf({sphereMesh(1.0)}), {});
    ASSERT_TRUE(geometry.ok());
    const Result<RayScene> scene = RayScene::build(*geometry, {});
    ASSERT_TRUE(scene.ok());
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float inf = std::numeric_limits<float>::infinity();
    for (const std::size_t repeats : {1u, 100u}) { // single rays and streams
        std::vector<OcclusionRay> rays;
        for (std::size_t i = 0; i < repeats; ++i) {
            rays.push_back(rayFrom({0.1f, 0.1f, 3}, {0, 0, -1}));
            rays.push_back(rayFrom({nan, 0, 3}, {0, 0, -1}));
            rays.push_back(rayFrom({0, 0, 3}, {0, inf, -1}));
            rays.push_back(rayFrom({0, -inf, 3}, {0, 0, -1}));
            rays.push_back(rayFrom({0, 0, 3}, {0, 0, 0}));
            rays.push_back(rayFrom({0, 0, 3}, {0, 0, -1}));
            rays.back().maxDistance = nan;
            rays.push_back(rayFrom({0, 0, 3}, {0, 0, -1}));
            rays.back().minDistance = nan;
        }
        EXPECT_EQ(scene->occlude(rays), 6 * repeats);
        for (std::size_t i = 0; i < rays.size(); ++i)
            EXPECT_EQ(rays[i].occluded(), i % 7 == 0) << i;
    }
}

TEST(RayScene, RefusedMemoryIsAnError) {
    const Result<BakeGeometry> geometry =
        makeBakeGeometry(sceneOf({sphereMesh(1.0, 256, 128)}), {});
    ASSERT_TRUE(geometry.ok());
    const Result<RayScene> scene = RayScene::build(*geometry, {}, 100'000);
    ASSERT_FALSE(scene.ok());
    EXPECT_EQ(scene.error().kind, ErrorKind::Internal);
    EXPECT_NE(scene.error().message.find("memory"), std::string::npos);
}

TEST(RayScene, ACancelledBuildSaysSo) {
    const Result<BakeGeometry> geometry = makeBakeGeometry(sceneOf({sphereMesh(1.0)}), {});
    ASSERT_TRUE(geometry.ok());
    JobControl control;
    control.cancel();
    const Result<RayScene> scene = RayScene::build(*geometry, control.context());
    ASSERT_FALSE(scene.ok());
    EXPECT_EQ(scene.error().kind, ErrorKind::Cancelled);
}

namespace {

// Two facing squares of side 2 at z = 0 (mesh 0) and z = -1 (mesh 1), their normals towards +z.
BakeInputs twoSquares() {
    const auto square = [](double z) {
        return gridMesh(
            1, 1, [=](double u, double v) { return glm::dvec3(2.0 * u - 1.0, 1.0 - 2.0 * v, z); });
    };
    return sceneOf({square(0.0), square(-1.0)});
}

ClosestRay closestFrom(const glm::vec3& origin, const glm::vec3& direction) {
    ClosestRay closest;
    closest.ray = rayFrom(origin, direction);
    return closest;
}

} // namespace

TEST(RayScene, TellsWhatARayMeetsFirstAndWhere) {
    const Result<BakeGeometry> geometry = makeBakeGeometry(twoSquares(), {});
    ASSERT_TRUE(geometry.ok());
    const Result<RayScene> scene = RayScene::build(*geometry, {});
    ASSERT_TRUE(scene.ok());
    std::mt19937 random(5);
    const auto number = [&] { return float(random() / 4294967296.0 * 3.0 - 1.5); };
    for (const std::size_t length : {1u, 31u, 32u, 500u}) {
        std::vector<ClosestRay> rays;
        for (std::size_t i = 0; i < length; ++i)
            rays.push_back(closestFrom({number(), number(), i % 2 == 0 ? 2.0f : -2.0f},
                                       {0, 0, i % 2 == 0 ? -1.0f : 1.0f}));
        EXPECT_EQ(scene->intersect(rays), 0u);
        for (std::size_t i = 0; i < length; ++i) {
            const glm::vec3 origin = rays[i].ray.origin;
            const bool inside = std::abs(origin.x) < 1.0f && std::abs(origin.y) < 1.0f;
            // The scene is centred on z = -0.5.
            ASSERT_EQ(rays[i].mesh, inside ? unsigned(i % 2) : ClosestRay::kNothing);
            if (!inside)
                continue;
            const BakeGeometryMesh& mesh = geometry->meshes[rays[i].mesh];
            const std::uint32_t* index = &mesh.mesh->indices[3 * std::size_t{rays[i].triangle}];
            const glm::vec3 p = (1.0f - rays[i].u - rays[i].v) * mesh.positions[index[0]] +
                                rays[i].u * mesh.positions[index[1]] +
                                rays[i].v * mesh.positions[index[2]];
            EXPECT_NEAR(p.x, origin.x, 1e-5f);
            EXPECT_NEAR(p.y, origin.y, 1e-5f);
        }
    }
    std::vector<ClosestRay> broken(40, closestFrom({0, 0, 2}, {0, 0, -1}));
    broken[7].ray.direction.x = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(scene->intersect(broken), 1u);
    EXPECT_EQ(broken[7].mesh, ClosestRay::kNothing);
    EXPECT_EQ(broken[8].mesh, 0u);
}

TEST(RayScene, MaskedSurfacesLetRaysThroughWhereTheyAreOpen) {
    BakeInputs inputs = twoSquares();
    // Left half open, right half solid; nearest to bilinear differ only near the border.
    auto image = std::make_shared<Image>(64, 1, 4, PixelType::U8, ColorEncoding::Srgb);
    for (std::size_t x = 0; x < 64; ++x)
        image->u8()[4 * x + 3] = x < 32 ? 0 : 255;
    Mesh front = *inputs.meshes[0].mesh;
    for (std::size_t i = 0; i < front.positions.size(); ++i)
        front.uvs[i] = {0.5f * (front.positions[i].x + 1.0f), 0.5f};
    inputs.meshes[0].mesh = std::make_shared<const Mesh>(front);
    inputs.meshes[0].surface.baseColorMap.image = image;
    inputs.meshes[0].surface.alphaMode = AlphaMode::Mask;
    inputs.meshes[1].transform =
        glm::translate(glm::mat4(1.0f), glm::vec3(0.0f, -5.0f, 0.0f)); // away: the front alone
    const auto trace = [&](std::size_t count) {
        const Result<BakeGeometry> geometry = makeBakeGeometry(inputs, {});
        const Result<RayScene> scene = RayScene::build(*geometry, {});
        const float unit = static_cast<float>(geometry->unitsPerMetre);
        const glm::vec3 middle =
            0.25f * (geometry->meshes[0].positions[0] + geometry->meshes[0].positions[1] +
                     geometry->meshes[0].positions[2] + geometry->meshes[0].positions[3]);
        std::vector<OcclusionRay> any;
        std::vector<ClosestRay> closest;
        for (std::size_t i = 0; i < count; ++i) {
            const float x = (static_cast<float>(i) + 0.5f) / static_cast<float>(count);
            const glm::vec3 origin =
                middle + unit * glm::vec3(1.9f * x - 0.95f, 0.8f * x - 0.35f, 0.5f);
            any.push_back(rayFrom(origin, glm::vec3(0, 0, -1)));
            closest.push_back(closestFrom(origin, glm::vec3(0, 0, -1)));
        }
        EXPECT_EQ(scene->occlude(any), 0u);
        EXPECT_EQ(scene->intersect(closest), 0u);
        std::vector<bool> solid;
        for (std::size_t i = 0; i < count; ++i) {
            solid.push_back(any[i].occluded());
            EXPECT_EQ(closest[i].mesh == 0u, any[i].occluded()) << i;
        }
        return solid;
    };
    for (const std::size_t count : {20u, 400u}) { // single rays and streams
        const std::vector<bool> solid = trace(count);
        for (std::size_t i = 0; i < count; ++i)
            EXPECT_EQ(solid[i], i >= count / 2) << i << " of " << count;
    }
    // Blended, at its ends.
    inputs.meshes[0].surface.baseColorMap = {};
    inputs.meshes[0].surface.alphaMode = AlphaMode::Blend;
    inputs.meshes[0].surface.opacity = 0.0f;
    for (const bool stopped : trace(100))
        EXPECT_FALSE(stopped);
    inputs.meshes[0].surface.opacity = 1.0f;
    for (const bool stopped : trace(100))
        EXPECT_TRUE(stopped);
}

// Layers let through what they would one after the other, wherever they lie and whatever mesh they
// belong to, and which rays they stop says nothing about where those were sent.
TEST(RayScene, LayersOfBlendedSurfacesLetThroughTheProduct) {
    const auto layer = [](double z) {
        return gridMesh(
            1, 1, [=](double u, double v) { return glm::dvec3(2.0 * u - 1.0, 1.0 - 2.0 * v, z); });
    };
    struct Layers {
        std::vector<float> opacities; // a mesh each
        double apart;                 // 0: coincident triangles
    };
    for (const Layers& layers :
         {Layers{{0.5f}, 0.0}, Layers{{0.5f, 0.5f}, 0.1}, Layers{{0.5f, 0.5f}, 0.0},
          Layers{{0.3f, 0.7f}, 0.1}, Layers{{0.5f, 0.5f, 0.5f, 0.5f}, 0.1},
          Layers{{0.2f, 0.5f, 0.4f, 0.3f}, 0.0}}) {
        SCOPED_TRACE(testing::PrintToString(layers.opacities));
        std::vector<Mesh> meshes;
        double expected = 1.0;
        for (std::size_t i = 0; i < layers.opacities.size(); ++i) {
            meshes.push_back(layer(layers.apart * static_cast<double>(i)));
            expected *= 1.0 - double{layers.opacities[i]};
        }
        BakeInputs inputs = sceneOf(meshes);
        for (std::size_t i = 0; i < meshes.size(); ++i) {
            inputs.meshes[i].surface.alphaMode = AlphaMode::Blend;
            inputs.meshes[i].surface.opacity = layers.opacities[i];
        }
        const Result<BakeGeometry> geometry = makeBakeGeometry(inputs, {});
        ASSERT_TRUE(geometry.ok());
        const Result<RayScene> scene = RayScene::build(*geometry, {});
        ASSERT_TRUE(scene.ok());
        constexpr std::uint32_t kRays = 1u << 16;
        constexpr int kBins = 8; // of either number that a ray was sent by
        std::vector<OcclusionRay> any;
        std::vector<ClosestRay> closest;
        std::vector<glm::vec2> sent;
        for (std::uint32_t i = 0; i < kRays; ++i) {
            sent.push_back(sobolOwen2D(i, 7));
            const glm::vec3 origin(1.6f * sent[i].x - 0.8f, 1.6f * sent[i].y - 0.8f, 3.0f);
            any.push_back(rayFrom(origin, {0, 0, -1}));
            closest.push_back(closestFrom(origin, {0, 0, -1}));
        }
        EXPECT_EQ(scene->occlude(any), 0u);
        EXPECT_EQ(scene->intersect(closest), 0u);
        std::array<double, kBins * kBins> through{};
        double all = 0.0;
        for (std::uint32_t i = 0; i < kRays; ++i) {
            ASSERT_EQ(closest[i].mesh == ClosestRay::kNothing, !any[i].occluded());
            if (any[i].occluded())
                continue;
            all += 1.0;
            through[static_cast<std::size_t>(sent[i].x * kBins) * kBins +
                    static_cast<std::size_t>(sent[i].y * kBins)] += 1.0;
        }
        const double deviation = std::sqrt(expected * (1.0 - expected) / kRays);
        EXPECT_NEAR(all / kRays, expected, 4.0 * deviation);
        // χ² of 64 cells, in which Sobol's points are as many each: 63 or 64 of freedom, of which
        // 104.7 is exceeded once in a thousand.
        double chi2 = 0.0;
        for (const double cell : through) {
            const double mean = expected * kRays / (kBins * kBins);
            chi2 += (cell - mean) * (cell - mean) / (mean * (1.0 - expected));
        }
        EXPECT_LT(chi2, 104.7);
    }
}

TEST(RayScene, BlendedSurfacesStopAsManyRaysAsTheyAreOpaque) {
    BakeInputs inputs = twoSquares();
    inputs.meshes[0].surface.alphaMode = AlphaMode::Blend;
    inputs.meshes[0].surface.opacity = 0.3f;
    inputs.meshes.pop_back();
    const Result<BakeGeometry> geometry = makeBakeGeometry(inputs, {});
    ASSERT_TRUE(geometry.ok());
    const Result<RayScene> scene = RayScene::build(*geometry, {});
    ASSERT_TRUE(scene.ok());
    std::mt19937 random(9);
    const auto number = [&] { return float(random() / 4294967296.0 - 0.5); };
    std::vector<OcclusionRay> rays;
    for (int i = 0; i < 20000; ++i)
        rays.push_back(rayFrom({0.5f * number(), 0.5f * number(), 1.0f},
                               glm::normalize(glm::vec3(0.5f * number(), 0.5f * number(), -1.0f))));
    EXPECT_EQ(scene->occlude(rays), 0u);
    const auto stopped = std::count_if(rays.begin(), rays.end(),
                                       [](const OcclusionRay& ray) { return ray.occluded(); });
    EXPECT_NEAR(double(stopped) / 20000.0, 0.3, 3.0 * std::sqrt(0.3 * 0.7 / 20000.0));
}
