// Radiosity along a line over a surface, and the elements that light one most.
#include "core/radiosity/document/SurfaceProfile.h"
#include "core/radiosity/document/EnergyFlow.h"
#include "tests/core/radiosity/RadiosityScenes.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <numbers>
#include <set>

namespace patina::test {

using namespace radiosity;

namespace {

LiveRadiosityPtr solved(const TraceInputs& inputs, double maxArea, double adaptive = 0.0) {
    RadiositySettings settings;
    settings.maxArea = maxArea;
    settings.adaptive = adaptive;
    settings.lightSamples = 16;
    settings.factors.resolution = 64;
    if (adaptive > 0.0) // so few rays are noise, which divides nothing
        settings.factors.resolution = 1024;
    const auto live = followRadiosity(inputs, settings, nullptr, {});
    EXPECT_TRUE(live) << live.error().text();
    return *live;
}

void expectConnected(const SurfaceProfile& profile, std::uint32_t element) {
    std::set<std::uint32_t> met;
    bool own = false;
    for (std::size_t i = 0; i < profile.pieces.size(); ++i) {
        const SurfaceProfile::Piece& piece = profile.pieces[i];
        EXPECT_LT(piece.from, piece.to);
        EXPECT_TRUE(met.insert(piece.element).second) << "each element once";
        if (i > 0) {
            EXPECT_NEAR(piece.from, profile.pieces[i - 1].to, 1e-9);
        }
        if (piece.element == element) {
            own = true;
            EXPECT_NEAR(piece.from, -piece.to, 1e-6) << "its middle is 0";
        }
    }
    EXPECT_TRUE(own);
}

double lengthOf(const SurfaceProfile& profile) {
    return profile.pieces.back().to - profile.pieces.front().from;
}

TEST(SurfaceProfile, GoesFromEndToEndOfAWall) {
    const LiveRadiosityPtr live = solved(sceneOf(unitCube(0.5f)), 0.005);
    for (const glm::vec3& way :
         {glm::vec3(0, -1, 0), glm::vec3(1, 0, 0), glm::vec3(0.1f, 0.2f, 0.97f)}) {
        const auto element = elementAlong(*live, {0.52f, 0.47f, 0.55f}, glm::normalize(way));
        ASSERT_TRUE(element);
        const glm::vec3 centre = elementCentre(*live, *element);
        for (const ProfileWay along : {ProfileWay::Across, ProfileWay::Up}) {
            const SurfaceProfile profile = profileOver(*live, *element, along);
            ASSERT_GT(profile.pieces.size(), 5u);
            expectConnected(profile, *element);
            EXPECT_NEAR(lengthOf(profile), 1.0, 1e-6);
            // The pieces lie where the line is.
            for (const SurfaceProfile::Piece& piece : profile.pieces) {
                const glm::vec3 at =
                    centre + profile.way * static_cast<float>(0.5 * (piece.from + piece.to));
                EXPECT_LT(glm::distance(at, elementCentre(*live, piece.element)), 0.06f);
            }
        }
        EXPECT_NEAR(glm::dot(profileOver(*live, *element, ProfileWay::Across).way,
                             profileOver(*live, *element, ProfileWay::Up).way),
                    0.0, 1e-6);
    }
}

TEST(SurfaceProfile, CrossesElementsOfEverySize) {
    std::vector<Wall> walls = unitCube(0.5f);
    const LiveRadiosityPtr live = solved(sceneOf(walls), 0.05, 0.03);
    double smallest = 1.0, largest = 0.0;
    const auto element = elementAlong(*live, {0.5f, 0.5f, 0.5f}, {1, 0, 0});
    ASSERT_TRUE(element);
    const SurfaceProfile profile = profileOver(*live, *element, ProfileWay::Up);
    expectConnected(profile, *element);
    EXPECT_NEAR(lengthOf(profile), 1.0, 1e-6);
    for (const SurfaceProfile::Piece& piece : profile.pieces) {
        smallest = std::min(smallest, piece.to - piece.from);
        largest = std::max(largest, piece.to - piece.from);
    }
    EXPECT_LT(smallest, 0.6 * largest) << "they are divided where the light differs";
}

TEST(SurfaceProfile, GoesRoundABall) {
    TraceInputs inputs =
        sceneOf({Wall{{{{-2, 3, -2}, {2, 3, -2}, {2, 3, 2}, {-2, 3, 2}}}, glm::vec3(0.5f), 1.0f}});
    inputs.materials.push_back({});
    inputs.meshes.push_back(facetedBall(24, 1.0f, false, inputs.materials.size() - 1));
    const LiveRadiosityPtr live = solved(inputs, 1.0);
    const auto element = elementAlong(*live, {3.0f, 0.15f, 0.2f}, {-1, 0, 0});
    ASSERT_TRUE(element);
    const SurfaceProfile profile = profileOver(*live, *element, ProfileWay::Across);
    expectConnected(profile, *element);
    EXPECT_NEAR(lengthOf(profile), 2.0 * std::numbers::pi, 0.05 * 2.0 * std::numbers::pi);
}

TEST(EnergyFlow, NamesTheElementsThatSendMost) {
    const LiveRadiosityPtr live = solved(sceneOf(unitCube(0.5f)), 0.02);
    const auto element = elementAlong(*live, {0.5f, 0.5f, 0.5f}, {1, 0, 0});
    ASSERT_TRUE(element);
    const std::vector<FlowShare> senders = largestSenders(*live, live->solution, *element, 10);
    ASSERT_EQ(senders.size(), 10u);
    double last = 1.0;
    for (const FlowShare& share : senders) {
        EXPECT_LE(share.share, last);
        EXPECT_GT(share.share, 0.0);
        last = share.share;
        ASSERT_TRUE(share.place);
        if (share.kind == FlowShare::Kind::Element) {
            EXPECT_EQ(*share.place, elementCentre(*live, share.element));
            EXPECT_EQ(share.id, live->scene->meshId(live->elements().face(share.element).mesh));
        }
    }
    // All of them together are what arrives.
    glm::dvec3 sum(0.0);
    for (const FlowShare& share :
         largestSenders(*live, live->solution, *element, live->elements().size() + 9))
        sum += share.light;
    const glm::dvec3 irradiance = live->lit.irradiance(live->solution, *element);
    EXPECT_LT(magnitude(sum - irradiance), 1e-4 * magnitude(irradiance));
}

} // namespace
} // namespace patina::test
