// Leaks and seams in scenes that have one of known size, and in the same scenes without.
#include "core/radiosity/document/LeaksAndSeams.h"
#include "core/job/Parallel.h"
#include "tests/core/radiosity/RadiosityScenes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <memory>

namespace patina::test {

using namespace radiosity;

namespace {

struct SolvedScene {
    std::unique_ptr<RadiosityScene> scene;
    LitMesh mesh;
    Solution solution;

    [[nodiscard]] SolvedElements elements() const {
        return {scene->scene(), scene->elements(), mesh, scene->lit(), solution, 64, 3};
    }
    [[nodiscard]] std::vector<LightLeak> leaks() const {
        const auto found = findLeaks(elements(), {});
        EXPECT_TRUE(found);
        return *found;
    }
    [[nodiscard]] std::vector<LightSeam> seams() const {
        const auto found = findSeams(elements(), {});
        EXPECT_TRUE(found);
        return *found;
    }
};

SolvedScene solved(const TraceInputs& inputs, double maxArea) {
    RadiositySettings settings;
    settings.maxArea = maxArea;
    settings.factors.resolution = 128;
    SolvedScene result;
    auto scene = RadiosityScene::make(inputs, settings, {});
    EXPECT_TRUE(scene) << scene.error().text();
    result.scene = *std::move(scene);
    result.mesh = litMesh(result.scene->elements(), *result.scene->scene().geometry(),
                          *result.scene->scene().rays());
    auto solution = result.scene->solve(settings, {});
    EXPECT_TRUE(solution) << solution.error().text();
    result.solution = std::move(solution->solution);
    return result;
}

// A unit cube in two halves: a wall across its middle that begins `gap` above the floor and, but
// for it, touches all around; `slant`: how far it is off to either side at its ends. In the half of
// small x the ceiling glows.
TraceInputs dividedBox(float gap, float slant = 0.0f) {
    std::vector<Wall> walls = unitCube(0.5f);
    walls[0].emission = 0.0f;
    walls.push_back(
        {{{{0.1f, 0.1f, 0.99f}, {0.1f, 0.9f, 0.99f}, {0.4f, 0.9f, 0.99f}, {0.4f, 0.1f, 0.99f}}},
         glm::vec3(0.5f),
         5.0f});
    const float from = 0.5f - slant, to = 0.5f + slant;
    walls.push_back(
        {{{{from, 0, gap}, {to, 1, gap}, {to, 1, 1}, {from, 0, 1}}}, glm::vec3(0.5f), 0.0f, true});
    return sceneOf(walls);
}

bool isDivided(const LightLeak& leak) {
    return leak.kind == LightLeak::Kind::Divided;
}

// A floor of 2 × 1 m, of two squares that meet at x = 1, under a light near that line.
std::vector<Wall> twoSquares(float apart, float shift = 0.0f) {
    return {{{{{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}}, glm::vec3(0.5f)},
            {{{{1 + apart, 0, shift},
               {1 + apart, 0, 1 + shift},
               {2 + apart, 0, 1 + shift},
               {2 + apart, 0, shift}}},
             glm::vec3(0.5f)}};
}

Light nearLight() {
    Light light;
    light.id = 50;
    light.type = LightType::Sphere;
    light.position = {1.15f, 0.2f, 0.4f};
    light.radius = 0.02f;
    light.intensity = 10.0f;
    return light;
}

// As twoSquares(), of one material.
TraceInputs squares(float apart, float shift = 0.0f) {
    TraceInputs inputs = sceneOf(twoSquares(apart, shift));
    inputs.meshes[1].material = 0;
    inputs.lights = {nearLight()};
    return inputs;
}

// The same floor as one mesh whose two squares share their vertices.
TraceInputs joinedSquares() {
    TraceInputs inputs = squares(0.0f);
    Mesh mesh;
    for (const glm::vec3& p : {glm::vec3(0, 0, 0), glm::vec3(0, 0, 1), glm::vec3(1, 0, 1),
                               glm::vec3(1, 0, 0), glm::vec3(2, 0, 1), glm::vec3(2, 0, 0)}) {
        mesh.positions.push_back(p);
        mesh.normals.emplace_back(0, 1, 0);
        mesh.tangents.emplace_back(1, 0, 0, 1);
        mesh.uvs.emplace_back(0.5f * p.x, p.z);
    }
    mesh.indices = {0, 1, 2, 0, 2, 3, 3, 2, 4, 3, 4, 5};
    inputs.meshes.pop_back();
    inputs.meshes[0].mesh = std::make_shared<const Mesh>(std::move(mesh));
    return inputs;
}

} // namespace

TEST(Leaks, AWallThatStandsBetweenElementsIsTight) {
    // Elements of a tenth: the wall stands on an edge of theirs.
    EXPECT_TRUE(solved(dividedBox(0.0f), 0.01).leaks().empty());
}

TEST(Leaks, AGapUnderTheWallHasItsWidth) {
    const SolvedScene scene = solved(dividedBox(0.01f), 0.01);
    const std::vector<LightLeak> leaks = scene.leaks();
    ASSERT_FALSE(leaks.empty());
    double length = 0.0;
    for (const LightLeak& leak : leaks) {
        ASSERT_EQ(leak.kind, LightLeak::Kind::Gap);
        EXPECT_NEAR(leak.width, 0.01, 1e-4);
        EXPECT_NEAR(leak.place.x, 0.5, 1e-4);
        EXPECT_NEAR(leak.place.z, 0.005, 1e-4);
        EXPECT_EQ(scene.scene->elements().face(leak.element).mesh, 7u) << "the wall's";
        // At most all that the lamp gives, through that gap.
        EXPECT_GT(leak.power, 0.0);
        EXPECT_LT(leak.power, 0.01 * 0.2 * 3 * 5.0);
        length += 0.1;
    }
    // Along all of the wall, once from each of its sides.
    EXPECT_NEAR(length, 2.0, 0.21);
    EXPECT_TRUE(std::ranges::is_sorted(leaks, std::ranges::greater{}, &LightLeak::power));
}

// Nine elements along the floor would have the wall across the middle of the fifth column, ten have
// it on an edge: they end there, so that nothing of the light comes to the dark half, nor to its
// vertices.
class DividedLeaks : public ::testing::TestWithParam<int> {};
TEST_P(DividedLeaks, ElementsEndWhereAWallStandsOnThem) {
    const int count = GetParam();
    const SolvedScene scene = solved(dividedBox(0.0f), 1.0 / (count * count) + 1e-6);
    const ElementMesh& elements = scene.scene->elements();
    EXPECT_TRUE(scene.leaks().empty());
    EXPECT_TRUE(scene.seams().empty()) << "what the wall parts is none";
    std::size_t dark = 0, lit = 0;
    for (std::uint32_t e = 0; e < elements.size(); ++e) {
        const float x = scene.scene->scene().toWorld(glm::vec3(elements.centre(e))).x;
        if (x < 0.499f)
            lit += magnitude(scene.solution.radiosity[e]) > 0.01 ? 1 : 0;
        if (x < 0.501f)
            continue;
        ++dark;
        EXPECT_EQ(magnitude(scene.solution.radiosity[e]), 0.0) << x;
    }
    EXPECT_GT(lit, 100u);
    EXPECT_GT(dark, 100u);
    for (const LitPart& part : litParts(scene.scene->surfaces(), scene.solution)) {
        const Mesh& mesh = *part.mesh;
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            const std::uint32_t* v = mesh.indices.data() + i;
            const float x =
                (mesh.positions[v[0]].x + mesh.positions[v[1]].x + mesh.positions[v[2]].x) / 3.0f;
            for (int k = 0; x > 0.501f && k < 3; ++k)
                EXPECT_EQ(part.radiosity[v[k]], glm::vec3(0.0f)) << x;
        }
    }
    // What it cuts has its elements by the same numbers whoever asks.
    const ElementMesh::Node& node = elements.node(elements.elementAt(1, {0.3, 0.501}));
    EXPECT_EQ(elements.faces()[1].cut, count % 2 == 1);
    EXPECT_LE(node.origin.x, 0.301f);
    EXPECT_GE(node.origin.x + node.extent.x, 0.299f);
}

INSTANTIATE_TEST_SUITE_P(Radiosity, DividedLeaks, ::testing::Values(9, 10));

// A wall that is not along their rows or columns: they are as small there as they may be, and what
// leaks is told.
TEST(Leaks, ASlantedWallDividesElementsFurther) {
    const SolvedScene scene = solved(dividedBox(0.0f, 0.06f), 1.0 / 81.0 + 1e-6);
    const std::vector<LightLeak> leaks = scene.leaks();
    ASSERT_FALSE(leaks.empty());
    EXPECT_TRUE(std::ranges::all_of(leaks, isDivided)) << "it is tight, but they are not";
    std::size_t floor = 0;
    for (const LightLeak& leak : leaks) {
        const glm::dvec3 centre = scene.scene->elements().centre(leak.element);
        EXPECT_NEAR(scene.scene->scene().toWorld(glm::vec3(centre)).x, 0.5, 0.08);
        EXPECT_LT(scene.scene->elements().area(leak.element), 1.01 / 81.0 / 16.0);
        EXPECT_LE(leak.share, 0.5);
        floor += scene.scene->elements().face(leak.element).mesh == 1;
        // A part of the element is as bright as the lit half's floor, the rest is dark, and both
        // show the mean.
        const glm::dvec3 sent = scene.scene->lit().radiosity(scene.solution, leak.element);
        const double all = magnitude(sent) * scene.scene->elements().area(leak.element);
        EXPECT_LT(leak.power, all);
    }
    EXPECT_GT(floor, 9u);
}

TEST(Leaks, AreTheSameForAnyNumberOfThreads) {
    const SolvedScene scene = solved(dividedBox(0.01f), 1.0 / 81.0 + 1e-6);
    const std::vector<LightLeak> some = scene.leaks();
    const ThreadLimit one(1);
    const std::vector<LightLeak> again = scene.leaks();
    ASSERT_EQ(again.size(), some.size());
    for (std::size_t i = 0; i < some.size(); ++i) {
        EXPECT_EQ(again[i].element, some[i].element);
        EXPECT_EQ(again[i].power, some[i].power);
    }
}

TEST(Leaks, CanBeCancelled) {
    JobControl control;
    control.cancel();
    const SolvedScene scene = solved(dividedBox(0.01f), 0.02);
    EXPECT_EQ(findLeaks(scene.elements(), control.context()).error().kind, ErrorKind::Cancelled);
    EXPECT_EQ(findSeams(scene.elements(), control.context()).error().kind, ErrorKind::Cancelled);
}

TEST(Seams, SquaresThatAreNotJoinedHaveOne) {
    const SolvedScene scene = solved(squares(0.0f), 0.04);
    const std::vector<LightSeam> seams = scene.seams();
    ASSERT_FALSE(seams.empty());
    for (const LightSeam& seam : seams) {
        EXPECT_NEAR(seam.place.x, 1.0, 1e-4);
        EXPECT_EQ(seam.width, 0.0);
        EXPECT_FALSE(seam.sameMesh);
        EXPECT_GE(seam.share, kLeastJump);
        EXPECT_NEAR(seam.length, 0.2, 1e-3);
        EXPECT_NE(scene.scene->elements().face(seam.element).mesh,
                  scene.scene->elements().face(seam.other).mesh);
    }
    EXPECT_TRUE(std::ranges::is_sorted(seams, std::ranges::greater{}, &LightSeam::jump));
}

TEST(Seams, JoinedSquaresHaveNone) {
    EXPECT_TRUE(solved(joinedSquares(), 0.04).seams().empty());
}

TEST(Seams, ACrackHasItsWidth) {
    const std::vector<LightSeam> seams = solved(squares(0.002f), 0.04).seams();
    ASSERT_FALSE(seams.empty());
    for (const LightSeam& seam : seams)
        EXPECT_NEAR(seam.width, 0.002, 1e-5);
    // Surfaces that are further apart are two.
    EXPECT_TRUE(solved(squares(0.1f), 0.04).seams().empty());
}

TEST(Seams, OtherMaterialsAndOtherSurfacesAreNone) {
    TraceInputs inputs = squares(0.0f);
    inputs.meshes[1].material = 1;
    inputs.materials[1].id = 2;
    EXPECT_TRUE(solved(inputs, 0.04).seams().empty()) << "another material may end there";
    // Upright: an edge of the room.
    std::vector<Wall> corner = twoSquares(0.0f);
    corner[1].corners = {{{1, 0, 0}, {1, 0, 1}, {1, 1, 1}, {1, 1, 0}}};
    inputs = sceneOf(corner);
    inputs.meshes[1].material = 0;
    inputs.lights = {nearLight()};
    inputs.lights[0].position.x = 0.8f;
    EXPECT_TRUE(solved(inputs, 0.04).seams().empty());
}

} // namespace patina::test
