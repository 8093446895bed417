// Links between clusters against the solution of every pair of elements.
#include "core/radiosity/Hierarchical.h"

#include "core/job/Parallel.h"
#include "core/radiosity/ClusterTree.h"
#include "tests/core/radiosity/RadiosityScenes.h"
#include "tests/core/trace/CornellScene.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <numeric>
#include <string>
#include <vector>

namespace patina::test {

using namespace radiosity;

namespace {

// Mean difference by area, as a share of the mean radiosity.
double meanDifference(const Problem& problem, const Solution& a, const Solution& b) {
    double sum = 0.0, all = 0.0;
    for (std::size_t e = 0; e < problem.size(); ++e) {
        sum += problem.areas[e] * magnitude(a.radiosity[e] - b.radiosity[e]);
        all += problem.areas[e] * magnitude(b.radiosity[e]);
    }
    return sum / all;
}

Solved hierarchical(const DividedScene& scene, const HierarchySettings& settings) {
    SolveSettings solving;
    solving.residual = 1e-4;
    auto solved = solveHierarchical(scene.problem(), scene.elements, *scene.scene.rays(), settings,
                                    solving, {});
    EXPECT_TRUE(solved) << solved.error().text();
    EXPECT_TRUE(solved->report.converged);
    return std::move(*solved);
}

} // namespace

TEST(ClusterTree, HoldsEveryElementOnceAndEnclosesIt) {
    const auto scene = divided(cornellBox(kCornellWalls[0], true), {0.08}, {16, 1, false});
    const ClusterTree tree(scene->elements, scene->problem().areas);
    std::vector<std::uint32_t> leaves = tree.leaves();
    std::ranges::sort(leaves);
    std::vector<std::uint32_t> all(scene->elements.size());
    std::iota(all.begin(), all.end(), 0u);
    EXPECT_EQ(leaves, all);
    std::size_t elements = 0;
    for (std::size_t i = 0; i < tree.nodes().size(); ++i) {
        const ClusterTree::Node& node = tree.nodes()[i];
        elements += node.isElement();
        EXPECT_GE(node.leafCount, 1u);
        for (std::uint32_t l = node.firstLeaf; l < node.firstLeaf + node.leafCount; ++l) {
            const std::uint32_t e = tree.leaves()[l];
            if (node.face != kNone) {
                EXPECT_EQ(scene->elements.node(e).face, node.face);
            }
            const Polygon polygon = scene->elements.polygon(e);
            for (const glm::dvec3& corner : polygon.points())
                EXPECT_LE(glm::length(corner - glm::dvec3(node.centre)),
                          double{node.radius} * 1.0001 + 1e-6);
        }
        if (node.isElement())
            continue;
        EXPECT_GT(node.firstChild, i);
        EXPECT_LE(node.childCount, ClusterTree::kMostChildren);
        std::uint32_t next = node.firstLeaf;
        for (std::uint32_t k = node.firstChild; k < node.firstChild + node.childCount; ++k) {
            EXPECT_EQ(tree.nodes()[k].firstLeaf, next);
            next += tree.nodes()[k].leafCount;
        }
        EXPECT_EQ(next, node.firstLeaf + node.leafCount);
    }
    EXPECT_EQ(elements, scene->elements.size());
}

TEST(ClusterTree, SamplesElementsByArea) {
    const auto scene = divided(sceneOf(unitCube(0.5f)), {0.5});
    std::vector<double> areas = scene->problem().areas;
    areas[3] *= 5.0;
    const ClusterTree tree(scene->elements, areas);
    std::vector<double> hits(areas.size(), 0.0);
    constexpr int kSteps = 100'000;
    for (int i = 0; i < kSteps; ++i) {
        float u = (static_cast<float>(i) + 0.5f) / kSteps;
        hits[tree.sampleElement(tree.nodes()[ClusterTree::kRoot], u)] += 1.0 / kSteps;
        EXPECT_TRUE(u >= 0.0f && u <= 1.0f);
    }
    const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
    for (std::size_t e = 0; e < areas.size(); ++e)
        EXPECT_NEAR(hits[e], areas[e] / area, 1e-4);
}

// The stated tolerance: by default 3 % of the mean radiosity, in the mean over the area.
TEST(Hierarchical, AgreesWithGathering) {
    struct Case {
        const char* name;
        std::unique_ptr<DividedScene> scene;
        FactorSettings factors;
    };
    std::vector<Case> cases;
    cases.push_back({"cube",
                     divided(sceneOf(unitCube(0.8f)), {0.11}, {64, 0, false}),
                     {FactorMethod::Analytic, 1, 0}});
    cases.push_back({"box",
                     divided(cornellBox(kCornellWalls[0], true), {0.05}, {64, 1, false}),
                     {FactorMethod::Rays, 1024, 1}});
    cases.push_back({"fine box",
                     divided(cornellBox(kCornellWalls[0], true), {0.025}, {16, 1, false}),
                     {FactorMethod::Rays, 512, 1}});
    // Many small faces: clusters of them.
    TraceInputs balls = sceneOf(unitCube(0.7f));
    balls.materials.push_back(balls.materials[1]);
    balls.meshes.push_back(facetedBall(12, 0.25f, false, balls.materials.size() - 1));
    balls.meshes.back().transform[3] = {0.5f, 0.5f, 0.3f, 1.0f};
    cases.push_back({"ball", divided(balls, {0.1}, {64, 0, false}), {FactorMethod::Rays, 1024, 1}});
    for (const Case& one : cases) {
        SolveSettings settings;
        settings.residual = 1e-5;
        const auto truth =
            solve(one.scene->problem(), *one.scene->factors(one.factors), settings, {});
        ASSERT_TRUE(truth);
        const Solved usual = hierarchical(*one.scene, {});
        EXPECT_LT(meanDifference(one.scene->problem(), usual.solution, truth->solution), 0.03)
            << one.name;
        const auto elements = static_cast<double>(one.scene->elements.size());
        const auto links = static_cast<double>(usual.report.links->last);
        EXPECT_LT(links, 0.5 * elements * elements) << one.name;
        if (one.name == std::string("fine box")) {
            EXPECT_LT(links, 0.03 * elements * elements) << elements;
        }
        // What is allowed to each link decides.
        HierarchySettings coarse;
        coarse.linkError = 1e-4;
        const Solved rough = hierarchical(*one.scene, coarse);
        EXPECT_LT(rough.report.links->last, usual.report.links->last) << one.name;
        EXPECT_GT(meanDifference(one.scene->problem(), rough.solution, truth->solution),
                  meanDifference(one.scene->problem(), usual.solution, truth->solution))
            << one.name;
    }
}

TEST(Hierarchical, DoesNotDependOnThreads) {
    const auto scene = divided(cornellBox(kCornellWalls[0], true), {0.1}, {16, 1, false});
    const Solved many = hierarchical(*scene, {});
    const ThreadLimit one(1);
    const Solved alone = hierarchical(*scene, {});
    EXPECT_EQ(many.solution.radiosity, alone.solution.radiosity);
    EXPECT_EQ(many.report.links->last, alone.report.links->last);
}

// Few links to begin with, however many elements, and little memory beside them.
TEST(Hierarchical, BeginsWithFewLinksOfManyTriangles) {
    TraceInputs inputs = sceneOf(unitCube(0.6f));
    inputs.materials.push_back(inputs.materials[1]);
    inputs.meshes.push_back(facetedBall(104, 0.3f, false, inputs.materials.size() - 1));
    inputs.meshes.back().transform[3] = {0.5f, 0.5f, 0.4f, 1.0f};
    const auto scene = divided(inputs, {0.25}, {4, 0, false});
    ASSERT_GT(scene->elements.size(), 20'000u);
    SolveSettings settings;
    settings.maxIterations = 1; // the first links, one bounce
    const auto solved = solveHierarchical(scene->problem(), scene->elements, *scene->scene.rays(),
                                          {}, settings, {});
    ASSERT_TRUE(solved);
    const auto count = static_cast<double>(scene->elements.size());
    EXPECT_LT(static_cast<double>(solved->report.links->first), 40.0 * count);
    EXPECT_LT(static_cast<double>(solved->report.links->treeBytes), 120.0 * count);
}

TEST(Hierarchical, EndsWhenItIsTold) {
    const auto scene = divided(sceneOf(unitCube(0.5f)), {0.26});
    JobControl control;
    control.cancel();
    const auto cancelled = solveHierarchical(scene->problem(), scene->elements,
                                             *scene->scene.rays(), {}, {}, control.context());
    ASSERT_FALSE(cancelled);
    EXPECT_EQ(cancelled.error().kind, ErrorKind::Cancelled);
    SolveSettings settings;
    settings.residual = 1e-9;
    settings.maxIterations = 3;
    const auto three = solveHierarchical(scene->problem(), scene->elements, *scene->scene.rays(),
                                         {}, settings, {});
    ASSERT_TRUE(three);
    EXPECT_EQ(three->report.iterations, 3u);
    EXPECT_FALSE(three->report.converged);
    Problem dark = scene->problem();
    dark.emission.assign(dark.size(), glm::dvec3(0.0));
    const auto nothing =
        solveHierarchical(dark, scene->elements, *scene->scene.rays(), {}, settings, {});
    ASSERT_TRUE(nothing);
    EXPECT_TRUE(nothing->report.converged);
    EXPECT_EQ(nothing->solution.irradiance, std::vector<glm::dvec3>(dark.size(), glm::dvec3(0.0)));
}

} // namespace patina::test
