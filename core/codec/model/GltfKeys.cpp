#include "core/codec/model/GltfKeys.h"

#include "core/base/Limits.h"
#include "core/codec/Codec.h"
#include "core/codec/model/GltfExtensions.h"
#include "core/codec/model/GltfMaterials.h"
#include "core/material/Material.h"
#include "core/material/MaterialInputs.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace patina::codec {

namespace {

using nlohmann::json;

constexpr const char* kLights = "extensions.KHR_lights_punctual.lights";
constexpr const char* kCopies = "EXT_mesh_gpu_instancing";
constexpr std::size_t kIsRoot = ~std::size_t{0};
constexpr std::size_t kMostRows = 100'000;

struct Verdict {
    KeyUse use = KeyUse::LeftOut;
    std::string why;
    std::string refers; // array of root whose elements the value names by number; empty: none
};

Verdict used(std::string refers = {}) {
    return {KeyUse::Used, {}, std::move(refers)};
}
Verdict kept() {
    return {KeyUse::Kept, {}, {}};
}
Verdict leftOut(std::string why) {
    return {KeyUse::LeftOut, std::move(why), {}};
}

// --- Keys that mean the same wherever they stand -------------------------------------------------

using Rules = std::unordered_map<std::string, Verdict>;

void addTexture(Rules& rules, const std::string& key) {
    rules[key] = used();
    rules[key + ".index"] = used("textures");
    rules[key + ".texCoord"] = used();
    for (const char* member : {"offset", "rotation", "scale", "texCoord"})
        rules[key + ".extensions.KHR_texture_transform." + member] = used();
}

Rules materialRules() {
    Rules rules;
    const std::string material = "materials[].";
    for (const char* key :
         {"pbrMetallicRoughness", "pbrMetallicRoughness.baseColorFactor", "emissiveFactor",
          "alphaMode", "doubleSided", "extensions.KHR_materials_emissive_strength.emissiveStrength",
          "extensions.KHR_materials_ior.ior", "extensions.KHR_materials_volume.attenuationColor",
          "extensions.KHR_materials_volume.attenuationDistance",
          "extensions.KHR_materials_volume.thicknessFactor"})
        rules[material + key] = used();
    rules[material + "name"] = kept();
    rules[material + "extensions.KHR_materials_volume.thicknessTexture"] =
        leftOut("paths find how far light goes through a volume");
    for (const MaterialInputInfo& info : kMaterialInputs) {
        const GltfPlace& place = info.gltf;
        const std::string object = place.object.empty() ? material
                                   : place.object == kGltfPbr
                                       ? material + std::string(kGltfPbr) + "."
                                       : material + "extensions." + std::string(place.object) + ".";
        const std::string texture = object + std::string(place.texture);
        addTexture(rules, texture);
        if (!place.factor.empty())
            rules[object + std::string(place.factor)] = used();
        if (!place.scale.empty())
            rules[texture + "." + std::string(place.scale)] = used();
    }
    const std::string glossiness = material + "extensions.KHR_materials_pbrSpecularGlossiness.";
    for (const char* key : {"diffuseFactor", "specularFactor", "glossinessFactor"})
        rules[glossiness + key] = used();
    for (const char* key : {"diffuseTexture", "specularGlossinessTexture"})
        addTexture(rules, glossiness + key);
    return rules;
}

Rules allRules() {
    Rules rules = materialRules();
    const auto add = [&](const std::string& in, std::initializer_list<const char*> keys,
                         const Verdict& verdict) {
        for (const char* key : keys)
            rules[in + key] = verdict;
    };
    add("asset.", {"version"}, used());
    add("asset.", {"copyright", "generator", "minVersion"},
        leftOut("notes about the file do not come into the scene"));
    add("", {"asset", "scene", "extensionsUsed", "extensionsRequired"}, used());

    add("scenes[].", {"nodes"}, used("nodes"));
    add("scenes[].", {"name"}, leftOut("a scene is named by its file"));
    add("nodes[].", {"children"}, used("nodes"));
    add("nodes[].", {"mesh"}, used("meshes"));
    add("nodes[].", {"skin"}, used("skins"));
    add("nodes[].", {"camera"}, used("cameras"));
    add("nodes[].", {"matrix", "translation", "rotation", "scale", "weights"}, used());
    add("nodes[].extensions.KHR_lights_punctual.", {"light"}, used(kLights));
    add("nodes[].extensions.EXT_mesh_gpu_instancing.", {"attributes"}, used());
    add("nodes[].extensions.EXT_mesh_gpu_instancing.attributes.",
        {"TRANSLATION", "ROTATION", "SCALE"}, used("accessors"));

    add("meshes[].", {"primitives", "weights"}, used());
    add("meshes[].", {"name"}, kept());
    add("meshes[].primitives[].", {"attributes", "mode", "targets"}, used());
    add("meshes[].primitives[].", {"indices"}, used("accessors"));
    add("meshes[].primitives[].", {"material"}, used("materials"));
    add("meshes[].primitives[].targets[].", {"POSITION", "NORMAL", "TANGENT"}, used("accessors"));
    add("meshes[].primitives[].extensions.KHR_draco_mesh_compression.", {"bufferView"},
        used("bufferViews"));
    add("meshes[].primitives[].extensions.KHR_draco_mesh_compression.", {"attributes"}, used());

    add("skins[].", {"joints"}, used("nodes"));
    add("skins[].", {"inverseBindMatrices"}, used("accessors"));
    add("skins[].", {"skeleton"}, leftOut("joints stand where their nodes do"));

    add("cameras[].", {"type", "perspective", "perspective.yfov"}, used());
    add("cameras[].perspective.", {"aspectRatio"}, leftOut("pictures have their own proportions"));
    add("cameras[].perspective.", {"znear", "zfar"}, leftOut("they follow from the scene"));
    add(std::string(kLights) + "[].",
        {"type", "color", "intensity", "range", "spot", "spot.innerConeAngle",
         "spot.outerConeAngle"},
        used());
    add(std::string(kLights) + "[].", {"name"}, kept());

    add("textures[].", {"source"}, used("images"));
    add("textures[].extensions.EXT_texture_webp.", {"source"}, used("images"));
    add("textures[].", {"sampler"}, leftOut("all textures repeat, and are filtered smoothly"));
    add("images[].", {"uri"}, used());
    add("images[].", {"bufferView"}, used("bufferViews"));
    add("images[].", {"mimeType"}, leftOut("what a picture is follows from its bytes"));

    add("accessors[].",
        {"byteOffset", "componentType", "count", "type", "normalized", "sparse", "sparse.count",
         "sparse.indices", "sparse.indices.byteOffset", "sparse.indices.componentType",
         "sparse.values", "sparse.values.byteOffset"},
        used());
    add("accessors[].", {"bufferView", "sparse.indices.bufferView", "sparse.values.bufferView"},
        used("bufferViews"));
    add("accessors[].", {"min", "max"}, leftOut("they follow from the numbers"));
    for (const std::string place :
         {"bufferViews[].", "bufferViews[].extensions.EXT_meshopt_compression."}) {
        add(place, {"buffer"}, used("buffers"));
        add(place, {"byteOffset", "byteLength", "byteStride"}, used());
    }
    add("bufferViews[].extensions.EXT_meshopt_compression.", {"count", "mode", "filter"}, used());
    add("bufferViews[].", {"target"}, leftOut("what bytes are for follows from who uses them"));
    add("buffers[].", {"uri"}, used());
    add("buffers[].", {"byteLength"}, leftOut("buffers are as long as their bytes"));
    return rules;
}

// --- The list ------------------------------------------------------------------------------------

class KeyList {
  public:
    explicit KeyList(const json& root)
        : m_root(root)
        , m_rules(allRules()) {}

