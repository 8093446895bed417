// Nodes that several others show through <instance_node> are copied where one of these showings
// shall differ from the others.
#pragma once

#include "core/export/collada/ColladaScene.h"

#include <cstddef>
#include <map>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace patina::collada {

// A copy of an element with ids of its own; what refers to them within it refers to the copy.
void renameIds(Tree& tree, xml_node copy);

class OwnNodes {
  public:
    explicit OwnNodes(Tree& tree);

    // The element of the instance that only this place shows. All of them are made before any of
    // them is changed, as copies are made of what is there.
    xml_node own(const Place& place);
    // After all are made: what else shows nodes that are to be changed where they are, shows copies
    // of these as they were.
    void separateOthers();
    [[nodiscard]] const std::vector<std::string>& notices() const { return m_notices; }

  private:
    using Key = pugi::xml_node_struct*;
    // From elements of the document to their copies.
    using Copies = std::unordered_map<Key, xml_node>;

    const Copies& copiesBehind(const std::vector<xml_node>& hops, std::size_t count);
    xml_node copyOf(xml_node node);
    void noteChange(xml_node element); // of the nodes that show it
    xml_node target(xml_node hop) const;
    static xml_node in(const Copies& copies, xml_node element);

    Tree& m_tree;
    std::unordered_map<Key, int> m_uses;         // of nodes, through instance_node
    std::map<std::vector<Key>, Copies> m_behind; // of hops; empty: as it is
    std::unordered_set<Key> m_changed;           // nodes that are changed where they are
    std::unordered_set<Key> m_kept;              // hops that lead to such, on purpose
    std::vector<std::string> m_notices;
};

} // namespace patina::collada
