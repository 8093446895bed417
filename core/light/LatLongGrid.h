// The texels of a lat-long picture, of any width and height: their directions and solid angles,
// with the conventions of patina::Environment.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace patina {

class LatLongGrid {
  public:
    // At least 1 each. Where the height is odd, the horizon lies within a row.
    LatLongGrid(int width, int height);
    explicit LatLongGrid(int height); // 2h × h

    [[nodiscard]] int width() const { return static_cast<int>(m_columns.size()); }
    [[nodiscard]] int height() const { return static_cast<int>(m_rows.size()); }
    [[nodiscard]] glm::dvec3 direction(int x, int y) const { // unit vector to the texel's centre
        const glm::dvec2& column = m_columns[static_cast<std::size_t>(x)];
        const glm::dvec2& row = m_rows[static_cast<std::size_t>(y)];
        return {row.x * column.x, row.y, -row.x * column.y};
    }
    // The same anywhere in the picture, in texels.
    [[nodiscard]] glm::dvec3 directionAt(double x, double y) const;
    [[nodiscard]] double texelAngle() const; // height of a texel, radians
    [[nodiscard]] double sinPolar(int y) const { return m_rows[static_cast<std::size_t>(y)].x; }
    // Exact solid angle of a texel of row y, and the exact integral of the direction's y over it.
    [[nodiscard]] double solidAngle(int y) const;
    [[nodiscard]] double projectedSolidAngle(int y) const;
    // How many rows make one range of a parallel loop. All of a draft: the frame that waits for it
    // must not depend on threads of low priority.
    [[nodiscard]] std::size_t rowsPerRange() const { return height() <= 256 ? 256 : 8; }
    // Rows that meet directions with a polar angle from `begin` to `end` radians (0 is up), clamped
    // to the picture: first, and one behind the last.
    [[nodiscard]] glm::ivec2 rowsBetween(double begin, double end) const;

  private:
    std::vector<glm::dvec2> m_columns, m_rows; // (sin, cos) of the azimuth from -Z, of the polar
                                               // angle
};

// Sample (i, j) of columns × rows within a texel, 0…1: one in each cell, skewed so that no two
// share an x or a y. An upright edge is then resolved by as many steps as there are samples.
[[nodiscard]] inline glm::dvec2 subTexel(int i, int j, int columns, int rows) {
    return {(i + (j + 0.5) / rows) / columns, (j + (i + 0.5) / columns) / rows};
}

// Unit vector; azimuth 0 is +Z, 90 is +X, elevation 90 is up: as lights, suns and softboxes stand.
[[nodiscard]] glm::dvec3 directionFromAngles(double azimuthDeg, double elevationDeg);
// The inverse: (azimuth in -180…180, elevation) of a vector that is not zero.
[[nodiscard]] glm::dvec2 anglesFromDirection(const glm::dvec3& direction);

} // namespace patina
