// Meshes of the faces of an OBJ file, with the vertices that Assimp 5.2.5 would give them.
#pragma once

#include "core/codec/model/ObjText.h"
#include "core/mesh/Mesh.h"

#include <span>
#include <vector>

namespace patina::codec {

class ObjMeshes {
  public:
    // Keeps a reference to `text`.
    explicit ObjMeshes(const ObjText& text);

    // The faces of these runs as one mesh without a name. Corners that nearly agree share a vertex;
    // vertices stand in the order in which faces name them.
    [[nodiscard]] Mesh join(std::span<const std::size_t> runs);

  private:
    struct Vertex {
        ObjText::Corner corner;
        std::uint32_t older = ObjText::kNone; // the next in its bucket
    };

    [[nodiscard]] std::size_t cornerCount(std::span<const std::size_t> runs) const;
    [[nodiscard]] std::size_t endOf(std::size_t run) const; // face
    std::uint32_t vertexOf(const ObjText::Corner& corner);
    [[nodiscard]] bool nearlyEqual(const ObjText::Corner& a, const ObjText::Corner& b) const;
    [[nodiscard]] glm::vec3 normal(const ObjText::Corner& corner) const;
    [[nodiscard]] glm::vec2 uv(const ObjText::Corner& corner) const;
    [[nodiscard]] int firstCornerOfQuad(const ObjText::Corner* corners) const;

    const ObjText& m_text;
    std::vector<std::size_t> m_hashes;    // of each position
    std::vector<std::uint32_t> m_buckets; // the newest vertex in each, of this mesh
    std::vector<Vertex> m_vertices;       // of this mesh
};

} // namespace patina::codec
