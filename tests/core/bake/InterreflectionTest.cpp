// Bounces against closed forms: inside a sphere every point lights every other alike, so that
// interreflection there is a geometric series in every band (integrating sphere; see
// docs/maths/baking.md).
#include "core/bake/bounce/Interreflection.h"
#include "core/bake/Bake.h"
#include "core/bake/domain/BakeOptions.h"
#include "core/job/Parallel.h"
#include "core/library/Meshes.h"
#include "core/material/Material.h"
#include "core/math/Shading.h"
#include "tests/core/bake/BakeTestScene.h"

#include <gtest/gtest.h>
#include <numbers>
#include <random>

using namespace patina;
using namespace patina::test;

namespace {

constexpr double kY00 = 0.28209479177387814;

PrtSettings bouncing(int order, int bounces, int bounceSamples, int samples = 256) {
    PrtSettings settings;
    settings.order = order;
    settings.samples = samples;
    settings.transfer = TransferKind::Interreflected;
    settings.bounces = bounces;
    settings.bounceSamples = bounceSamples;
    settings.fitted = false;
    return settings;
}

BakeArtifact bake(const BakeInputs& inputs, const PrtSettings& settings) {
    TileSink sink;
    Result<BakeArtifact> artifact = bakePrtVertex(inputs, settings, sink, {});
    EXPECT_TRUE(artifact.ok()) << (artifact.ok() ? "" : artifact.error().text());
    return artifact ? std::move(*artifact) : BakeArtifact{};
}

BakeInputs withAlbedo(BakeInputs inputs, const glm::vec3& albedo) {
    for (BakeMesh& mesh : inputs.meshes)
        mesh.surface.baseColor = albedo;
    return inputs;
}

// Looking in from all sides: faces and normals point to the centre.
Mesh insideOf(Mesh sphere) {
    for (std::size_t i = 0; i < sphere.indices.size(); i += 3)
        std::swap(sphere.indices[i + 1], sphere.indices[i + 2]);
    sphere.normals.clear();
    for (const glm::vec3& position : sphere.positions)
        sphere.normals.push_back(-glm::normalize(position));
    return sphere;
}

// Area-weighted means over the surface of a sphere about the origin, of every coefficient.
std::vector<double> sphereMean(const Mesh& mesh, std::span<const float> values,
                               std::size_t stride) {
    std::vector<double> sum(stride, 0.0);
    double area = 0.0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const std::uint32_t* v = &mesh.indices[i];
        const double a = glm::length(glm::cross(mesh.positions[v[1]] - mesh.positions[v[0]],
                                                mesh.positions[v[2]] - mesh.positions[v[0]]));
        area += a;
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t k = 0; k < stride; ++k)
                sum[k] += a / 3.0 * values[v[c] * stride + k];
    }
    for (double& s : sum)
        s /= area;
    return sum;
}

} // namespace

// White surfaces in white light: nothing is brighter than that, on however coarse a mesh, and
// little is lost.
TEST(Interreflection, AWhiteFurnaceGrowsNoBrighter) {
    struct Case {
        int segments, sides;
    };
    for (const auto& [segments, sides] : {Case{24, 5}, {40, 6}, {80, 8}, {160, 24}, {256, 40}})
        for (const bool fitted : {true, false}) {
            const auto mesh = std::make_shared<const Mesh>(library::makeTorusKnot(segments, sides));
            BakeInputs inputs;
            BakeMesh& only = inputs.meshes.emplace_back();
            only.id = 1;
            only.mesh = mesh;
            only.surface.baseColor = glm::vec3(1.0f);
            PrtSettings settings = bouncing(3, 16, 64);
            settings.fitted = fitted;
            const BakeArtifact artifact = bake(inputs, settings);
            const VertexBake& values = artifact.vertices.at(0);
            double most = 0.0, sum = 0.0, area = 0.0;
            const auto at = [&](std::uint32_t v) {
                return (static_cast<double>(values.values[9 * v]) +
                        static_cast<double>(values.bounced[3 * 9 * v + 1])) /
                       kY00;
            };
            for (std::size_t i = 0; i < mesh->indices.size(); i += 3) {
                const std::uint32_t* v = &mesh->indices[i];
                const double a =
                    glm::length(glm::cross(mesh->positions[v[1]] - mesh->positions[v[0]],
                                           mesh->positions[v[2]] - mesh->positions[v[0]]));
                for (int c = 0; c < 3; ++c)
                    most = std::max(most, at(v[c]));
                sum += a * (at(v[0]) + at(v[1]) + at(v[2])) / 3.0;
                area += a;
            }
            EXPECT_LE(most, 1.005) << segments << " × " << sides << (fitted ? ", fitted" : "");
            EXPECT_NEAR(sum / area, 1.0, 0.01)
                << segments << " × " << sides << (fitted ? ", fitted" : "");
        }
}

