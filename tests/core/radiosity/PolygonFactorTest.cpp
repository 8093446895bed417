// Form factors in closed form against catalogued values: Howell, "A Catalog of Radiation Heat
// Transfer Configuration Factors" (numbers as in the tests), to twelve digits.
#include "core/radiosity/PolygonFactor.h"
#include "core/radiosity/HemicubeFactors.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

namespace patina::radiosity {
namespace {

using Points = std::vector<glm::dvec3>;

Polygon rectangle(const glm::dvec3& origin, const glm::dvec3& x, const glm::dvec3& y) {
    return Polygon(Points{origin, origin + x, origin + x + y, origin + y});
}

double factor(const Polygon& a, const Polygon& b) {
    return exchange(a, b) / glm::length(areaVector(a.points()));
}

TEST(PolygonFactor, OfParallelRectanglesIsHowellsC11) {
    struct Case {
        double a, b, c, truth;
    };
    for (const Case& k : {Case{1, 1, 1, 0.199824895698}, Case{1, 2, 1, 0.285875384851},
                          Case{2, 2, 1, 0.415253283577}, Case{10, 10, 1, 0.826994522397},
                          Case{1, 1.5, 0.5, 0.475576436533}, Case{0.1, 0.1, 0.05, 0.415253283577},
                          Case{1, 1, 10, 0.00316205683875}}) {
        const Polygon below = rectangle({0, 0, 0}, {k.a, 0, 0}, {0, k.b, 0}),
                      above = rectangle({0, 0, k.c}, {0, k.b, 0}, {k.a, 0, 0});
        EXPECT_NEAR(factor(below, above), k.truth, 1e-8) << k.a << " " << k.b << " " << k.c;
        EXPECT_NEAR(factor(above, below), k.truth, 1e-8);
    }
}

TEST(PolygonFactor, OfRectanglesAtARightAngleIsHowellsC14) {
    struct Case {
        double h, l, w, truth;
    };
    for (const Case& k : {Case{1, 1, 1, 0.200043776075}, Case{2, 1, 1, 0.232852602795},
                          Case{1, 1, 2, 0.116426301398}, Case{1, 2, 1, 0.240636006177},
                          Case{0.5, 1, 1, 0.146186679106}}) {
        const Polygon floor = rectangle({0, 0, 0}, {k.w, 0, 0}, {0, k.l, 0}),
                      wall = rectangle({0, 0, 0}, {0, k.l, 0}, {0, 0, k.h});
        EXPECT_NEAR(factor(floor, wall), k.truth, 1e-7) << k.h << " " << k.l << " " << k.w;
        EXPECT_NEAR(factor(wall, floor) * k.h, k.truth * k.w, 1e-7) << "reciprocity";
    }
}

TEST(PolygonFactor, OfParallelRectanglesInPiecesIsTheSame) {
    // Edges that run along one another, touch and cross, all of one exchange.
    const Polygon floor = rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    double sum = 0.0;
    for (const double y : {0.0, 0.3, 0.55})
        for (const double z : {0.0, 0.4}) {
            const double y1 = y == 0.0 ? 0.3 : (y == 0.3 ? 0.55 : 1.0), z1 = z == 0.0 ? 0.4 : 1.0;
            sum += exchange(rectangle({0, y, z}, {0, y1 - y, 0}, {0, 0, z1 - z}), floor);
        }
    EXPECT_NEAR(sum, 0.200043776075, 1e-7);
}

TEST(PolygonFactor, OfAWallThatStandsOnAFloorCountsBothSidesApart) {
    // The wall's foot crosses the floor: only what is before its front sees it.
    const Polygon floor = rectangle({-1, 0, 0}, {2, 0, 0}, {0, 1, 0}),
                  wall = rectangle({0, 0, -0.5}, {0, 1, 0}, {0, 0, 1.5});
    EXPECT_NEAR(exchange(floor, wall), 0.200043776075, 1e-7);
}

TEST(PolygonFactor, OfPolygonsThatTurnAwayIsNothing) {
    const Polygon below = rectangle({0, 0, 0}, {0, 1, 0}, {1, 0, 0}),
                  above = rectangle({0, 0, 1}, {1, 0, 0}, {0, 1, 0});
    EXPECT_EQ(exchange(below, above), 0.0);
    const Polygon beside = rectangle({1, 0, 0}, {1, 0, 0}, {0, 1, 0});
    EXPECT_EQ(exchange(rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), beside), 0.0) << "one plane";
}

TEST(PolygonFactor, FromAPointIsLambertsWithWhatIsBelowTheHorizonCutOff) {
    const glm::dvec3 up(0, 0, 1);
    const Polygon triangle(Points{{1, 0, 1}, {-0.5, -0.5, 1.2}, {0, 1.5, 2}});
    EXPECT_NEAR(pointToPolygon({}, up, triangle), 0.173508388477, 1e-11);
    const Polygon quad(Points{{1, -1, -0.5}, {1, -1, 1}, {1, 1, 1}, {1, 1, -0.5}});
    EXPECT_NEAR(pointToPolygon({}, up, quad), 0.111468394005, 1e-11);
}

TEST(PolygonFactor, FromAPointToRectanglesIsHowellsB3AndB4) {
    struct Case {
        double a, b, c, parallel, perpendicular;
    };
    for (const Case& k : {Case{1, 1, 1, 0.138531605995, 0.0557341970026},
                          Case{2, 1, 1, 0.167375009914, 0.0950679411924},
                          Case{0.5, 0.5, 1, 0.0598641176152, 0.01392769121},
                          Case{1, 1, 2, 0.0598641176152, 0.01392769121}}) {
        const Polygon above = rectangle({0, 0, k.c}, {0, k.b, 0}, {k.a, 0, 0});
        EXPECT_NEAR(pointToPolygon({}, {0, 0, 1}, above), k.parallel, 1e-11);
        const Polygon wall = rectangle({k.c, 0, 0}, {0, 0, k.a}, {0, k.b, 0});
        EXPECT_NEAR(pointToPolygon({}, {0, 0, 1}, wall), k.perpendicular, 1e-11);
    }
}

// Discs and spheres out of many polygons, whose form factors converge as the square of their
// number: extrapolated, they are those of the round ones.
Polygon sector(double radius, double h, int part, int parts) {
    const auto at = [&](int k) {
        const double angle = 2.0 * std::numbers::pi * k / parts;
        return glm::dvec3(radius * std::cos(angle), radius * std::sin(angle), h);
    };
    return Polygon(Points{{0, 0, h}, at(part + 1), at(part)});
}

double pointToDisc(const glm::dvec3& point, const glm::dvec3& normal, double radius, double h,
                   int parts) {
    double sum = 0.0;
    for (int k = 0; k < parts; ++k)
        sum += pointToPolygon(point, normal, sector(radius, h, k, parts));
    return sum;
}

TEST(PolygonFactor, FromAPointToADiscIsHowellsB13) {
    struct Case {
        double a, r, h, truth;
    };
    for (const Case& k : {Case{0, 1, 1, 0.5}, Case{0, 1, 2, 0.2}, Case{1, 1, 1, 0.27639320225},
                          Case{2, 1, 1, 0.0527864045}, Case{0.5, 0.25, 1, 0.039182312431}}) {
        const double coarse = pointToDisc({k.a, 0, 0}, {0, 0, 1}, k.r, k.h, 256),
                     fine = pointToDisc({k.a, 0, 0}, {0, 0, 1}, k.r, k.h, 512);
        EXPECT_NEAR(fine + (fine - coarse) / 3.0, k.truth, 1e-7);
    }
}

TEST(PolygonFactor, OfCoaxialDiscsIsHowellsC41) {
    struct Case {
        double r1, r2, h, truth;
    };
    for (const Case& k : {Case{1, 1, 1, 0.38196601125}, Case{1, 2, 1, 0.7639320225},
                          Case{2, 1, 1, 0.190983005625}, Case{0.5, 1, 2, 0.192235935956},
                          Case{1, 1, 0.1, 0.904875078027}, Case{1, 1, 10, 0.00980486407215}}) {
        // A sector of the first sees all of the second: one for all.
        const auto discs = [&](int parts) {
            const Polygon mine(Points{{0, 0, 0},
                                      {k.r1, 0, 0},
                                      {k.r1 * std::cos(2.0 * std::numbers::pi / parts),
                                       k.r1 * std::sin(2.0 * std::numbers::pi / parts), 0}});
            double sum = 0.0;
            for (int i = 0; i < parts; ++i)
                sum += exchange(mine, sector(k.r2, k.h, i, parts));
            return sum / glm::length(areaVector(mine.points()));
        };
        const double coarse = discs(96), fine = discs(192);
        EXPECT_NEAR(fine + (fine - coarse) / 3.0, k.truth, 1e-6) << k.r1 << " " << k.h;
    }
}

TEST(Hemicube, CellsAreIntegratedExactlyAndSumUpToOne) {
    // Top and side of a hemicube, top_exact and side_exact of formfactor.hemicube_delta.
    EXPECT_NEAR(HemicubeCells::top(-1, 1, -1, 1), 0.55412642398, 1e-11);
    EXPECT_NEAR(HemicubeCells::side(-1, 1, 0, 1), 0.111468394005, 1e-11);
    for (const int resolution : {2, 16, 128}) {
        const HemicubeCells cells(resolution);
        double sum = 0.0;
        for (const HemicubeCells::Cell& cell : cells.cells())
            sum += cell.factor;
        EXPECT_NEAR(sum, 1.0, 1e-12) << resolution;
        EXPECT_EQ(cells.cells().size(), 3u * resolution * resolution);
        double front = 0.0;
        for (const HemicubeCells::Cell& cell : cells.cells(HemicubeCells::Face::Front)) {
            EXPECT_LT(cell.direction.y, 0.0f);
            front += cell.factor;
        }
        EXPECT_NEAR(front, 0.111468394005, 1e-11);
    }
}

} // namespace
} // namespace patina::radiosity
