// How an environment stands in the world.
#pragma once

#include "core/math/ShRotation.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace patina {

struct Environment;

// Angles in degrees, of right-handed rotations about the axes of the world: first the roll about
// +Z, then the tilt about +X, last the rotation about +Y, which therefore always goes round the
// horizon. Without tilt and roll every function computes as a rotation about +Y alone does.
struct Orientation {
    float rotationDeg, tiltDeg, rollDeg;

    // A number alone is a rotation about +Y.
    Orientation(float rotation = 0.0f, float tilt = 0.0f, float roll = 0.0f)
        : rotationDeg(rotation)
        , tiltDeg(tilt)
        , rollDeg(roll) {}
    [[nodiscard]] bool isLevel() const { return tiltDeg == 0.0f && rollDeg == 0.0f; }
    [[nodiscard]] bool isIdentity() const { return isLevel() && rotationDeg == 0.0f; }
    // Orthonormal; takes directions of the environment's picture to those of the world.
    [[nodiscard]] glm::dmat3 matrix() const;
    [[nodiscard]] glm::vec3 toWorld(const glm::vec3& inPicture) const;
    [[nodiscard]] glm::vec3 toPicture(const glm::vec3& world) const;
    // What it does to an environment's coefficients.
    [[nodiscard]] ShRotation harmonics(int order) const;

    friend bool operator==(const Orientation&, const Orientation&) = default;
};

[[nodiscard]] Orientation orientationOf(const Environment& environment);

} // namespace patina
