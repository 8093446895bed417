#include "core/export/collada/ColladaLighting.h"

#include "core/export/collada/ColladaElements.h"
#include "core/export/collada/ColladaGeometry.h"
#include "core/export/collada/ColladaLightMaps.h"
#include "core/export/collada/ColladaMaterials.h"
#include "core/export/collada/ColladaTransforms.h"
#include "core/export/collada/OwnNodes.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <set>
#include <string_view>
#include <unordered_set>
#include <utility>

namespace patina::collada {
namespace {

template <class Vector>
bool allWithin(std::span<const Vector> vectors, float lowest, float highest) {
    return std::ranges::all_of(vectors, [&](const Vector& v) {
        for (glm::length_t i = 0; i < v.length(); ++i)
            if (!(v[i] >= lowest && v[i] <= highest)) // also where it is no number
                return false;
        return true;
    });
}

// The lit meshes of one <instance_geometry>, in the order of its primitive elements.
struct LitInstance {
    std::vector<const ColladaLitMesh*> meshes;
    xml_node element; // that only this place shows
};

std::string nameOf(const ColladaInstance& instance) {
    return fmt::format("\"{}\" ({})", instance.path, instance.geometryId);
}

// Brings a mesh back from world space, behind those that are there.
void addVertices(const Mesh& mesh, const glm::dmat4& toWorld, LitVertices& vertices) {
    const glm::dmat4 fromWorld = glm::inverse(toWorld);
    // Normals left with the inverse transpose: they return with the transpose.
    const glm::dmat3 normalFromWorld = glm::transpose(glm::dmat3(toWorld));
    for (const glm::vec3& p : mesh.positions)
        vertices.positions.emplace_back(fromWorld * glm::dvec4(p, 1.0));
    for (const glm::vec3& n : mesh.normals) {
        const glm::dvec3 local = normalFromWorld * glm::dvec3(n);
        const double length = glm::length(local);
        vertices.normals.push_back(length > 0.0 ? glm::vec3(local / length) : n);
    }
}

class Lighting {
  public:
    Lighting(Tree& tree, const SceneContents& contents, const ColladaLightMap* lightMap)
        : m_tree(tree)
        , m_contents(contents)
        , m_lightMap(lightMap)
        , m_nodes(tree) {}

    std::vector<std::string> put(std::span<const ColladaLitMesh> meshes,
                                 std::chrono::sys_seconds modified) {
        std::vector<LitInstance> instances = byInstance(meshes);
        for (LitInstance& instance : instances)
            instance.element = m_nodes.own(place(*instance.meshes.front()));
        m_nodes.separateOthers();
        if (m_lightMap != nullptr)
            m_materials.emplace(m_tree, m_lightMap->picture);
        m_notices.insert(m_notices.end(), m_nodes.notices().begin(), m_nodes.notices().end());
        for (const LitInstance& instance : instances)
            light(instance);
        removeFormerLight();
        stampAsset(m_tree.root(), modified);
        m_tree.rebuildIds();
        return std::move(m_notices);
    }

  private:
    [[nodiscard]] const Place& place(const ColladaLitMesh& mesh) const {
        return m_contents.places[mesh.instance];
    }
    [[nodiscard]] const ColladaInstance& info(const ColladaLitMesh& mesh) const {
        return m_contents.instances[mesh.instance];
    }

    std::vector<LitInstance> byInstance(std::span<const ColladaLitMesh> meshes) {
        std::vector<const ColladaLitMesh*> sorted;
        for (const ColladaLitMesh& mesh : meshes)
            sorted.push_back(&mesh);
        std::ranges::sort(sorted, {}, [](const ColladaLitMesh* mesh) { return mesh->instance; });
        std::vector<LitInstance> result;
        for (const ColladaLitMesh* mesh : sorted) {
            const ColladaInstance& instance = info(*mesh);
            if (instance.controlled) {
                m_notices.push_back(fmt::format("{} is deformed by a controller, which needs its "
                                                "vertices as they are; it was left without light.",
                                                nameOf(instance)));
                continue;
            }
            if (!isInvertible(instance.toWorld)) {
                m_notices.push_back(fmt::format("{} is flattened by its node's transform; it was "
                                                "left without light.",
                                                nameOf(instance)));
                continue;
            }
            const bool continues =
                !result.empty() &&
                place(*result.back().meshes.front()).element == place(*mesh).element &&
                place(*result.back().meshes.front()).hops == place(*mesh).hops;
            if (!continues)
                result.emplace_back();
            result.back().meshes.push_back(mesh);
        }
        return result;
    }

