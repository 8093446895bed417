// The part of a scene that bakes depend on.
#pragma once

#include "core/base/Id.h"
#include "core/base/Result.h"
#include "core/mesh/Mesh.h"
#include "core/trace/BakeSurface.h"

#include <glm/mat4x4.hpp>
#include <vector>

namespace patina {

struct BakeMesh {
    Id id = 0;
    Id material = 0;
    MeshPtr mesh;
    glm::mat4 transform{1.0f};
    bool doubleSided = false; // else what hits the back is absorbed
    BakeSurface surface = {};
};

struct BakeInputs {
    std::vector<BakeMesh> meshes; // visible ones
};

// What a bake returns when it is cancelled.
[[nodiscard]] inline Error bakeCancelled() {
    return {ErrorKind::Cancelled, "The bake was cancelled.", {}, {}};
}

} // namespace patina
