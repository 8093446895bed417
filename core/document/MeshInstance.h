// A mesh where it stands in the scene.
#pragma once

#include "core/base/Id.h"
#include "core/document/Placement.h"
#include "core/mesh/Mesh.h"

#include <string>

namespace patina {

struct MeshInstance {
    Id id = 0;
    std::string name;
    // Where the mesh came from: absolute path (UTF-8) or "builtin:NAME", and which of its
    // instances.
    std::string source;
    int sourceIndex = 0;
    MeshPtr mesh; // never null in a resolved document
    Placement placement;
    Id material = 0;
    bool visible = true;
    friend bool operator==(const MeshInstance&, const MeshInstance&) = default;
};

} // namespace patina
