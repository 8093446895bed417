// Cutting a surface into charts: connected groups of triangles that look in similar directions and
// do not overlap when they are projected along their common axis.
#pragma once

#include "core/mesh/Mesh.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace patina {

struct UvCharts {
    std::vector<std::uint32_t> chartOfTriangle;
    std::vector<glm::dvec3> axes; // unit, one per chart
};

struct UvChartSettings {
    double maxDeviationDeg = 55.0;  // between axis and triangle normals
    double overlapTolerance = 1e-6; // length by which projections may overlap
};

// `points`: the mesh's positions, scaled to a size near 1. Every triangle gets a chart.
// Deterministic; O(n log n).
[[nodiscard]] UvCharts cutUvCharts(const Mesh& mesh, const std::vector<glm::dvec3>& points,
                                   const UvChartSettings& settings);

// Two unit vectors perpendicular to `axis` and each other: seen against the axis, y is to the left
// of x (counter-clockwise).
struct ChartFrame {
    glm::dvec3 x, y;
};
[[nodiscard]] ChartFrame chartFrame(const glm::dvec3& axis);

} // namespace patina
