#include "core/codec/model/Polygon.h"

#include "core/codec/Codec.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>
#include <limits>
#include <numeric>
#include <random>
#include <string>

namespace patina {
namespace {

using codec::triangulatePolygon;
using Points = std::vector<glm::vec3>;

double area(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::dvec3& up) {
    return 0.5 *
           glm::dot(glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a)), up);
}

double area(const Points& outline, const glm::dvec3& up) {
    double sum = 0.0;
    for (std::size_t i = 1; i + 1 < outline.size(); ++i)
        sum += area(outline[0], outline[i], outline[i + 1], up);
    return sum;
}

// Triangles of the outline's own orientation whose areas add up to its area cover it exactly once.
void expectCovered(const Points& outline, const glm::dvec3& up, std::size_t triangles) {
    const auto found = triangulatePolygon(outline);
    double sum = 0.0;
    for (const auto& t : found) {
        const double part = area(outline[t[0]], outline[t[1]], outline[t[2]], up);
        EXPECT_GT(part, 0.0) << t[0] << " " << t[1] << " " << t[2];
        sum += part;
    }
    const double whole = area(outline, up);
    EXPECT_GT(whole, 0.0);
    EXPECT_NEAR(sum, whole, 1e-6 * whole);
    EXPECT_EQ(found.size(), triangles);
}

// Points on a grid of halves, so that areas are exact; `steps` points on each edge.
Points withPointsOnEdges(const Points& outline, int steps) {
    Points result;
    for (std::size_t i = 0; i < outline.size(); ++i)
        for (int k = 0; k < steps; ++k)
            result.push_back(glm::mix(outline[i], outline[(i + 1) % outline.size()],
                                      static_cast<float>(k) / static_cast<float>(steps)));
    return result;
}

const std::vector<Points> kOutlines{
    {{0, 0, 0}, {4, 0, 0}, {4, 2, 0}, {2, 2, 0}, {2, 4, 0}, {0, 4, 0}},                       // L
    {{2, 0, 0}, {4, 0, 0}, {4, 2, 0}, {6, 2, 0}, {6, 4, 0}, {0, 4, 0}, {0, 2, 0}, {2, 2, 0}}, // T
    {{0, 0, 0}, {6, 0, 0}, {6, 4, 0}, {4, 4, 0}, {4, 2, 0}, {2, 2, 0}, {2, 4, 0}, {0, 4, 0}}, // U
    {{2, 0, 0}, {4, 0, 0}, {6, 4, 0}, {4, 4, 0}, {3, 2, 0}, {2, 4, 0}, {0, 4, 0}},            // V
};

TEST(Polygon, OutlinesWithPointsOnTheirEdgesKeepTheirNotches) {
    for (const Points& outline : kOutlines)
        for (const int steps : {1, 2, 4, 8})
            for (const bool upsideDown : {false, true}) {
                Points points = withPointsOnEdges(outline, steps);
                if (upsideDown)
                    std::reverse(points.begin(), points.end());
                for (std::size_t first = 0; first < points.size(); ++first) {
                    expectCovered(points, {0, 0, upsideDown ? -1 : 1}, points.size() - 2);
                    std::rotate(points.begin(), points.begin() + 1, points.end());
                }
            }
}

TEST(Polygon, TheyMayLieInAnyPlane) {
    for (const Points& outline : kOutlines) {
        Points points = withPointsOnEdges(outline, 4);
        for (glm::vec3& p : points)
            p = {p.y, 0.25f * p.x + 0.5f * p.y, p.x};
        const glm::dvec3 up = glm::cross(glm::dvec3(0, 0.25, 1), glm::dvec3(1, 0.5, 0));
        expectCovered(points, glm::normalize(up), points.size() - 2);
    }
}

// The outline runs into the hole and back along the same line.
TEST(Polygon, HolesStayOpen) {
    const Points outer{{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}};
    const Points hole{{2, 2, 0}, {2, 6, 0}, {6, 6, 0}, {6, 2, 0}};
    for (std::size_t from = 0; from < 4; ++from)
        for (std::size_t into = 0; into < 4; ++into) {
            // Bridges that cross the hole's own side are none.
            if (from != into && (from + into) % 2 == 0)
                continue;
            const std::size_t matching = std::array<std::size_t, 4>{0, 3, 2, 1}[from];
            Points points;
            for (std::size_t i = 0; i <= 4; ++i)
                points.push_back(outer[(from + i) % 4]);
            for (std::size_t i = 0; i <= 4; ++i)
                points.push_back(hole[(matching + i) % 4]);
            expectCovered(points, {0, 0, 1}, points.size() - 2);
        }
}

