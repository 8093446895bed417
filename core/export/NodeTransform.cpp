#include "core/export/NodeTransform.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace patina {
namespace {

// Columns closer to a right angle than this (about 0.0006°) are taken as orthogonal: products of
// float matrices are no better.
constexpr double kOrthogonalTolerance = 1e-5;
// An axis scaled by less than this, relative to the largest, carries no direction any more.
constexpr double kFlatTolerance = 1e-9;

bool isFlat(const glm::dvec3& scale) {
    const double most = std::max({scale.x, scale.y, scale.z});
    return !(std::min({scale.x, scale.y, scale.z}) > most * kFlatTolerance);
}

// Eigenvectors of a symmetric matrix as the columns of a rotation, by cyclic Jacobi sweeps
// (Golub & Van Loan, Matrix Computations, sec. 8.5). Diagonalises `a` in place.
glm::dmat3 diagonalize(glm::dmat3& a) {
    glm::dmat3 vectors(1.0);
    for (int sweep = 0; sweep < 32; ++sweep) {
        for (int p = 0; p < 2; ++p) {
            for (int q = p + 1; q < 3; ++q) {
                if (a[p][q] == 0.0)
                    continue;
                const double theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
                const double t =
                    std::copysign(1.0, theta) / (std::abs(theta) + std::hypot(theta, 1.0));
                const double c = 1.0 / std::hypot(t, 1.0);
                const double s = t * c;
                glm::dmat3 rotation(1.0);
                rotation[p][p] = rotation[q][q] = c;
                rotation[q][p] = s;
                rotation[p][q] = -s;
                a = glm::transpose(rotation) * a * rotation;
                a[p][q] = a[q][p] = 0.0;
                vectors = vectors * rotation;
            }
        }
    }
    return vectors;
}

} // namespace

glm::dmat4 NodeTransform::matrix() const {
    glm::dmat4 result(glm::mat3_cast(rotation));
    for (int axis = 0; axis < 3; ++axis)
        result[axis] *= scale[axis];
    result[3] = glm::dvec4(translation, 1.0);
    return result;
}

std::vector<NodeTransform> decomposeMatrix(const glm::mat4& matrix) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(matrix[column][row]))
                return {};

    NodeTransform outer;
    outer.translation = glm::dvec3(matrix[3]);
    const glm::dmat3 a{glm::mat3(matrix)};
    const double handedness = glm::determinant(a) < 0.0 ? -1.0 : 1.0;

    // Orthogonal columns: their lengths are the scale, their directions the rotation.
    outer.scale = {glm::length(a[0]), glm::length(a[1]), glm::length(a[2])};
    if (isFlat(outer.scale))
        return {};
    glm::dmat3 axes(a[0] / outer.scale.x, a[1] / outer.scale.y, a[2] / outer.scale.z);
    const double skew =
        std::max({std::abs(glm::dot(axes[0], axes[1])), std::abs(glm::dot(axes[1], axes[2])),
                  std::abs(glm::dot(axes[2], axes[0]))});
    if (skew < kOrthogonalTolerance) {
        outer.scale.x *= handedness;
        axes[0] *= handedness;
        outer.rotation = glm::normalize(glm::quat_cast(axes));
        return {outer};
    }

    // Shear: the singular value decomposition A = U S Vᵀ is a scale between two rotations. The
    // columns of V are eigenvectors of AᵀA, and those of U are A V / S.
    glm::dmat3 squared = glm::transpose(a) * a;
    const glm::dmat3 v = diagonalize(squared);
    glm::dmat3 u = a * v;
    outer.scale = {glm::length(u[0]), glm::length(u[1]), glm::length(u[2])};
    if (isFlat(outer.scale))
        return {};
    for (int axis = 0; axis < 3; ++axis)
        u[axis] /= outer.scale[axis];
    outer.scale.x *= handedness;
    u[0] *= handedness;
    outer.rotation = glm::normalize(glm::quat_cast(u));
    NodeTransform inner;
    inner.rotation = glm::normalize(glm::quat_cast(glm::transpose(v)));
    return {outer, inner};
}

glm::dquat rotationFromMinusZ(const glm::dvec3& direction) {
    const glm::dvec3 from(0.0, 0.0, -1.0);
    const double cosine = glm::dot(from, direction);
    if (cosine < -1.0 + 1e-12)
        return {0.0, 0.0, 1.0, 0.0}; // half a turn about +Y
    const glm::dvec3 axis = glm::cross(from, direction);
    return glm::normalize(glm::dquat(1.0 + cosine, axis.x, axis.y, axis.z));
}

} // namespace patina
