// World matrices as the translation, rotation and scale that glTF nodes are made of.
#pragma once

#include <glm/ext/quaternion_double.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace patina {

struct NodeTransform {
    glm::dvec3 translation{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0}; // w, x, y, z
    glm::dvec3 scale{1.0};

    [[nodiscard]] glm::dmat4 matrix() const; // translation * rotation * scale
};

// Nested nodes, outermost first, whose product is the affine matrix: one for an ordinary
// placement; two for a sheared one, which no single node can express. A mirrored matrix has one
// negative scale. Empty when the matrix flattens space or is not finite.
[[nodiscard]] std::vector<NodeTransform> decomposeMatrix(const glm::mat4& matrix);

// The rotation that turns -Z, along which glTF lights shine, to the unit vector `direction`.
[[nodiscard]] glm::dquat rotationFromMinusZ(const glm::dvec3& direction);

} // namespace patina
