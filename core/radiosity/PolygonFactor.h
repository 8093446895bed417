// Form factors of flat convex polygons, nothing between them: closed forms and line integrals in
// double precision.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <span>

namespace patina::radiosity {

// Corners of a convex polygon in its plane, counter-clockwise about its normal. What is left of a
// quad that five planes have cut has nine corners at most.
struct Polygon {
    static constexpr std::size_t kMax = 12;

    std::array<glm::dvec3, kMax> corners{};
    std::size_t count = 0;

    Polygon() = default;
    explicit Polygon(std::span<const glm::dvec3> points);
    [[nodiscard]] std::span<const glm::dvec3> points() const { return {corners.data(), count}; }
    void add(const glm::dvec3& corner) { corners[count++] = corner; }
};

// Half the sum of the cross products: the area times the unit normal.
[[nodiscard]] glm::dvec3 areaVector(std::span<const glm::dvec3> polygon);

// The part of a polygon with dot(normal, p - point) > 0; fewer than three corners: nothing is left.
// Sutherland & Hodgman 1974.
[[nodiscard]] Polygon clip(const Polygon& polygon, const glm::dvec3& point,
                           const glm::dvec3& normal);

// Form factor of a small surface at `point` facing `normal` (unit) to a polygon whose front it
// sees; the part below its horizon is cut off. 0…1. Lambert 1760; Baum, Rushmeier & Winget 1989,
// "Improving Radiosity Solutions Through the Use of Analytically Determined Form-Factors".
[[nodiscard]] double pointToPolygon(const glm::dvec3& point, const glm::dvec3& normal,
                                    const Polygon& polygon);

// Area of the first times its mean form factor to the second (m² if corners are in metres), which
// is symmetric. Parts of either behind the other's plane are cut off first. By Stokes' theorem a
// double line integral, the inner one in closed form: Goral et al. 1984, "Modeling the Interaction
// of Light Between Diffuse Surfaces", eq. 13. Relative error below 1e-7, also where they touch.
[[nodiscard]] double exchange(const Polygon& a, const Polygon& b);

} // namespace patina::radiosity
