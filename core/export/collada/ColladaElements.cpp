#include "core/export/collada/ColladaElements.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>

namespace patina::collada {
namespace {

constexpr const char* kTool = "Patina " PATINA_VERSION;

int depthOf(xml_node element) {
    int depth = -1;
    for (xml_node above = element.parent(); above; above = above.parent())
        ++depth;
    return depth;
}

std::string newLine(int depth) {
    return "\n" + std::string(static_cast<std::size_t>(2 * std::max(depth, 0)), ' ');
}

// White space, too: an element with both is one that a program has laid out.
bool hasText(xml_node element) {
    return std::ranges::any_of(element.children(), [](const xml_node& child) {
        return child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata;
    });
}

// Before an element that has just been put behind `sibling`.
void lineBefore(xml_node element, xml_node sibling) {
    const std::string line = newLine(depthOf(element));
    xml_node parent = element.parent();
    parent.insert_child_before(pugi::node_pcdata, element).set_value(line.c_str());
    // The only element of its parent: the end tag stands on a line of its own.
    if (!sibling && !element.next_sibling())
        parent.insert_child_after(pugi::node_pcdata, element)
            .set_value(newLine(depthOf(parent)).c_str());
}

template <class Vector>
std::string numbers(std::span<const Vector> vectors) {
    std::string text;
    for (const Vector& v : vectors)
        for (glm::length_t i = 0; i < v.length(); ++i)
            fmt::format_to(std::back_inserter(text), "{}{}", text.empty() ? "" : " ", v[i]);
    return text;
}

template <class Vector>
std::string appendSource(xml_node mesh, const std::vector<Vector>& vectors, const char* part,
                         std::string_view parameters,
                         const std::function<std::string(xml_node, std::string_view)>& newId) {
    const std::string base = mesh.parent().attribute("id").value();
    const xml_node source = append(mesh, "source");
    const std::string id = newId(source, base + "-" + part);
    setAttribute(source, "id", id);
    const xml_node array = append(source, "float_array", numbers(std::span(vectors)));
    const std::string arrayId = newId(array, id + "-array");
    setAttribute(array, "id", arrayId);
    setAttribute(array, "count", fmt::to_string(vectors.size() * parameters.size()));
    const xml_node accessor = append(append(source, "technique_common"), "accessor");
    setAttribute(accessor, "source", "#" + arrayId);
    setAttribute(accessor, "count", fmt::to_string(vectors.size()));
    setAttribute(accessor, "stride", fmt::to_string(parameters.size()));
    for (const char parameter : parameters) {
        const xml_node param = append(accessor, "param");
        setAttribute(param, "name", std::string(1, parameter));
        setAttribute(param, "type", "float");
    }
    return id;
}

void appendInput(xml_node parent, const char* semantic, const std::string& source, bool shared,
                 int set = -1) {
    const xml_node input = append(parent, "input");
    setAttribute(input, "semantic", semantic);
    setAttribute(input, "source", "#" + source);
    if (shared)
        setAttribute(input, "offset", "0");
    if (set >= 0)
        setAttribute(input, "set", fmt::to_string(set));
}

// An <extra> of Patina's with an element of this name.
bool holdsOwn(xml_node extra, const char* name) {
    if (std::string_view(extra.name()) != "extra")
        return false;
    for (const xml_node& technique : extra.children("technique"))
        if (std::string_view(technique.attribute("profile").value()) == "Patina" &&
            technique.child(name))
            return true;
    return false;
}

} // namespace

void setText(xml_node element, const std::string& text) {
    element.remove_children();
    element.append_child(pugi::node_pcdata).set_value(text.c_str());
}

xml_node append(xml_node parent, const char* name) {
    return parent.append_child(name);
}

xml_node append(xml_node parent, const char* name, const std::string& text) {
    const xml_node element = parent.append_child(name);
    setText(element, text);
    return element;
}

void setAttribute(xml_node element, const char* name, const std::string& value) {
    pugi::xml_attribute attribute = element.attribute(name);
    if (!attribute)
        attribute = element.append_attribute(name);
    attribute.set_value(value.c_str());
}

void indent(xml_node element) {
    if (!element.first_child() || hasText(element))
        return;
    const int depth = depthOf(element);
    std::vector<xml_node> children;
    for (const xml_node& child : element.children())
        children.push_back(child);
    for (const xml_node& child : children) {
        element.insert_child_before(pugi::node_pcdata, child).set_value(newLine(depth + 1).c_str());
        indent(child);
    }
    element.append_child(pugi::node_pcdata).set_value(newLine(depth).c_str());
}

xml_node insertAfter(xml_node parent, xml_node sibling, const char* name) {
    const xml_node element =
        sibling ? parent.insert_child_after(name, sibling) : parent.prepend_child(name);
    lineBefore(element, sibling);
    return element;
}

xml_node insertCopyAfter(xml_node parent, xml_node sibling, xml_node element) {
    const xml_node copy =
        sibling ? parent.insert_copy_after(element, sibling) : parent.prepend_copy(element);
    lineBefore(copy, sibling);
    return copy;
}

xml_node lastOf(xml_node parent, std::initializer_list<std::string_view> names) {
    for (xml_node child = parent.last_child(); child; child = child.previous_sibling())
        if (child.type() == pugi::node_element &&
            std::ranges::find(names, std::string_view(child.name())) != names.end())
            return child;
    return {};
}

std::string numberText(double value) {
    return fmt::format("{}", value);
}

std::string numbersText(std::span<const glm::vec4> vectors) {
    return numbers(vectors);
}

std::string matrixText(const glm::dmat4& matrix) {
    std::string text;
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            text += (text.empty() ? "" : " ") + numberText(matrix[column][row]);
    return text;
}

std::string dateText(std::chrono::sys_seconds time) {
    const auto day = std::chrono::floor<std::chrono::days>(time);
    const std::chrono::year_month_day date(day);
    const std::chrono::hh_mm_ss clock(time - day);
    return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", static_cast<int>(date.year()),
                       static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                       clock.hours().count(), clock.minutes().count(), clock.seconds().count());
}

