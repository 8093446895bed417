// The shape in which a node shows a mesh of glTF: morphed by the weights that the file has as
// defaults (glTF 2.0, 3.7.2.2).
#pragma once

#include "core/codec/model/GltfPrimitive.h"
#include "core/mesh/Mesh.h"

#include <compare>
#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <vector>

namespace patina::codec {

// Nodes of equal shapes show the same triangles.
struct GltfShape {
    std::size_t mesh = 0;
    std::vector<float> weights; // of the morph targets: finite, without zeros at the end

    friend auto operator<=>(const GltfShape&, const GltfShape&) = default;
};

class GltfShaper {
  public:
    // Keeps references.
    GltfShaper(const nlohmann::json& root, const GltfBuffers& buffers)
        : m_root(root)
        , m_buffers(buffers) {}

    // Of a node that has a mesh.
    [[nodiscard]] GltfShape shapeOf(const nlohmann::json& node);
    // `mesh` holds the arrays of the primitive as they stand in the file.
    void morph(Mesh& mesh, const GltfPrimitive& primitive, const GltfShape& shape);
    // One sentence for each thing that could not be applied.
    [[nodiscard]] const std::set<std::string>& notes() const { return m_notes; }

  private:
    void note(const std::string& mesh, const char* what);

    const nlohmann::json& m_root;
    const GltfBuffers& m_buffers;
    std::set<std::string> m_notes;
};

} // namespace patina::codec
