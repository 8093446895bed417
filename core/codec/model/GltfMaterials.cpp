#include "core/codec/model/GltfMaterials.h"

#include "core/codec/Codec.h"
#include "core/codec/model/GltfExtensions.h"
#include "core/material/Material.h"
#include "core/material/MaterialInputs.h"

#include <algorithm>
#include <fmt/format.h>
#include <glm/trigonometric.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

namespace patina::codec {

namespace {

using nlohmann::json;

constexpr std::string_view kGlossiness = "KHR_materials_pbrSpecularGlossiness";

template <int N>
glm::vec<N, float> vector(const json& parent, const char* key, glm::vec<N, float> fallback) {
    const auto it = parent.find(key);
    if (it == parent.end())
        return fallback;
    for (int i = 0; i < N; ++i)
        fallback[i] = it->at(static_cast<std::size_t>(i)).template get<float>();
    return fallback;
}

const json& extension(const json& parent, std::string_view name) {
    static const json kNone = json::object();
    const auto extensions = parent.find("extensions");
    if (extensions == parent.end())
        return kNone;
    const auto it = extensions->find(std::string(name));
    return it == extensions->end() ? kNone : *it;
}

bool hasExtension(const json& parent, std::string_view name) {
    const auto extensions = parent.find("extensions");
    return extensions != parent.end() && extensions->contains(name);
}

// Of a textureInfo.
int textureSet(const json& info) {
    return extension(info, "KHR_texture_transform").value("texCoord", info.value("texCoord", 0));
}

// Whatever has an index is a texture, at any depth. Those that are not read do not count.
void collectSets(const json& value, std::set<int>& sets) {
    if (!value.is_object())
        return;
    if (value.contains("index")) {
        sets.insert(textureSet(value));
        return;
    }
    for (const auto& [key, child] : value.items())
        if (key == "extensions") {
            for (const auto& [name, content] : child.items())
                if (isReadGltfExtension(name))
                    collectSets(content, sets);
        } else if (key != "thicknessTexture" && key != "extras") {
            collectSets(child, sets);
        }
}

bool isOfPbr(const MaterialInputInfo& info) {
    return info.gltf.object == kGltfPbr;
}

bool isOfMaterial(const MaterialInputInfo& info) {
    return info.gltf.object.empty();
}

class GltfMaterialReader {
  public:
    GltfMaterialReader(const json& root, const GltfBuffers& buffers, ImportedModel& model)
        : m_root(root)
        , m_buffers(buffers)
        , m_model(model) {}

    ImportedMaterial material(const json& source, std::size_t index);

  private:
    std::optional<ImportedTexture> texture(const json& parent, const char* key,
                                           const std::string& material, char channel = 0);
    void image(std::size_t index, ImportedTexture& texture);
    void readInput(const MaterialInputInfo& info, const json& object, ImportedMaterial& material);
    void readInputs(const json& object, bool (*wanted)(const MaterialInputInfo&),
                    ImportedMaterial& material);
    void specularGlossiness(const json& source, ImportedMaterial& material);
    void warnOnce(std::string text) {
        if (std::find(m_model.warnings.begin(), m_model.warnings.end(), text) ==
            m_model.warnings.end())
            m_model.warnings.push_back(std::move(text));
    }

