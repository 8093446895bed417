#include "core/light/Orientation.h"

#include "core/light/Environment.h"
#include "core/math/Shading.h"

#include <cmath>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

namespace patina {

glm::dmat3 Orientation::matrix() const {
    const auto turn = [](float degrees) {
        const double angle = glm::radians(static_cast<double>(degrees));
        return glm::dvec2(std::cos(angle), std::sin(angle));
    };
    const glm::dvec2 y = turn(rotationDeg), x = turn(tiltDeg), z = turn(rollDeg);
    // By columns.
    const glm::dmat3 aboutY(y.x, 0.0, -y.y, 0.0, 1.0, 0.0, y.y, 0.0, y.x);
    const glm::dmat3 aboutX(1.0, 0.0, 0.0, 0.0, x.x, x.y, 0.0, -x.y, x.x);
    const glm::dmat3 aboutZ(z.x, z.y, 0.0, -z.y, z.x, 0.0, 0.0, 0.0, 1.0);
    return aboutY * aboutX * aboutZ;
}

glm::vec3 Orientation::toWorld(const glm::vec3& inPicture) const {
    return isLevel() ? shading::rotateY(inPicture, glm::radians(rotationDeg))
                     : glm::mat3(matrix()) * inPicture;
}

glm::vec3 Orientation::toPicture(const glm::vec3& world) const {
    return isLevel() ? shading::rotateY(world, -glm::radians(rotationDeg))
                     : world * glm::mat3(matrix()); // by its transpose
}

ShRotation Orientation::harmonics(int order) const {
    return isLevel() ? ShRotation::aboutY(glm::radians(static_cast<double>(rotationDeg)), order)
                     : ShRotation(matrix(), order);
}

Orientation orientationOf(const Environment& environment) {
    return {environment.rotationDeg, environment.tiltDeg, environment.rollDeg};
}

} // namespace patina
