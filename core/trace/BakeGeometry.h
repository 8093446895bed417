// The triangles of a bake in one space: world axes, moved and scaled so that the scene fits the
// cube from -1 to 1. Scenes of any size then share the same tolerances, and floats keep their
// precision wherever the scene stands.
#pragma once

#include "core/base/Result.h"
#include "core/job/JobContext.h"
#include "core/trace/BakeInputs.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace patina {

// Distance that ray origins keep from the surface they leave, in scene units: 1/200,000 of the
// scene's size, about a hundred times the rounding of a coordinate. Too small for the eye, large
// enough that no ray meets the triangle it starts from.
inline constexpr float kRayOffset = 1e-5f;

struct BakeGeometryMesh {
    Id id = 0;
    Id material = 0;
    MeshPtr mesh;                     // indices and uvs
    std::vector<glm::vec3> positions; // scene units
    std::vector<glm::vec3> normals;   // unit, world axes
    float winding = 1.0f;             // -1 when the transform mirrors: triangles run clockwise
    bool doubleSided = false;
    BakeSurface surface = {};
    std::string name; // nameOf(BakeMesh)
};

struct BakeGeometry {
    std::vector<BakeGeometryMesh> meshes;
    glm::dvec3 centre{0.0}; // in the world; the origin of the scene's units
    double unitsPerMetre = 1.0;

    [[nodiscard]] std::size_t triangleCount() const;
    [[nodiscard]] std::size_t vertexCount() const;
};

// Errors: InputBroken for a scene without triangles, a transform or position that is not finite,
// a mesh that does not keep the promises of core/mesh/Mesh.h.
Result<BakeGeometry> makeBakeGeometry(const BakeInputs& inputs, const JobContext& job);

} // namespace patina