// The bowl opens to +Y. With zonal axis y, the light of the opening is Σ_l a_l / 2 on the average
// point, and its form factor to itself 1/2: bounce n adds ρ a_l / 4 · (ρ/2)^(n-1) to irradiance,
// a_l the coefficients of the clamped cosine. Divided by π it is the transfer to exit radiance.
TEST(Interreflection, TheBowlsSeriesHoldsInEveryBandAtEveryPoint) {
    const BakeInputs inputs = withAlbedo(sceneOf({bowlMesh(64, 32)}), {0.25f, 0.5f, 1.0f});
    constexpr int kOrder = 5;
    // ∫ max(0, cos) Y_l0 about the axis, l = 0 … 4.
    constexpr double a[] = {0.886226925453, 1.02332670795, 0.495415912201, 0.0, -0.110778365682};
    const Mesh& mesh = *inputs.meshes[0].mesh;
    for (const int bounces : {1, 2, 12}) {
        const BakeArtifact artifact = bake(inputs, bouncing(kOrder, bounces, 256));
        ASSERT_EQ(artifact.vertices.size(), 1u);
        EXPECT_EQ(artifact.bounces, bounces);
        EXPECT_EQ(artifact.transfer, TransferKind::Interreflected);
        EXPECT_EQ(artifact.albedo, hashBakeAlbedo(inputs));
        const std::vector<float>& bounced = artifact.vertices[0].bounced;
        ASSERT_EQ(bounced.size(), mesh.vertexCount() * 3 * kOrder * kOrder);
        // Harmonics of the axis: Y_lm(+y) / Y_l0(+z) spreads a zonal function of z over the m.
        float axis[25];
        shading::shBasis25(glm::vec3(0, 1, 0), axis);
        const double rho[] = {0.25, 0.5, 1.0};
        std::vector<double> worst(25, 0.0);
        const std::vector<double> mean = sphereMean(mesh, bounced, 75);
        for (int c = 0; c < 3; ++c) {
            const double half = rho[c] / 2.0;
            const double series = rho[c] / 4.0 * (1.0 - std::pow(half, bounces)) / (1.0 - half);
            for (int l = 0; l < kOrder; ++l)
                for (int m = -l; m <= l; ++m) {
                    const int i = l * (l + 1) + m;
                    const double zonal = std::sqrt((2 * l + 1) / (4.0 * std::numbers::pi));
                    const double expected = series * a[l] * axis[i] / zonal / std::numbers::pi;
                    const double scale = series * a[0] / std::numbers::pi;
                    EXPECT_NEAR(mean[std::size_t(3 * i + c)], expected, 0.01 * scale)
                        << "l " << l << " m " << m << " channel " << c;
                    for (std::size_t v = 0; v < mesh.vertexCount(); ++v)
                        EXPECT_NEAR(bounced[v * 75 + std::size_t(3 * i + c)], expected,
                                    0.12 * scale)
                            << "vertex " << v;
                }
        }
    }
}

