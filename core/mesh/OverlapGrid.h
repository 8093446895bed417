// Finding out whether a triangle in the plane overlaps others, for many groups at once.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <unordered_map>
#include <vector>

namespace patina {

using Triangle2 = std::array<glm::dvec2, 3>;

// True when the interiors overlap by more than `tolerance` in every direction.
[[nodiscard]] bool trianglesOverlap(const Triangle2& a, const Triangle2& b, double tolerance);

// Triangles of several groups in square cells; only triangles of one group are compared.
class OverlapGrid {
  public:
    OverlapGrid(double cellSize, double tolerance)
        : m_cellSize(cellSize)
        , m_tolerance(tolerance) {}

    // Adds the triangle unless it overlaps one of its group; says whether it was added.
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
    void findCells(std::uint32_t group, const Triangle2& triangle);

    double m_cellSize, m_tolerance;
    std::vector<Triangle2> m_triangles;
    std::vector<std::uint32_t> m_testedFor; // per triangle: the last add() that compared it
    std::uint32_t m_adds = 0;
    std::vector<Entry> m_entries; // lists of the triangles of each cell
    std::unordered_map<Cell, std::uint32_t, CellHash> m_heads;
    std::vector<Cell> m_cells; // of the triangle being added
};

} // namespace patina