    std::vector<ModelKey> list();

  private:
    // Where a walk is: an object, and its place in the array that holds it.
    struct Place {
        const json* object;
        std::size_t index;
    };

    void reach(const std::string& array, const json& numbers);
    void visitReached();
    void visitOthers(const std::string& array, const json& elements);
    KeyUse walk(const json& value, const std::string& path, std::size_t index);
    KeyUse member(const std::string& key, const json& value, const std::string& path);
    [[nodiscard]] Verdict judge(const std::string& path, const std::string& key) const;
    [[nodiscard]] Verdict judgeExtension(const std::string& path, const std::string& name) const;
    [[nodiscard]] Verdict judgeNode(const std::string& path, const std::string& key) const;
    [[nodiscard]] Verdict judgeAttribute(const std::string& name) const;
    [[nodiscard]] Verdict judgeTarget(const std::string& name) const;
    void count(const std::string& path, KeyUse use, const std::string& why);

    [[nodiscard]] const json& object(std::size_t up = 0) const {
        return *m_places[m_places.size() - 1 - up].object;
    }
    [[nodiscard]] bool rule(const std::string& path) const { return m_rules.contains(path); }

    const json& m_root;
    const Rules m_rules;
    std::map<std::tuple<std::string, KeyUse, std::string>, std::size_t> m_rows;
    std::map<std::string, std::set<std::size_t>> m_reached; // elements of root's arrays
    std::vector<std::pair<std::string, std::size_t>> m_pending;
    std::vector<Place> m_places; // of the walk, from the element down
    // Of the element: why none of its keys is used, or empty.
    std::string m_why;
    std::map<std::size_t, std::set<const json*>> m_meshUsers; // nodes, by mesh
    std::set<std::size_t> m_namelessCameras;                  // shown by a node without a name
    std::vector<std::size_t> m_parents;                       // of nodes
    std::set<std::size_t> m_vectors; // accessors that are more than indices of triangles
    std::size_t m_unlisted = 0;
};

void KeyList::count(const std::string& path, KeyUse use, const std::string& why) {
    const std::tuple row(path, use, why);
    if (m_rows.size() < kMostRows || m_rows.contains(row))
        ++m_rows[row];
    else
        ++m_unlisted;
}

// Elements that a key names.
void KeyList::reach(const std::string& array, const json& numbers) {
    if (numbers.is_array()) {
        for (const json& number : numbers)
            reach(array, number);
        return;
    }
    if (!numbers.is_number_unsigned())
        return;
    const auto index = numbers.get<std::size_t>();
    if (m_reached[array].insert(index).second)
        m_pending.emplace_back(array, index);
}

const json& arrayOf(const json& root, const std::string& path) {
    static const json kNone = json::array();
    const json* at = &root;
    for (std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + 1) {
        end = path.find('.', begin);
        const std::string key = path.substr(begin, end - begin);
        if (!at->is_object() || !at->contains(key))
            return kNone;
        at = &at->at(key);
    }
    return at->is_array() ? *at : kNone;
}

void KeyList::visitReached() {
    while (!m_pending.empty()) {
        const auto [array, index] = m_pending.back();
        m_pending.pop_back();
        const json& all = arrayOf(m_root, array);
        if (index >= all.size())
            continue; // the reader refuses the file
        walk(all[index], array + "[]", index);
        // Joints may lie outside of the scene, as far up as they move with something.
        if (array == "nodes" && m_parents[index] != kIsRoot)
            reach(array, json(m_parents[index]));
    }
}

void KeyList::visitOthers(const std::string& array, const json& elements) {
    const std::set<std::size_t>& reached = m_reached[array];
    for (std::size_t i = 0; i < elements.size(); ++i) {
        if (reached.contains(i))
            continue;
        m_why = array == "animations" ? "animation is not read"
                : array == "scenes"   ? "another scene of the file is shown"
                : array == "samplers" ? "all textures repeat, and are filtered smoothly"
                                      : "nothing that is shown uses it";
        walk(elements[i], array + "[]", i);
        m_why.clear();
    }
}

// Of the keys below a value; the best use of them.
KeyUse KeyList::walk(const json& value, const std::string& path, std::size_t index) {
    KeyUse best = KeyUse::LeftOut;
    if (static_cast<int>(m_places.size()) > limits::kMaxJsonDepth)
        throw Refusal("the file is damaged: its JSON is nested too deeply; export it again");
    m_places.push_back({&value, index});
    if (value.is_object())
        for (const auto& [key, below] : value.items())
            best = std::min(best, member(key, below, path));
    if (value.is_array()) {
        const json* const holder =
            m_places.size() > 1 ? m_places[m_places.size() - 2].object : nullptr;
        for (std::size_t i = 0; i < value.size(); ++i) {
            if (!value[i].is_structured())
                continue;
            m_places.back() = {holder, i};
            best = std::min(best, walk(value[i], path + "[]", i));
        }
    }
    m_places.pop_back();
    return best;
}

KeyUse KeyList::member(const std::string& key, const json& value, const std::string& path) {
    const std::string full = path.empty() ? key : path + "." + key;
    Verdict verdict = m_why.empty() ? judge(full, key) : leftOut(m_why);
    if (!verdict.refers.empty())
        reach(verdict.refers, value);
    if (verdict.refers == "accessors" && key != "indices" && value.is_number_unsigned())
        m_vectors.insert(value.get<std::size_t>());
    const bool isOpen = verdict.use == KeyUse::LeftOut && verdict.why.empty();
    const std::string outer = m_why;
    if (verdict.use == KeyUse::LeftOut && !isOpen)
        m_why = verdict.why;
    if (value.is_structured()) {
        const KeyUse below = walk(value, full, 0);
        if (isOpen && below != KeyUse::LeftOut)
            verdict.use = below;
    }
    m_why = outer;
    if (verdict.use == KeyUse::LeftOut && verdict.why.empty())
        verdict.why = "it holds nothing that is used";
    count(full, verdict.use, verdict.use == KeyUse::LeftOut ? verdict.why : std::string());
    return verdict.use;
}

// A reason that is empty: what is below decides.
Verdict KeyList::judge(const std::string& path, const std::string& key) const {
    if (key == "extras")
        return leftOut("data of the program that wrote the file (extras)");
    if (key == "extensions")
        return leftOut({});
    if (path.ends_with("extensions." + key))
        return judgeExtension(path, key);
    if (path.starts_with("meshes[].primitives[].attributes."))
        return judgeAttribute(key);
    if (path.starts_with("meshes[].primitives[].targets[]."))
        return judgeTarget(key);
    if (path.starts_with("meshes[].primitives[].extensions.KHR_draco_mesh_compression.attributes."))
        return judgeAttribute(key).use == KeyUse::Used ? used() : leftOut(judgeAttribute(key).why);
    if (path.starts_with("nodes[]."))
        return judgeNode(path, key);
    if (path.starts_with("meshes[].primitives[]") && key != "mode" && object().value("mode", 4) < 4)
        return leftOut("lines and points are not shown");
    if (path == "meshes[].primitives[].indices" &&
        object().value("extensions", json::object()).contains("KHR_draco_mesh_compression"))
        return leftOut("KHR_draco_mesh_compression has the triangles");
    if (path == "meshes[].weights") {
        const auto users = m_meshUsers.find(m_places.front().index);
        if (users != m_meshUsers.end() &&
            std::none_of(users->second.begin(), users->second.end(),
                         [](const json* node) { return !node->contains("weights"); }))
            return leftOut("the nodes that show the mesh have weights of their own");
    }
    if (path == "materials[].alphaCutoff")
        return object().value("alphaMode", std::string()) == "MASK" ? used() : kept();
    if (path.starts_with("materials[].") && key == "texCoord" && m_rules.contains(path) &&
        object()
            .value("extensions", json::object())
            .value("KHR_texture_transform", json::object())
            .contains("texCoord"))
        return leftOut("KHR_texture_transform names the set of coordinates");
    if (path == "accessors[].type" && !m_vectors.contains(m_places.front().index))
        return leftOut("indices are single numbers");
    if (path.starts_with("cameras[].") && key != "type" &&
        m_places.front().object->value("type", "") == "orthographic")
        return leftOut("view cameras have a perspective");
    if (path == "cameras[].name")
        return m_namelessCameras.contains(m_places.front().index)
                   ? kept()
                   : leftOut("the node's name is shown");
    if (path == "textures[].extensions.EXT_texture_webp.source" &&
        m_places.front().object->contains("source"))
        return leftOut("the texture's other picture is used");
    if (const auto found = m_rules.find(path); found != m_rules.end())
        return found->second;
    if (key == "name")
        return leftOut("names of this kind are not shown");
    return leftOut("Patina does not know this key");
}

Verdict KeyList::judgeExtension(const std::string& path, const std::string& name) const {
    if (path.starts_with("textures[].") && name != "EXT_texture_webp" &&
        !object(1).contains("source"))
        return leftOut("pictures of this format are not supported");
    if (isHarmlessGltfExtension(name))
        return leftOut("nothing is missed without this extension");
    if (name == "KHR_materials_unlit")
        return leftOut("the extension is not supported: the material is shaded");
    if (!isReadGltfExtension(name))
        return leftOut("the extension is not supported");
    if (name == "KHR_materials_pbrSpecularGlossiness" && path.starts_with("materials[].") &&
        !object(1).value("pbrMetallicRoughness", json::object()).empty())
        return leftOut("pbrMetallicRoughness says the same");
    return leftOut({});
}

Verdict KeyList::judgeNode(const std::string& path, const std::string& key) const {
    const json& node = *m_places.front().object;
    const bool hasLight = node.value("extensions", json::object()).contains("KHR_lights_punctual");
    const json& cameras = arrayOf(m_root, "cameras");
    const auto camera = node.value("camera", cameras.size());
    const bool isFlat =
        camera < cameras.size() && cameras[camera].value("type", "") == "orthographic";
    if (path == "nodes[].camera" && isFlat)
        return {KeyUse::LeftOut, "view cameras have a perspective", "cameras"};
    if (path == "nodes[].name") {
        if (node.contains("mesh") || (node.contains("camera") && !isFlat))
            return kept();
        if (!hasLight)
            return leftOut("only nodes that show something become objects");
        const json& lights = arrayOf(m_root, kLights);
        const auto light = node["extensions"]["KHR_lights_punctual"].value("light", std::size_t{0});
        return light < lights.size() && lights[light].contains("name")
                   ? leftOut("the light's name is shown")
                   : kept();
    }
    if (node.contains("matrix") && (key == "translation" || key == "rotation" || key == "scale"))
        return leftOut("the node has a matrix");
    if (!node.contains("mesh") && (key == "skin" || key == "weights"))
        return leftOut("the node has no mesh");
    if (path.starts_with(fmt::format("nodes[].extensions.{}.attributes.", kCopies)) && !rule(path))
        return leftOut("it is for applications");
    const auto found = m_rules.find(path);
    return found == m_rules.end() ? leftOut("Patina does not know this key") : found->second;
}

// Of a primitive, object(1).
Verdict KeyList::judgeAttribute(const std::string& name) const {
    const bool isDraco = object(1).contains("bufferView"); // the attributes of the compression
    const json& primitive = isDraco ? object(3) : object(1);
    const json& attributes = primitive.at("attributes");
    if (primitive.value("mode", 4) < 4)
        return leftOut("lines and points are not shown");
    const json draco = primitive.value("extensions", json::object())
                           .value("KHR_draco_mesh_compression", json::object())
                           .value("attributes", json::object());
    // Of what is compressed, the name alone counts.
    const auto taken = [&] { return draco.contains(name) ? used() : used("accessors"); };
    if (name == "POSITION" || name == "NORMAL")
        return taken();
    if (name == "TANGENT")
        return attributes.contains("NORMAL") ? taken()
                                             : leftOut("tangents mean nothing without normals");
    if (name.starts_with("TEXCOORD_")) {
        const int material = primitive.value("material", -1);
        const json& materials = arrayOf(m_root, "materials");
        const int set = material < 0 || static_cast<std::size_t>(material) >= materials.size()
                            ? 0
                            : gltfTextureSet(materials[static_cast<std::size_t>(material)]);
        const std::string wanted = fmt::format("TEXCOORD_{}", set);
        const std::string shown = attributes.contains(wanted) ? wanted : "TEXCOORD_0";
        return name == shown ? taken()
                             : leftOut("the material's textures use another set of coordinates");
    }
    if (name.starts_with("COLOR_"))
        return leftOut("vertex colours are not shown");
    if (name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_")) {
        const auto users = m_meshUsers.find(m_places.front().index);
        const bool skinned = users != m_meshUsers.end() &&
                             std::any_of(users->second.begin(), users->second.end(),
                                         [](const json* node) { return node->contains("skin"); });
        return skinned ? taken() : leftOut("no node that shows the mesh has a skin");
    }
    return leftOut(name.starts_with("_PRT_") ? "radiance transfer is for engines"
                   : name.starts_with("_")   ? "it is for applications"
                                             : "Patina does not know this attribute");
}

// Of a morph target, whose place in its array is the number of its weight.
Verdict KeyList::judgeTarget(const std::string& name) const {
    const std::size_t target = m_places.back().index;
    const json& mesh = *m_places.front().object;
    const auto users = m_meshUsers.find(m_places.front().index);
    bool moves = false;
    if (users != m_meshUsers.end())
        for (const json* node : users->second) {
            const json& owner = node->contains("weights") ? *node : mesh;
            const json weights = owner.value("weights", json::array());
            moves = moves || (target < weights.size() && weights[target].get<float>() != 0.0f);
        }
    if (!moves)
        return leftOut("the target's weight is 0");
    const auto found = m_rules.find("meshes[].primitives[].targets[]." + name);
    return found == m_rules.end() ? leftOut("morph targets move positions, normals and tangents")
                                  : found->second;
}

std::vector<ModelKey> KeyList::list() {
    // The scene that is shown, or all nodes that have no parent.
    const json& nodes = arrayOf(m_root, "nodes");
    const json& scenes = arrayOf(m_root, "scenes");
    m_parents.assign(nodes.size(), kIsRoot);
    for (std::size_t i = 0; i < nodes.size(); ++i)
        for (const json& child : nodes[i].value("children", json::array()))
            if (const auto c = child.get<std::size_t>(); c < nodes.size())
                m_parents[c] = i;
    if (!scenes.empty())
        reach("scenes", m_root.value("scene", json(std::size_t{0})));
    for (std::size_t i = 0; scenes.empty() && i < nodes.size(); ++i)
        if (m_parents[i] == kIsRoot)
            reach("nodes", json(i));
    // Nodes first: what a mesh is taken for depends on them.
    std::vector<std::pair<std::string, std::size_t>> later;
    while (!m_pending.empty()) {
        const auto [array, index] = m_pending.back();
        m_pending.pop_back();
        const json& all = arrayOf(m_root, array);
        if (array != "scenes" && array != "nodes") {
            later.emplace_back(array, index);
            continue;
        }
        if (index >= all.size())
            continue;
        const json& node = all[index];
        if (array == "nodes" && node.contains("mesh"))
            m_meshUsers[node["mesh"].get<std::size_t>()].insert(&node);
        if (array == "nodes" && node.contains("camera") && !node.contains("name"))
            m_namelessCameras.insert(node["camera"].get<std::size_t>());
        walk(all[index], array + "[]", index);
    }
    m_pending = std::move(later);
    visitReached();

    // What is left of the root, and elements that nothing leads to.
    constexpr std::array kArrays{"accessors", "animations", "buffers",  "bufferViews", "cameras",
                                 "images",    "materials",  "meshes",   "nodes",       "samplers",
                                 "scenes",    "skins",      "textures", kLights};
    for (const char* array : kArrays)
        visitOthers(array, arrayOf(m_root, array));
    m_places.push_back({&m_root, 0});
    for (const auto& [key, value] : m_root.items()) {
        const bool isArray =
            std::find(kArrays.begin(), kArrays.end(), key) != kArrays.end() && value.is_array();
        if (isArray && !m_reached[key].empty())
            count(key, KeyUse::Used, {});
        else if (isArray)
            count(key, KeyUse::LeftOut,
                  key == std::string_view("animations") ? "animation is not read"
                                                        : "nothing that is shown uses it");
        else if (key == "extensions" && value.is_object() && !arrayOf(m_root, kLights).empty()) {
            const bool shine = !m_reached[kLights].empty();
            const KeyUse use = shine ? KeyUse::Used : KeyUse::LeftOut;
            const std::string why = shine ? "" : "nothing that is shown uses it";
            for (const char* path : {"extensions", "extensions.KHR_lights_punctual", kLights})
                count(path, use, why);
            json rest = value;
            rest["KHR_lights_punctual"].erase("lights");
            for (const auto& [name, below] : rest["KHR_lights_punctual"].items())
                member(name, below, "extensions.KHR_lights_punctual");
            rest.erase("KHR_lights_punctual");
            walk(rest, "extensions", 0);
        } else
            member(key, value, "");
    }
    m_places.pop_back();

    std::vector<ModelKey> rows;
    for (const auto& [row, times] : m_rows) {
        const auto& [key, use, why] = row;
        rows.push_back({key, use, why, times});
    }
    if (m_unlisted > 0)
        rows.push_back(
            {"…", KeyUse::LeftOut,
             fmt::format("more than {} different keys; the others are not listed", kMostRows),
             m_unlisted});
    return rows;
}

} // namespace

std::vector<ModelKey> gltfKeys(const json& root) {
    return KeyList(root).list();
}

} // namespace patina::codec