    void light(const LitInstance& instance) {
        const xml_node original = place(*instance.meshes.front()).geometry;
        LitVertices vertices;
        std::vector<LitTriangles> triangles;
        std::set<std::string> left;
        for (const ColladaLitMesh* lit : instance.meshes)
            triangles.push_back(addPart(*lit, vertices, left));
        for (const std::string& semantic : left)
            m_notices.push_back(fmt::format("{} has {} that its lit copy has not.",
                                            nameOf(info(*instance.meshes.front())), semantic));
        if (!vertices.uvs.empty()) // of the last part, where it has none
            vertices.uvs.resize(vertices.positions.size(), glm::vec2(0.0f));

        const xml_node geometry = newGeometry(original);
        appendLitMesh(geometry, vertices, triangles,
                      [&](xml_node element, std::string_view wanted) {
                          std::string id = m_tree.newId(wanted);
                          m_tree.add(element, id);
                          return id;
                      });
        indent(geometry);
        copyExtras(original.child("mesh"), geometry.child("mesh"));
        copyExtras(original, geometry);
        addOwnExtra(geometry, vertices);

        addRest(instance, original);
        setAttribute(instance.element, "url", "#" + std::string(geometry.attribute("id").value()));
        if (m_lightMap != nullptr)
            for (const LitTriangles& part : triangles)
                m_materials->bind(instance.element, part.material, part.lightMapSet);
        m_originals.push_back(original);
    }

    LitTriangles addPart(const ColladaLitMesh& lit, LitVertices& vertices,
                         std::set<std::string>& left) const {
        const ColladaInstance& instance = info(lit);
        const xml_node primitive = place(lit).primitive;
        const std::vector<Input> inputs = inputsOf(m_tree, primitive);
        const std::string symbol = primitive.attribute("material").value();
        const Input* uv =
            textureInput(inputs, textureSet(m_tree, boundMaterial(place(lit).element, symbol)));
        for (const Input& input : inputs)
            if (input.semantic == "TEXCOORD" && &input != uv)
                left.insert(fmt::format("texture coordinates of set {}", input.set));
            else if (input.semantic.find("TANGENT") != std::string::npos ||
                     input.semantic.find("BINORMAL") != std::string::npos)
                left.insert("tangents");

        LitTriangles result;
        result.material = symbol;
        const auto first = static_cast<std::uint32_t>(vertices.positions.size());
        addVertices(lit.mesh, instance.toWorld, vertices);
        if (!lit.mesh.uvs.empty()) {
            result.textureSet = uv != nullptr ? uv->set : 0;
            vertices.uvs.resize(first, glm::vec2(0.0f)); // of parts that have none
            for (const glm::vec2& v : lit.mesh.uvs)
                vertices.uvs.emplace_back(v.x, 1.0f - v.y);
        }
        if (m_lightMap != nullptr) {
            result.lightMapSet = result.textureSet + 1;
            if (result.material.empty())
                result.material = "light-map";
            for (const glm::vec2& v : lit.lightMapUvs)
                vertices.lightMapUvs.emplace_back(v.x, 1.0f - v.y);
        }
        addWhite(lit, vertices);
        vertices.colors.insert(vertices.colors.end(), lit.colors.begin(), lit.colors.end());
        vertices.radiosity.insert(vertices.radiosity.end(), lit.radiosity.begin(),
                                  lit.radiosity.end());
        const bool mirrored = glm::determinant(glm::dmat3(instance.toWorld)) < 0.0;
        for (std::size_t i = 0; i < lit.mesh.indices.size(); i += 3) {
            const std::uint32_t* corner = lit.mesh.indices.data() + i;
            for (const std::uint32_t index :
                 {corner[0], corner[mirrored ? 2 : 1], corner[mirrored ? 1 : 2]})
                result.indices.push_back(first + index);
        }
        return result;
    }

