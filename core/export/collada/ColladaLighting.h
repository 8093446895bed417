// Puts lit meshes into the tree of a COLLADA document.
#pragma once

#include "core/export/collada/ColladaScene.h"

#include <chrono>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace patina::collada {

// Why these cannot be put into the document.
[[nodiscard]] std::optional<std::string> problemOf(const Tree& tree, const SceneContents& contents,
                                                   std::span<const ColladaLitMesh> meshes);
// Whether a mesh keeps the promises of ColladaLitMesh, for messages with `name`.
[[nodiscard]] std::optional<std::string>
problemOf(const Mesh& mesh, std::span<const glm::vec4> colors, std::span<const glm::vec3> radiosity,
          std::span<const glm::vec3> white, const std::string& name);

// Of meshes that have no problem. Returns notices. `contents` is out of date afterwards.
std::vector<std::string> putLight(Tree& tree, const SceneContents& contents,
                                  std::span<const ColladaLitMesh> meshes,
                                  std::chrono::sys_seconds modified);

} // namespace patina::collada
