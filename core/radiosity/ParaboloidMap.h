// The hemisphere above a point as a paraboloid mirror shows it, on a disc: a direction d, |d| = 1,
// is at (d.x, d.y) / (1 + d.z), the horizon at radius 1. Heidrich & Seidel 1998, "View-Independent
// Environment Maps". Straight edges become arcs of circles. The disc lies in a square of texels.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace patina::radiosity {

class ParaboloidMap {
  public:
    // Texels of a row whose centres are on the disc: [first, end).
    struct Run {
        int first, end;
    };

    explicit ParaboloidMap(int resolution); // texels along the diameter, at least 2

    [[nodiscard]] int resolution() const { return m_resolution; }
    // Row after row, from y = -1 upwards and from x = -1: the form factor through each texel, as
    // far as it is on the disc, integrated exactly. A texel at the rim whose centre is off the disc
    // has 0: what it holds counts with its neighbour towards the middle, so that all are 1.
    [[nodiscard]] std::span<const double> weights() const { return m_weights; }
    [[nodiscard]] Run run(int row) const { return m_runs[static_cast<std::size_t>(row)]; }
    [[nodiscard]] double centre(int texel) const { // of a column or row
        return (texel + 0.5) * m_step - 1.0;
    }
    // The first column or row whose centre is not below a coordinate; resolution(): none.
    [[nodiscard]] int firstFrom(double coordinate) const;

    // Form factor through the part of a rectangle that is on the disc.
    [[nodiscard]] static double factor(double x0, double x1, double y0, double y1);
    // Of a direction of any length with z >= 0, to the disc, and back to one that is not unit.
    [[nodiscard]] static glm::dvec2 project(const glm::dvec3& direction);
    [[nodiscard]] static glm::dvec3 direction(const glm::dvec2& at) {
        return {2.0 * at.x, 2.0 * at.y, 1.0 - at.x * at.x - at.y * at.y};
    }

  private:
    int m_resolution;
    double m_step;
    std::vector<double> m_weights;
    std::vector<Run> m_runs;
};

// Draws flat convex polygons onto a map. An edge is divided at every row of texels, and where it
// runs along one: between two rows it is straight, at each it is where the edge itself is. So edges
// that others share, or a part of, leave no texel out and none twice.
class ParaboloidFill {
  public:
    struct Span {
        int row, first, end; // columns [first, end)
    };

    explicit ParaboloidFill(const ParaboloidMap& map)
        : m_map(map)
        , m_rows(static_cast<std::size_t>(map.resolution())) {}

    // The texels whose centres a triangle or quad covers, row by row, until the next call. Corners
    // are relative to the point that sees them, z along its normal; what is below the horizon is
    // cut off. `front`: they run counter-clockwise about a normal that the point is in front of.
    [[nodiscard]] std::span<const Span> cover(std::span<const glm::dvec3> corners, bool front);

  private:
    // Quads that are nearly flat may cross the horizon four times: two edges along it and six
    // others at most, each of which runs up once and down once.
    static constexpr std::size_t kMostCorners = 8, kMostCrossings = 16;
    struct Row {
        std::size_t count = 0;
        std::array<double, kMostCrossings> x;
    };

    void addEdge(const glm::dvec2& from, const glm::dvec2& to, const glm::dvec3& plane);
    void addLine(const glm::dvec2& from, const glm::dvec2& to);
    void addArc(double fromY, double toY, const glm::dvec3& plane, bool negative);
    template <class PositionAt>
    void cross(double fromY, double toY, const PositionAt& xAt);

    const ParaboloidMap& m_map;
    std::vector<Row> m_rows;
    int m_firstRow = 0, m_endRow = 0; // that were crossed
    std::vector<Span> m_spans;
};

} // namespace patina::radiosity