    // As long as no part has a texture there is none; `vertices.radiosity` is that of the parts
    // before.
    static void addWhite(const ColladaLitMesh& lit, LitVertices& vertices) {
        if (lit.white.empty() && vertices.white.empty())
            return;
        if (vertices.white.empty())
            vertices.white = vertices.radiosity;
        const std::vector<glm::vec3>& shown = lit.white.empty() ? lit.radiosity : lit.white;
        vertices.white.insert(vertices.white.end(), shown.begin(), shown.end());
    }

    // Behind the original's library, with its name.
    xml_node newGeometry(xml_node original) {
        xml_node library = original.parent();
        const xml_node geometry = insertAfter(library, lastOf(library, {"geometry"}), "geometry");
        const std::string id =
            m_tree.newId(fmt::format("{}-lit", original.attribute("id").value()));
        setAttribute(geometry, "id", id);
        if (original.attribute("name"))
            setAttribute(geometry, "name", original.attribute("name").value());
        m_tree.add(geometry, id);
        return geometry;
    }

    // What programs have noted there, but former light.
    void copyExtras(xml_node from, xml_node to) {
        for (const xml_node& extra : from.children("extra"))
            if (!isRadiosity(extra) && !isLightMap(extra))
                renameIds(m_tree, insertCopyAfter(to, lastChild(to), extra));
    }

    static xml_node lastChild(xml_node parent) {
        xml_node child = parent.last_child();
        while (child && child.type() != pugi::node_element)
            child = child.previous_sibling();
        return child;
    }

    void addOwnExtra(xml_node geometry, const LitVertices& values) const {
        const xml_node last = lastChild(geometry);
        if (m_lightMap != nullptr)
            appendLightMap(geometry, *m_lightMap);
        else
            appendRadiosity(geometry, values);
        // On a line of its own, before the end tag's.
        const xml_node extra = insertCopyAfter(geometry, last, geometry.last_child());
        geometry.remove_child(geometry.last_child());
        indent(extra);
    }

    // What of an instance is not lit keeps a geometry with that alone.
    void addRest(const LitInstance& instance, xml_node original) {
        std::unordered_set<pugi::xml_node_struct*> lit;
        for (const ColladaLitMesh* mesh : instance.meshes)
            lit.insert(place(*mesh).primitive.internal_object());
        std::vector<bool> remove;
        bool anyLeft = false;
        for (const xml_node& child : original.child("mesh").children()) {
            remove.push_back(lit.contains(child.internal_object()));
            anyLeft = anyLeft || ((isPrimitive(child) || isLine(child)) && !remove.back());
        }
        if (!anyLeft)
            return;
        const xml_node rest =
            insertCopyAfter(original.parent(), lastOf(original.parent(), {"geometry"}), original);
        setAttribute(rest, "id", fmt::format("{}-unlit", original.attribute("id").value()));
        renameIds(m_tree, rest);
        xml_node mesh = rest.child("mesh");
        std::size_t i = 0;
        for (xml_node child = mesh.first_child(); child; ++i) {
            const xml_node next = child.next_sibling();
            if (remove[i])
                mesh.remove_child(child);
            child = next;
        }
        const xml_node element =
            insertCopyAfter(instance.element.parent(), instance.element, instance.element);
        xml_node(element).remove_attribute("sid"); // it is the first one's
        setAttribute(element, "url", "#" + std::string(rest.attribute("id").value()));
    }

    // Geometry that earlier runs have lit, and nothing shows any more.
    void removeFormerLight() {
        std::unordered_set<std::string> references;
        for (xml_node e = m_tree.root(); e; e = nextElement(e, m_tree.root()))
            for (const char* name : {"url", "source", "target"})
                if (const char* value = e.attribute(name).value(); *value == '#')
                    references.insert(value + 1);
        std::unordered_set<pugi::xml_node_struct*> seen;
        for (const xml_node& original : m_originals)
            if (seen.insert(original.internal_object()).second &&
                std::ranges::any_of(original.children("extra"), isRadiosity) &&
                !references.contains(original.attribute("id").value())) {
                if (const xml_node line = original.previous_sibling();
                    line.type() == pugi::node_pcdata && trimmed(line.value()).empty())
                    original.parent().remove_child(line);
                original.parent().remove_child(original);
            }
    }

