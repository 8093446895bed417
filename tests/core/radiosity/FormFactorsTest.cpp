// Form factors between elements of scenes, obstacles included, by every method.
#include "core/job/Parallel.h"
#include "core/radiosity/FactorMatrix.h"
#include "core/radiosity/HemicubeFactors.h"
#include "tests/core/radiosity/RadiosityScenes.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <gtest/gtest.h>
#include <set>
#include <thread>

namespace patina::test {

using namespace radiosity;

namespace {

double factorTo(const FactorRow& row, std::uint32_t element) {
    for (const FactorRow::Share& share : row.shares)
        if (share.element == element)
            return share.factor;
    return 0.0;
}

double longestEdge(const Polygon& polygon) {
    double longest = 0.0;
    for (std::size_t k = 0; k < polygon.count; ++k)
        longest = std::max(
            longest, glm::length(polygon.corners[(k + 1) % polygon.count] - polygon.corners[k]));
    return longest;
}

TEST(ElementMesh, MakesOneElementOfTwoTrianglesThatAreOneQuad) {
    const auto scene = divided(sceneOf(unitCube(0.5f)), {});
    ASSERT_EQ(scene->elements.size(), 6u);
    for (std::uint32_t e = 0; e < 6; ++e) {
        EXPECT_NEAR(scene->elements.area(e), 1.0, 1e-12);
        EXPECT_EQ(scene->elements.polygon(e).count, 4u);
        EXPECT_NEAR(glm::dot(scene->elements.face(e).normal, scene->elements.centre(e)) *
                        scene->elements.metresPerUnit(),
                    -0.5, 1e-12)
            << "fronts look inside";
    }
}

TEST(ElementMesh, DividesByEdgeAndByAreaAndFindsEveryElementAgain) {
    // A quad that is no parallelogram, a triangle, and a quad seen from both sides.
    std::vector<Wall> walls{{{{{0, 0, 0}, {3, 0, 0}, {2, 2, 0}, {0, 1, 0}}}},
                            {{{{0, 0, 2}, {2, 0, 2}, {1, 2, 2}, {1, 2, 2}}}},
                            {{{{4, 0, 0}, {5, 0, 0}, {5, 1, 1}, {4, 1, 1}}}}};
    walls[2].twoSided = true;
    for (const ElementLimits& limits :
         {ElementLimits{}, ElementLimits{0.4}, ElementLimits{0.0, 0.05}}) {
        auto scene = divided(sceneOf(walls), limits);
        ElementMesh& elements = scene->elements;
        std::vector<std::uint32_t> some;
        for (std::uint32_t e = 0; e < elements.size(); e += 3)
            some.push_back(e);
        for (int round = 0; round < 2; ++round) {
            double area = 0.0;
            for (std::uint32_t e = 0; e < elements.size(); ++e) {
                area += elements.area(e);
                if (round == 0) {
                    if (limits.maxArea > 0.0) {
                        EXPECT_LE(elements.area(e), limits.maxArea * 1.000001);
                    }
                    const double longest = longestEdge(elements.polygon(e));
                    if (limits.maxEdge > 0.0) {
                        EXPECT_LE(longest * elements.metresPerUnit(), limits.maxEdge * 1.000001);
                    }
                }
                // What is inside of it is found in it.
                for (const glm::vec2& u : {glm::vec2(0.5f), glm::vec2(0.1f, 0.8f),
                                           glm::vec2(0.97f, 0.96f), glm::vec2(0.02f, 0.03f)}) {
                    const Face& face = elements.face(e);
                    const glm::dvec3 at = elements.samplePosition(e, u);
                    EXPECT_EQ(elements.elementAt(elements.node(e).face, coordinatesOn(face, at)),
                              e);
                    ClosestRay ray;
                    ray.ray.origin = glm::vec3(at + 0.01 * face.normal);
                    ray.ray.direction = glm::vec3(-face.normal);
                    scene->scene.rays()->intersect({&ray, 1});
                    EXPECT_EQ(elements.met(ray), e);
                }
            }
            EXPECT_NEAR(area, 4.0 + 2.0 + 2.0 * std::sqrt(2.0), 1e-5);
            const std::size_t before = elements.size();
            const std::vector<std::uint32_t> old = elements.divide(some);
            EXPECT_EQ(elements.size(), before + 3 * some.size());
            EXPECT_EQ(std::set<std::uint32_t>(old.begin(), old.end()).size(), before);
            some = {0, static_cast<std::uint32_t>(elements.size() - 1)};
        }
    }
}

TEST(ElementMesh, RefusesADivisionThatIsTooFine) {
    const auto scene = TraceScene::build(sceneOf(unitCube(0.5f)), {});
    const auto elements = ElementMesh::make(*scene->geometry(), {0.001, 0.0, 1000});
    ASSERT_FALSE(elements);
    EXPECT_NE(elements.error().message.find("6000000 elements, and 1000 are allowed"),
              std::string::npos)
        << elements.error().message;
}

TEST(HemicubeFactors, OneStandIsTheCentreAloneAndTakesATenth) {
    const auto scene = divided(sceneOf(unitCube(0.5f)), {0.2});
    const auto factors = [&](int stands, bool centreOnly) {
        FactorSettings settings{FactorMethod::Hemicube, 16, 5, centreOnly};
        settings.stands = stands;
        return scene->factors(settings);
    };
    const auto one = factors(1, false), centre = factors(3, true), nine = factors(3, false);
    bool differs = false;
    for (std::uint32_t e = 0; e < scene->elements.size(); e += 5) {
        FactorRow alone, classic, several;
        one->row(e, alone);
        centre->row(e, classic);
        nine->row(e, several);
        ASSERT_EQ(alone.shares.size(), classic.shares.size());
        for (std::size_t i = 0; i < alone.shares.size(); ++i)
            EXPECT_EQ(alone.shares[i].factor, classic.shares[i].factor);
        differs = differs || several.shares.size() > alone.shares.size();
    }
    EXPECT_TRUE(differs) << "others are near";
}

// A row takes 2 ms, whoever computes it.
TEST(FormFactors, SayHowLongAllRowsWillTake) {
    struct Slow : FormFactors {
        mutable std::atomic<int> rows{0};
        void row(std::uint32_t sender, FactorRow& row) const override {
            EXPECT_LT(sender, 1000u);
            row.clear();
            ++rows;
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
    };
    const Slow slow;
    const double threads = std::max(threadCount(), 1);
    const double seconds = expectedSeconds(slow, 1000, {});
    EXPECT_LE(slow.rows, 2 * threads) << "it is begun only";
    EXPECT_GT(seconds, 0.9 * 2.0 / threads);
    EXPECT_EQ(expectedSeconds(slow, 0, {}), 0.0);
}

TEST(HemicubeFactors, TheCellsThatAreShownAddUpToTheRow) {
    // A room with a block on its floor, and a part of the ceiling open.
    std::vector<Wall> walls = unitCube(0.5f);
    walls[0].corners = {{{0, 0, 1}, {0, 1, 1}, {0.6f, 1, 1}, {0.6f, 0, 1}}};
    walls.push_back(
        {{{{0.4f, 0.3f, 0.5f}, {0.7f, 0.3f, 0.5f}, {0.7f, 0.6f, 0.5f}, {0.4f, 0.6f, 0.5f}}}});
    const auto scene = divided(sceneOf(walls), {0.2});
    const FactorSettings settings{FactorMethod::Hemicube, 32, 5, true};
    const HemicubeFactors factors(scene->elements, *scene->scene.rays(), settings);
    bool outside = false, backs = false;
    for (std::uint32_t e = 0; e < scene->elements.size(); e += 7) {
        FactorRow row;
        factors.row(e, row);
        const std::vector<std::uint32_t> seen = factors.seenFromCentre(e);
        const auto cells = factors.cells().cells();
        ASSERT_EQ(seen.size(), cells.size());
        std::vector<double> sums(scene->elements.size(), 0.0);
        double escaped = 0.0, absorbed = 0.0, total = 0.0;
        for (std::size_t c = 0; c < cells.size(); ++c) {
            total += cells[c].factor;
            (seen[c] == HemicubeFactors::kOutside ? escaped
             : seen[c] == HemicubeFactors::kBack  ? absorbed
                                                  : sums[seen[c]]) += cells[c].factor;
        }
        EXPECT_NEAR(total, 1.0, 1e-12);
        for (std::uint32_t other = 0; other < scene->elements.size(); ++other)
            EXPECT_NEAR(factorTo(row, other), sums[other], 1e-7) << e << " -> " << other;
        EXPECT_NEAR(row.escaped, escaped, 1e-7);
        EXPECT_NEAR(row.absorbed, absorbed, 1e-7);
        outside = outside || escaped > 0.0;
        backs = backs || absorbed > 0.0;
    }
    EXPECT_TRUE(outside);
    EXPECT_TRUE(backs);
}

class EveryMethod : public ::testing::TestWithParam<FactorMethod> {
  protected:
    [[nodiscard]] FactorSettings settings() const {
        const int resolution = GetParam() == FactorMethod::Rays         ? 1 << 14
                               : GetParam() == FactorMethod::Paraboloid ? 512
                                                                        : 256;
        return {GetParam(), resolution, 7};
    }
};

TEST_P(EveryMethod, FindsTheFactorsOfAUnitCube) {
    const auto scene = divided(sceneOf(unitCube(0.5f)), {});
    const auto factors = scene->factors(settings());
    const double tolerance = GetParam() == FactorMethod::Analytic ? 1e-6 : 0.01 * kOpposite;
    FactorRow row;
    for (std::uint32_t e = 0; e < 6; ++e) {
        factors->row(e, row);
        const std::uint32_t opposite = e ^ 1;
        for (std::uint32_t other = 0; other < 6; ++other) {
            const double truth = other == e ? 0.0 : (other == opposite ? kOpposite : kAdjacent);
            EXPECT_NEAR(factorTo(row, other), truth, tolerance) << e << " " << other;
        }
        EXPECT_NEAR(row.sum() + row.escaped + row.absorbed, 1.0, 1e-6) << "closed";
        EXPECT_NEAR(row.escaped, 0.0, 1e-6);
    }
}

TEST_P(EveryMethod, TellsWhatEscapesAndWhatBacksAbsorb) {
    // Two squares that face one another, one of them with its back to a third.
    const std::vector<Wall> walls{{{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}},
                                  {{{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}}},
                                  {{{{0, 0, 2}, {0, 1, 2}, {1, 1, 2}, {1, 0, 2}}}}};
    const auto scene = divided(sceneOf(walls), {});
    const auto factors = scene->factors(settings());
    FactorRow row;
    factors->row(0, row);
    EXPECT_NEAR(factorTo(row, 1), kOpposite, 0.01 * kOpposite);
    EXPECT_NEAR(row.sum() + row.escaped, 1.0, 1e-6);
    factors->row(2, row);
    if (GetParam() == FactorMethod::Analytic) {
        EXPECT_LT(row.sum(), 0.05) << "most of the first square is hidden";
    } else {
        // One point, the centre, where only a back is near, which is no element.
        const double centre = 4.0 * 0.0598641176152; // Howell B-3: four quarters of .5 by .5 at 1
        EXPECT_NEAR(row.absorbed, GetParam() == FactorMethod::Rays ? kOpposite : centre,
                    0.01 * kOpposite);
        EXPECT_NEAR(row.sum() + row.absorbed + row.escaped, 1.0, 1e-6);
    }
}

TEST_P(EveryMethod, LetsNothingThroughAWall) {
    // A box that a wall divides: light on one side.
    std::vector<Wall> walls = unitCube(0.5f);
    walls.push_back({{{{0.5f, 0, 0}, {0.5f, 1, 0}, {0.5f, 1, 1}, {0.5f, 0, 1}}}});
    walls.back().twoSided = true;
    const auto scene = divided(sceneOf(walls), {0.5});
    const auto factors = scene->factors({GetParam(), 64, 3});
    FactorRow row;
    for (std::uint32_t e = 0; e < scene->elements.size(); ++e) {
        factors->row(e, row);
        const bool left = scene->elements.centre(e).x + 1e-3 * scene->elements.face(e).normal.x < 0;
        for (const FactorRow::Share& share : row.shares) {
            const glm::dvec3 there = scene->elements.centre(share.element) +
                                     1e-3 * scene->elements.face(share.element).normal;
            EXPECT_EQ(there.x < 0, left) << e << " -> " << share.element;
        }
        EXPECT_NEAR(row.sum(), 1.0, GetParam() == FactorMethod::Analytic ? 1e-4 : 1e-6) << e;
    }
}

TEST_P(EveryMethod, LeavesOutWhatABlockStandsOn) {
    // Some elements of the floor are below the block, wholly or in part.
    std::vector<Wall> walls = unitCube(0.5f);
    const float x0 = 0.3f, x1 = 0.73f, y0 = 0.2f, y1 = 0.66f, z = 0.4f;
    const std::array<std::array<glm::vec3, 4>, 5> block{
        {{{{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}}},
         {{{x0, y0, 0}, {x1, y0, 0}, {x1, y0, z}, {x0, y0, z}}},
         {{{x1, y0, 0}, {x1, y1, 0}, {x1, y1, z}, {x1, y0, z}}},
         {{{x1, y1, 0}, {x0, y1, 0}, {x0, y1, z}, {x1, y1, z}}},
         {{{x0, y1, 0}, {x0, y0, 0}, {x0, y0, z}, {x0, y1, z}}}}};
    for (const std::array<glm::vec3, 4>& corners : block)
        walls.push_back({corners});
    const auto scene = divided(sceneOf(walls), {0.13});
    const int resolution = GetParam() == FactorMethod::Hemicube     ? 32
                           : GetParam() == FactorMethod::Paraboloid ? 64
                                                                    : 256;
    const auto factors = scene->factors({GetParam(), resolution, 3});
    int buried = 0, partly = 0;
    double error = 0.0, rows = 0.0;
    FactorRow row;
    for (std::uint32_t e = 0; e < scene->elements.size(); ++e) {
        factors->row(e, row);
        const float exposed = scene->elements.exposed(e);
        buried += exposed == 0.0f ? 1 : 0;
        partly += exposed > 0.0f && exposed < 1.0f ? 1 : 0;
        for (const FactorRow::Share& share : row.shares)
            EXPECT_GT(scene->elements.exposed(share.element), 0.0f) << e;
        if (exposed == 0.0f) {
            EXPECT_EQ(row.absorbed, 1.0f);
            continue;
        }
        error += std::abs(row.sum() - 1.0);
        rows += 1.0;
    }
    EXPECT_GE(buried, 4);
    EXPECT_GE(partly, 8);
    EXPECT_LT(error / rows, GetParam() == FactorMethod::Analytic ? 0.01 : 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Radiosity, EveryMethod,
                         ::testing::Values(FactorMethod::Rays, FactorMethod::Hemicube,
                                           FactorMethod::Analytic, FactorMethod::Paraboloid),
                         [](const auto& test) { return std::string(name(test.param)); });

TEST(AnalyticFactors, OfADividedBoxAreClosedAndReciprocal) {
    const auto scene = divided(sceneOf(unitCube(0.5f)), {0.25});
    const auto factors = scene->factors({FactorMethod::Analytic, 8, 0});
    const auto matrix = FactorMatrix::compute(*factors, scene->elements.size(), 0, {});
    ASSERT_TRUE(matrix);
    const FactorQuality quality = qualityOf(*matrix, scene->elements.areas());
    EXPECT_LT(quality.escaped, 2e-6);
    EXPECT_LT(quality.reciprocity, 2e-6);
    EXPECT_LT(quality.closure, 1e-5);
}

TEST(FactorMatrix, RefusesToTakeMoreThanItsBudget) {
    const auto scene = divided(sceneOf(unitCube(0.5f)), {0.25});
    const auto factors = scene->factors({});
    const auto matrix = FactorMatrix::compute(*factors, scene->elements.size(), 10000, {});
    ASSERT_FALSE(matrix);
    EXPECT_EQ(matrix.error().kind, ErrorKind::Usage);
    EXPECT_NE(matrix.error().message.find("divide"), std::string::npos);
}

TEST(FactorMatrix, IsTheSameOnAnyNumberOfThreads) {
    const auto scene = divided(sceneOf(unitCube(0.5f)), {0.25});
    for (const FactorSettings& settings :
         {FactorSettings{}, FactorSettings{FactorMethod::Hemicube, 16},
          FactorSettings{FactorMethod::Paraboloid, 32}}) {
        const auto factors = scene->factors(settings);
        std::vector<FactorMatrix> matrices;
        for (const int threads : {1, 2, 7}) {
            const ThreadLimit limit(threads);
            matrices.push_back(*FactorMatrix::compute(*factors, scene->elements.size(), 0, {}));
        }
        for (std::size_t k = 1; k < 3; ++k)
            for (std::uint32_t e = 0; e < matrices[0].size(); ++e) {
                const auto a = matrices[0].row(e), b = matrices[k].row(e);
                ASSERT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end(),
                                       [](const auto& x, const auto& y) {
                                           return x.element == y.element && x.factor == y.factor;
                                       }))
                    << name(settings.method);
            }
    }
}

} // namespace
} // namespace patina::test
