#include "core/document/Placement.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

namespace patina {
namespace {

constexpr double kLargest = 1e30; // of a scale: its cube has to be a number, too
constexpr double kFlat = 1e-12;   // an axis that is shorter has no direction, and is not divided by

// Numbers that a person reads: the matrix keeps what rounding leaves.
float rounded(double value, double step) {
    const double result = std::round(value / step) * step;
    return static_cast<float>(result == 0.0 ? 0.0 : result); // no -0
}

glm::dmat3 rotationOf(const glm::vec3& degrees) {
    const glm::dvec3 angle = glm::radians(glm::dvec3(degrees));
    const glm::dmat4 one(1.0);
    return glm::dmat3(glm::rotate(one, angle.z, glm::dvec3(0, 0, 1)) *
                      glm::rotate(one, angle.y, glm::dvec3(0, 1, 0)) *
                      glm::rotate(one, angle.x, glm::dvec3(1, 0, 0)));
}

// Angles of Rz Ry Rx, in degrees. Where y is ±90° the other two rotate about the same axis, and x
// has all of it.
glm::vec3 anglesOf(const glm::dmat3& r) {
    constexpr double kStep = 1e-4;
    const double cosY = std::hypot(r[0][0], r[0][1]);
    const double y = std::atan2(-r[0][2], cosY);
    double x = 0.0, z = 0.0;
    if (cosY > 1e-6) {
        x = std::atan2(r[1][2], r[2][2]);
        z = std::atan2(r[0][1], r[0][0]);
    } else {
        x = std::atan2(-r[2][1], r[1][1]);
    }
    return {rounded(glm::degrees(x), kStep), rounded(glm::degrees(y), kStep),
            rounded(glm::degrees(z), kStep)};
}

glm::dmat3 scaled(const glm::dmat3& rotation, const glm::vec3& scale) {
    return {rotation[0] * static_cast<double>(scale.x), rotation[1] * static_cast<double>(scale.y),
            rotation[2] * static_cast<double>(scale.z)};
}

glm::dvec3 anyAcross(const glm::dvec3& axis) {
    const glm::dvec3 other = std::abs(axis.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    return glm::normalize(glm::cross(axis, other));
}

// The rotation that is nearest to the matrix' first axis, then its second one (Gram-Schmidt).
glm::dmat3 rotationOf(const glm::dmat3& linear) {
    glm::dvec3 x = linear[0], y = linear[1];
    x = glm::length(x) > kFlat ? glm::normalize(x) : glm::dvec3(1, 0, 0);
    if (glm::determinant(linear) < 0.0)
        x = -x; // the mirror is left to the rest
    y -= glm::dot(x, y) * x;
    y = glm::length(y) > kFlat ? glm::normalize(y) : anyAcross(x);
    return {x, y, glm::cross(x, y)};
}

} // namespace

Placement::Values Placement::valuesOf(const glm::mat4& matrix) {
    const glm::dmat3 linear{glm::mat3(matrix)};
    Values values;
    values.position = glm::vec3(matrix[3]);
    values.rotationDeg = anglesOf(rotationOf(linear));
    for (int axis = 0; axis < 3; ++axis) {
        const double length = glm::length(linear[axis]);
        if (length > kFlat)
            values.scale[axis] = rounded(std::min(length, kLargest), length * 1e-6);
    }
    return values;
}

Placement::Placement(const glm::mat4& asRead)
    : m_asRead(asRead)
    , m_matrix(asRead)
    , m_start(valuesOf(asRead))
    , m_now(m_start) {}

void Placement::setPosition(const glm::vec3& position) {
    m_now.position = position;
    update();
}

void Placement::setRotationDeg(const glm::vec3& rotationDeg) {
    m_now.rotationDeg = rotationDeg;
    update();
}

void Placement::setScale(const glm::vec3& scale) {
    m_now.scale = scale;
    update();
}

void Placement::update() {
    if (isAsRead()) {
        m_matrix = m_asRead;
        return;
    }
    m_now.position = glm::clamp(m_now.position, -kMaxPosition, kMaxPosition);
    m_now.scale = glm::clamp(m_now.scale, kMinScale, kMaxScale);
    const glm::dmat3 rest = glm::inverse(scaled(rotationOf(m_start.rotationDeg), m_start.scale)) *
                            glm::dmat3(glm::mat3(m_asRead));
    const bool moved = m_now.rotationDeg != m_start.rotationDeg || m_now.scale != m_start.scale;
    const glm::dmat3 linear = moved ? scaled(rotationOf(m_now.rotationDeg), m_now.scale) * rest
                                    : glm::dmat3(glm::mat3(m_asRead));
    m_matrix = glm::mat4(glm::mat3(linear));
    m_matrix[3] = glm::vec4(m_now.position, 1.0f);
}

void Placement::rotateAbout(const glm::vec3& pivot, const glm::mat3& rotation) {
    const glm::dmat3 turn(rotation);
    m_now.rotationDeg = anglesOf(turn * rotationOf(m_now.rotationDeg));
    m_now.position =
        glm::vec3(glm::dvec3(pivot) + turn * (glm::dvec3(m_now.position) - glm::dvec3(pivot)));
    update();
}

void Placement::scaleAbout(const glm::vec3& pivot, const glm::vec3& factors) {
    // Along its own axes: from the pivot to the origin of the mesh, and back.
    const glm::dmat3 own(axes());
    const glm::dvec3 along = glm::transpose(own) * (glm::dvec3(m_now.position) - glm::dvec3(pivot));
    m_now.position = glm::vec3(glm::dvec3(pivot) + own * (along * glm::dvec3(factors)));
    m_now.scale *= factors;
    update();
}

glm::mat3 Placement::axes() const {
    return glm::mat3(rotationOf(m_now.rotationDeg));
}

} // namespace patina
