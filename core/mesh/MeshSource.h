// Where the vertices of an imported mesh come from: importing drops vertices that nothing uses,
// repeats those on seams of new texture coordinates and at hard edges, and moves mirrors into
// copies. Whoever wants to put values per vertex onto the file itself needs to know.
#pragma once

#include "core/mesh/Mesh.h"

#include <cstdint>
#include <vector>

namespace patina {

struct MeshSource {
    // In glTF: meshes[mesh].primitives[primitive]. Elsewhere both are 0, or the number of the mesh
    // in the file.
    int mesh = 0, primitive = 0;
    // For each vertex of the mesh that of the primitive (in STL: 3 · triangle + corner).
    std::vector<std::uint32_t> vertices;
    bool mirrored = false; // x was negated, as a transform that mirrors became one that does not
    // In glTF: nodes[node] shows this mesh as instance `instance` of the model.
    struct Use {
        int instance = 0;
        int node = 0;
        friend bool operator==(const Use&, const Use&) = default;
    };
    std::vector<Use> uses;
    friend bool operator==(const MeshSource&, const MeshSource&) = default;
};

// The source travels with the shared mesh (it is the owner's, as a deleter is) and is no part of
// its value: neither == nor hashMesh() sees it, and a changed copy has none.
[[nodiscard]] std::shared_ptr<Mesh> withSource(Mesh mesh, MeshSource source);
// The same for a mesh whose vertices are those of the file's mesh of this number, one by one.
[[nodiscard]] std::shared_ptr<Mesh> withOwnVertices(Mesh mesh, int number);
// Null where it is not known: built-in meshes, and formats that lose it (OBJ, FBX, COLLADA).
[[nodiscard]] const MeshSource* meshSource(const MeshPtr& mesh);
// For the importer alone, as long as nobody else holds the mesh.
void addUse(const MeshPtr& mesh, const MeshSource::Use& use);

// As sanitizeMesh(Mesh&), and keeps `origin`, which has an entry for each vertex, in step with the
// vertices: those that are dropped take theirs along, copies have that of what they repeat.
MeshRepairs sanitizeMesh(Mesh& mesh, std::vector<std::uint32_t>& origin);
// The same for a mesh that may have a source, which is kept in step. For the importer alone.
MeshRepairs sanitizeMesh(const std::shared_ptr<Mesh>& mesh);

} // namespace patina