// A random star-shaped outline on a grid: corners of all angles, points on edges, needles.
TEST(Polygon, RandomOutlinesAreCoveredOnce) {
    std::mt19937 random(1);
    for (int run = 0; run < 300; ++run) {
        const int corners = 5 + static_cast<int>(random() % 60);
        Points points;
        double last = -1.0;
        std::vector<std::pair<double, glm::ivec2>> sorted;
        for (int i = 0; i < corners; ++i) {
            const glm::ivec2 p(static_cast<int>(random() % 41) - 20,
                               static_cast<int>(random() % 41) - 20);
            if (p != glm::ivec2(0))
                sorted.emplace_back(std::atan2(p.y, p.x), p);
        }
        std::sort(sorted.begin(), sorted.end(),
                  [](const auto& a, const auto& b) { return a.first < b.first; });
        for (const auto& [angle, p] : sorted)
            if (angle > last || points.empty()) {
                points.emplace_back(p.x, p.y, 0.0f);
                last = angle;
            }
        // Around the middle without a gap of half a turn.
        bool whole = points.size() > 4;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const glm::vec3 &a = points[i], &b = points[(i + 1) % points.size()];
            whole = whole && a.x * b.y - a.y * b.x > 0.0f;
        }
        if (!whole)
            continue;
        const auto found = triangulatePolygon(points);
        double sum = 0.0;
        for (const auto& t : found) {
            const double part = area(points[t[0]], points[t[1]], points[t[2]], {0, 0, 1});
            EXPECT_GT(part, 0.0) << "run " << run;
            sum += part;
        }
        EXPECT_DOUBLE_EQ(sum, area(points, {0, 0, 1})) << "run " << run;
    }
}

// Each corner against all others, as Polygon.h describes it; for polygons that are simple and run
// counter-clockwise in the plane.
std::vector<std::array<std::uint32_t, 3>> slowly(const Points& points) {
    std::vector<std::uint32_t> left(points.size());
    std::iota(left.begin(), left.end(), 0u);
    const auto areaOf = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        return area(points[a], points[b], points[c], {0, 0, 1});
    };
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::size_t at = 0; left.size() >= 3;) {
        const auto corner = [&](std::size_t i) { return left[i % left.size()]; };
        // Free of other corners, at its border, too; else without area.
        const auto isFree = [&](std::size_t i) {
            const std::uint32_t a = corner(i + left.size() - 1), b = corner(i), c = corner(i + 1);
            return areaOf(a, b, c) > 0.0 && std::none_of(left.begin(), left.end(), [&](auto p) {
                       return p != a && p != b && p != c && areaOf(a, b, p) >= 0.0 &&
                              areaOf(b, c, p) >= 0.0 && areaOf(c, a, p) >= 0.0;
                   });
        };
        const auto isFlat = [&](std::size_t i) {
            return areaOf(corner(i + left.size() - 1), corner(i), corner(i + 1)) == 0.0;
        };
        std::size_t ear = at;
        while (ear < at + left.size() && !isFree(ear))
            ++ear;
        const bool free = ear < at + left.size();
        while (!free && !isFlat(ear))
            ++ear;
        ear %= left.size();
        if (free)
            triangles.push_back({corner(ear + left.size() - 1), corner(ear), corner(ear + 1)});
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
        at = (ear + 1) % left.size();
    }
    return triangles;
}

// Outlines of many corners, on grids, so that areas are exact.
Points comb(int teeth) {
    Points points{{0.0f, -1.0f, 0.0f}, {2.0f * static_cast<float>(teeth), -1.0f, 0.0f}};
    for (int i = teeth; i-- > 0;) {
        const float x = 2.0f * static_cast<float>(i);
        points.insert(points.end(), {{x + 2, 0, 0}, {x + 1, 100, 0}});
    }
    points.emplace_back(0.0f, 0.0f, 0.0f);
    return points;
}

