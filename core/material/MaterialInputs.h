// THE table of material inputs: everything of a material that a map can vary, described once. It
// drives uniforms, textures and variants of the surface shader (render/shader/GeneratedShaders.h),
// the rows of the parameter table, reading and writing glTF, `patina info`, the explanation of a
// pixel, and which map a picture is. CONTRIBUTING.md says how to add one.
#pragma once

#include "core/material/Material.h"
#include "core/material/MaterialInput.h"
#include "core/math/Shading.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace patina {

// How the material's value and the texel of the map become what shading reads.
enum class InputRole {
    Color,    // colour × texel; of the map all colours count, or one channel for all of them
    Number,   // number × one channel of the map, within 0…1: a member of shading::SurfaceInputs
    Normal,   // tangent-space normals, tilted by the number
    Occlusion // one channel: how open the surface is; the number says how much that counts
};

// Where an input stands in a glTF material.
struct GltfPlace {
    // "pbrMetallicRoughness", an extension "KHR_…"; empty: the material itself
    std::string_view object = {};
    std::string_view texture = {}; // "metallicRoughnessTexture"
    char channel = 0;              // of the texture: 'r', 'g', 'b', 'a'; 0: its colours
    std::string_view factor = {};  // "metallicFactor"; empty: a colour's
    std::string_view scale = {};   // the number is a member of the texture's reference: "strength"
    float absent = 1.0f;           // the factor or scale of a file that does not state it
};
inline constexpr std::string_view kGltfPbr = "pbrMetallicRoughness";

// What the parameter table says of the value and of its map.
struct InputParameters {
    // "material.metallic.map"; the value's id is the part before ".map"
    std::string_view map = {};
    std::string_view alias = {}, mapAlias = {}; // other accepted spellings, or empty
    std::string_view label = {}, mapLabel = {};
    std::string_view group = {};
    std::string_view help = {}, mapHelp = {};
    float softMin = 0.0f, softMax = 1.0f, hardMin = 0.0f, hardMax = 1.0f; // no unit: factors

    [[nodiscard]] constexpr std::string_view value() const { return map.substr(0, map.size() - 4); }
};

struct MaterialInputInfo {
    MaterialInput input = MaterialInput::BaseColor;
    InputRole role = InputRole::Color;
    // "perceptualRoughness": in `patina info`; in shaders u_…Map, u_…Texture, HAS_…_MAP.
    std::string_view id = {};
    MapSlot Material::*map = nullptr;
    glm::vec3 Material::*color = nullptr;           // Color
    float Material::*number = nullptr;              // the other roles
    float shading::SurfaceInputs::*shown = nullptr; // Number: what shading reads
    // Few materials have it: shaders of those whose number is 0 hold the constant 0.
    bool rare = false;
    ColorEncoding encoding = ColorEncoding::Data; // how integer files are read
    MapChannel channel = MapChannel::R;           // of the map, when nothing else is said
    std::string_view view = {};                   // id of the view of the product (Views.h)
    GltfPlace gltf = {};
    // Words in the names of files that say which map it is, apart by blanks; weak ones are words
    // for the stuff itself, too, and count where no other word does.
    std::string_view fileWords = {}, weakFileWords = {};
    InputParameters parameters = {};
};

