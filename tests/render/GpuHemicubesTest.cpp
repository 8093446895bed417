// Hemicubes that OpenGL draws against those whose cells rays look through.
#include "render/GpuHemicubes.h"
#include "core/job/Parallel.h"
#include "core/radiosity/FaceItems.h"
#include "core/radiosity/FactorMatrix.h"
#include "core/radiosity/HemicubeFactors.h"
#include "tests/core/radiosity/RadiosityScenes.h"
#include "tests/core/trace/CornellScene.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <numbers>
#include <tuple>
#include <vector>

namespace patina::render {
namespace {

using namespace radiosity;
using test::divided;
using test::sceneOf;
using test::Wall;

class GpuHemicubesTest : public ::testing::Test {
  protected:
    void SetUp() override {
        auto made = GpuHemicubes::create();
        ASSERT_TRUE(made) << made.error().text();
        m_drawer = *std::move(made);
    }
    [[nodiscard]] FactorSettings settings(int resolution, bool centreOnly) const {
        FactorSettings result{FactorMethod::Hemicube, resolution, 1, centreOnly};
        result.drawer = m_drawer;
        return result;
    }
    std::shared_ptr<GpuHemicubes> m_drawer;
};

// Form factor through the largest cell, in the middle of the top.
double largestDelta(int resolution) {
    return 4.0 / (std::numbers::pi * resolution * resolution);
}

std::map<std::uint32_t, double> sharesOf(const FormFactors& factors, std::uint32_t element,
                                         FactorRow& row) {
    factors.row(element, row);
    EXPECT_NEAR(row.sum() + row.escaped + row.absorbed, 1.0, 1e-6);
    std::map<std::uint32_t, double> result;
    for (const FactorRow::Share& share : row.shares)
        result[share.element] = share.factor;
    return result;
}

// A wall of one side or two.
Wall square(float half, float z, bool twoSided) {
    Wall wall{{{{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}}}};
    wall.twoSided = twoSided;
    return wall;
}

TEST_F(GpuHemicubesTest, FactorsAreThoseOfRaysInTheCornellBox) {
    constexpr int kCells = 128;
    const auto scene = divided(test::cornellBox(test::kCornellWalls[0], true), {0.05});
    FactorSettings byRays = settings(kCells, false);
    byRays.drawer = nullptr;
    const auto drawn = scene->factors(settings(kCells, false)), cast = scene->factors(byRays);
    std::size_t compared = 0, same = 0;
    for (std::uint32_t e = 0; e < scene->elements.size(); e += 31) {
        FactorRow a, b;
        std::map<std::uint32_t, double> shares = sharesOf(*drawn, e, a);
        for (const auto& [other, factor] : sharesOf(*cast, e, b)) {
            EXPECT_NEAR(shares[other], factor, 2.0 * largestDelta(kCells)) << e << " " << other;
            same += shares[other] == factor ? 1 : 0;
            ++compared;
            shares.erase(other);
        }
        for (const auto& [other, factor] : shares)
            EXPECT_LE(factor, 2.0 * largestDelta(kCells)) << e << " " << other;
        EXPECT_NEAR(a.escaped, b.escaped, 2.0 * largestDelta(kCells)) << e;
        EXPECT_NEAR(a.absorbed, b.absorbed, 2.0 * largestDelta(kCells)) << e;
    }
    EXPECT_GT(compared, 10000u);
    EXPECT_GT(same, compared / 2) << "cells differ only where an edge runs through their middle";
}

TEST_F(GpuHemicubesTest, EachFaceOfTheHemicubeIsWhereItsCellsAre) {
    // A wall in each direction, no two alike, all two-sided: cell for cell.
    const std::vector<Wall> walls{
        square(1e-3f, 0.0f, false),
        square(0.7f, 1.1f, true),
        {{{{1, -0.2f, -0.1f}, {1, 0.9f, -0.1f}, {1, 0.9f, 1.3f}, {1, -0.2f, 0.6f}}}},
        {{{{-0.3f, 1.4f, 0}, {1.2f, 1.4f, 0.2f}, {0.4f, 1.4f, 1.9f}, {-0.3f, 1.4f, 1.2f}}}},
        {{{{-1, -1, 0.1f}, {-1, 0.5f, 0.1f}, {-1, 0.5f, 0.4f}, {-1, -1, 0.7f}}}}};
    std::vector<Wall> two = walls;
    for (std::size_t i = 1; i < two.size(); ++i)
        two[i].twoSided = true;
    for (const std::vector<Wall>& some : {walls, two}) { // else some show their backs
        const auto scene = divided(sceneOf(some), {0.21});
        FactorSettings byRays = settings(64, true);
        byRays.drawer = nullptr;
        const auto drawn = scene->factors(settings(64, true)), cast = scene->factors(byRays);
        const auto seen = [](const FormFactors& factors) {
            return dynamic_cast<const PointFactors&>(factors).seenFromCentre(0);
        };
        const std::vector<std::uint32_t> a = seen(*drawn), b = seen(*cast);
        std::size_t other = 0;
        for (std::size_t cell = 0; cell < a.size(); ++cell)
            other += a[cell] != b[cell] ? 1 : 0;
        EXPECT_LT(other, 8u) << "of " << a.size();
        EXPECT_GT(std::count(b.begin(), b.end(), PointFactors::kOutside), 1000);
    }
}

TEST_F(GpuHemicubesTest, RowsAreTheSameOnAnyNumberOfThreads) {
    const auto scene = divided(sceneOf(test::unitCube(0.5f)), {0.25});
    const auto factors = scene->factors(settings(32, false));
    const auto rowsOn = [&](int threads) {
        const ThreadLimit limit(threads);
        return *FactorMatrix::compute(*factors, scene->elements.size(), 0, {});
    };
    const FactorMatrix one = rowsOn(1), five = rowsOn(5);
    for (std::uint32_t e = 0; e < one.size(); ++e) {
        EXPECT_EQ(one.escaped(e), 0.0f);
        const auto a = one.row(e), b = five.row(e);
        ASSERT_TRUE(
            std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
                return x.element == y.element && x.factor == y.factor;
            }));
    }
}

