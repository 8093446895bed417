// Colours of geometries that Patina has lit, replaced by others of the same light.
#pragma once

#include "core/export/collada/ColladaScene.h"

#include <glm/vec4.hpp>
#include <span>
#include <vector>

namespace patina::collada {

// Those that the scene shows, each once. Throws Fault: light and vertices that do not fit together.
[[nodiscard]] std::vector<ColladaLitGeometry> litGeometries(const Tree& tree,
                                                            const SceneContents& contents);
// `colors`: of each of those, in their order, one per vertex.
void recolor(const Tree& tree, const SceneContents& contents,
             std::span<const std::vector<glm::vec4>> colors);

} // namespace patina::collada
