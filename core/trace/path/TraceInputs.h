// The part of a scene that a picture traced by rays depends on, as values.
#pragma once

#include "core/image/Image.h"
#include "core/light/Light.h"
#include "core/light/Orientation.h"
#include "core/material/Material.h"
#include "core/material/ShadingModel.h"
#include "core/mesh/Mesh.h"

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <vector>

namespace patina {

struct TraceMesh {
    Id id = 0;
    MeshPtr mesh;
    glm::mat4 transform{1.0f};
    std::size_t material = 0; // of TraceInputs::materials
    friend bool operator==(const TraceMesh&, const TraceMesh&) = default;
};

// Radiance scale · image, as it stands in the world.
struct TraceEnvironment {
    ImagePtr image; // lat-long, F32, 3 channels or more, finite, at least 0
    Orientation orientation;
    glm::vec3 scale{1.0f};
    friend bool operator==(const TraceEnvironment&, const TraceEnvironment&) = default;
};

struct TraceInputs {
    std::vector<TraceMesh> meshes; // visible ones
    std::vector<Material> materials;
    ShadingModel model;
    std::vector<Light> lights;                  // those that are on
    std::vector<TraceEnvironment> environments; // their radiances add up
    // Meshes and images compare by identity: they are immutable.
    friend bool operator==(const TraceInputs&, const TraceInputs&) = default;
};

} // namespace patina
