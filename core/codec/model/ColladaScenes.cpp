#include "core/codec/model/ColladaScenes.h"

#include "core/codec/Codec.h"
#include "core/codec/model/ColladaArrays.h"
#include "core/codec/model/ColladaNodes.h"
#include "core/mesh/VisualScenes.h"

#include <algorithm>
#include <pugixml.hpp>
#include <sstream>
#include <string_view>

namespace patina::codec {
namespace {

constexpr const char* kChosenId = "patina-chosen-scene"; // in the copy alone

std::string asUtf8(const pugi::xml_document& document) {
    std::ostringstream text;
    document.save(text, "", pugi::format_raw | pugi::format_no_declaration, pugi::encoding_utf8);
    return std::move(text).str();
}

std::string_view idOf(const char* url) {
    const std::string_view text(url);
    return text.starts_with('#') ? text.substr(1) : text;
}

} // namespace

ColladaScenes colladaScenes(std::span<const std::byte> file, const std::string& wanted) {
    ColladaScenes result;
    pugi::xml_document document;
    // Without the declaration, which names the file's encoding: a copy has its own.
    const pugi::xml_parse_result parsed =
        document.load_buffer(file.data(), file.size(),
                             (pugi::parse_full & ~pugi::parse_declaration) | pugi::parse_ws_pcdata);
    if (!parsed)
        return result; // Assimp says what is wrong
    checkColladaArrays(document);
    if (parsed.encoding != pugi::encoding_utf8)
        result.text = asUtf8(document);
    const pugi::xml_node root = document.child("COLLADA");
    std::vector<pugi::xml_node> nodes;
    std::vector<VisualScene> scenes;
    for (const pugi::xml_node& library : root.children("library_visual_scenes"))
        for (const pugi::xml_node& scene : library.children("visual_scene")) {
            nodes.push_back(scene);
            scenes.push_back({scene.attribute("id").value(), scene.attribute("name").value()});
        }
    std::vector<std::string> titles = visualSceneTitles(scenes);
    if (!wanted.empty()) {
        const auto found = visualScene(scenes, wanted);
        if (!found)
            throw Refusal::usage(scenes.empty() ? "it has no visual scenes"
                                                : noSuchVisualScene(titles, wanted));
        result.taken = *found;
    }
    if (scenes.size() < 2) {
        for (const pugi::xml_node& only : nodes)
            checkColladaNodes(document, only);
        return result;
    }
    result.titles = std::move(titles);

    pugi::xml_node shown = root.child("scene");
    pugi::xml_node instance = shown.child("instance_visual_scene");
    const std::string_view named = idOf(instance.attribute("url").value());
    const auto byFile = std::ranges::find(scenes, named, &VisualScene::id);
    const bool isNamed = !named.empty() && byFile != scenes.end();
    if (wanted.empty() && isNamed) {
        result.taken = static_cast<std::size_t>(byFile - scenes.begin());
        checkColladaNodes(document, nodes[result.taken]);
        return result;
    }
    if (wanted.empty() && instance)
        return {{}, 0, result.text}; // it names one that is not there: Assimp refuses it
    checkColladaNodes(document, nodes[result.taken]);
    if (!shown)
        shown = document.child("COLLADA").append_child("scene");
    if (!instance)
        instance = shown.append_child("instance_visual_scene");
    const auto set = [](pugi::xml_node node, const char* name, const char* value) {
        pugi::xml_attribute attribute = node.attribute(name);
        (attribute ? attribute : node.append_attribute(name)).set_value(value);
    };
    set(nodes[result.taken], "id", kChosenId);
    set(instance, "url", (std::string("#") + kChosenId).c_str());
    result.text = asUtf8(document);
    return result;
}

} // namespace patina::codec
