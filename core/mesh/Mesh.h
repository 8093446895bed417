// A triangle mesh with one material: the value every part of Patina shares.
//
// Conventions: right-handed, +Y up, metres, counter-clockwise front faces. Texture coordinates as
// in glTF: (0, 0) is the top-left corner of the image. Tangent space: xyz is the direction of
// growing u, w = ±1, bitangent = cross(normal, tangent.xyz) * tangent.w points up in the image
// (towards smaller v), so that a normal map's green channel means "up" (the OpenGL convention).
#pragma once

#include "core/base/Hash.h"
#include "core/math/Bounds.h"

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <string>
#include <vector>

namespace patina {

struct Mesh {
    std::string name;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;     // unit, one per position
    std::vector<glm::vec4> tangents;    // one per position
    std::vector<glm::vec2> uvs;         // one per position
    std::vector<std::uint32_t> indices; // three per triangle, each < positions.size()

    [[nodiscard]] std::size_t vertexCount() const { return positions.size(); }
    [[nodiscard]] std::size_t triangleCount() const { return indices.size() / 3; }
    [[nodiscard]] Bounds bounds() const;

    friend bool operator==(const Mesh&, const Mesh&) = default;
};

using MeshPtr = std::shared_ptr<const Mesh>;

[[nodiscard]] Hash hashMesh(const Mesh& mesh); // geometry and uvs, not the name

// Angle- and area-weighted vertex normals over shared positions; vertices that only touch
// degenerate triangles get +Y. `creaseDeg` splits nothing: vertices stay as they are.
void computeNormals(Mesh& mesh);

// Tangents per vertex after MikkTSpace's weighting (angle-weighted, orthogonalised against the
// normal), without splitting vertices. Where UVs are degenerate any unit tangent is chosen.
void computeTangents(Mesh& mesh);

// What sanitizeMesh removed or replaced.
struct MeshRepairs {
    std::size_t droppedTriangles = 0; // degenerate: repeated index, zero area
    std::size_t invalidTriangles = 0; // an index out of range or a non-finite position
    std::size_t repairedNormals = 0;  // non-finite or zero
    bool generatedNormals = false, generatedTangents = false, generatedUvs = false;
};

// Makes the mesh keep every promise of the struct above: drops bad triangles, generates missing
// normals, UVs (core/mesh/UvUnwrap.h) and tangents. Afterwards every number is finite.
MeshRepairs sanitizeMesh(Mesh& mesh);

} // namespace patina