TEST_F(GpuHemicubesTest, WhatIsCutOutIsSeenThrough) {
    // A wall before another one: cut out, solid, half blended; and cut out in part by its map.
    Image map(2, 1, 4, PixelType::U8, ColorEncoding::Srgb);
    for (const std::size_t channel : {0u, 1u, 2u, 3u, 4u, 5u, 6u})
        map.u8()[channel] = 255;
    map.u8()[7] = 0; // the right half
    const ImagePtr halves = std::make_shared<const Image>(std::move(map));
    for (const auto& [mode, opacity, image, share] :
         {std::tuple(AlphaMode::Mask, 0.4f, ImagePtr(), 0.0),
          std::tuple(AlphaMode::Mask, 0.6f, ImagePtr(), 1.0),
          std::tuple(AlphaMode::Blend, 0.25f, ImagePtr(), 0.25),
          std::tuple(AlphaMode::Mask, 1.0f, halves, 0.5)}) {
        TraceInputs inputs =
            sceneOf({square(1e-3f, 0, false), square(1, 1, true), square(2, 2, true)});
        inputs.materials[1].alphaMode = mode;
        inputs.materials[1].opacity = opacity;
        inputs.materials[1].baseColorMap.image = image;
        const auto scene = divided(inputs, {});
        FactorRow row;
        scene->factors(settings(128, true))->row(0, row);
        double near = 0.0;
        for (const FactorRow::Share& s : row.shares)
            if (scene->elements.face(s.element).mesh == 1)
                near += s.factor;
        // The top of a hemicube, of which both cover all: formfactor.hemicube_delta.
        EXPECT_NEAR(row.sum(), 0.55412642398, 0.003);
        EXPECT_NEAR(near, share * 0.55412642398, share == 0.25 ? 0.01 : 0.004);
    }
}

TEST_F(GpuHemicubesTest, TooManyCellsAreRefused) {
    const auto scene = divided(sceneOf(test::unitCube(0.5f)), {});
    const FaceItems faces(scene->elements);
    const int most = m_drawer->info().maxTextureSize;
    const auto drawn = m_drawer->load(faces, most + most % 2);
    ASSERT_FALSE(drawn);
    EXPECT_EQ(drawn.error().kind, ErrorKind::Usage);
    EXPECT_NE(drawn.error().message.find("--device cpu"), std::string::npos);
    EXPECT_TRUE(m_drawer->load(faces, 64)) << "smaller ones are drawn all the same";
}

} // namespace
} // namespace patina::render