// Under a uniform sky of radiance 1 the bowl shows ρ/2 directly and ρ / (2 - ρ) at last: a white
// one, 1, as bright as the sky.
TEST(Interreflection, AWhiteBowlUnderAUniformSkyBecomesTheSky) {
    const BakeInputs inputs = withAlbedo(sceneOf({bowlMesh(64, 32)}), {1.0f, 0.8f, 0.5f});
    const BakeArtifact artifact = bake(inputs, bouncing(1, 64, 256, 1024));
    const double light = 1.0 / kY00; // L_00 of radiance 1
    const std::vector<double> direct =
        sphereMean(*inputs.meshes[0].mesh, artifact.vertices[0].values, 1);
    const std::vector<double> bounced =
        sphereMean(*inputs.meshes[0].mesh, artifact.vertices[0].bounced, 3);
    EXPECT_NEAR(1.0 * light * (direct[0] + bounced[0]), 1.0, 0.01);
    EXPECT_NEAR(0.8 * light * (direct[0] + bounced[1]), 0.8 / 1.2, 0.006);
    EXPECT_NEAR(0.5 * light * (direct[0] + bounced[2]), 0.5 / 1.5, 0.003);
}

// A closed diffuse sphere: with direct light e everywhere, k bounces make
// e (ρ + … + ρ^k), whatever is where.
TEST(Interreflection, AClosedSphereIsAGeometricSeriesInEachBounce) {
    const BakeInputs inputs =
        withAlbedo(sceneOf({insideOf(sphereMesh(1.0, 48, 24))}), {0.2f, 0.5f, 0.8f});
    const Result<BakeGeometry> geometry = makeBakeGeometry(inputs, {});
    ASSERT_TRUE(geometry.ok());
    const Result<RayScene> scene = RayScene::build(*geometry, {});
    ASSERT_TRUE(scene.ok());
    const Result<HitSourcePtr> hits = traceHits(*scene, *geometry, bouncing(1, 1, 64), {});
    ASSERT_TRUE(hits.ok());
    BounceSolver solver(*hits);
    solver.setSurfaces(surfacesOf((*hits)->elements(), inputs), {});
    const std::vector<glm::vec3> direct((*hits)->elements().fronts(), glm::vec3(1.0f));
    // e (1 - ρ^(n+1)) / (1 - ρ) - e after n bounces.
    const double after[][3] = {{0.2, 0.5, 0.8},
                               {0.24, 0.75, 1.44},
                               {0.248, 0.875, 1.952},
                               {0.2496, 0.9375, 2.3616},
                               {0.24992, 0.96875, 2.68928}};
    for (int n = 1; n <= 5; ++n) {
        const Result<std::vector<glm::vec3>> bounced = solver.solveLight(direct, {}, n, {});
        ASSERT_TRUE(bounced.ok());
        for (const glm::vec3& b : *bounced)
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(b[c], after[n - 1][c], 2e-5) << n << " bounces";
    }
    // No ray leaves: 8 bytes for each.
    const auto* cache = dynamic_cast<const HitCache*>(hits->get());
    ASSERT_NE(cache, nullptr);
    EXPECT_EQ(cache->hitBytes(), (*hits)->elements().fronts() * 64 * 8);
}

