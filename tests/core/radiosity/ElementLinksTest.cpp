// The links of an element are what its light was gathered over.
#include "core/radiosity/document/ElementLinks.h"
#include "core/light/Light.h"
#include "core/radiosity/document/EnergyFlow.h"
#include "tests/core/radiosity/RadiosityScenes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace patina::test {

using namespace radiosity;

namespace {

LiveRadiosityPtr linkedRoom(Solver solver = Solver::Hierarchical) {
    std::vector<Wall> walls = unitCube(0.5f);
    walls[0].emission = 0.3f;
    TraceInputs inputs = sceneOf(walls);
    Light light;
    light.id = 7;
    light.type = LightType::Sphere;
    light.position = {0.3f, 0.6f, 0.4f};
    light.radius = 0.1f;
    light.intensity = 20.0f;
    light.gainEv = 1.0f;
    inputs.lights = {light};
    RadiositySettings settings;
    settings.maxArea = 0.01;
    settings.solve.residual = 1e-6;
    settings.solve.solver = solver;
    settings.hierarchy.linkError = 1e-5; // coarse: clusters, too
    auto live = followRadiosity(inputs, settings, nullptr, {});
    EXPECT_TRUE(live) << live.error().text();
    return *live;
}

} // namespace

TEST(ElementLinks, FactorsAddUpToTheRowAndLightToTheBouncedLight) {
    const LiveRadiosityPtr live = linkedRoom();
    std::size_t clusters = 0, elements = 0, inherited = 0;
    double worst = 0.0, mean = 0.0;
    int count = 0;
    for (std::uint32_t e = 0; e < live->elements().size(); e += 37) {
        const ElementLinks found = linksOf(*live, e);
        ASSERT_FALSE(found.links.empty());
        double sum = 0.0, shares = 0.0;
        glm::dvec3 light(0.0);
        for (const ElementLink& link : found.links) {
            sum += link.factor;
            shares += link.share;
            light += link.light;
            (link.element == kNone ? clusters : elements) += 1;
            inherited += link.receivers > 1;
            EXPECT_EQ(link.element == kNone, link.elements > 1);
            EXPECT_GT(link.factor, 0.0);
        }
        EXPECT_NEAR(sum, found.factorSum, 1e-12);
        EXPECT_NEAR(shares, 1.0, 1e-9);
        EXPECT_TRUE(
            std::ranges::is_sorted(found.links, std::ranges::greater{}, &ElementLink::share));
        // The row that the links stand for: of each other element its own factor.
        double row = 0.0;
        for (const double factor : factorsOverLinks(*live, e))
            row += factor;
        EXPECT_NEAR(row, sum, 1e-9);
        worst = std::max(worst, std::abs(sum - 1.0)); // a closed room
        mean += sum;
        ++count;
        // What was gathered over them.
        const RadiositySource& source = live->sources[found.source];
        const glm::dvec3 bounced = source.power * source.bounced[e];
        EXPECT_LT(magnitude(light - bounced), 1e-4 * magnitude(bounced)) << e;
        // And over those of all sources.
        glm::dvec3 all(0.0), arrived(0.0);
        for (const RadiositySource& each : live->sources)
            all += each.power * each.bounced[e];
        for (const glm::dvec3& from : lightOverLinks(*live, e))
            arrived += from;
        EXPECT_LT(magnitude(arrived - all), 1e-4 * magnitude(all)) << e;
    }
    EXPECT_LT(worst, 0.3) << "of one element: links of its clusters are means";
    EXPECT_NEAR(mean / count, 1.0, 0.03);
    EXPECT_GT(clusters, 0u);
    EXPECT_GT(elements, 0u);
    EXPECT_GT(inherited, 0u);
}

TEST(ElementLinks, WhoLightsAnElementIsKnownByLinks) {
    const LiveRadiosityPtr live = linkedRoom();
    for (std::uint32_t e = 3; e < live->elements().size(); e += 101) {
        const glm::dvec3 whole = live->lit.irradiance(live->solution, e);
        glm::dvec3 sum(0.0);
        bool meshes = false;
        for (const FlowShare& share : arrivingLight(*live, live->solution, e)) {
            sum += share.light;
            meshes = meshes || share.kind == FlowShare::Kind::Mesh;
        }
        EXPECT_TRUE(meshes);
        EXPECT_LT(magnitude(sum - whole), 1e-4 * magnitude(whole)) << e;
        EXPECT_FALSE(largestSenders(*live, live->solution, e, 5).empty());
        const ShownRadiosityPtr shown = shownRadiosity(*live, live->solution, {}, e);
        double shares = 0.0;
        for (const ShownRadiosity::Element& element : shown->elements)
            shares += double{element.share};
        EXPECT_NEAR(shares, linksOf(*live, e).factorSum, 1e-4);
    }
}

TEST(ElementLinks, OtherSolversHaveNone) {
    const LiveRadiosityPtr live = linkedRoom(Solver::GaussSeidel);
    EXPECT_TRUE(linksOf(*live, 0).links.empty());
    EXPECT_TRUE(lightOverLinks(*live, 0).empty());
    EXPECT_TRUE(factorsOverLinks(*live, 0).empty());
}

} // namespace patina::test
