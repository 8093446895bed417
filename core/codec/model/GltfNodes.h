// Where the nodes of a glTF file stand, and the copies of an instanced one.
#pragma once

#include "core/codec/model/GltfBuffers.h"

#include <glm/mat4x4.hpp>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

namespace patina::codec {

// A node's own transform. Its numbers may be infinite.
[[nodiscard]] glm::mat4 gltfTransform(const nlohmann::json& node);

[[nodiscard]] bool isFinite(const glm::mat4& matrix);

// EXT_mesh_gpu_instancing: the transforms of a node's copies, relative to the node. Nothing where
// the node is not instanced. Throws Refusal.
[[nodiscard]] std::optional<std::vector<glm::mat4>> gltfCopies(const nlohmann::json& node,
                                                               const GltfBuffers& buffers);

// World transforms by the number of the node, whether a scene shows it or not.
class GltfNodes {
  public:
    // Keeps a reference.
    explicit GltfNodes(const nlohmann::json& root);
    // Throws Refusal where there is no such node or it is its own ancestor.
    [[nodiscard]] const glm::mat4& world(std::size_t node);

  private:
    const nlohmann::json& m_root;
    std::vector<std::size_t> m_parents;
    std::vector<std::optional<glm::mat4>> m_worlds;
};

} // namespace patina::codec