// An integrating sphere with a port of a share f of its surface: indirect light is
// ρ (1 - f) / (1 - ρ (1 - f)) of the first reflection's … of uniform direct light on the wall.
TEST(Interreflection, APortLetsItsShareOfTheLightOut) {
    // Polar cap cut at the height where 5 % of the area is missing.
    const double top = std::acos(1.0 - 2.0 * 0.05);
    Mesh mesh = gridMesh(48, 32, [=](double u, double v) {
        const double phi = 2 * kPi * wrapped(u), theta = top + (kPi - top) * v;
        return glm::dvec3(std::sin(theta) * std::sin(phi), std::cos(theta),
                          std::sin(theta) * std::cos(phi));
    });
    for (const glm::vec3& position : mesh.positions)
        mesh.normals.push_back(-glm::normalize(position));
    const BakeInputs inputs = withAlbedo(sceneOf({mesh}), {0.5f, 0.9f, 0.98f});
    const Result<BakeGeometry> geometry = makeBakeGeometry(inputs, {});
    const Result<RayScene> scene = RayScene::build(*geometry, {});
    const Result<HitSourcePtr> hits = traceHits(*scene, *geometry, bouncing(1, 1, 256), {});
    ASSERT_TRUE(hits.ok());
    BounceSolver solver(*hits);
    solver.setSurfaces(surfacesOf((*hits)->elements(), inputs), {});
    const std::vector<glm::vec3> direct((*hits)->elements().fronts(), glm::vec3(1.0f));
    const Result<std::vector<glm::vec3>> bounced = solver.solveLight(direct, {}, 200, {});
    ASSERT_TRUE(bounced.ok());
    std::vector<float> flat;
    for (const glm::vec3& b : *bounced)
        flat.insert(flat.end(), {b.r, b.g, b.b});
    const std::vector<double> mean = sphereMean(*inputs.meshes[0].mesh, flat, 3);
    // Goebel 1967: the multiplier M = ρ / (1 - ρ (1 - f)); the wall's own first light not counted,
    // the rest is (1 - f) M.
    const double multiplier[] = {0.952380952381, 6.20689655172, 14.2028985507};
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(mean[std::size_t(c)] / (0.95 * multiplier[c]), 1.0, 0.01) << c;
}

// Solving for the light shown is solving for all coefficients, and then lighting.
TEST(Interreflection, TheLightShownAgreesWithTheFullCoefficients) {
    BakeInputs inputs = sceneOf({planeMesh(2.0, 12), sphereMesh(0.5, 24, 12, {0, 0.6, 0})});
    inputs.meshes[0].surface.baseColor = {0.9f, 0.1f, 0.3f};
    inputs.meshes[1].surface.baseColor = {0.2f, 0.7f, 0.5f};
    inputs.meshes[1].doubleSided = true;
    const Result<BakeGeometry> geometry = makeBakeGeometry(inputs, {});
    const Result<RayScene> scene = RayScene::build(*geometry, {});
    for (const int order : {1, 2, 3, 4}) {
        const PrtSettings settings = bouncing(order, 3, 64);
        const BakeArtifact artifact = bake(inputs, settings);
        const Result<HitSourcePtr> hits = traceHits(*scene, *geometry, settings, {});
        BounceSolver solver(*hits);
        solver.setSurfaces(surfacesOf((*hits)->elements(), inputs), {});
        solver.setOpen(openness(*directTransfer((*hits)->elements(), artifact), order));
        std::mt19937 random(11);
        std::vector<glm::vec3> light;
        for (int i = 0; i < order * order; ++i)
            light.emplace_back(random() / 4294967296.0, random() / 4294967296.0,
                               random() / 4294967296.0);
        std::vector<glm::vec3> direct;
        for (const VertexBake& mesh : artifact.vertices)
            for (std::size_t v = 0; v < mesh.values.size(); v += light.size()) {
                glm::vec3 sum(0.0f);
                for (std::size_t i = 0; i < light.size(); ++i)
                    sum += mesh.values[v + i] * light[i];
                direct.push_back(sum);
            }
        const Result<std::vector<glm::vec3>> shown = solver.solveLight(direct, light, 3, {});
        ASSERT_TRUE(shown.ok());
        std::size_t element = 0;
        for (const VertexBake& mesh : artifact.vertices)
            for (std::size_t v = 0; v < mesh.bounced.size(); v += 3 * light.size(), ++element)
                for (int c = 0; c < 3; ++c) {
                    float sum = 0.0f;
                    for (std::size_t i = 0; i < light.size(); ++i)
                        sum += mesh.bounced[v + 3 * i + std::size_t(c)] * light[i][c];
                    ASSERT_NEAR((*shown)[element][c], sum, 2e-5f) << element;
                }
        EXPECT_EQ(element, shown->size());
    }
}

