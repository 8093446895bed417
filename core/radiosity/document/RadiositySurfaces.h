// The elements of a solution as meshes that can be drawn: one for each side of each mesh instance.
#pragma once

#include "core/base/Id.h"
#include "core/mesh/Mesh.h"
#include "core/radiosity/Reconstruction.h"

#include <cstdint>
#include <vector>

namespace patina {

struct RadiositySurface {
    Id instance = 0;   // MeshInstance::id
    bool back = false; // of triangles whose two sides both reflect
    MeshPtr mesh;      // world, metres; tangents follow the texture coordinates
    // Of each vertex: LitMesh::Vertex::light, and an element that it is a corner of (the one where
    // corners belong to one alone).
    std::vector<std::uint32_t> lights, elements;
};

enum class Corners {
    Shared,    // by all elements that meet there, as far as light runs on smoothly
    PerElement // none: what is said of an element ends with it
};

// In the order of the scene's meshes. All three arguments belong to one scene.
[[nodiscard]] std::vector<RadiositySurface>
radiositySurfaces(const radiosity::LitMesh& mesh, const radiosity::ElementMesh& elements,
                  const BakeGeometry& geometry, Corners corners);

} // namespace patina