    const json& m_root;
    const GltfBuffers& m_buffers;
    ImportedModel& m_model;
    std::map<std::size_t, int> m_embedded; // image → index into embeddedImages
    int m_set = 0;                         // of the current material: gltfTextureSet()
};

// A file beside the model, a data URI or a buffer view.
void GltfMaterialReader::image(std::size_t index, ImportedTexture& texture) {
    const json& image = element(m_root, "images", index);
    if (const auto known = m_embedded.find(index); known != m_embedded.end()) {
        texture.embedded = known->second;
        return;
    }
    Bytes bytes;
    if (const auto uri = image.find("uri"); uri != image.end()) {
        const auto text = uri->get<std::string>();
        if (!decodeDataUri(text, bytes)) {
            texture.file = decodePercent(text);
            return;
        }
    } else {
        const auto view = m_buffers.view(image.at("bufferView").get<std::size_t>());
        bytes.assign(view.begin(), view.end());
    }
    texture.embedded = static_cast<int>(m_model.embeddedImages.size());
    m_embedded[index] = texture.embedded;
    m_model.embeddedImages.push_back(std::move(bytes));
}

std::optional<ImportedTexture> GltfMaterialReader::texture(const json& parent, const char* key,
                                                           const std::string& material,
                                                           char channel) {
    const auto info = parent.find(key);
    if (info == parent.end())
        return std::nullopt;
    ImportedTexture result;
    result.channel = channel;
    const json& source = element(m_root, "textures", info->at("index").get<std::size_t>());
    const json& webp = extension(source, "EXT_texture_webp");
    if (source.contains("source")) {
        image(source.at("source").get<std::size_t>(), result);
    } else if (webp.contains("source")) {
        image(webp.at("source").get<std::size_t>(), result);
    } else {
        warnOnce(fmt::format("Material \"{}\" has a texture in a format that is not supported "
                             "(such as KTX2); it was left out.",
                             material));
        return std::nullopt;
    }

    // KHR_texture_transform: uv' = T * R * S * uv.
    const json& transform = extension(*info, "KHR_texture_transform");
    result.uvOffset = vector<2>(transform, "offset", glm::vec2(0.0f));
    result.uvScale = vector<2>(transform, "scale", glm::vec2(1.0f));
    result.uvRotationDeg = glm::degrees(transform.value("rotation", 0.0f));
    if (textureSet(*info) != m_set)
        warnOnce(fmt::format("The textures of material \"{}\" use several sets of texture "
                             "coordinates, which is not supported; the first one is used instead.",
                             material));
    return result;
}

// The map of an input and its number from the object that holds them.
void GltfMaterialReader::readInput(const MaterialInputInfo& info, const json& object,
                                   ImportedMaterial& material) {
    const std::string key(info.gltf.texture);
    auto& map = material.maps[info.input] =
        texture(object, key.c_str(), material.name, info.gltf.channel);
    if (!info.gltf.factor.empty())
        material.numbers[info.input] =
            object.value(std::string(info.gltf.factor), info.gltf.absent);
    if (!info.gltf.scale.empty() && map)
        material.numbers[info.input] =
            object.at(key).value(std::string(info.gltf.scale), info.gltf.absent);
}

void GltfMaterialReader::readInputs(const json& object, bool (*wanted)(const MaterialInputInfo&),
                                    ImportedMaterial& material) {
    for (const MaterialInputInfo& info : kMaterialInputs)
        if (wanted(info))
            readInput(info, object, material);
}

// KHR_materials_pbrSpecularGlossiness, archived by Khronos. The client converts it.
void GltfMaterialReader::specularGlossiness(const json& source, ImportedMaterial& material) {
    material.baseColor = vector<4>(source, "diffuseFactor", glm::vec4(1.0f));
    material.maps[MaterialInput::BaseColor] = texture(source, "diffuseTexture", material.name);
    ImportedGlossiness& glossiness = material.glossiness.emplace();
    glossiness.specular = vector<3>(source, "specularFactor", glm::vec3(1.0f));
    glossiness.glossiness = source.value("glossinessFactor", 1.0f);
    glossiness.map = texture(source, "specularGlossinessTexture", material.name);
}

// KHR_materials_ior and KHR_materials_volume. An index of 0 stands for infinity there; the greatest
// that a material can have comes nearest.
void readVolume(const json& source, ImportedMaterial& material) {
    const float ior = extension(source, "KHR_materials_ior").value("ior", 1.5f);
    material.ior = ior == 0.0f ? 3.0f : ior;
    const json& volume = extension(source, "KHR_materials_volume");
    material.thinWalled = !(volume.value("thicknessFactor", 0.0f) > 0.0f);
    material.attenuationColor = vector<3>(volume, "attenuationColor", glm::vec3(1.0f));
    material.attenuationDistance = volume.value("attenuationDistance", 0.0f);
}

ImportedMaterial GltfMaterialReader::material(const json& source, std::size_t index) {
    ImportedMaterial material;
    material.name = source.value("name", fmt::format("material {}", index + 1));
    m_set = gltfTextureSet(source);
    const json& pbr =
        source.contains("pbrMetallicRoughness") ? source["pbrMetallicRoughness"] : json::object();
    material.baseColor = vector<4>(pbr, "baseColorFactor", glm::vec4(1.0f));
    readInputs(pbr, &isOfPbr, material);
    // Files with both models give metallic-roughness as they mean it.
    if (hasExtension(source, kGlossiness) && pbr.empty())
        specularGlossiness(extension(source, kGlossiness), material);

    // Extensions last: an embedded image is known to projects by its place among those that were
    // read before it.
    readInputs(source, &isOfMaterial, material);
    for (const MaterialInputInfo& info : kMaterialInputs)
        if (!isOfPbr(info) && !isOfMaterial(info))
            readInput(info, extension(source, info.gltf.object), material);
    material.emissive =
        vector<3>(source, "emissiveFactor", glm::vec3(0.0f)) *
        extension(source, "KHR_materials_emissive_strength").value("emissiveStrength", 1.0f);

    readVolume(source, material);

    material.doubleSided = source.value("doubleSided", false);
    const std::string alphaMode = source.value("alphaMode", "OPAQUE");
    material.alphaMask = alphaMode == "MASK";
    material.alphaBlend = alphaMode == "BLEND";
    material.alphaCutoff = source.value("alphaCutoff", 0.5f);
    return material;
}

} // namespace

int gltfTextureSet(const json& material) {
    std::set<int> sets;
    collectSets(material, sets);
    return sets.size() == 1 ? std::max(*sets.begin(), 0) : 0;
}

void readGltfMaterials(const json& root, const GltfBuffers& buffers, ImportedModel& model) {
    const auto materials = root.find("materials");
    if (materials == root.end())
        return;
    GltfMaterialReader reader(root, buffers, model);
    for (std::size_t i = 0; i < materials->size(); ++i)
        model.materials.push_back(reader.material((*materials)[i], i));
}

} // namespace patina::codec
