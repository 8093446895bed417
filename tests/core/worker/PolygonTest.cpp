#include "core/codec/model/Polygon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>
#include <limits>
#include <random>

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
