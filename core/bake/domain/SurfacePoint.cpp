#include "core/bake/domain/BakePoints.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace patina {

BakePoint surfacePoint(const BakeGeometryMesh& mesh, std::uint32_t triangle, float b1, float b2) {
    const std::uint32_t* index = mesh.mesh->indices.data() + std::size_t{3} * triangle;
    const glm::vec3 corners[3] = {mesh.positions[index[0]], mesh.positions[index[1]],
                                  mesh.positions[index[2]]};
    const glm::vec3 normals[3] = {mesh.normals[index[0]], mesh.normals[index[1]],
                                  mesh.normals[index[2]]};
    const float weights[3] = {1.0f - b1 - b2, b1, b2};
    glm::vec3 position(0.0f), normal(0.0f);
    for (int i = 0; i < 3; ++i) {
        position += weights[i] * corners[i];
        normal += weights[i] * normals[i];
    }
    const glm::dvec3 faceCross =
        glm::cross(glm::dvec3(corners[1] - corners[0]), glm::dvec3(corners[2] - corners[0])) *
        static_cast<double>(mesh.winding);
    const double faceLength = glm::length(faceCross);
    const float normalLength = glm::length(normal);
    glm::vec3 face = faceLength > 0.0 ? glm::vec3(faceCross / faceLength) : normals[0];
    normal = normalLength > 1e-6f ? normal / normalLength : face;
    if (glm::dot(face, normal) < 0.0f) // inconsistent winding: the normals decide
        face = -face;
    glm::vec3 lift(0.0f);
    for (int i = 0; i < 3; ++i)
        lift -=
            weights[i] * std::min(glm::dot(position - corners[i], normals[i]), 0.0f) * normals[i];
    // Off the edges: a point on the border of a wall would else lie in the wall next to it.
    glm::vec3 inwards = (corners[0] + corners[1] + corners[2]) / 3.0f - position;
    if (const float length = glm::length(inwards); length > kRayOffset)
        inwards *= kRayOffset / length;
    return {position + lift + inwards + kRayOffset * face, normal};
}

} // namespace patina
