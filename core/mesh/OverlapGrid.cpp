#include "core/mesh/OverlapGrid.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace patina {
namespace {

constexpr std::uint32_t kEnd = std::numeric_limits<std::uint32_t>::max();

struct Interval {
    double low, high;
};

Interval extentAlong(const Triangle2& triangle, const glm::dvec2& axis) {
    const double a = glm::dot(triangle[0], axis), b = glm::dot(triangle[1], axis),
                 c = glm::dot(triangle[2], axis);
    return {std::min({a, b, c}), std::max({a, b, c})};
}

} // namespace

// Convex shapes are disjoint exactly when the normal of one of their edges separates them.
bool trianglesOverlap(const Triangle2& a, const Triangle2& b, double tolerance) {
    for (const Triangle2* triangle : {&a, &b}) {
        for (std::size_t edge = 0; edge < 3; ++edge) {
            const glm::dvec2 along = (*triangle)[(edge + 1) % 3] - (*triangle)[edge];
            const double length = glm::length(along);
            if (!(length > 0.0))
                continue;
            const glm::dvec2 axis(-along.y / length, along.x / length);
            const Interval ofA = extentAlong(a, axis), ofB = extentAlong(b, axis);
            if (std::min(ofA.high, ofB.high) - std::max(ofA.low, ofB.low) <= tolerance)
                return false;
        }
    }
    return true;
}

std::size_t OverlapGrid::CellHash::operator()(const Cell& cell) const {
    std::uint64_t h =
        (static_cast<std::uint64_t>(cell.group) + 0x9e3779b97f4a7c15ull) * 0xff51afd7ed558ccdull;
    h = (h ^ static_cast<std::uint32_t>(cell.x)) * 0xc4ceb9fe1a85ec53ull;
    h = (h ^ (h >> 29) ^ static_cast<std::uint32_t>(cell.y)) * 0xff51afd7ed558ccdull;
    return h ^ (h >> 32);
}

// Every cell the triangle touches: row by row the span of its part between two grid lines.
bool OverlapGrid::findCells(std::uint32_t group, const Triangle2& triangle) {
    m_cells.clear();
    const auto cellOf = [&](double v) { return std::floor(v / m_cellSize); };
    const Interval rows = extentAlong(triangle, {0.0, 1.0});
    for (double row = cellOf(rows.low); row <= cellOf(rows.high); ++row) {
        const double top = row * m_cellSize, bottom = (row + 1.0) * m_cellSize;
        Interval span{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
        const auto include = [&](double x) {
            span.low = std::min(span.low, x);
            span.high = std::max(span.high, x);
        };
        for (std::size_t edge = 0; edge < 3; ++edge) {
            const glm::dvec2 a = triangle[edge], b = triangle[(edge + 1) % 3];
            if (std::max(a.y, b.y) < top || std::min(a.y, b.y) > bottom)
                continue;
            const auto at = [&](double y) {
                const double t = a.y == b.y ? 0.0 : std::clamp((y - a.y) / (b.y - a.y), 0.0, 1.0);
                return a.x + t * (b.x - a.x);
            };
            include(at(top));
            include(at(bottom));
            if (a.y == b.y)
                include(b.x);
        }
        for (double column = cellOf(span.low); column <= cellOf(span.high); ++column) {
            if (!spend(1))
                return false;
            m_cells.push_back(
                {group, static_cast<std::int32_t>(column), static_cast<std::int32_t>(row)});
        }
    }
    return true;
}

bool OverlapGrid::spend(std::size_t steps) {
    m_allowance -= std::min(m_allowance, steps);
    return m_allowance > 0;
}

// Those of its group, in the cells that were found. Also true where the allowance ends.
bool OverlapGrid::overlapsOthers(const Triangle2& triangle) {
    ++m_adds;
    for (const Cell& cell : m_cells) {
        const auto head = m_heads.find(cell);
        if (head == m_heads.end())
            continue;
        for (std::uint32_t e = head->second; e != kEnd; e = m_entries[e].next) {
            const std::uint32_t other = m_entries[e].triangle;
            if (!spend(1))
                return true;
            if (m_testedFor[other] == m_adds)
                continue;
            m_testedFor[other] = m_adds;
            if (trianglesOverlap(triangle, m_triangles[other], m_tolerance))
                return true;
        }
    }
    return false;
}

bool OverlapGrid::add(std::uint32_t group, const Triangle2& triangle) {
    const bool isFirst = m_begun.insert(group).second;
    if (m_allowance == 0 || !findCells(group, triangle))
        return isFirst;
    if (!isFirst && overlapsOthers(triangle))
        return false;
    const auto added = static_cast<std::uint32_t>(m_triangles.size());
    m_triangles.push_back(triangle);
    m_testedFor.push_back(0);
    for (const Cell& cell : m_cells) {
        const auto [head, isNew] = m_heads.try_emplace(cell, kEnd);
        m_entries.push_back({added, head->second});
        head->second = static_cast<std::uint32_t>(m_entries.size() - 1);
    }
    return true;
}

} // namespace patina
