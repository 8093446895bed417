// A primitive element of a COLLADA geometry as a mesh.
#pragma once

#include "core/export/collada/ColladaTree.h"

#include <glm/mat4x4.hpp>
#include <string>
#include <vector>

namespace patina::collada {

// An <input> of a primitive element; those of <vertices> are listed as if they stood there.
struct Input {
    std::string semantic;
    xml_node element, source; // the <source> that it names
    std::size_t offset = 0;   // among the indices of a corner
    int set = 0;
};

// Throws Fault.
[[nodiscard]] std::vector<Input> inputsOf(const Tree& tree, xml_node primitive);
// The texture coordinates of a set; the lowest one there is where `set` is -1 or not there.
[[nodiscard]] const Input* textureInput(const std::vector<Input>& inputs, int set);

// In world space. `set`: of texture coordinates, or -1. Throws Fault.
[[nodiscard]] ColladaMesh readMesh(const Tree& tree, xml_node primitive, int set,
                                   const glm::dmat4& toWorld);

} // namespace patina::collada
