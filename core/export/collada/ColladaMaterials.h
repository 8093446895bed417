// Materials of a COLLADA document: from a bound material to the colours of its effect.
#pragma once

#include "core/export/collada/ColladaTree.h"

namespace patina::collada {

// Of a <material>. Throws Fault.
[[nodiscard]] ColladaMaterial readMaterial(const Tree& tree, xml_node material);

// A URI as the name of a file, as far as it is one.
[[nodiscard]] std::string fileNameOf(std::string_view uri);

// The <instance_material> that an instance binds to a symbol; empty: none.
[[nodiscard]] xml_node boundMaterial(xml_node instance, std::string_view symbol);

// Which set of texture coordinates the diffuse texture uses; -1: the file does not say.
[[nodiscard]] int textureSet(const Tree& tree, xml_node instanceMaterial);

} // namespace patina::collada