    Tree& m_tree;
    const SceneContents& m_contents;
    const ColladaLightMap* m_lightMap;
    OwnNodes m_nodes;
    std::vector<std::string> m_notices;
    std::optional<LightMapMaterials> m_materials; // with a light map
    std::vector<xml_node> m_originals;
};

} // namespace

std::optional<std::string> problemOf(const Mesh& mesh, std::span<const glm::vec4> colors,
                                     std::span<const glm::vec3> radiosity,
                                     std::span<const glm::vec3> white,
                                     std::span<const glm::vec2> lightMapUvs, bool hasLightMap,
                                     const std::string& name) {
    constexpr float kMost = std::numeric_limits<float>::max();
    const std::size_t count = mesh.positions.size(), lit = hasLightMap ? 0 : count;
    if (mesh.indices.empty() || mesh.indices.size() % 3 != 0)
        return fmt::format("the lit mesh of {} has no triangles; leave it out", name);
    if (lightMapUvs.size() != count - lit || !allWithin<glm::vec2>(lightMapUvs, 0.0f, 1.0f))
        return fmt::format("the lit mesh of {} does not lie in the light map; give each vertex a "
                           "place in it, or none",
                           name);
    if (mesh.normals.size() != count || colors.size() != lit || radiosity.size() != lit ||
        (!mesh.uvs.empty() && mesh.uvs.size() != count) ||
        (!white.empty() && white.size() != count))
        return fmt::format("the lit mesh of {} has {} positions, {} normals, {} texture "
                           "coordinates, {} colours and {} radiosities; give each vertex one of "
                           "each",
                           name, count, mesh.normals.size(), mesh.uvs.size(), colors.size(),
                           radiosity.size());
    if (std::ranges::any_of(mesh.indices, [&](std::uint32_t index) { return index >= count; }))
        return fmt::format("a triangle of the lit mesh of {} has a vertex beyond its {}", name,
                           count);
    if (!allWithin<glm::vec3>(mesh.positions, -kMost, kMost) ||
        !allWithin<glm::vec3>(mesh.normals, -kMost, kMost) ||
        !allWithin<glm::vec2>(mesh.uvs, -kMost, kMost))
        return fmt::format("the lit mesh of {} has a vertex that is not finite", name);
    if (!allWithin<glm::vec4>(colors, 0.0f, 1.0f))
        return fmt::format("the lit mesh of {} has a colour outside of 0 to 1", name);
    if (!allWithin<glm::vec3>(radiosity, 0.0f, kMost) || !allWithin<glm::vec3>(white, 0.0f, kMost))
        return fmt::format("the lit mesh of {} has a radiosity that is negative or not finite",
                           name);
    return std::nullopt;
}

bool showsLightMap(const SceneContents& contents) {
    return std::ranges::any_of(contents.places, [](const Place& place) {
        return std::ranges::any_of(place.geometry.children("extra"), isLightMap);
    });
}

std::optional<std::string> problemOf(const Tree& tree, const SceneContents& contents,
                                     std::span<const ColladaLitMesh> meshes, bool hasLightMap) {
    if (showsLightMap(contents))
        return std::string("the document's surfaces show a light map already; light the "
                           "document that it was made from");
    std::set<std::size_t> known;
    for (const ColladaLitMesh& lit : meshes) {
        if (lit.instance >= contents.instances.size())
            return fmt::format("there is no instance {}; the scene has {}", lit.instance,
                               contents.instances.size());
        const std::string name = nameOf(contents.instances[lit.instance]);
        if (!known.insert(lit.instance).second)
            return fmt::format("{} is lit twice; give it one mesh", name);
        if (auto problem = problemOf(lit.mesh, lit.colors, lit.radiosity, lit.white,
                                     lit.lightMapUvs, hasLightMap, name))
            return problem;
        const std::vector<Input> inputs = inputsOf(tree, contents.places[lit.instance].primitive);
        if (lit.mesh.uvs.empty() && textureInput(inputs, -1) != nullptr)
            return fmt::format("the lit mesh of {} has no texture coordinates, which its "
                               "original has; keep them",
                               name);
    }
    return std::nullopt;
}

std::vector<std::string> putLight(Tree& tree, const SceneContents& contents,
                                  std::span<const ColladaLitMesh> meshes,
                                  std::chrono::sys_seconds modified,
                                  const ColladaLightMap* lightMap) {
    return Lighting(tree, contents, lightMap).put(meshes, modified);
}

} // namespace patina::collada