// Two facing unit squares at distance 1: F = 0.1998248957. Light that falls on one only (radiance
// transfer 1) lends the other F ρ; and as much the other way round (reciprocity).
TEST(Interreflection, FacingSquaresExchangeTheirFormFactor) {
    const auto square = [](double y, bool up) {
        Mesh mesh = gridMesh(16, 16, [=](double u, double v) {
            return glm::dvec3(u - 0.5, y, up ? 0.5 - v : v - 0.5);
        });
        for (std::size_t i = 0; i < mesh.positions.size(); ++i)
            mesh.normals.push_back({0, up ? 1 : -1, 0});
        return mesh;
    };
    BakeInputs inputs = sceneOf({square(0, true), square(1, false)});
    inputs.meshes[0].surface.baseColor = {0.5f, 1.0f, 0.25f};
    inputs.meshes[1].surface.baseColor = {0.75f, 1.0f, 1.0f};
    const Result<BakeGeometry> geometry = makeBakeGeometry(inputs, {});
    const Result<RayScene> scene = RayScene::build(*geometry, {});
    const Result<HitSourcePtr> hits = traceHits(*scene, *geometry, bouncing(1, 1, 256), {});
    ASSERT_TRUE(hits.ok());
    BounceSolver solver(*hits);
    solver.setSurfaces(surfacesOf((*hits)->elements(), inputs), {});
    const std::size_t half = (*hits)->elements().fronts() / 2;
    const auto received = [&](bool byLower) {
        std::vector<glm::vec3> direct(2 * half, glm::vec3(0.0f));
        for (std::size_t i = 0; i < half; ++i)
            direct[(byLower ? 0 : half) + i] = glm::vec3(1.0f);
        const Result<std::vector<glm::vec3>> bounced = solver.solveLight(direct, {}, 1, {});
        // Mean over the other square: interior vertices count four times those of corners.
        glm::dvec3 sum(0.0);
        double weight = 0.0;
        for (std::size_t i = 0; i < half; ++i) {
            const glm::vec3 p = inputs.meshes[0].mesh->positions[i];
            const double w = (std::abs(std::abs(p.x) - 0.5) < 1e-4 ? 0.5 : 1.0) *
                             (std::abs(std::abs(p.z) - 0.5) < 1e-4 ? 0.5 : 1.0);
            sum += w * glm::dvec3((*bounced)[(byLower ? half : 0) + i]);
            weight += w;
        }
        return sum / weight;
    };
    constexpr double kFormFactor = 0.1998248957;
    const glm::dvec3 up = received(true), down = received(false);
    EXPECT_NEAR(up.r, 0.5 * kFormFactor, 0.002);
    EXPECT_NEAR(up.g, 1.0 * kFormFactor, 0.004);
    EXPECT_NEAR(up.b, 0.25 * kFormFactor, 0.001);
    EXPECT_NEAR(down.r, 0.75 * kFormFactor, 0.003);
    EXPECT_NEAR(up.g, down.g, 0.002);
}

// Nothing is brighter than the environment: in the open, T + B under a uniform sky is at most 1
// with white surfaces, and light that is lost is lost.
TEST(Interreflection, EnergyNeverGrows) {
    const BakeInputs inputs =
        withAlbedo(sceneOf({planeMesh(2.0, 10), torusMesh(0.5, 0.2, 32, 16)}), glm::vec3(1.0f));
    const BakeArtifact artifact = bake(inputs, bouncing(1, 64, 256, 1024));
    double brightest = 0.0, dimmest = 1.0;
    for (const VertexBake& mesh : artifact.vertices)
        for (std::size_t v = 0; v < mesh.values.size(); ++v) {
            const double shown = (mesh.values[v] + mesh.bounced[3 * v]) / kY00;
            brightest = std::max(brightest, shown);
            dimmest = std::min(dimmest, shown);
            EXPECT_GE(mesh.bounced[3 * v], 0.0f);
        }
    EXPECT_LE(brightest, 1.02);
    EXPECT_GE(dimmest, 0.0);
}

