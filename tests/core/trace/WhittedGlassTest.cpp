// What the classical ray tracer sees through glass, against the laws of optics.
#include "core/trace/whitted/WhittedTracer.h"

#include "tests/core/trace/TraceBall.h"
#include "tests/core/trace/WhittedScenes.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace patina {

using test::cubeMesh;
using test::floorMesh;
using test::floorUnderPoint;
using test::fromAbove;
using test::glass;
using test::ofKind;
using test::viewFrom;
using test::whitted;
using test::whittedScene;

namespace {

// Fresnel's equations for both polarisations, of a ray from index 1 to `eta`; 1 beyond the critical
// angle.
double fresnelOf(double cosine, double eta) {
    const double sin2 = (1.0 - cosine * cosine) / (eta * eta);
    if (sin2 >= 1.0)
        return 1.0;
    const double behind = std::sqrt(1.0 - sin2);
    const double s = (cosine - eta * behind) / (cosine + eta * behind);
    const double p = (eta * cosine - behind) / (eta * cosine + behind);
    return 0.5 * (s * s + p * p);
}

} // namespace

// Snell's law, Fresnel's equations and total reflection, at every surface of a cube of glass.
TEST(Whitted, GlassFollowsSnellAndFresnel) {
    for (const float ior : {1.0f, 1.3f, 1.5f, 2.4f}) {
        TraceInputs inputs = test::ballUnderSky(glass(ior));
        inputs.meshes[0].mesh = cubeMesh();
        const TraceScene scene = whittedScene(inputs);
        TraceView view = viewFrom(5.0f);
        view.camera.pitchDeg = 35.0f;
        WhittedSettings settings;
        settings.minContribution = 1e-3f;
        int refracted = 0, total = 0, partly = 0;
        for (int y = 4; y < 12; ++y) {
            const RayTree tree = traceRayTree(scene, view, settings, 6, y, 1);
            for (const RayNode& node : tree.nodes()) {
                if (node.parent == RayNode::kNone || node.kind == RayKind::Shadow)
                    continue;
                const RayNode& from = tree.nodes()[static_cast<std::size_t>(node.parent)];
                const glm::dvec3 n(from.normal), d(from.direction), out(node.direction);
                const double cosine = -glm::dot(n, d);
                const double sine = glm::length(glm::cross(n, d));
                // Within the cube at its odd surfaces.
                const bool leaves = from.etaRatio > 1.0f;
                const double eta =
                    leaves ? 1.0 / static_cast<double>(ior) : static_cast<double>(ior);
                const double reflectance = fresnelOf(cosine, eta);
                const double ratio = static_cast<double>(node.weight.y / from.weight.y);
                EXPECT_NEAR(from.cosIncident, cosine, 1e-5);
                EXPECT_EQ(from.totalReflection, sine >= eta) << sine;
                if (node.kind == RayKind::Reflected) {
                    EXPECT_LT(glm::length(out - (d + 2.0 * cosine * n)), 1e-5);
                    EXPECT_NEAR(ratio, reflectance, 2e-4);
                    total += from.totalReflection ? 1 : 0;
                    partly += from.totalReflection ? 0 : 1;
                } else {
                    EXPECT_NEAR(glm::length(glm::cross(n, out)), sine / eta, 1e-5);
                    EXPECT_LT(glm::dot(n, out), 0.0);
                    EXPECT_NEAR(ratio, 1.0 - reflectance, 2e-4);
                    ++refracted;
                }
            }
        }
        EXPECT_GT(refracted, 20);
        if (ior >= 1.5f) { // the light that enters cannot leave by a side
            EXPECT_GT(total, 10);
        }
        EXPECT_EQ(partly > 0, ior != 1.0f);
    }
}

// Of a sheet both faces: 2R / (1 + R) comes back and the rest goes straight on.
TEST(Whitted, ASheetOfGlassIsBothOfItsFaces) {
    Material sheet = glass();
    sheet.thinWalled = true;
    sheet.baseColor = {0.9f, 0.5f, 0.25f};
    TraceInputs inputs = test::ballUnderSky(sheet);
    inputs.meshes[0].mesh = floorMesh();
    const TraceScene scene = whittedScene(inputs);
    TraceView view = fromAbove();
    view.camera.pitchDeg = 20.0f;
    const RayTree tree = traceRayTree(scene, view, {}, 7, 8, 1);
    ASSERT_EQ(ofKind(tree, RayKind::Refracted).size(), tree.sampleCount());
    for (const RayNode& node : tree.nodes()) {
        if (node.kind == RayKind::Camera)
            continue;
        const RayNode& from = tree.nodes()[static_cast<std::size_t>(node.parent)];
        const double once = fresnelOf(-static_cast<double>(from.direction.y), 1.5);
        const double reflectance = 2.0 * once / (1.0 + once);
        if (node.kind == RayKind::Reflected) {
            EXPECT_NEAR(node.weight.y, reflectance, 2e-4);
        } else {
            EXPECT_LT(glm::length(node.direction - from.direction), 1e-6f);
            EXPECT_NEAR(node.weight.y, 0.5 * (1.0 - reflectance), 2e-4);
        }
    }
}

