#include "core/codec/model/GltfMaterials.h"

#include "core/codec/Codec.h"

#include <algorithm>
#include <fmt/format.h>
#include <glm/trigonometric.hpp>
#include <map>
#include <nlohmann/json.hpp>

namespace patina::codec {

namespace {

using nlohmann::json;

template <int N>
glm::vec<N, float> vector(const json& parent, const char* key, glm::vec<N, float> fallback) {
    const auto it = parent.find(key);
    if (it == parent.end())
        return fallback;
    for (int i = 0; i < N; ++i)
        fallback[i] = it->at(static_cast<std::size_t>(i)).template get<float>();
    return fallback;
}

const json& extension(const json& parent, const char* name) {
    static const json kNone = json::object();
    const auto extensions = parent.find("extensions");
    if (extensions == parent.end())
        return kNone;
    const auto it = extensions->find(name);
    return it == extensions->end() ? kNone : *it;
}

class Reader {
  public:
    Reader(const json& root, const GltfBuffers& buffers, ImportedModel& model)
        : m_root(root)
        , m_buffers(buffers)
        , m_model(model) {}

    ImportedMaterial material(const json& source, std::size_t index);

  private:
    std::optional<ImportedTexture> texture(const json& parent, const char* key,
                                           const std::string& material, char channel = 0);
    void image(std::size_t index, ImportedTexture& texture);
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
};

// A file beside the model, a data URI or a buffer view.
void Reader::image(std::size_t index, ImportedTexture& texture) {
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

std::optional<ImportedTexture> Reader::texture(const json& parent, const char* key,
                                               const std::string& material, char channel) {
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
    if (transform.value("texCoord", info->value("texCoord", 0)) != 0)
        warnOnce(fmt::format("Material \"{}\" uses a second set of texture coordinates, which is "
                             "not supported; the first one is used instead.",
                             material));
    return result;
}

// KHR_materials_pbrSpecularGlossiness, archived by Khronos: taken as a dielectric.
void Reader::specularGlossiness(const json& source, ImportedMaterial& material) {
    material.baseColor = vector<4>(source, "diffuseFactor", glm::vec4(1.0f));
    material.metallic = 0.0f;
    material.perceptualRoughness = 1.0f - source.value("glossinessFactor", 1.0f);
    material.baseColorMap = texture(source, "diffuseTexture", material.name);
    warnOnce(fmt::format("Material \"{}\" uses the outdated specular-glossiness model; it is "
                         "approximated.",
                         material.name));
}

ImportedMaterial Reader::material(const json& source, std::size_t index) {
    ImportedMaterial material;
    material.name = source.value("name", fmt::format("material {}", index + 1));
    const json& pbr =
        source.contains("pbrMetallicRoughness") ? source["pbrMetallicRoughness"] : json::object();
    material.baseColor = vector<4>(pbr, "baseColorFactor", glm::vec4(1.0f));
    material.metallic = pbr.value("metallicFactor", 1.0f);
    material.perceptualRoughness = pbr.value("roughnessFactor", 1.0f);
    material.baseColorMap = texture(pbr, "baseColorTexture", material.name);
    material.metallicMap = texture(pbr, "metallicRoughnessTexture", material.name, 'b');
    material.roughnessMap = texture(pbr, "metallicRoughnessTexture", material.name, 'g');
    const json& glossiness = extension(source, "KHR_materials_pbrSpecularGlossiness");
    if (!glossiness.empty() && pbr.empty())
        specularGlossiness(glossiness, material);

    material.normalMap = texture(source, "normalTexture", material.name);
    if (material.normalMap)
        material.normalStrength = source["normalTexture"].value("scale", 1.0f);
    material.occlusionMap = texture(source, "occlusionTexture", material.name, 'r');
    if (material.occlusionMap)
        material.occlusionStrength = source["occlusionTexture"].value("strength", 1.0f);
    material.emissiveMap = texture(source, "emissiveTexture", material.name);
    material.emissive =
        vector<3>(source, "emissiveFactor", glm::vec3(0.0f)) *
        extension(source, "KHR_materials_emissive_strength").value("emissiveStrength", 1.0f);

    material.doubleSided = source.value("doubleSided", false);
    const std::string alphaMode = source.value("alphaMode", "OPAQUE");
    material.alphaMask = alphaMode == "MASK";
    material.alphaBlend = alphaMode == "BLEND";
    material.alphaCutoff = source.value("alphaCutoff", 0.5f);
    return material;
}

} // namespace

void readGltfMaterials(const json& root, const GltfBuffers& buffers, ImportedModel& model) {
    const auto materials = root.find("materials");
    if (materials == root.end())
        return;
    Reader reader(root, buffers, model);
    for (std::size_t i = 0; i < materials->size(); ++i)
        model.materials.push_back(reader.material((*materials)[i], i));
}

} // namespace patina::codec
