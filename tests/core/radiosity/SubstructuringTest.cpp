// Patches that shoot and elements that receive: how surfaces are divided, what rows of patches are,
// and how far their solution is from that in which every element shoots.
#include "core/job/Parallel.h"
#include "core/radiosity/Shooting.h"
#include "core/radiosity/Solve.h"
#include "core/radiosity/document/Convergence.h"
#include "core/radiosity/document/EnergyFlow.h"
#include "core/radiosity/document/LitDocument.h"
#include "core/radiosity/document/RadiositySteps.h"
#include "tests/core/radiosity/RadiosityScenes.h"
#include "tests/core/trace/CornellScene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numeric>
#include <string>
#include <vector>

namespace patina::test {

using namespace radiosity;

namespace {

constexpr std::array kShootingSolvers{radiosity::Solver::Progressive, radiosity::Solver::Southwell,
                                      radiosity::Solver::Overshooting};

// Elements of at most that area in patches of at most another; 0: each element shoots. The same
// elements, with the same numbers, either way.
std::unique_ptr<DividedScene> patched(const TraceInputs& inputs, double patchArea, int divisions,
                                      bool patches) {
    const double area = patchArea / std::pow(4.0, divisions);
    if (patches)
        return divided(inputs, {.maxArea = area, .patchArea = patchArea});
    auto scene = divided(inputs, {.maxArea = patchArea});
    for (;;) {
        std::vector<double> largest(scene->elements.faces().size(), 0.0);
        const auto faceOf = [&](std::uint32_t e) { return scene->elements.node(e).face; };
        for (std::uint32_t e = 0; e < scene->elements.size(); ++e)
            largest[faceOf(e)] = std::max(largest[faceOf(e)], scene->elements.area(e));
        std::vector<std::uint32_t> tooLarge;
        for (std::uint32_t e = 0; e < scene->elements.size(); ++e)
            if (largest[faceOf(e)] > area * (1.0 + 1e-5))
                tooLarge.push_back(e);
        if (tooLarge.empty())
            break;
        scene->elements.divide(tooLarge);
    }
    scene->elements.findBuried(*scene->scene.rays(), {});
    auto lit = SceneProblem::make(scene->scene, scene->elements, {.glowByFactors = true}, {});
    EXPECT_TRUE(lit);
    scene->lit = *std::move(lit);
    return scene;
}

Solved solvedBy(const DividedScene& scene, const FactorSettings& factors, radiosity::Solver solver,
                double residual) {
    SolveSettings settings;
    settings.solver = solver;
    settings.residual = residual;
    auto solved = solve(scene.problem(), *scene.factors(factors), settings, {});
    EXPECT_TRUE(solved) << solved.error().text();
    return *std::move(solved);
}

// Root mean square by area of the difference of two radiosities, by the mean of the second.
double relativeDifference(const Problem& problem, const std::vector<glm::dvec3>& a,
                          const std::vector<glm::dvec3>& b) {
    double squares = 0.0, sum = 0.0, area = 0.0;
    for (std::size_t e = 0; e < problem.size(); ++e) {
        const glm::dvec3 d = a[e] - b[e];
        squares += problem.areas[e] * (d.x * d.x + d.y * d.y + d.z * d.z) / 3.0;
        sum += problem.areas[e] * (b[e].x + b[e].y + b[e].z) / 3.0;
        area += problem.areas[e];
    }
    return std::sqrt(squares / area) / (sum / area);
}

TraceInputs litRoom() {
    std::vector<Wall> walls = unitCube(0.7f);
    walls[2].reflectance = {0.8f, 0.3f, 0.1f};
    // A shelf, open below: what is above it hides the floor.
    walls.push_back(
        {{{{0.2f, 0.2f, 0.4f}, {0.7f, 0.2f, 0.4f}, {0.7f, 0.6f, 0.4f}, {0.2f, 0.6f, 0.4f}}},
         glm::vec3(0.5f),
         0.0f,
         true});
    return sceneOf(walls);
}

TEST(Patches, AreDividedIntoElementsAndStay) {
    const TraceInputs inputs = litRoom();
    auto scene = divided(inputs, {.maxArea = 0.02, .patchArea = 0.26});
    ElementMesh& elements = scene->elements;
    // Walls of 2 × 2 patches, either side of the shelf one; divided twice: .25 / 16 < .02.
    EXPECT_EQ(elements.patches().size(), 6u * 4u + 2u);
    EXPECT_EQ(elements.senderCount(), elements.patches().size());
    EXPECT_EQ(elements.size(), 16u * elements.patches().size());
    const auto check = [&] {
        const Patches& patches = elements.patches();
        std::vector<int> times(elements.size(), 0);
        for (std::uint32_t p = 0; p < patches.size(); ++p) {
            double area = 0.0;
            for (const std::uint32_t e : patches.elementsOf(p)) {
                ++times[e];
                area += elements.area(e);
                EXPECT_EQ(patches.of[e], p);
                EXPECT_EQ(elements.senderOf(e), p);
                EXPECT_EQ(elements.node(e).face, elements.sender(p).face);
            }
            EXPECT_LE(area, 0.26);
            const Polygon polygon = elements.polygon(elements.sender(p));
            EXPECT_NEAR(area,
                        glm::length(areaVector(polygon.points())) * elements.metresPerUnit() *
                            elements.metresPerUnit(),
                        1e-6);
        }
        EXPECT_EQ(std::ranges::count(times, 1), static_cast<std::ptrdiff_t>(elements.size()));
        EXPECT_LE(std::ranges::max(elements.areas()), 0.02 * (1.0 + 1e-5));
    };
    check();
    const std::size_t before = elements.size();
    elements.divide(std::vector<std::uint32_t>{3, 77, 200});
    EXPECT_EQ(elements.size(), before + 9);
    EXPECT_EQ(elements.patches().size(), 26u) << "they stay";
    check();

    const BakeGeometry& geometry = *scene->scene.geometry();
    const auto smaller = ElementMesh::make(geometry, {.maxArea = 0.02, .patchArea = 0.01});
    ASSERT_FALSE(smaller);
    EXPECT_EQ(smaller.error().kind, ErrorKind::Usage);
    const auto many =
        ElementMesh::make(geometry, {.maxArea = 0.02, .maxElements = 400, .patchArea = 0.26});
    ASSERT_FALSE(many) << "416 elements";
    EXPECT_NE(many.error().message.find("416"), std::string::npos) << many.error().message;
}

class RowsOfPatches : public ::testing::TestWithParam<FactorMethod> {};

TEST_P(RowsOfPatches, AreTheMeansOfTheirElementsRows) {
    const auto patches = patched(litRoom(), 0.26, 1, true),
               alone = patched(litRoom(), 0.26, 1, false);
    ASSERT_EQ(patches->elements.size(), alone->elements.size());
    const FactorSettings settings{GetParam(), GetParam() == FactorMethod::Rays       ? 1 << 14
                                              : GetParam() == FactorMethod::Hemicube ? 32
                                                                                     : 256};
    const auto ofPatches = patches->factors(settings), ofElements = alone->factors(settings);
    const Problem& problem = patches->problem();
    // Rays have noise, hemicubes the error of 3 × 3 points where walls touch, and polygons that of
    // the pairs of points where the shelf hides a part.
    const double tolerance = GetParam() == FactorMethod::Rays       ? 2e-3
                             : GetParam() == FactorMethod::Hemicube ? 1e-2
                                                                    : 5e-3;
    const double closure = GetParam() == FactorMethod::Analytic ? 2e-2 : 1e-5;
    FactorRow row;
    for (std::uint32_t p = 0; p < problem.senders(); ++p) {
        std::vector<double> mean(problem.size(), 0.0);
        double area = 0.0, shares = 0.0;
        for (const std::uint32_t e : problem.patches.elementsOf(p)) {
            ofElements->row(e, row);
            for (const FactorRow::Share& share : row.shares)
                mean[share.element] += problem.areas[e] * double{share.factor};
            area += problem.areas[e];
        }
        ofPatches->row(p, row);
        double sum = double{row.absorbed} + double{row.escaped};
        for (const FactorRow::Share& share : row.shares) {
            EXPECT_NEAR(share.factor, mean[share.element] / area, tolerance) << p;
            EXPECT_NE(problem.patches.of[share.element], p) << "a patch is flat";
            mean[share.element] = 0.0;
            sum += double{share.factor};
            shares += double{share.factor};
        }
        for (const double missing : mean)
            EXPECT_LE(missing / area, tolerance) << p;
        EXPECT_NEAR(sum, 1.0, closure) << p;
        EXPECT_GT(shares, 0.9) << "the room is closed";
    }
}

INSTANTIATE_TEST_SUITE_P(Radiosity, RowsOfPatches,
                         ::testing::Values(FactorMethod::Rays, FactorMethod::Hemicube,
                                           FactorMethod::Analytic),
                         [](const auto& test) { return std::string(name(test.param)); });

TEST(Substructuring, WithPatchesOfOneElementIsTheSolutionWithoutPatches) {
    for (const FactorMethod method :
         {FactorMethod::Rays, FactorMethod::Hemicube, FactorMethod::Analytic})
        for (const radiosity::Solver solver : kShootingSolvers) {
            const auto patches = patched(litRoom(), 0.1, 0, true),
                       alone = patched(litRoom(), 0.1, 0, false);
            ASSERT_EQ(patches->problem().senders(), alone->problem().size());
            const FactorSettings factors{method, 16, 3};
            const Solved a = solvedBy(*patches, factors, solver, 1e-10),
                         b = solvedBy(*alone, factors, solver, 1e-10);
            for (std::size_t e = 0; e < alone->problem().size(); ++e)
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(a.solution.radiosity[e][c], b.solution.radiosity[e][c], 1e-9)
                        << name(method) << " " << name(solver) << " " << e;
        }
}

TEST(Substructuring, KnowsWhereAllOfTheLightIs) {
    std::vector<Wall> walls = unitCube(0.7f);
    walls.pop_back(); // some leaves it
    for (const bool ahead : {false, true})
        for (const FactorMethod method : {FactorMethod::Rays, FactorMethod::Hemicube}) {
            const auto scene = divided(sceneOf(walls), {.maxArea = 0.02, .patchArea = 0.3});
            const auto factors = scene->factors({method, 32, 0});
            Shooting shooting(scene->problem(), ShootingRule::Power, ahead);
            FactorRow row;
            for (int shot = 0; shot < 60; ++shot) {
                const std::uint32_t patch = shooting.next(1).at(0);
                factors->row(patch, row);
                shooting.shoot(patch, row);
                const Shooting::Energy energy = shooting.energy();
                ASSERT_NEAR(energy.absorbed + energy.lost + energy.unshot, energy.emitted,
                            1e-6 * energy.emitted)
                    << shot;
            }
            EXPECT_GT(shooting.energy().lost, 0.1);
            EXPECT_LT(shooting.residual(), 0.05);
        }
}

// Radiosities of the box with its blocks in which each element shoots, and those of the same
// elements in patches of 4 or 16: docs/maths/radiosity.md states the bounds.
TEST(Substructuring, OfTheCornellBoxIsNearTheSolutionInWhichEachElementShoots) {
    const TraceInputs box = cornellBox(kCornellWalls[0], true);
    for (const int divisions : {1, 2}) {
        const double area = 0.01 * std::pow(4.0, divisions - 1);
        const auto patches = patched(box, area, divisions, true),
                   alone = patched(box, area, divisions, false);
        ASSERT_EQ(patches->problem().size(), alone->problem().size());
        // By polygons, which have no noise.
        const FactorSettings factors{FactorMethod::Analytic, 8, 1};
        const Solved a = solvedBy(*patches, factors, radiosity::Solver::Progressive, 1e-4),
                     b = solvedBy(*alone, factors, radiosity::Solver::Progressive, 1e-4);
        const double apart =
            relativeDifference(alone->problem(), a.solution.radiosity, b.solution.radiosity);
        EXPECT_LT(apart, divisions == 1 ? 0.02 : 0.035) << divisions;
        EXPECT_LT(a.report.shares, b.report.shares / (divisions == 1 ? 3 : 12));
        EXPECT_EQ(a.report.rows, patches->problem().senders()) << "each has shot";
        double sum = 0.0, truth = 0.0;
        for (std::size_t e = 0; e < alone->problem().size(); ++e) {
            sum += alone->problem().areas[e] * magnitude(a.solution.irradiance[e]);
            truth += alone->problem().areas[e] * magnitude(b.solution.irradiance[e]);
        }
        EXPECT_NEAR(sum, truth, 0.005 * truth) << "all of the light that bounces";
    }
}

TEST(Substructuring, IsTheSameOnAnyNumberOfThreads) {
    const auto scene = divided(litRoom(), {.maxArea = 0.01, .patchArea = 0.1});
    std::vector<Solution> solutions;
    for (const int threads : {1, 2, 7}) {
        const ThreadLimit limit(threads);
        solutions.push_back(
            solvedBy(*scene, {FactorMethod::Rays, 32, 0}, radiosity::Solver::Overshooting, 1e-3)
                .solution);
    }
    EXPECT_EQ(solutions[0].radiosity, solutions[1].radiosity);
    EXPECT_EQ(solutions[0].radiosity, solutions[2].radiosity);
}

RadiositySettings patchSettings() {
    RadiositySettings settings;
    settings.maxArea = 0.02;
    settings.patchArea = 0.3;
    settings.factors.resolution = 64;
    settings.lightSamples = 16;
    settings.solve.solver = radiosity::Solver::Progressive;
    settings.solve.residual = 1e-4;
    return settings;
}

TEST(Substructuring, RefusesSolversThatDoNotShoot) {
    for (const radiosity::Solver solver :
         {radiosity::Solver::GaussSeidel, radiosity::Solver::Jacobi, radiosity::Solver::Direct,
          radiosity::Solver::Hierarchical}) {
        RadiositySettings settings = patchSettings();
        settings.solve.solver = solver;
        const auto scene = RadiosityScene::make(litRoom(), settings, {});
        ASSERT_FALSE(scene);
        EXPECT_EQ(scene.error().kind, ErrorKind::Usage);
        EXPECT_NE(scene.error().message.find("southwell"), std::string::npos);
    }
}

TEST(Substructuring, DividesElementsAdaptivelyAndKeepsPatches) {
    RadiositySettings settings = patchSettings();
    const auto even = RadiosityScene::make(litRoom(), settings, {});
    ASSERT_TRUE(even);
    settings.adaptive = 0.1;
    const auto adaptive = RadiosityScene::make(litRoom(), settings, {});
    ASSERT_TRUE(adaptive) << adaptive.error().text();
    const ElementMesh& elements = (*adaptive)->elements();
    EXPECT_GT(elements.size(), (*even)->elements().size());
    EXPECT_EQ(elements.patches().size(), (*even)->elements().patches().size());
    EXPECT_EQ((*adaptive)->lit().problem.patches.elements.size(), elements.size());
    const auto solved = (*adaptive)->solve(settings, {});
    ASSERT_TRUE(solved) << solved.error().text();
    EXPECT_TRUE(solved->report.converged);
    EXPECT_EQ(solved->report.rows, elements.patches().size());
    ASSERT_TRUE(solved->report.bound);
    EXPECT_TRUE(solved->report.bound->sampling);
}

TEST(Substructuring, IsFollowedAndSteppedThroughPatchByPatch) {
    RadiositySettings settings = patchSettings();
    settings.classic = true; // so that there is much to shoot
    const auto live = followRadiosity(litRoom(), settings, nullptr, {});
    ASSERT_TRUE(live) << live.error().text();
    EXPECT_TRUE((*live)->solved);
    const auto scene = RadiosityScene::make(litRoom(), settings, {});
    ASSERT_TRUE(scene);
    const auto solved = (*scene)->solve(settings, {});
    ASSERT_TRUE(solved);
    const Problem& problem = (*live)->lit.problem;
    EXPECT_LT(relativeDifference(problem, (*live)->solution.radiosity, solved->solution.radiosity),
              1e-3);

    RadiositySteps steps(*live);
    EXPECT_EQ(steps.stepsPerRound(), problem.senders());
    steps.goTo(1);
    ASSERT_TRUE(steps.last());
    EXPECT_LT(*steps.last(), problem.senders());
    const std::vector<glm::dvec3> unshot = steps.unshot();
    for (const std::uint32_t e : problem.patches.elementsOf(*steps.last()))
        EXPECT_EQ(unshot[e], glm::dvec3(0.0)) << "all of the patch has shot";
    EXPECT_EQ(senderOutline(**live, *steps.last()).size(), 4u);
    const auto curves = convergence(**live, {});
    ASSERT_TRUE(curves);
    EXPECT_EQ(curves->size(), 2u) << "patches cannot gather";

    // What lights an element adds up to what it receives; where it goes, to what it sends.
    const auto element = static_cast<std::uint32_t>(problem.size() / 2);
    glm::dvec3 arrives(0.0), leaves(0.0);
    for (const FlowShare& share : arrivingLight(**live, (*live)->solution, element))
        arrives += share.light;
    for (const FlowShare& share : leavingLight(**live, (*live)->solution, element))
        leaves += share.light;
    const glm::dvec3 received = (*live)->lit.irradiance((*live)->solution, element),
                     sent = (*live)->lit.radiosity((*live)->solution, element);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(arrives[c], received[c], 2e-3 * received[c]);
        EXPECT_NEAR(leaves[c], sent[c], 1e-5 * sent[c]);
    }
    const ShownRadiosityPtr shown = shownRadiosity(**live, (*live)->solution, unshot, element);
    double share = 0.0;
    for (const ShownRadiosity::Element& other : shown->elements)
        share += double{other.share};
    EXPECT_NEAR(share, 1.0, 1e-4) << "the room is closed";
}

} // namespace

} // namespace patina::test