// The back of a one-sided surface absorbs; that of a two-sided one reflects what falls on it.
TEST(Interreflection, OnlyTwoSidedSurfacesReflectWithTheirBacks) {
    // A floor of no size under a large lid whose front points up, to the sky.
    Mesh lid = planeMesh(20.0, 2), floor = planeMesh(0.02, 1);
    for (glm::vec3& position : lid.positions)
        position.y += 0.5f;
    BakeInputs inputs = withAlbedo(sceneOf({floor, lid}), glm::vec3(0.5f));
    const auto bounced = [&] {
        const Result<BakeGeometry> geometry = makeBakeGeometry(inputs, {});
        const Result<RayScene> scene = RayScene::build(*geometry, {});
        const Result<HitSourcePtr> hits = traceHits(*scene, *geometry, bouncing(2, 1, 256), {});
        BounceSolver solver(*hits);
        solver.setSurfaces(surfacesOf((*hits)->elements(), inputs), {});
        const std::vector<glm::vec3> direct((*hits)->elements().fronts(), glm::vec3(7.0f));
        // Radiance 1 everywhere, as coefficients: the lid's back sees the lower half of it.
        const glm::vec3 one(float(1.0 / kY00)), none(0.0f);
        const std::vector<glm::vec3> light{one, none, none, none};
        return (*solver.solveLight(direct, light, 1, {}))[0];
    };
    EXPECT_EQ(bounced(), glm::vec3(0.0f));
    inputs.meshes[1].doubleSided = true;
    // The back's direct transfer is 1 (the floor hides nothing), not the front's 7.
    EXPECT_NEAR(bounced().r, 0.5, 0.01);
}

// Albedo comes from the map where a ray ends.
TEST(Interreflection, MapsColourTheLightThatTheyReflect) {
    // A floor point looks up at a lid: red where x < 0, blue where x > 0.
    Mesh lid = gridMesh(2, 2, [](double u, double v) {
        return glm::dvec3(40.0 * (u - 0.5), 1.0, 40.0 * (v - 0.5));
    });
    for (std::size_t i = 0; i < lid.positions.size(); ++i) {
        lid.normals.push_back({0, -1, 0});
        lid.uvs.push_back({lid.positions[i].x / 40.0f + 0.5f, 0.5f});
    }
    BakeInputs inputs = sceneOf({planeMesh(0.02, 1), lid});
    auto image = std::make_shared<Image>(2, 1, 3, PixelType::U8, ColorEncoding::Srgb);
    image->u8()[0] = 255;
    image->u8()[5] = 255;
    inputs.meshes[1].surface.baseColor = {0.5f, 0.5f, 0.25f};
    inputs.meshes[1].surface.baseColorMap.image = image;
    const Result<BakeGeometry> geometry = makeBakeGeometry(inputs, {});
    const Result<RayScene> scene = RayScene::build(*geometry, {});
    for (const bool kept : {true, false}) {
        PrtSettings settings = bouncing(1, 1, 256);
        if (!kept)
            settings.hitBudget = 0;
        const Result<HitSourcePtr> hits = traceHits(*scene, *geometry, settings, {});
        ASSERT_EQ((*hits)->kept(), kept);
        BounceSolver solver(*hits);
        const std::vector<glm::vec3> direct((*hits)->elements().fronts(), glm::vec3(1.0f));
        const auto shown = [&] {
            solver.setSurfaces(surfacesOf((*hits)->elements(), inputs), {});
            return (*solver.solveLight(direct, {}, 1, {}))[0];
        };
        const glm::vec3 both = shown();
        EXPECT_NEAR(both.r, 0.25f, 0.005f);
        EXPECT_EQ(both.g, 0.0f);
        EXPECT_NEAR(both.b, 0.125f, 0.005f);
        // Edits follow: the factor, the map's place, another map, none.
        inputs.meshes[1].surface.baseColor = {0.1f, 0.5f, 0.0f};
        EXPECT_NEAR(shown().r, 0.05f, 0.001f);
        inputs.meshes[1].surface.baseColorMap.uvScale.x = 0.0f; // all of it red
        EXPECT_NEAR(shown().r, 0.1f, 0.001f);
        inputs.meshes[1].surface.baseColorMap.uvScale.x = 1.0f;
        inputs.meshes[1].surface.baseColorMap.image = nullptr;
        EXPECT_NEAR(shown().g, 0.5f, 0.003f); // the lid is finite
        inputs.meshes[1].surface.metallic = 1.0f;
        EXPECT_EQ(shown(), glm::vec3(0.0f));
        inputs.meshes[1].surface.metallic = 0.0f;
        inputs.meshes[1].surface.baseColor = {0.5f, 0.5f, 0.25f};
        inputs.meshes[1].surface.baseColorMap.image = image;
    }
}