// Through a sheet the background is seen as it would be without: as it was asked for, or not there.
TEST(Whitted, BehindASheetIsTheBackground) {
    Material sheet = glass();
    sheet.thinWalled = true;
    TraceInputs inputs = test::ballUnderSky(sheet, 0.5f);
    inputs.meshes[0].mesh = floorMesh();
    const TraceScene scene = whittedScene(inputs);
    TraceView view = fromAbove();
    WhittedSettings settings;
    settings.subdivisions = 0;
    const RayTree tree = traceRayTree(scene, view, settings, 8, 8, 1);
    double reflected = 0.0;
    for (const RayNode& node : ofKind(tree, RayKind::Reflected))
        reflected += 0.25 * static_cast<double>(node.weight.y);
    view.background = [](const glm::vec3&) { return glm::vec3(2.0f); };
    EXPECT_NEAR(whitted(scene, view, settings).at(8, 8).luminance(),
                reflected * 0.5 + (1.0 - reflected) * 2.0, 1e-4);
    view.transparent = true;
    const Film film = whitted(scene, view, settings);
    EXPECT_NEAR(film.at(8, 8).coverage, reflected, 1e-5);
    EXPECT_NEAR(film.at(8, 8).luminance(), reflected * 0.5, 1e-4);
    view.camera.distance = 20.0f;
    EXPECT_EQ(whitted(scene, view, settings).at(0, 0).coverage, 0.0f); // beside it
}

// Beer and Lambert's law, of what is seen through the body and of the light that comes through.
TEST(Whitted, BodiesAbsorbByTheLengthOfTheWay) {
    TraceInputs inputs = floorUnderPoint();
    Material body = glass(1.0f); // rays go straight on
    body.attenuationColor = {0.5f, 0.25f, 1.0f};
    body.attenuationDistance = 0.3f;
    inputs.materials.push_back(body);
    glm::mat4 slab(1.0f); // 0.2 m thick, above the floor
    slab[1].y = 0.1f;
    slab[3].y = 0.5f;
    inputs.meshes.push_back({2, cubeMesh(), slab, 1});
    inputs.lights[0].position = {0.1f, 1.5f, 0.1f};
    const TraceScene scene = whittedScene(inputs);
    TraceView view = fromAbove();
    view.camera.pitchDeg = 85.0f;
    const RayTree tree = traceRayTree(scene, view, {}, 8, 8, 1);
    int floors = 0;
    for (const RayNode& node : tree.nodes()) {
        if (node.kind != RayKind::Shadow || node.end != RayEnd::Lit)
            continue;
        const RayNode& seen = tree.nodes()[static_cast<std::size_t>(node.parent)];
        if (seen.mesh != 1)
            continue;
        ++floors;
        const double up = 0.2 / std::abs(static_cast<double>(node.direction.y));
        const double down = 0.2 / std::abs(static_cast<double>(seen.direction.y));
        EXPECT_NEAR(node.passes.x, std::pow(0.5, up / 0.3), 1e-4);
        EXPECT_NEAR(node.passes.y, std::pow(0.25, up / 0.3), 1e-4);
        EXPECT_NEAR(node.passes.z, 1.0, 1e-5);
        EXPECT_NEAR(seen.weight.x, std::pow(0.5, down / 0.3), 1e-4);
        EXPECT_NEAR(seen.weight.y, std::pow(0.25, down / 0.3), 1e-4);
    }
    EXPECT_EQ(floors, static_cast<int>(tree.sampleCount()));
}

// A closed scene of glass in uniform light shows that light: nothing is lost but what is cut.
TEST(Whitted, GlassInUniformLightIsInvisible) {
    for (const bool thin : {false, true}) {
        Material material = glass();
        material.thinWalled = thin;
        const TraceScene scene = whittedScene(test::ballUnderSky(material, 0.7f));
        WhittedSettings settings;
        settings.maxDepth = 32;
        settings.minContribution = kLeastContribution;
        const Film film = whitted(scene, viewFrom(3.4f), settings);
        for (const Film::Pixel& pixel : film.pixels())
            EXPECT_NEAR(pixel.luminance(), 0.7, 0.004);
    }
}

} // namespace patina
