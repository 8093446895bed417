// The XML of a COLLADA document: parsed within limits, its elements by id, and what its numbers
// and references say. Only files of this module see it, and with it pugixml.
#pragma once

#include "core/export/collada/ColladaDocument.h"

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <pugixml.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace patina::collada {

using pugi::xml_node;

// Leaves the module as an Error (InputBroken).
class Fault : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

class Tree {
  public:
    // Throws Fault.
    Tree(std::string text, const ColladaLimits& limits);

    [[nodiscard]] xml_node root() const { return m_document.document_element(); }
    [[nodiscard]] const ColladaLimits& limits() const { return m_limits; }

    // The element of one of these names that "#id" refers to. `from` refers to it, for messages.
    // Throws Fault: another file, no such element, more than one.
    [[nodiscard]] xml_node resolve(std::string_view reference,
                                   std::initializer_list<std::string_view> names,
                                   xml_node from) const;
    // The same, where it may be missing: an empty node.
    [[nodiscard]] xml_node find(const std::string& id,
                                std::initializer_list<std::string_view> names) const;

    // An ASCII id that nothing has yet, made of `wanted`; taken from now on. Its element is to be
    // added when it has it.
    std::string newId(std::string_view wanted);
    void add(xml_node element, const std::string& id) { m_ids[id].push_back(element); }
    void rebuildIds();

    [[nodiscard]] std::string text() const;

  private:
    pugi::xml_document m_document;
    ColladaLimits m_limits;
    std::unordered_map<std::string, std::vector<xml_node>> m_ids;
    std::unordered_map<std::string, int> m_nextSuffix; // that newId() tries
};

// `<p> in <geometry id="Box-mesh">`.
[[nodiscard]] std::string describe(xml_node element);

// All text in an element, comments left out.
[[nodiscard]] std::string textOf(xml_node element);
[[nodiscard]] std::string trimmed(std::string_view text);

// Throw Fault: not a number, not finite, out of range of float.
[[nodiscard]] std::vector<float> floatsOf(xml_node element);
[[nodiscard]] std::vector<double> doublesOf(xml_node element);
[[nodiscard]] std::vector<double> doublesOf(xml_node element, std::size_t count); // so many
[[nodiscard]] std::vector<std::uint32_t> indicesOf(xml_node element);
// An attribute that is a whole number. Throws Fault where it is missing or none.
[[nodiscard]] std::uint64_t countOf(xml_node element, const char* attribute);
[[nodiscard]] std::uint64_t countOf(xml_node element, const char* attribute,
                                    std::uint64_t whereMissing);

// The element that follows `element` in the document within `top`, `element` itself first: an end
// of the walk is an empty node. Needs no stack, however deep the tree is.
[[nodiscard]] xml_node nextElement(xml_node element, xml_node top);

} // namespace patina::collada