// clang-format off
inline constexpr std::array<MaterialInputInfo, kMaterialInputCount> kMaterialInputs{{
    {.input = MaterialInput::BaseColor, .role = InputRole::Color, .id = "baseColor",
     .map = &Material::baseColorMap, .color = &Material::baseColor,
     .encoding = ColorEncoding::Srgb, .channel = MapChannel::Rgb, .view = "baseColor",
     .gltf = {.object = kGltfPbr, .texture = "baseColorTexture"},
     .fileWords = "basecolor basecolour albedo diffuse diff color colour col",
     .parameters = {.map = "material.baseColor.map", .label = "Base colour", .mapLabel = "Base colour map", .group = "Surface",
                    .help = "Colour of a non-metal's body, or of a metal's reflection.",
                    .mapHelp = "Image that multiplies the base colour; its alpha multiplies the opacity."}},
    {.input = MaterialInput::Metallic, .role = InputRole::Number, .id = "metallic",
     .map = &Material::metallicMap, .number = &Material::metallic, .shown = &shading::SurfaceInputs::metallic,
     .view = "metallic",
     .gltf = {.object = kGltfPbr, .texture = "metallicRoughnessTexture", .channel = 'b', .factor = "metallicFactor"},
     .fileWords = "metallic metalness", .weakFileWords = "metal",
     .parameters = {.map = "material.metallic.map", .label = "Metallic", .mapLabel = "Metallic map", .group = "Surface",
                    .help = "0 for everything that is not metal, 1 for bare metal; values between belong to mixed pixels such as rust or dust.",
                    .mapHelp = "Image that multiplies the metallic value."}},
    {.input = MaterialInput::PerceptualRoughness, .role = InputRole::Number, .id = "perceptualRoughness",
     .map = &Material::perceptualRoughnessMap, .number = &Material::perceptualRoughness,
     .shown = &shading::SurfaceInputs::perceptualRoughness, .view = "perceptualRoughness",
     .gltf = {.object = kGltfPbr, .texture = "metallicRoughnessTexture", .channel = 'g', .factor = "roughnessFactor"},
     .fileWords = "roughness", .weakFileWords = "rough",
     .parameters = {.map = "material.perceptualRoughness.map", .alias = "material.roughness", .mapAlias = "material.roughness.map",
                    .label = "Roughness", .mapLabel = "Roughness map", .group = "Surface",
                    .help = "How blurred reflections are: 0 is a mirror, 1 is chalk; the shading uses its square.",
                    .mapHelp = "Image that multiplies the roughness."}},
    {.input = MaterialInput::Normal, .role = InputRole::Normal, .id = "normal",
     .map = &Material::normalMap, .number = &Material::normalStrength,
     .channel = MapChannel::Rgb, .view = "normalMap",
     .gltf = {.texture = "normalTexture", .scale = "scale"},
     .fileWords = "normal normals normalgl normaldx nrm nor",
     .parameters = {.map = "material.normalStrength.map", .mapAlias = "material.normal.map",
                    .label = "Normal strength", .mapLabel = "Normal map", .group = "Normal & occlusion",
                    .help = "How strongly the normal map tilts the surface; negative values turn bumps into dents.",
                    .mapHelp = "Tangent-space normal map that adds fine relief.",
                    .softMax = 2.0f, .hardMin = -10.0f, .hardMax = 10.0f}},
    {.input = MaterialInput::Occlusion, .role = InputRole::Occlusion, .id = "occlusion",
     .map = &Material::occlusionMap, .number = &Material::occlusionStrength, .view = "ao",
     .gltf = {.texture = "occlusionTexture", .channel = 'r', .scale = "strength"},
     .fileWords = "occlusion ambientocclusion ao",
     .parameters = {.map = "material.occlusionStrength.map", .mapAlias = "material.occlusion.map",
                    .label = "Occlusion strength", .mapLabel = "Occlusion map", .group = "Normal & occlusion",
                    .help = "How much the occlusion map darkens the light that arrives from the environment.",
                    .mapHelp = "Image of how open each point is to the environment: white is open, black is hidden."}},
    {.input = MaterialInput::Emissive, .role = InputRole::Color, .id = "emissive",
     .map = &Material::emissiveMap, .color = &Material::emissive,
     .encoding = ColorEncoding::Srgb, .channel = MapChannel::Rgb, .view = "emissive",
     .gltf = {.texture = "emissiveTexture"},
     .fileWords = "emissive emission", .weakFileWords = "glow",
     .parameters = {.map = "material.emissive.map", .label = "Emission colour", .mapLabel = "Emission map", .group = "Emission",
                    .help = "Colour of the light that the surface gives off by itself; black gives none.",
                    .mapHelp = "Image that multiplies the emission colour."}},
    {.input = MaterialInput::Transmission, .role = InputRole::Number, .id = "transmission",
     .map = &Material::transmissionMap, .number = &Material::transmission,
     .shown = &shading::SurfaceInputs::transmission, .rare = true, .view = "transmission",
     .gltf = {.object = "KHR_materials_transmission", .texture = "transmissionTexture", .channel = 'r',
              .factor = "transmissionFactor", .absent = 0.0f},
     .fileWords = "transmission transmissive", .weakFileWords = "glass",
     .parameters = {.map = "material.transmission.map", .label = "Transmission", .mapLabel = "Transmission map", .group = "Transmission",
                    .help = "Share of the light entering a non-metal that goes through it, as through glass, instead of into its body; the raster view shows only the environment through it, path tracing all.",
                    .mapHelp = "Image that multiplies the transmission (red channel in glTF)."}},
}};
// clang-format on

[[nodiscard]] constexpr const MaterialInputInfo& inputInfo(MaterialInput input) {
    return kMaterialInputs[static_cast<std::size_t>(input)];
}

// Whether shading reads one channel of the map.
[[nodiscard]] constexpr bool readsOneChannel(const MaterialInputInfo& info) {
    return info.role == InputRole::Number || info.role == InputRole::Occlusion;
}

namespace detail {

constexpr bool isExtension(std::string_view object) {
    return object.starts_with("KHR_") || object.starts_with("EXT_");
}

constexpr bool isWhole(const MaterialInputInfo& info, std::size_t place) {
    const bool number = info.role == InputRole::Number;
    return static_cast<std::size_t>(info.input) == place && !info.id.empty() &&
           info.map != nullptr && (info.color != nullptr) == (info.role == InputRole::Color) &&
           (info.number != nullptr) != (info.color != nullptr) &&
           (info.shown != nullptr) == number && number != info.gltf.factor.empty() &&
           (!number || info.gltf.object == kGltfPbr || isExtension(info.gltf.object)) &&
           readsOneChannel(info) == (info.gltf.channel != 0) && !info.gltf.texture.empty() &&
           !info.fileWords.empty() && info.parameters.map.ends_with(".map") &&
           !info.parameters.label.empty() && !info.parameters.mapLabel.empty() &&
           !info.parameters.group.empty() && !info.parameters.help.empty() &&
           !info.parameters.mapHelp.empty();
}

constexpr bool areWhole() {
    for (std::size_t i = 0; i < kMaterialInputCount; ++i)
        if (!isWhole(kMaterialInputs[i], i))
            return false;
    return true;
}
static_assert(areWhole(), "a whole row for every enumerator, in its order");

// Beside the numbers of the table shading reads the base colour, the diffuse roughness and the
// refractive index.
constexpr std::size_t kNumberCount = static_cast<std::size_t>(
    std::count_if(kMaterialInputs.begin(), kMaterialInputs.end(),
                  [](const MaterialInputInfo& info) { return info.role == InputRole::Number; }));
static_assert(sizeof(shading::SurfaceInputs) ==
                  sizeof(glm::vec3) + (kNumberCount + 2) * sizeof(float),
              "a row for every number of SurfaceInputs");

} // namespace detail

// All maps of a material, in the order of the table.
template <class MaterialType, class Visit>
void forEachMap(MaterialType& material, Visit visit) {
    for (const MaterialInputInfo& info : kMaterialInputs)
        visit(material.*info.map);
}

} // namespace patina
