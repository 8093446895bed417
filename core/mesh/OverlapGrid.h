// Finding out whether a triangle in the plane overlaps others, for many groups at once.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace patina {

using Triangle2 = std::array<glm::dvec2, 3>;

// True when the interiors overlap by more than `tolerance` in every direction.
[[nodiscard]] bool trianglesOverlap(const Triangle2& a, const Triangle2& b, double tolerance);

// Triangles of several groups in square cells; only triangles of one group are compared.
class OverlapGrid {
  public:
    // `allowance`: how many cells and triangles it looks at, all calls together. Afterwards it adds
    // nothing but the first triangles of groups: needles may lie in very many cells together.
    OverlapGrid(double cellSize, double tolerance, std::size_t allowance)
        : m_cellSize(cellSize)
        , m_tolerance(tolerance)
        , m_allowance(allowance) {}

    // Adds the triangle unless it overlaps one of its group, or may do so; says whether it was
    // added. The first one of a group always is.
    bool add(std::uint32_t group, const Triangle2& triangle);

  private:
    struct Cell {
        std::uint32_t group;
        std::int32_t x, y;
        friend bool operator==(const Cell&, const Cell&) = default;
    };
    struct CellHash {
        std::size_t operator()(const Cell& cell) const;
    };
    struct Entry {
        std::uint32_t triangle, next;
    };
    // False where the allowance ends before.
    bool findCells(std::uint32_t group, const Triangle2& triangle);
    bool overlapsOthers(const Triangle2& triangle);
    bool spend(std::size_t steps);

    double m_cellSize, m_tolerance;
    std::size_t m_allowance;                   // what is left of it
    std::unordered_set<std::uint32_t> m_begun; // groups
    std::vector<Triangle2> m_triangles;
    std::vector<std::uint32_t> m_testedFor; // per triangle: the last add() that compared it
    std::uint32_t m_adds = 0;
    std::vector<Entry> m_entries; // lists of the triangles of each cell
    std::unordered_map<Cell, std::uint32_t, CellHash> m_heads;
    std::vector<Cell> m_cells; // of the triangle being added
};

} // namespace patina
