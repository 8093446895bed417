// New elements of a COLLADA tree, as both a lit document and a new one have them.
#pragma once

#include "core/export/collada/ColladaTree.h"

#include <chrono>
#include <cstddef>
#include <functional>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace patina::collada {

xml_node append(xml_node parent, const char* name);
xml_node append(xml_node parent, const char* name, const std::string& text);
void setText(xml_node element, const std::string& text); // instead of all that is in it
void setAttribute(xml_node element, const char* name, const std::string& value);

// Puts each element within `element` that has no text onto a line of its own.
void indent(xml_node element);
// A new element, on a line of its own, after `sibling`; the first one of `parent` where that is
// empty.
xml_node insertAfter(xml_node parent, xml_node sibling, const char* name);
// The same for a copy of `element`.
xml_node insertCopyAfter(xml_node parent, xml_node sibling, xml_node element);
// The last child element with one of these names; empty: none.
[[nodiscard]] xml_node lastOf(xml_node parent, std::initializer_list<std::string_view> names);

[[nodiscard]] std::string numberText(double value); // as short as reads back the same
[[nodiscard]] std::string numbersText(std::span<const glm::vec4> vectors); // one after another
[[nodiscard]] std::string matrixText(const glm::dmat4& matrix);            // row after row
[[nodiscard]] std::string dateText(std::chrono::sys_seconds time);         // ISO 8601, UTC

// What is new in a geometry, in its own space and units, v upwards.
struct LitVertices {
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec2> uvs; // empty: none
    std::vector<glm::vec4> colors;
    std::vector<glm::vec3> radiosity;   // W/m², linear sRGB
    std::vector<glm::vec3> white;       // as ColladaLitMesh::white
    std::vector<glm::vec2> lightMapUvs; // empty: light is in `colors`
};
struct LitTriangles {
    std::string material; // its symbol; empty: none
    int textureSet = -1;  // none
    int lightMapSet = -1; // none
    std::vector<std::uint32_t> indices;
};

// The <mesh> of a lit geometry. `newId` makes ids that nothing else has.
void appendLitMesh(xml_node geometry, const LitVertices& vertices,
                   std::span<const LitTriangles> triangles,
                   const std::function<std::string(xml_node, std::string_view)>& newId);
// In the <extra> of a lit geometry: what its colours show, where that is not its radiosity.
inline constexpr const char* kWhiteRadiosity = "white_radiosity";
// The <extra> with the radiosity of its vertices.
void appendRadiosity(xml_node geometry, const LitVertices& vertices);
[[nodiscard]] bool isRadiosity(xml_node extra);
// The <extra> of one whose light is in a light map.
void appendLightMap(xml_node geometry, const ColladaLightMap& map);
[[nodiscard]] bool isLightMap(xml_node extra);

// A file name as a URI: what is no plain character of one is written as its bytes.
[[nodiscard]] std::string uriOf(const std::string& file);

// Patina among the contributors, and the date.
void stampAsset(xml_node root, std::chrono::sys_seconds modified);

} // namespace patina::collada