void appendLitMesh(xml_node geometry, const LitVertices& vertices,
                   std::span<const LitTriangles> triangles,
                   const std::function<std::string(xml_node, std::string_view)>& newId) {
    const xml_node mesh = append(geometry, "mesh");
    const std::string positions = appendSource(mesh, vertices.positions, "positions", "XYZ", newId);
    const std::string normals = appendSource(mesh, vertices.normals, "normals", "XYZ", newId);
    // The light map comes first: Blender takes the first set for all textures of a material.
    std::string lightMap, uvs, colors;
    if (!vertices.lightMapUvs.empty())
        lightMap = appendSource(mesh, vertices.lightMapUvs, "light-map", "ST", newId);
    if (!vertices.uvs.empty())
        uvs = appendSource(mesh, vertices.uvs, "texcoords", "ST", newId);
    if (lightMap.empty())
        colors = appendSource(mesh, vertices.colors, "colors", "RGBA", newId);
    const xml_node shared = append(mesh, "vertices");
    const std::string id =
        newId(shared, std::string(geometry.attribute("id").value()) + "-vertices");
    setAttribute(shared, "id", id);
    appendInput(shared, "POSITION", positions, false);
    for (const LitTriangles& part : triangles) {
        const xml_node element = append(mesh, "triangles");
        setAttribute(element, "count", fmt::to_string(part.indices.size() / 3));
        if (!part.material.empty())
            setAttribute(element, "material", part.material);
        appendInput(element, "VERTEX", id, true);
        appendInput(element, "NORMAL", normals, true);
        if (!lightMap.empty())
            appendInput(element, "TEXCOORD", lightMap, true, part.lightMapSet);
        if (!vertices.uvs.empty() && part.textureSet >= 0)
            appendInput(element, "TEXCOORD", uvs, true, part.textureSet);
        if (lightMap.empty())
            appendInput(element, "COLOR", colors, true, 0);
        std::string indices;
        for (const std::uint32_t index : part.indices)
            fmt::format_to(std::back_inserter(indices), "{}{}", indices.empty() ? "" : " ", index);
        append(element, "p", indices);
    }
}

void appendRadiosity(xml_node geometry, const LitVertices& vertices) {
    const xml_node technique = append(append(geometry, "extra"), "technique");
    setAttribute(technique, "profile", "Patina");
    const auto add = [&](const char* name, const std::vector<glm::vec3>& light) {
        const xml_node values = append(technique, name, numbers(std::span(light)));
        setAttribute(values, "count", fmt::to_string(light.size()));
        setAttribute(values, "unit", "W/m^2");
        setAttribute(values, "color_space", "linear sRGB");
    };
    add("radiosity", vertices.radiosity);
    if (!vertices.white.empty())
        add(kWhiteRadiosity, vertices.white);
}

bool isRadiosity(xml_node extra) {
    return holdsOwn(extra, "radiosity");
}

void appendLightMap(xml_node geometry, const ColladaLightMap& map) {
    const xml_node technique = append(append(geometry, "extra"), "technique");
    setAttribute(technique, "profile", "Patina");
    const xml_node element = append(technique, "light_map", uriOf(map.radiance));
    setAttribute(element, "unit", "W/(m^2 sr)");
    setAttribute(element, "color_space", "linear sRGB");
}

bool isLightMap(xml_node extra) {
    return holdsOwn(extra, "light_map");
}

std::string uriOf(const std::string& file) {
    std::string uri = file.starts_with('/') ? "file://" : "";
    for (const char c : file) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                           (c >= '0' && c <= '9') ||
                           std::string_view("-_.~/:").find(c) != std::string_view::npos;
        if (plain)
            uri += c;
        else
            uri += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    return uri;
}

void stampAsset(xml_node root, std::chrono::sys_seconds modified) {
    xml_node asset = root.child("asset");
    const bool isNew = !asset;
    if (isNew)
        asset = insertAfter(root, {}, "asset");
    bool named = false;
    for (const xml_node& contributor : asset.children("contributor"))
        named = named || trimmed(textOf(contributor.child("authoring_tool"))) == kTool;
    if (!named) {
        const xml_node contributor =
            insertAfter(asset, lastOf(asset, {"contributor"}), "contributor");
        append(contributor, "authoring_tool", kTool);
        indent(contributor);
    }
    // The schema's order: contributor, coverage (1.5), created, keywords, modified.
    const std::string date = dateText(modified);
    if (!asset.child("created"))
        setText(insertAfter(asset, lastOf(asset, {"contributor", "coverage"}), "created"), date);
    if (!asset.child("modified"))
        insertAfter(asset, lastOf(asset, {"contributor", "coverage", "created", "keywords"}),
                    "modified");
    setText(asset.child("modified"), date);
}

} // namespace patina::collada