// Light falls through the holes of a masked surface, directly and by way of others.
TEST(Interreflection, MaskedSurfacesLetLightThrough) {
    Mesh lid = planeMesh(20.0, 1), floor = planeMesh(0.02, 1);
    for (std::size_t i = 0; i < lid.positions.size(); ++i) {
        lid.positions[i].y += 0.2f;
        lid.uvs.push_back({lid.positions[i].x * 8.0f, 0.5f});
    }
    BakeInputs inputs = sceneOf({floor, lid});
    // A quarter of every 32 texels is solid.
    auto image = std::make_shared<Image>(32, 1, 4, PixelType::U8, ColorEncoding::Srgb);
    for (std::size_t i = 0; i < 32; ++i)
        image->u8()[4 * i + 3] = i < 8 ? 255 : 0;
    inputs.meshes[1].surface.baseColorMap.image = image;
    const auto open = [&] {
        return bake(inputs, bouncing(1, 1, 64, 4096)).vertices[0].values[0] / kY00;
    };
    EXPECT_NEAR(open(), 0.0, 1e-3);
    inputs.meshes[1].surface.alphaMode = AlphaMode::Mask;
    EXPECT_NEAR(open(), 0.75, 0.02);
    inputs.meshes[1].surface.alphaMode = AlphaMode::Blend;
    inputs.meshes[1].surface.baseColorMap.image = nullptr;
    inputs.meshes[1].surface.opacity = 0.4f;
    EXPECT_NEAR(open(), 0.6, 0.03);
}

TEST(Interreflection, ResultsAreTheSameForAnyThreadCountAndWithoutACache) {
    BakeInputs inputs = sceneOf({planeMesh(2.0, 16), sphereMesh(0.5, 24, 12, {0, 0.6, 0})});
    inputs.meshes[1].doubleSided = true;
    PrtSettings settings = bouncing(3, 2, 16, 32);
    const BakeArtifact reference = bake(inputs, settings);
    ASSERT_FALSE(reference.vertices.empty());
    for (const int threads : {1, 2, 7}) {
        const ThreadLimit limit(threads);
        EXPECT_EQ(bake(inputs, settings), reference) << threads;
    }
    settings.hitBudget = 0;
    EXPECT_EQ(bake(inputs, settings), reference);
}

TEST(Interreflection, HitsAreHandedOverOnceWhenTheyAreKept) {
    struct HitSink : TileSink {
        int calls = 0;
        HitSourcePtr last;
        void hits(const HitSourcePtr& hits) override {
            ++calls;
            last = hits;
        }
    };
    const BakeInputs inputs = sceneOf({planeMesh(2.0, 4), sphereMesh(0.5, 12, 6, {0, 0.6, 0})});
    PrtSettings settings = bouncing(2, 2, 50, 32);
    HitSink sink;
    const Result<BakeArtifact> artifact = bakePrtVertex(inputs, settings, sink, {});
    ASSERT_TRUE(artifact.ok());
    EXPECT_EQ(sink.calls, 1);
    ASSERT_NE(sink.last, nullptr);
    EXPECT_EQ(sink.last->settings().samples, 64); // rounded up
    // They are those that were used.
    BounceSolver solver(sink.last);
    solver.setSurfaces(surfacesOf(sink.last->elements(), inputs), {});
    solver.setOpen(openness(*directTransfer(sink.last->elements(), *artifact), 2));
    BakeArtifact again = *artifact;
    setBounced(again, sink.last->elements(),
               *solver.solve(*directTransfer(sink.last->elements(), again), 2, {}));
    EXPECT_EQ(again, *artifact);
    settings.hitBudget = 0;
    (void)bakePrtVertex(inputs, settings, sink, {});
    settings.transfer = TransferKind::Shadowed;
    const Result<BakeArtifact> shadowed = bakePrtVertex(inputs, settings, sink, {});
    EXPECT_EQ(sink.calls, 1);
    EXPECT_TRUE(shadowed->vertices[0].bounced.empty());
    // Of other meshes there is nothing to start from.
    BakeArtifact other = *artifact;
    other.vertices[0].mesh = 99;
    EXPECT_FALSE(directTransfer(sink.last->elements(), other).has_value());
}

