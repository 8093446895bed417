// What places things in a COLLADA scene: transform elements, units and axes.
#pragma once

#include "core/export/collada/ColladaTree.h"

#include <glm/mat4x4.hpp>

namespace patina::collada {

// The product of a node's transform elements, in their order; columns are multiplied from the
// right. Throws Fault.
[[nodiscard]] glm::dmat4 transformOf(xml_node node);

// From the document's units and axes (its <asset>) to metres and +Y up. Throws Fault.
[[nodiscard]] glm::dmat4 assetTransform(const Tree& tree);

// Not finite, or flat: nothing can be brought back through it.
[[nodiscard]] bool isInvertible(const glm::dmat4& matrix);

} // namespace patina::collada
