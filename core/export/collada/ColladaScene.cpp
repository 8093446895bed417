#include "core/export/collada/ColladaScene.h"

#include "core/export/Names.h"
#include "core/export/collada/ColladaMaterials.h"
#include "core/export/collada/ColladaTransforms.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <set>
#include <string_view>
#include <utility>

namespace patina::collada {
namespace {

std::string nodeName(xml_node node) {
    for (const char* attribute : {"name", "id", "sid"})
        if (const char* value = node.attribute(attribute).value(); *value != '\0')
            return cleanName(value, "node");
    return "node";
}

class SceneWalk {
  public:
    explicit SceneWalk(const Tree& tree)
        : m_tree(tree) {}

    SceneContents walk(xml_node visualScene) {
        const glm::dmat4 toWorld = assetTransform(m_tree);
        for (const xml_node& node : visualScene.children("node"))
            visit(node, toWorld);
        return std::move(m_contents);
    }

  private:
    void visit(xml_node node, const glm::dmat4& above) {
        if (std::ranges::find(m_path, node) != m_path.end())
            throw Fault(fmt::format("{} contains itself through <instance_node>; remove one of "
                                    "these references",
                                    describe(node)));
        if (m_path.size() >= static_cast<std::size_t>(m_tree.limits().depth))
            throw Fault(fmt::format("nodes are nested more than {} deep at {}; export the scene "
                                    "with a flatter hierarchy",
                                    m_tree.limits().depth, describe(node)));
        if (++m_visited > m_tree.limits().nodes)
            throw Fault(fmt::format("the scene has more than {} nodes through <instance_node>; "
                                    "export a part of it",
                                    m_tree.limits().nodes));
        m_path.push_back(node);
        const glm::dmat4 toWorld = above * transformOf(node);
        for (const xml_node& child : node.children()) {
            const std::string_view name = child.name();
            if (name == "instance_geometry") {
                const xml_node geometry =
                    m_tree.resolve(child.attribute("url").value(), {"geometry"}, child);
                addGeometry(child, geometry, false, toWorld);
            } else if (name == "instance_controller") {
                addGeometry(child, controlledGeometry(child), true, toWorld);
            } else if (name == "instance_node") {
                const xml_node target =
                    m_tree.resolve(child.attribute("url").value(), {"node"}, child);
                m_hops.push_back(child);
                visit(target, toWorld);
                m_hops.pop_back();
            } else if (name == "node") {
                visit(child, toWorld);
            }
        }
        m_path.pop_back();
    }

    // Through skins of morphs of skins, to what they deform.
    [[nodiscard]] xml_node controlledGeometry(xml_node instance) const {
        xml_node from = instance;
        xml_node target =
            m_tree.resolve(instance.attribute("url").value(), {"controller"}, instance);
        for (int steps = 0; std::string_view(target.name()) == "controller"; ++steps) {
            if (steps > 16)
                throw Fault(fmt::format("{} deforms itself through other controllers; remove one "
                                        "of these references",
                                        describe(target)));
            from = target.child("skin") ? target.child("skin") : target.child("morph");
            if (!from)
                throw Fault(fmt::format("{} has neither <skin> nor <morph>; export the scene again",
                                        describe(target)));
            target =
                m_tree.resolve(from.attribute("source").value(), {"geometry", "controller"}, from);
        }
        return target;
    }

    void addGeometry(xml_node element, xml_node geometry, bool controlled,
                     const glm::dmat4& toWorld) {
        const xml_node mesh = geometry.child("mesh");
        if (!mesh) {
            notice(geometry, "no mesh (a spline or solid)");
            return;
        }
        int number = 0;
        for (const xml_node& primitive : mesh.children()) {
            if (isLine(primitive)) {
                notice(geometry, "lines");
                ++number;
            }
            if (!isPrimitive(primitive))
                continue;
            if (m_contents.instances.size() >= m_tree.limits().elements)
                throw Fault(fmt::format("the scene shows more than {} pieces of geometry; export a "
                                        "part of it",
                                        m_tree.limits().elements));
            ColladaInstance instance;
            instance.path = pathName();
            instance.nodeId = m_path.back().attribute("id").value();
            instance.geometryId = geometry.attribute("id").value();
            instance.geometryName = geometry.attribute("name").value();
            instance.primitive = number++;
            instance.material = material(element, primitive.attribute("material").value());
            instance.controlled = controlled;
            instance.toWorld = toWorld;
            m_contents.instances.push_back(std::move(instance));
            m_contents.places.push_back({element, geometry, primitive, m_hops});
        }
    }

    [[nodiscard]] std::string pathName() const {
        std::string result;
        for (const xml_node& node : m_path)
            result += (result.empty() ? "" : "/") + nodeName(node);
        return result;
    }

    int material(xml_node element, const std::string& symbol) {
        const xml_node bound = boundMaterial(element, symbol);
        if (!bound)
            return -1;
        const std::string target = bound.attribute("target").value();
        const auto [entry, isNew] =
            m_materials.try_emplace(target, static_cast<int>(m_contents.materials.size()));
        if (isNew)
            m_contents.materials.push_back(
                readMaterial(m_tree, m_tree.resolve(target, {"material"}, bound)));
        return entry->second;
    }

    void notice(xml_node geometry, const char* what) {
        const std::string text =
            fmt::format("{} has {}, which light is not computed for.", describe(geometry), what);
        if (m_noticed.insert(text).second)
            m_contents.notices.push_back(text);
    }

    const Tree& m_tree;
    SceneContents m_contents;
    std::vector<xml_node> m_path; // from a node of the scene to the one that is visited
    std::vector<xml_node> m_hops;
    std::size_t m_visited = 0;
    std::map<std::string, int> m_materials; // by what refers to them
    std::set<std::string> m_noticed;
};

} // namespace

bool isPrimitive(xml_node element) {
    const std::string_view name = element.name();
    return name == "triangles" || name == "polylist" || name == "polygons" || name == "trifans" ||
           name == "tristrips";
}

bool isLine(xml_node element) {
    const std::string_view name = element.name();
    return name == "lines" || name == "linestrips";
}

std::vector<xml_node> visualScenes(const Tree& tree) {
    std::vector<xml_node> scenes;
    for (const xml_node& library : tree.root().children("library_visual_scenes"))
        for (const xml_node& scene : library.children("visual_scene"))
            scenes.push_back(scene);
    if (scenes.empty())
        throw Fault("it has no <visual_scene>; export it with a scene");
    return scenes;
}

std::size_t namedScene(const Tree& tree, const std::vector<xml_node>& scenes) {
    const xml_node instance = tree.root().child("scene").child("instance_visual_scene");
    if (!instance)
        return 0;
    const xml_node named =
        tree.resolve(instance.attribute("url").value(), {"visual_scene"}, instance);
    return static_cast<std::size_t>(std::ranges::find(scenes, named) - scenes.begin());
}

SceneContents readScene(const Tree& tree, xml_node visualScene) {
    return SceneWalk(tree).walk(visualScene);
}

} // namespace patina::collada