TEST(Interreflection, SettingsOutOfRangeAreRefusedBeforeAnyRay) {
    const BakeInputs inputs = sceneOf({planeMesh(2.0, 4)});
    TileSink sink;
    for (const auto& [bounces, samples] : {std::pair(0, 64), std::pair(65, 64), std::pair(3, 0)}) {
        const Result<BakeArtifact> artifact =
            bakePrtVertex(inputs, bouncing(2, bounces, samples), sink, {});
        ASSERT_FALSE(artifact.ok());
        EXPECT_EQ(artifact.error().kind, ErrorKind::Usage);
    }
    const Result<BakeArtifact> texels = bakePrtTexel(inputs, bouncing(2, 0, 64), sink, {});
    ASSERT_FALSE(texels.ok());
    EXPECT_EQ(texels.error().kind, ErrorKind::Usage);
}

TEST(Interreflection, CancelLeavesNothing) {
    const BakeInputs inputs = sceneOf({planeMesh(2.0, 32)});
    struct CancelSink : TileSink {
        JobControl control;
        void hits(const HitSourcePtr&) override { control.cancel(); }
    } sink;
    const Result<BakeArtifact> artifact =
        bakePrtVertex(inputs, bouncing(2, 3, 64, 32), sink, sink.control.context());
    ASSERT_FALSE(artifact.ok());
    EXPECT_EQ(artifact.error().kind, ErrorKind::Cancelled);
}

// A bake of many bounces tells of fewer, and of more, to the bit what a bake of so many does.
TEST(Interreflection, IsFollowedAgainForAnotherNumberOfBounces) {
    const BakeInputs inputs = withAlbedo(sceneOf({bowlMesh(16, 8)}), {0.5f, 0.25f, 0.8f});
    BakeArtifact three = bake(inputs, bouncing(2, 3, 32, 32));
    BakeRequest request;
    request.kind = BakeKind::PrtVertex;
    request.prt = bouncing(2, 3, 32, 32);
    three.settings = settingsText(request);
    for (const int bounces : {1, 3, 5}) {
        const auto followed = withBounces(three, inputs, bounces, {});
        ASSERT_TRUE(followed.ok()) << followed.error().text();
        const BakeArtifact fresh = bake(inputs, bouncing(2, bounces, 32, 32));
        EXPECT_EQ((*followed)->vertices[0].bounced, fresh.vertices[0].bounced) << bounces;
        EXPECT_EQ((*followed)->vertices[0].values, three.vertices[0].values);
        EXPECT_EQ((*followed)->bounces, bounces);
    }
    EXPECT_NE((*withBounces(three, inputs, 1, {}))->vertices[0].bounced, three.vertices[0].bounced);
    BakeInputs moved = inputs;
    moved.meshes[0].transform[3].x += 1.0f;
    const auto refused = withBounces(three, moved, 1, {});
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().kind, ErrorKind::Usage);
    EXPECT_NE(refused.error().message.find("--bounces 1"), std::string::npos);
    three.kind = BakeKind::PrtTexel;
    EXPECT_FALSE(withBounces(three, inputs, 1, {}).ok());
}
