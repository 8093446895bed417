#include "core/codec/model/AssimpMaterials.h"

#include "core/base/LowerCase.h"
#include "core/codec/model/MtlText.h"
#include "core/material/Material.h"
#include "core/material/MaterialInputs.h"

#include <algorithm>
#include <assimp/material.h>
#include <assimp/scene.h>
#include <cctype>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <initializer_list>
#include <set>
#include <sstream>

namespace patina::codec {

namespace {

std::optional<float> number(const aiMaterial& material, const char* key) {
    ai_real value = 0;
    if (material.Get(key, 0, 0, value) != AI_SUCCESS || !std::isfinite(value))
        return std::nullopt;
    return static_cast<float>(value);
}

std::optional<glm::vec3> color(const aiMaterial& material, const char* key) {
    aiColor4D value;
    if (material.Get(key, 0, 0, value) != AI_SUCCESS)
        return std::nullopt;
    return glm::vec3(value.r, value.g, value.b);
}

// Blinn-Phong's exponent n as a microfacet width: alpha = sqrt(2 / (n + 2)) (Walter et al. 2007,
// section 5.1 gives n = 2 / alpha² - 2).
float roughnessOfExponent(float exponent) {
    return std::sqrt(std::sqrt(2.0f / (std::max(exponent, 0.0f) + 2.0f)));
}

class AssimpMaterialReader {
  public:
    AssimpMaterialReader(const aiScene& scene, std::string format, const MtlText& texts,
                         ImportedModel& model)
        : m_scene(scene)
        , m_format(std::move(format))
        , m_texts(texts)
        , m_model(model) {}

    ImportedMaterial material(const aiMaterial& source, std::size_t index);

  private:
    std::optional<ImportedTexture>
    texture(const aiMaterial& source, std::initializer_list<aiTextureType> types, char channel = 0);
    // Of an OBJ's texture; null where there is none.
    [[nodiscard]] const MtlTexture* mtlTexture(const aiMaterial& source, aiTextureType type) const {
        aiString path;
        return source.GetTexture(type, 0, &path) == AI_SUCCESS
                   ? m_texts.find({path.data, path.length})
                   : nullptr;
    }
    void ambient(const aiMaterial& source, ImportedMaterial& material);

