#include "core/codec/model/GltfExtensions.h"

#include "core/codec/Codec.h"
#include "core/material/Material.h"
#include "core/material/MaterialInputs.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>

namespace patina::codec {

namespace {

using nlohmann::json;
using namespace std::string_view_literals;

constexpr std::string_view kUnlit = "KHR_materials_unlit";
constexpr std::string_view kMaterialPrefix = "KHR_materials_";

constexpr std::array kRead{"EXT_mesh_gpu_instancing"sv, "EXT_meshopt_compression"sv,
                           "EXT_texture_webp"sv,        "KHR_draco_mesh_compression"sv,
                           "KHR_lights_punctual"sv,     "KHR_mesh_quantization"sv,
                           "KHR_texture_transform"sv};
constexpr std::array kReadOfMaterials{"KHR_materials_emissive_strength"sv, "KHR_materials_ior"sv,
                                      "KHR_materials_volume"sv,
                                      "KHR_materials_pbrSpecularGlossiness"sv};

// Nothing is missed without them: notes about the file, and what belongs to animation, which is
// told by itself. Textures in formats that are not read are named where nothing stands in for them.
// The environment is no part of a model: the scene it comes into has its own.
constexpr std::array kHarmless{
    "EXT_lights_image_based"sv, "EXT_texture_avif"sv, "KHR_animation_pointer"sv,
    "KHR_texture_basisu"sv,     "KHR_xmp"sv,          "KHR_xmp_json_ld"sv,
    "MSFT_texture_dds"sv};

template <class Names>
bool contains(const Names& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

bool isReadOfMaterials(std::string_view name) {
    return contains(kReadOfMaterials, name) ||
           std::any_of(kMaterialInputs.begin(), kMaterialInputs.end(),
                       [&](const MaterialInputInfo& info) { return info.gltf.object == name; });
}

// "a", "b", "c" and 4 others
std::string listed(const std::vector<std::string>& names) {
    constexpr std::size_t kMostNames = 3;
    std::string text;
    for (std::size_t i = 0; i < std::min(names.size(), kMostNames); ++i)
        text += fmt::format("{}\"{}\"", i == 0 ? "" : ", ", names[i]);
    return names.size() <= kMostNames
               ? text
               : text + fmt::format(" and {} others", names.size() - kMostNames);
}

} // namespace

bool isReadGltfExtension(std::string_view name) {
    return contains(kRead, name) || isReadOfMaterials(name);
}

bool isHarmlessGltfExtension(std::string_view name) {
    return contains(kHarmless, name);
}

void checkRequiredExtensions(const json& root) {
    for (const json& required : root.value("extensionsRequired", json::array())) {
        const auto name = required.get<std::string>();
        // Without those of materials there is something to see, at least.
        if (!name.starts_with(kMaterialPrefix) && !contains(kRead, name))
            throw Refusal(fmt::format("the file needs the glTF extension {}, which is not "
                                      "supported; export it without",
                                      name));
    }
}

std::vector<std::string> unusedExtensions(const json& root) {
    std::map<std::string, std::vector<std::string>> ofMaterials; // names of materials
    const json materials = root.value("materials", json::array());
    for (std::size_t i = 0; i < materials.size(); ++i) {
        const json extensions = materials[i].value("extensions", json::object());
        for (const auto& [name, content] : extensions.items())
            // Those of Khronos change nothing by their defaults.
            if (!isReadOfMaterials(name) &&
                (!content.empty() || name == kUnlit || !name.starts_with(kMaterialPrefix)))
                ofMaterials[name].push_back(
                    materials[i].value("name", fmt::format("material {}", i + 1)));
    }
    std::vector<std::string> sentences;
    for (const auto& [name, users] : ofMaterials)
        sentences.push_back(
            fmt::format("The glTF extension {} is not supported: {} shown {}.", name,
                        users.size() == 1 ? fmt::format("material {} is", listed(users))
                                          : fmt::format("materials {} are", listed(users)),
                        name == kUnlit ? "shaded" : "without it"));

    std::set<std::string> others;
    for (const json& used : root.value("extensionsUsed", json::array()))
        if (const auto name = used.get<std::string>();
            !ofMaterials.contains(name) && !contains(kRead, name) && !isReadOfMaterials(name) &&
            !contains(kHarmless, name) &&
            (!name.starts_with(kMaterialPrefix) || name == "KHR_materials_variants"))
            others.insert(name);
    std::string list;
    for (const std::string& name : others)
        list += (list.empty() ? "" : ", ") + name;
    if (!list.empty())
        sentences.push_back(fmt::format("Of this file's glTF extensions these are not supported "
                                        "and were left out: {}.",
                                        list));
    return sentences;
}

} // namespace patina::codec
