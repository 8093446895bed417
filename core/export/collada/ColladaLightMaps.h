// Materials that show a light map, in a document that has others.
#pragma once

#include "core/export/collada/ColladaTree.h"

#include <map>
#include <string>

namespace patina::collada {

class LightMapMaterials {
  public:
    // `picture`: name of the light map's file. Adds the image.
    LightMapMaterials(Tree& tree, const std::string& picture);

    // Binds a symbol of an <instance_geometry> to a copy of the material that it is bound to, which
    // is black and glows with the light map by a set of texture coordinates.
    void bind(xml_node instance, const std::string& symbol, int set);

  private:
    // A child of the root with this name.
    xml_node library(const char* name);
    std::string materialLike(xml_node original); // its id; empty original: none
    xml_node effectLike(xml_node original);
    void addParameters(xml_node profile);
    [[nodiscard]] bool isVersion15() const;

    Tree& m_tree;
    std::string m_image;                         // id
    std::map<std::string, std::string> m_copies; // of materials, by id
};

} // namespace patina::collada
