#include "core/export/collada/OwnNodes.h"

#include "core/export/collada/ColladaElements.h"

#include <fmt/format.h>
#include <string_view>
#include <utility>

namespace patina::collada {
namespace {

bool isNamed(xml_node element, std::string_view name) {
    return element.name() == name;
}

xml_node firstLibraryOfNodes(Tree& tree) {
    if (const xml_node library = tree.root().child("library_nodes"))
        return library;
    xml_node last = tree.root().child("asset");
    for (const xml_node& child : tree.root().children())
        if (std::string_view(child.name()).starts_with("library_"))
            last = child;
    return insertAfter(tree.root(), last, "library_nodes");
}

} // namespace

void renameIds(Tree& tree, xml_node copy) {
    std::unordered_map<std::string, std::string> renamed; // "#old" to "#new"
    for (xml_node element = copy; element; element = nextElement(element, copy)) {
        pugi::xml_attribute id = element.attribute("id");
        if (!id || *id.value() == '\0')
            continue;
        const std::string name = tree.newId(id.value());
        renamed["#" + std::string(id.value())] = "#" + name;
        id.set_value(name.c_str());
        tree.add(element, name);
    }
    for (xml_node element = copy; element; element = nextElement(element, copy)) {
        for (const char* name : {"url", "source", "target"})
            if (pugi::xml_attribute reference = element.attribute(name))
                if (const auto found = renamed.find(reference.value()); found != renamed.end())
                    reference.set_value(found->second.c_str());
        if (isNamed(element, "skeleton"))
            if (const auto found = renamed.find(trimmed(textOf(element))); found != renamed.end())
                element.text().set(found->second.c_str());
    }
}

OwnNodes::OwnNodes(Tree& tree)
    : m_tree(tree) {
    for (xml_node element = tree.root(); element; element = nextElement(element, tree.root()))
        if (isNamed(element, "instance_node"))
            if (const xml_node node = target(element))
                ++m_uses[node.internal_object()];
}

// Empty: what it refers to is in another file, or nowhere.
xml_node OwnNodes::target(xml_node hop) const {
    const std::string url = hop.attribute("url").value();
    return url.starts_with('#') ? m_tree.find(url.substr(1), {"node"}) : xml_node();
}

xml_node OwnNodes::in(const Copies& copies, xml_node element) {
    const auto found = copies.find(element.internal_object());
    return found == copies.end() ? element : found->second;
}

xml_node OwnNodes::own(const Place& place) {
    const xml_node element = in(copiesBehind(place.hops, place.hops.size()), place.element);
    noteChange(element);
    return element;
}

void OwnNodes::noteChange(xml_node element) {
    for (xml_node above = element.parent(); above; above = above.parent())
        m_changed.insert(above.internal_object());
}

const OwnNodes::Copies& OwnNodes::copiesBehind(const std::vector<xml_node>& hops,
                                               std::size_t count) {
    std::vector<Key> path;
    for (std::size_t i = 0; i < count; ++i)
        path.push_back(hops[i].internal_object());
    if (const auto found = m_behind.find(path); found != m_behind.end())
        return found->second;
    if (count == 0)
        return m_behind[path];
    const xml_node hop = in(copiesBehind(hops, count - 1), hops[count - 1]);
    const xml_node node = target(hops[count - 1]);
    noteChange(hop); // what shows its node shows what lies behind it
    m_kept.insert(hop.internal_object());
    // A copy's references are in use beside those of its original.
    const bool alone = hop == hops[count - 1] && m_uses[node.internal_object()] == 1 &&
                       isNamed(node.parent(), "library_nodes");
    if (alone)
        return m_behind[path];
    const xml_node copy = copyOf(node);
    setAttribute(hop, "url", "#" + std::string(copy.attribute("id").value()));
    Copies copies;
    xml_node to = copy;
    for (xml_node from = node; from; from = nextElement(from, node), to = nextElement(to, copy))
        copies[from.internal_object()] = to;
    return m_behind[path] = std::move(copies);
}

xml_node OwnNodes::copyOf(xml_node node) {
    xml_node copy;
    if (isNamed(node.parent(), "library_nodes")) {
        copy = insertCopyAfter(node.parent(), node, node);
    } else {
        xml_node library = firstLibraryOfNodes(m_tree);
        copy = insertCopyAfter(library, lastOf(library, {"asset", "node"}), node);
    }
    renameIds(m_tree, copy);
    m_notices.push_back(
        fmt::format("{} is shown several times and was copied; animations move the original only.",
                    describe(node)));
    return copy;
}

void OwnNodes::separateOthers() {
    std::vector<xml_node> hops;
    const auto addHops = [&](xml_node top) {
        for (xml_node element = top; element; element = nextElement(element, top))
            if (isNamed(element, "instance_node") && !m_kept.contains(element.internal_object()))
                hops.push_back(element);
    };
    addHops(m_tree.root());
    for (std::size_t i = 0; i < hops.size(); ++i) {
        const xml_node hop = hops[i];
        const xml_node node = target(hop);
        if (!node || !m_changed.contains(node.internal_object()))
            continue;
        const xml_node copy = copyOf(node);
        setAttribute(hop, "url", "#" + std::string(copy.attribute("id").value()));
        addHops(copy);
    }
}

} // namespace patina::collada
