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
                                                   std::span<const ColladaLitMesh> meshes,
                                                   bool hasLightMap);
// Whether a mesh keeps the promises of ColladaLitMesh, for messages with `name`.
[[nodiscard]] std::optional<std::string>
problemOf(const Mesh& mesh, std::span<const glm::vec4> colors, std::span<const glm::vec3> radiosity,
          std::span<const glm::vec3> white, std::span<const glm::vec2> lightMapUvs,
          bool hasLightMap, const std::string& name);

// Whether a surface's light is in a light map already.
[[nodiscard]] bool showsLightMap(const SceneContents& contents);

// Of meshes that have no problem. Returns notices. `contents` is out of date afterwards.
std::vector<std::string> putLight(Tree& tree, const SceneContents& contents,
                                  std::span<const ColladaLitMesh> meshes,
                                  std::chrono::sys_seconds modified,
                                  const ColladaLightMap* lightMap); // null: light is in vertices

} // namespace patina::collada