    const aiScene& m_scene;
    std::string m_format;
    const MtlText& m_texts;
    ImportedModel& m_model;
};

std::optional<ImportedTexture>
AssimpMaterialReader::texture(const aiMaterial& source, std::initializer_list<aiTextureType> types,
                              char channel) {
    for (const aiTextureType type : types) {
        aiString path;
        if (source.GetTexture(type, 0, &path) != AI_SUCCESS || path.length == 0)
            continue;
        ImportedTexture result;
        result.channel = channel;
        if (const MtlTexture* mtl = m_texts.find({path.data, path.length})) {
            result.file = mtl->file;
            if (channel != 0 && mtl->channel != 0)
                result.channel = mtl->channel;
            // v' = s v + o upwards is 1 - v' = s (1 - v) + (1 - s - o) in ours.
            result.uvScale = mtl->scale;
            result.uvOffset = {mtl->offset.x, 1.0f - mtl->scale.y - mtl->offset.y};
            return result;
        }
        const auto embedded = m_scene.GetEmbeddedTextureAndIndex(path.C_Str());
        if (embedded.first != nullptr)
            result.embedded = embedded.second;
        else
            result.file = std::string(path.data, path.length);

        // FlipUVs has negated the translation; in Assimp's space, whose v points up, the file says
        // v' = s v + t, which is 1 - v' = s (1 - v) + (1 - s - t) in ours.
        aiUVTransform transform;
        if (source.Get(AI_MATKEY_UVTRANSFORM(type, 0), transform) == AI_SUCCESS) {
            result.uvScale = {transform.mScaling.x, transform.mScaling.y};
            result.uvOffset = {transform.mTranslation.x,
                               1.0f - transform.mScaling.y + transform.mTranslation.y};
            if (std::abs(transform.mRotation) > 1e-6f)
                m_model.warnings.push_back(
                    fmt::format("The rotation of texture \"{}\" was ignored.", path.C_Str()));
        }
        return result;
    }
    return std::nullopt;
}

// What an artist puts into map_Ka is occlusion, or the colour once more, as programs do by
// themselves. Its name tells.
void AssimpMaterialReader::ambient(const aiMaterial& source, ImportedMaterial& material) {
    const MtlTexture* map = mtlTexture(source, aiTextureType_AMBIENT);
    const auto& color = material.maps[MaterialInput::BaseColor];
    if (map == nullptr || (color && color->file == map->file))
        return;
    std::string words = lowerCase(map->file.substr(map->file.find_last_of("/\\") + 1));
    std::replace_if(
        words.begin(), words.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, ' ');
    std::istringstream known(std::string(inputInfo(MaterialInput::Occlusion).fileWords));
    for (std::string word; known >> word;)
        if ((" " + words + " ").find(" " + word + " ") != std::string::npos) {
            material.maps[MaterialInput::Occlusion] = texture(source, {aiTextureType_AMBIENT}, 'r');
            return;
        }
    m_model.warnings.push_back(fmt::format(
        "The ambient texture \"{}\" of material \"{}\" is not used: its name does not say that it "
        "is ambient occlusion.",
        map->file, material.name));
}

ImportedMaterial AssimpMaterialReader::material(const aiMaterial& source, std::size_t index) {
    ImportedMaterial material;
    aiString name;
    source.Get(AI_MATKEY_NAME, name);
    material.name = name.length > 0 ? name.C_Str() : fmt::format("material {}", index + 1);
    if (material.name == AI_DEFAULT_MATERIAL_NAME && m_format != "fbx") {
        material.name = "default"; // the file has none; Assimp's own grey says nothing
        material.maps[MaterialInput::BaseColor] = texture(source, {aiTextureType_DIFFUSE});
        if (material.maps[MaterialInput::BaseColor])
            material.baseColor = glm::vec4(1.0f);
        return material;
    }

    // Colour. A texture replaces the diffuse colour (COLLADA and FBX by definition; exporters of
    // OBJ write any grey beside map_Kd).
    material.maps[MaterialInput::BaseColor] =
        texture(source, {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE});
    if (material.maps[MaterialInput::BaseColor])
        material.baseColor = glm::vec4(1.0f);
    else if (const auto base = color(source, "$clr.base"))
        material.baseColor = glm::vec4(*base, 1.0f);
    else if (const auto diffuse = color(source, "$clr.diffuse"))
        material.baseColor = glm::vec4(*diffuse, 1.0f);
    if (const auto opacity = number(source, "$mat.opacity")) {
        material.baseColor.a = *opacity;
        material.alphaBlend = *opacity < 1.0f;
    }
    if (const auto opacityMap = texture(source, {aiTextureType_OPACITY})) {
        // The usual case: the alpha of the colour texture. Another file has no slot.
        if (material.maps[MaterialInput::BaseColor] &&
            opacityMap->file == material.maps[MaterialInput::BaseColor]->file &&
            opacityMap->embedded == material.maps[MaterialInput::BaseColor]->embedded)
            material.alphaMask = true;
        else
            m_model.warnings.push_back(
                fmt::format("The opacity texture of material \"{}\" is not used; put it into the "
                            "alpha of the base colour texture.",
                            material.name));
    }

    // Surface: physically based values where the file has them, otherwise the exponent. (For FBX
    // Assimp itself turns the exponent n into 1 - sqrt(n) / 10, the inverse of what Blender
    // writes.)
    if (const auto metallic = number(source, "$mat.metallicFactor"))
        material.numbers[MaterialInput::Metallic] = *metallic;
    const auto exponent = number(source, "$mat.shininess");
    if (const auto roughness = number(source, "$mat.roughnessFactor"))
        material.numbers[MaterialInput::PerceptualRoughness] = *roughness;
    else if (exponent && *exponent > 0.0f)
        material.numbers[MaterialInput::PerceptualRoughness] = roughnessOfExponent(*exponent);
    material.maps[MaterialInput::Metallic] = texture(source, {aiTextureType_METALNESS}, 'r');
    if (material.maps[MaterialInput::Metallic])
        material.numbers[MaterialInput::Metallic] = 1.0f;
    material.maps[MaterialInput::PerceptualRoughness] =
        texture(source, {aiTextureType_DIFFUSE_ROUGHNESS}, 'r');
    if (material.maps[MaterialInput::PerceptualRoughness])
        material.numbers[MaterialInput::PerceptualRoughness] = 1.0f;

    // What OBJ calls bump is a normal map in practice; other formats keep them apart.
    material.maps[MaterialInput::Normal] =
        m_format == "obj" ? texture(source, {aiTextureType_NORMALS, aiTextureType_HEIGHT})
                          : texture(source, {aiTextureType_NORMALS, aiTextureType_NORMAL_CAMERA});
    if (material.maps[MaterialInput::Normal])
        if (const auto strength = number(source, "$mat.bumpscaling"); strength && *strength > 0.0f)
            material.numbers[MaterialInput::Normal] = *strength;
    for (const aiTextureType type : {aiTextureType_NORMALS, aiTextureType_HEIGHT})
        if (const MtlTexture* bump = mtlTexture(source, type)) {
            material.numbers[MaterialInput::Normal] = bump->strength.value_or(1.0f);
            break;
        }
    material.maps[MaterialInput::Occlusion] =
        texture(source, {aiTextureType_AMBIENT_OCCLUSION}, 'r');
    if (m_format == "obj")
        ambient(source, material);

    material.maps[MaterialInput::Emissive] =
        texture(source, {aiTextureType_EMISSION_COLOR, aiTextureType_EMISSIVE});
    material.emissive = color(source, "$clr.emissive").value_or(glm::vec3(0.0f));
    if (material.maps[MaterialInput::Emissive] && material.emissive == glm::vec3(0.0f))
        material.emissive = glm::vec3(1.0f);
    int twoSided = 0;
    source.Get(AI_MATKEY_TWOSIDED, twoSided);
    material.doubleSided = twoSided != 0;
    return material;
}

} // namespace

unsigned int assimpTextureSet(const aiMaterial& material) {
    std::set<int> sets;
    for (int type = aiTextureType_DIFFUSE; type <= AI_TEXTURE_TYPE_MAX; ++type) {
        const auto kind = static_cast<aiTextureType>(type);
        if (material.GetTextureCount(kind) == 0)
            continue;
        int set = 0;
        material.Get(AI_MATKEY_UVWSRC(kind, 0), set);
        sets.insert(set);
    }
    return sets.size() == 1 ? static_cast<unsigned int>(std::max(*sets.begin(), 0)) : 0;
}

void readAssimpMaterials(const aiScene& scene, const std::string& format, const MtlText& texts,
                         ImportedModel& model) {
    for (unsigned int i = 0; i < scene.mNumTextures; ++i) {
        const aiTexture& texture = *scene.mTextures[i];
        Bytes& bytes = model.embeddedImages.emplace_back();
        if (texture.mHeight != 0) {
            model.warnings.emplace_back("An embedded texture without compression is not read.");
            continue;
        }
        bytes.resize(texture.mWidth);
        if (texture.mWidth > 0)
            std::memcpy(bytes.data(), texture.pcData, bytes.size());
    }
    AssimpMaterialReader reader(scene, format, texts, model);
    for (unsigned int i = 0; i < scene.mNumMaterials; ++i)
        model.materials.push_back(reader.material(*scene.mMaterials[i], i));
    std::string unused;
    for (const std::string& keyword : texts.unused())
        unused += (unused.empty() ? "" : ", ") + keyword;
    if (!unused.empty())
        model.warnings.push_back(fmt::format(
            "Of the material file these statements are not supported and were left out: {}.",
            unused));
}

} // namespace patina::codec
