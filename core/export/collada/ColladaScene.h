// The surfaces that a visual scene shows, through all nodes that it reaches.
#pragma once

#include "core/export/collada/ColladaTree.h"

#include <cstddef>
#include <string>
#include <vector>

namespace patina::collada {

// Where an instance stands in the tree.
struct Place {
    xml_node element; // instance_geometry or instance_controller
    xml_node geometry, primitive;
    std::vector<xml_node> hops; // the instance_node elements on the way to it, outermost first
};

struct SceneContents {
    std::vector<ColladaInstance> instances;
    std::vector<Place> places; // of each instance
    std::vector<ColladaMaterial> materials;
    std::vector<std::string> notices;
};

// Throws Fault where the document has none.
[[nodiscard]] std::vector<xml_node> visualScenes(const Tree& tree);
// The one that <scene> names; 0 where it names none. Throws Fault.
[[nodiscard]] std::size_t namedScene(const Tree& tree, const std::vector<xml_node>& scenes);

// Throws Fault: references to what is not there, nodes that contain themselves, too many of them.
[[nodiscard]] SceneContents readScene(const Tree& tree, xml_node visualScene);

[[nodiscard]] bool isPrimitive(xml_node element); // of surfaces
[[nodiscard]] bool isLine(xml_node element);

} // namespace patina::collada
