#include "core/codec/model/ColladaNodes.h"

#include "core/base/Limits.h"
#include "core/codec/Codec.h"
#include "core/codec/model/ModelLimits.h"

#include <algorithm>
#include <cstddef>
#include <fmt/format.h>
#include <iterator>
#include <pugixml.hpp>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace patina::codec {
namespace {

// Assimp calls itself for each level: a stack of 8 MiB has room for some ten thousand.
constexpr std::size_t kMostLevels = 2000;
// Where counting ends: sums of two do not overflow.
constexpr std::size_t kMany = std::size_t{1} << 40;

std::string_view idOfUrl(const pugi::xml_node& instance) {
    const std::string_view url = instance.attribute("url").value();
    return url.starts_with('#') ? url.substr(1) : std::string_view();
}

std::string_view nameOf(const pugi::xml_node& node) {
    const std::string_view id = node.attribute("id").value();
    return id.empty() ? std::string_view(node.attribute("name").value()) : id;
}

// <node> elements by the names that <instance_node> gives them, as Assimp finds them: a node of the
// library by its id, else one of the scene by name or id.
class NodeNames {
  public:
    NodeNames(const pugi::xml_node& root, const pugi::xml_node& scene) {
        for (const pugi::xml_node& library : root.children("library_nodes"))
            for (const pugi::xml_node& node : library.children("node"))
                m_library[node.attribute("id").value()] = node;
        add(scene);
        std::vector<pugi::xml_node> pending{scene};
        while (!pending.empty()) { // in the order of the file
            const pugi::xml_node node = pending.back();
            pending.pop_back();
            add(node);
            const std::size_t first = pending.size();
            for (const pugi::xml_node& child : node.children("node"))
                pending.push_back(child);
            std::reverse(pending.begin() + static_cast<std::ptrdiff_t>(first), pending.end());
        }
    }

    [[nodiscard]] pugi::xml_node find(std::string_view name) const {
        if (const auto found = m_library.find(name); found != m_library.end())
            return found->second;
        const auto found = m_scene.find(name);
        return found == m_scene.end() ? pugi::xml_node() : found->second;
    }

  private:
    void add(const pugi::xml_node& node) {
        m_scene.try_emplace(node.attribute("name").value(), node);
        m_scene.try_emplace(node.attribute("id").value(), node);
    }

    std::unordered_map<std::string_view, pugi::xml_node> m_library, m_scene;
};

// The parts that a geometry is made of become an object each.
std::unordered_map<std::string_view, std::size_t> partsOfGeometries(const pugi::xml_node& root) {
    std::unordered_map<std::string_view, std::size_t> parts;
    for (const pugi::xml_node& library : root.children("library_geometries"))
        for (const pugi::xml_node& geometry : library.children("geometry")) {
            std::size_t count = 0;
            for (const pugi::xml_node& child : geometry.child("mesh").children())
                count +=
                    child.attribute("count") && std::string_view(child.name()) != "source" ? 1 : 0;
            parts[geometry.attribute("id").value()] = count;
        }
    return parts;
}

class NodeCount {
  public:
    NodeCount(const pugi::xml_node& root, const pugi::xml_node& scene)
        : m_names(root, scene)
        , m_parts(partsOfGeometries(root)) {}

    void check(const pugi::xml_node& scene) {
        m_path.push_back({scene, childrenOf(scene)});
        m_counts[scene.hash_value()];
        while (!m_path.empty()) {
            Step& step = m_path.back();
            if (step.next < step.children.size()) {
                enter(step.children[step.next++]);
                continue;
            }
            finish();
        }
        const Count& all = m_counts[scene.hash_value()];
        // Nodes that show nothing are copied, too; those that the file writes out are its own.
        if (all.objects > limits::kMaxInstances ||
            all.nodes > limits::kMaxInstances + m_counts.size())
            throw Refusal(tooManyObjects(), fmt::format("{}{} objects in {} nodes",
                                                        all.objects >= kMany ? "at least " : "",
                                                        all.objects, all.nodes));
    }

  private:
    struct Count { // of all that a node stands for
        std::size_t nodes = 0, objects = 0, levels = 0;
        bool done = false;
    };
    struct Step {
        pugi::xml_node node;
        std::vector<pugi::xml_node> children;
        std::size_t next = 0;
    };

    [[nodiscard]] std::vector<pugi::xml_node> childrenOf(const pugi::xml_node& node) const {
        std::vector<pugi::xml_node> children;
        for (const pugi::xml_node& child : node.children("node"))
            children.push_back(child);
        for (const pugi::xml_node& instance : node.children("instance_node"))
            if (const std::string_view id = idOfUrl(instance); !id.empty())
                if (const pugi::xml_node shown = m_names.find(id))
                    children.push_back(shown);
        return children;
    }

    void enter(pugi::xml_node node) {
        const auto [known, isNew] = m_counts.try_emplace(node.hash_value());
        if (!isNew && !known->second.done)
            throw Refusal(fmt::format("the node \"{}\" contains itself; remove its "
                                      "<instance_node>, or export the file again",
                                      nameOf(node)));
        if (!isNew)
            return;
        m_path.push_back({node, childrenOf(node)});
        checkLevels(m_path.size());
    }

    static void checkLevels(std::size_t levels) {
        if (levels > kMostLevels)
            throw Refusal(fmt::format("nodes lie within each other more than the supported {} "
                                      "levels deep; export the file with a flatter hierarchy",
                                      kMostLevels));
    }

    // Sums up the node at the end of the path.
    void finish() {
        const Step& step = m_path.back();
        Count count{1, 0, 1, true};
        for (const pugi::xml_node& child : step.children) {
            const Count& part = m_counts[child.hash_value()];
            count.nodes = std::min(count.nodes + part.nodes, kMany);
            count.objects = std::min(count.objects + part.objects, kMany);
            count.levels = std::max(count.levels, part.levels + 1);
        }
        checkLevels(count.levels);
        for (const pugi::xml_node& instance : step.node.children("instance_geometry")) {
            const auto parts = m_parts.find(idOfUrl(instance));
            count.objects += parts == m_parts.end() ? 0 : parts->second;
        }
        const auto controllers = step.node.children("instance_controller");
        count.objects +=
            static_cast<std::size_t>(std::distance(controllers.begin(), controllers.end()));
        m_counts[step.node.hash_value()] = count;
        m_path.pop_back();
    }

    NodeNames m_names;
    std::unordered_map<std::string_view, std::size_t> m_parts; // of each geometry, by id
    std::unordered_map<std::size_t, Count> m_counts;           // of each <node>
    std::vector<Step> m_path;                                  // from the scene down
};

} // namespace

void checkColladaNodes(const pugi::xml_document& document, const pugi::xml_node& scene) {
    NodeCount(document.child("COLLADA"), scene).check(scene);
}

} // namespace patina::codec