Points spiral(int turns) {
    Points outside, inside;
    for (int i = 0; i < 4 * turns; ++i) {
        const float r = 1.0f + static_cast<float>(i / 2);
        const glm::vec3 corner(i % 4 == 0 || i % 4 == 3 ? r : -r, i % 4 < 2 ? r : -r, 0);
        outside.push_back(corner);
        inside.push_back(corner * ((r - 0.5f) / r));
    }
    outside.insert(outside.end(), inside.rbegin(), inside.rend());
    return outside;
}

// Radii at random, so that a third of the corners are concave.
Points star(int corners) {
    std::mt19937 random(3);
    Points points;
    for (int i = 0; i < corners; ++i) {
        const double angle = 2.0 * 3.14159265358979 * i / corners;
        const double radius = 1e6 * (0.5 + 0.5 * (random() / 4294967296.0));
        points.emplace_back(std::round(radius * std::cos(angle)),
                            std::round(radius * std::sin(angle)), 0.0f);
    }
    return points;
}

Points square(int corners) {
    const int side = corners / 4;
    Points points;
    for (int edge = 0; edge < 4; ++edge)
        for (int i = 0; i < side; ++i) {
            const glm::ivec2 at = edge == 0   ? glm::ivec2(i, 0)
                                  : edge == 1 ? glm::ivec2(side, i)
                                  : edge == 2 ? glm::ivec2(side - i, side)
                                              : glm::ivec2(0, side - i);
            points.emplace_back(at.x, at.y, 0.0f);
        }
    return points;
}

TEST(Polygon, ManyCornersMakeTheTrianglesOfAFew) {
    for (const int corners : {65, 70, 100, 300})
        for (const Points& points :
             {comb(corners / 2), spiral(corners / 8), star(corners), square(corners)}) {
            const auto found = triangulatePolygon(points);
            EXPECT_EQ(found, slowly(points)) << corners;
        }
}

// Sixteen times the corners may take twice their share of the time. (Each corner against each other
// takes sixteen times their share: 35 s of a face of 100,000.)
TEST(Polygon, TimeGrowsWithTheCorners) {
    const auto seconds = [](const Points& points) {
        const std::clock_t begin = std::clock();
        expectCovered(points, {0, 0, 1}, points.size() - 2);
        return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    };
    const auto check = [&](const char* name, const auto& outline) {
        const double few = seconds(outline(6'400)), many = seconds(outline(102'400));
        EXPECT_LT(many, std::max(32.0 * few, 1.0)) << name;
    };
    check("comb", [](int corners) { return comb(corners / 2); });
    check("spiral", [](int corners) { return spiral(corners / 8); });
    check("star", star);
    check("square", square);
}

// What no care can make quick is refused before long.
TEST(Polygon, OutlinesThatTouchThemselvesEverywhereAreRefused) {
    Points petals;
    for (int i = 0; i < 15'000; ++i) {
        const double angle = 2.0 * 3.14159265358979 * i / 15'000, next = angle + 2e-4;
        petals.insert(petals.end(), {{0, 0, 0},
                                     {std::cos(angle), std::sin(angle), 0},
                                     {std::cos(next), std::sin(next), 0}});
    }
    try {
        (void)triangulatePolygon(petals);
        FAIL() << "it is divided after all";
    } catch (const codec::Refusal& refusal) {
        EXPECT_NE(std::string(refusal.what()).find("a face of 45000 corners"), std::string::npos);
    }
}

TEST(Polygon, NothingHangsOrIsOutOfRange) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float inf = std::numeric_limits<float>::infinity();
    std::mt19937 random(2);
    for (int run = 0; run < 2000; ++run) { // any order: most cross themselves
        Points points(3 + random() % 12);
        for (glm::vec3& p : points)
            p = {static_cast<float>(random() % 4), static_cast<float>(random() % 4),
                 static_cast<float>(random() % 2)};
        if (run % 10 == 0)
            points[random() % points.size()].x = run % 20 == 0 ? nan : inf;
        const auto found = triangulatePolygon(points);
        EXPECT_LE(found.size(), points.size() - 2);
        for (const auto& t : found)
            for (const std::uint32_t corner : t)
                ASSERT_LT(corner, points.size());
    }
    EXPECT_TRUE(triangulatePolygon(Points(2)).empty());
}

} // namespace
} // namespace patina
