// The shape in which a node shows a mesh of glTF: morphed by the weights that the file has as
// defaults (glTF 2.0, 3.7.2.2), and skinned in the pose that its joints have there (3.7.3.3).
#pragma once

#include "core/codec/model/GltfNodes.h"
#include "core/codec/model/GltfPrimitive.h"
#include "core/mesh/Mesh.h"

#include <compare>
#include <cstddef>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <vector>

namespace patina::codec {

// Nodes of equal shapes show the same triangles.
struct GltfShape {
    static constexpr std::size_t kNoSkin = ~std::size_t{0};
    std::size_t mesh = 0;
    std::size_t skin = kNoSkin;
    std::vector<float> weights; // of the morph targets: finite, without zeros at the end

    friend auto operator<=>(const GltfShape&, const GltfShape&) = default;
};

class GltfShaper {
  public:
    // Keeps references.
    GltfShaper(const nlohmann::json& root, const GltfBuffers& buffers)
        : m_root(root)
        , m_buffers(buffers)
        , m_nodes(root) {}

    // Of a node that has a mesh.
    [[nodiscard]] GltfShape shapeOf(const nlohmann::json& node);
    // `mesh` holds the arrays of the primitive as they stand in the file.
    void morph(Mesh& mesh, const GltfPrimitive& primitive, const GltfShape& shape);
    // Into world space; false where the primitive has no joints and stays where its node is.
    bool skin(Mesh& mesh, const GltfPrimitive& primitive, const GltfShape& shape);

    // One sentence for each thing that could not be applied.
    [[nodiscard]] const std::set<std::string>& notes() const { return m_notes; }

  private:
    const std::vector<glm::mat4>& jointMatrices(std::size_t skin);
    // Empty where the primitive has no joints.
    [[nodiscard]] std::vector<glm::mat4> vertexMatrices(const Mesh& mesh,
                                                        const GltfPrimitive& primitive,
                                                        const std::vector<glm::mat4>& joints);
    void note(const std::string& mesh, const char* what);

    const nlohmann::json& m_root;
    const GltfBuffers& m_buffers;
    GltfNodes m_nodes;
    std::map<std::size_t, std::vector<glm::mat4>> m_joints; // by skin
    std::set<std::string> m_notes;
};

} // namespace patina::codec
