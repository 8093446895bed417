// Which texels a triangle in the plane covers: the one rasteriser of the UV room and the texel
// bakes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <utility>

namespace patina {

// Calls visit(x, y) for every texel whose centre (x + 0.5, y + 0.5) lies in the triangle, of either
// orientation. Coordinates are in texels. A centre on the edge that two triangles share belongs to
// exactly one of them: rows and columns are half-open, and an edge gives the same numbers whichever
// triangle asks.
template <class Visit>
void forEachCoveredTexel(const std::array<glm::dvec2, 3>& triangle, Visit&& visit) {
    const auto [low, high] = std::minmax({triangle[0].y, triangle[1].y, triangle[2].y});
    const auto firstRow = static_cast<std::int64_t>(std::ceil(low - 0.5));
    const auto endRow = static_cast<std::int64_t>(std::ceil(high - 0.5));
    for (std::int64_t y = firstRow; y < endRow; ++y) {
        const double row = static_cast<double>(y) + 0.5;
        double crossings[2] = {0.0, 0.0};
        int count = 0;
        for (int edge = 0; edge < 3 && count < 2; ++edge) {
            glm::dvec2 a = triangle[static_cast<std::size_t>(edge)];
            glm::dvec2 b = triangle[static_cast<std::size_t>((edge + 1) % 3)];
            if (a.y > b.y)
                std::swap(a, b);
            if (a.y <= row && row < b.y)
                crossings[count++] = a.x + (b.x - a.x) * ((row - a.y) / (b.y - a.y));
        }
        if (count < 2)
            continue;
        if (crossings[0] > crossings[1])
            std::swap(crossings[0], crossings[1]);
        const auto firstColumn = static_cast<std::int64_t>(std::ceil(crossings[0] - 0.5));
        const auto endColumn = static_cast<std::int64_t>(std::ceil(crossings[1] - 0.5));
        for (std::int64_t x = firstColumn; x < endColumn; ++x)
            visit(x, y);
    }
}

// Distance of `point` to the triangle's border, positive inside; of either orientation.
[[nodiscard]] inline double insideDistance(const std::array<glm::dvec2, 3>& triangle,
                                           const glm::dvec2& point) {
    const auto cross = [](const glm::dvec2& a, const glm::dvec2& b) {
        return a.x * b.y - a.y * b.x;
    };
    const double area = cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
    double distance = 1e300;
    for (std::size_t edge = 0; edge < 3; ++edge) {
        const glm::dvec2 a = triangle[edge], b = triangle[(edge + 1) % 3];
        const double length = glm::length(b - a);
        if (!(length > 0.0))
            return -1.0;
        distance = std::min(distance, cross(b - a, point - a) / length * (area < 0.0 ? -1.0 : 1.0));
    }
    return distance;
}

} // namespace patina
