// Measures of one triangle in double precision, so that neither huge (1e30) nor denormal
// coordinates overflow or vanish on the way.
#pragma once

#include "core/mesh/Mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

namespace patina {

// Twice the area times the unit normal (counter-clockwise front).
[[nodiscard]] inline glm::dvec3 areaVector(const glm::vec3& a, const glm::vec3& b,
                                           const glm::vec3& c) {
    return glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
}

[[nodiscard]] inline glm::dvec3 areaVector(const Mesh& mesh, std::size_t triangle) {
    const std::uint32_t* index = mesh.indices.data() + 3 * triangle;
    return areaVector(mesh.positions[index[0]], mesh.positions[index[1]], mesh.positions[index[2]]);
}

// True when the corners are (nearly) on one line. 1e-10 is the ratio of height to length: far
// below what float positions can express for a real triangle, far above rounding in double.
[[nodiscard]] inline bool isDegenerate(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const glm::dvec3 ab = glm::dvec3(b) - glm::dvec3(a), bc = glm::dvec3(c) - glm::dvec3(b),
                     ca = glm::dvec3(a) - glm::dvec3(c);
    const double longest2 = std::max({glm::dot(ab, ab), glm::dot(bc, bc), glm::dot(ca, ca)});
    return !(glm::length(glm::cross(ab, bc)) > 1e-10 * longest2);
}

// Interior angles at the three corners, radians; 0 where an edge has no length.
[[nodiscard]] inline std::array<double, 3> cornerAngles(const glm::vec3& a, const glm::vec3& b,
                                                        const glm::vec3& c) {
    const glm::dvec3 ab = glm::dvec3(b) - glm::dvec3(a), bc = glm::dvec3(c) - glm::dvec3(b),
                     ca = glm::dvec3(a) - glm::dvec3(c);
    const double twiceArea = glm::length(glm::cross(ab, bc));
    // atan2 of sine and cosine keeps its precision for needles, unlike acos.
    return {std::atan2(twiceArea, -glm::dot(ab, ca)), std::atan2(twiceArea, -glm::dot(ab, bc)),
            std::atan2(twiceArea, -glm::dot(bc, ca))};
}

} // namespace patina
