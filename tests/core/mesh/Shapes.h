// Small exact meshes for tests: positions and indices only, unless said otherwise.
#pragma once

#include "core/mesh/Mesh.h"

#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>

namespace patina::test {

inline constexpr double kPi = 3.14159265358979323846;

// Points f(u, v) on a grid of (columns + 1) × (rows + 1) over the unit square, two triangles per
// cell, counter-clockwise when du × dv points to the front.
inline Mesh gridMesh(int columns, int rows, const std::function<glm::dvec3(double, double)>& f) {
    Mesh mesh;
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= columns; ++i)
            mesh.positions.push_back(glm::vec3(f(double(i) / columns, double(j) / rows)));
    const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * (columns + 1) + i); };
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i)
            mesh.indices.insert(mesh.indices.end(), {at(i, j), at(i + 1, j), at(i + 1, j + 1),
                                                     at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    return mesh;
}

// Makes both ends of a closed direction the same point to the last bit.
inline double wrapped(double t) {
    return t == 1.0 ? 0.0 : t;
}

// A square of side 2 * half on y = height, facing up.
inline Mesh planeMesh(double half, int cells = 1, double height = 0.0) {
    return gridMesh(cells, cells, [=](double u, double v) {
        return glm::dvec3(half * (2 * u - 1), height, half * (1 - 2 * v));
    });
}

// Outward sphere with poles on the y axis; the seam and the poles repeat positions, pole cells
// hold degenerate triangles (sanitizeMesh drops them).
inline Mesh sphereMesh(double radius, int columns = 64, int rows = 32,
                       glm::dvec3 centre = glm::dvec3(0.0)) {
    return gridMesh(columns, rows, [=](double u, double v) {
        const double phi = 2 * kPi * wrapped(u), theta = kPi * (1 - v);
        const double s = v == 0.0 || v == 1.0 ? 0.0 : std::sin(theta);
        return centre + radius * glm::dvec3(s * std::sin(phi), std::cos(theta), s * std::cos(phi));
    });
}

inline Mesh torusMesh(double major, double minor, int columns, int rows) {
    return gridMesh(columns, rows, [=](double u, double v) {
        const double a = 2 * kPi * wrapped(u), b = 2 * kPi * wrapped(v);
        const double r = major + minor * std::cos(b);
        return glm::dvec3(r * std::sin(a), minor * std::sin(b), r * std::cos(a));
    });
}

inline Mesh cubeMesh(double half = 1.0) {
    Mesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.positions.push_back(
            glm::vec3(glm::dvec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1) * half));
    mesh.indices = {1, 3, 7, 1, 7, 5, 0, 4, 6, 0, 6, 2, 2, 6, 7, 2, 7, 3,
                    0, 1, 5, 0, 5, 4, 4, 5, 7, 4, 7, 6, 0, 2, 3, 0, 3, 1};
    return mesh;
}

inline Mesh sanitized(Mesh mesh) {
    (void)sanitizeMesh(mesh);
    return mesh;
}

} // namespace patina::test
