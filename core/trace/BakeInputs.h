// The part of a scene that bakes depend on.
#pragma once

#include "core/base/Id.h"
#include "core/base/Result.h"
#include "core/mesh/Mesh.h"
#include "core/trace/BakeSurface.h"

#include <glm/mat4x4.hpp>
#include <string>
#include <vector>

namespace patina {

struct BakeMesh {
    Id id = 0;
    Id material = 0;
    MeshPtr mesh;
    glm::mat4 transform{1.0f};
    bool doubleSided = false; // else what hits the back is absorbed
    BakeSurface surface = {};
    std::string name = {}; // for messages, as the user calls it
};

// What messages call it: the file's name of the mesh where the user has none.
[[nodiscard]] inline const std::string& nameOf(const BakeMesh& mesh) {
    static const std::string kNone;
    return !mesh.name.empty() ? mesh.name : mesh.mesh ? mesh.mesh->name : kNone;
}

struct BakeInputs {
    std::vector<BakeMesh> meshes; // visible ones
};

// What a bake returns when it is cancelled.
[[nodiscard]] inline Error bakeCancelled() {
    return {ErrorKind::Cancelled, "The bake was cancelled.", {}, {}};
}

} // namespace patina
