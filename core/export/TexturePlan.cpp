#include "core/bake/lightmap/LightMap.h"
#include "core/edit/Edit.h"
#include "core/export/LightMapExport.h"
#include "core/export/Names.h"
#include "core/export/TexturePacking.h"
#include "core/material/Material.h"
#include "core/material/MaterialInputs.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <tuple>
#include <utility>

namespace patina {
namespace {

using Transform = std::tuple<glm::vec2, glm::vec2, float>;

constexpr std::size_t kRed = 0, kGreen = 1, kBlue = 2, kAlpha = 3; // of PackedTexture::channel

constexpr const char* kBakeSource = "bake"; // MapSlot::source of a baked texture

Transform transformOf(const MapSlot& slot) {
    return {slot.uvScale, slot.uvOffset, slot.uvRotationDeg};
}

bool hasAlpha(const Image& image) {
    return image.channels() == 2 || image.channels() == 4;
}

class Planner {
  public:
    Planner(const Document& document, const ExportSettings& settings, const std::string& stem)
        : m_document(document)
        , m_settings(settings)
        , m_stem(stem) {}

    void add(const Material& material) {
        MaterialTextures& uses = m_plan.materials.emplace_back();
        uses[MaterialInput::BaseColor] = addBaseColor(material);
        uses[MaterialInput::Emissive] =
            addColor(material, material.emissiveMap, "emissive", "emissive");
        uses[MaterialInput::Normal] = addNormal(material);
        addChannels(material, uses);
        for (const MaterialInputInfo& info : kMaterialInputs)
            if (info.role == InputRole::Number && info.gltf.object != kGltfPbr)
                uses[info.input] = addNumber(material, info);
        for (const auto& [source, maps] : std::exchange(m_missing, {}))
            m_plan.warnings.push_back(
                fmt::format("{}: “{}” could not be read and will be left out ({})", material.name,
                            source, fmt::join(maps, ", ")));
    }

    TexturePlan take() { return std::move(m_plan); }

  private:
    // The slot, or an empty one when its image could not be read.
    MapSlot readable(const MapSlot& slot, const std::string& what) {
        if (!slot.assigned() || (slot.image != nullptr && !slot.image->empty()))
            return slot;
        m_missing[slot.source].emplace_back(what);
        return {};
    }

    TextureUse addBaseColor(const Material& material) {
        const ImagePtr& image = material.baseColorMap.image;
        const bool alpha = material.alphaMode != AlphaMode::Opaque && image != nullptr &&
                           material.baseColorMap.channel == MapChannel::Rgb && hasAlpha(*image);
        return addColor(material, material.baseColorMap, "baseColor",
                        alpha ? "base colour (RGB), opacity (A)" : "base colour", alpha);
    }

    TextureUse addColor(const Material& material, const MapSlot& map, const char* suffix,
                        const char* what, bool alpha = false) {
        const MapSlot slot = readable(map, alpha ? "base colour" : what);
        if (slot.image == nullptr)
            return {};
        PackedTexture texture;
        texture.kind = PackKind::Color;
        texture.color = slot;
        texture.channels = alpha ? 4 : 3;
        // JPEG has no alpha, and blurs edges that a cut-out needs.
        if (m_settings.textures == ExportTextureFormat::Jpeg && !alpha)
            texture.format = ImageFileFormat::Jpeg;
        if (slot.image->type() == PixelType::F32)
            m_plan.warnings.push_back(fmt::format(
                "{}: the {} map holds floating-point numbers; values above 1 will be "
                "clipped in its 8-bit copy",
                material.name, suffix == std::string("emissive") ? what : "base colour"));
        return add(material, std::move(texture), suffix, what, {slot.image.get()},
                   transformOf(slot));
    }

    TextureUse addNormal(const Material& material) {
        const MapSlot slot = readable(material.normalMap, "normal");
        if (slot.image == nullptr)
            return {};
        PackedTexture texture;
        texture.kind = PackKind::Normal;
        texture.color = slot;
        texture.flipGreen = material.normalConvention == NormalConvention::DirectX;
        // Eight bits show as steps in the reflections of gentle curves, of floats, too.
        if (slot.image->type() != PixelType::U8)
            texture.type = PixelType::U16;
        return add(material, std::move(texture), "normal", "normal", {slot.image.get()},
                   transformOf(slot));
    }

    // A number with a texture of its own, of which one channel counts.
    TextureUse addNumber(const Material& material, const MaterialInputInfo& info) {
        std::string what(info.parameters.label);
        what[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(what[0])));
        const MapSlot slot = readable(material.*info.map, what);
        if (slot.image == nullptr)
            return {};
        const auto channel = std::string_view("rgba").find(info.gltf.channel);
        PackedTexture texture;
        texture.kind = PackKind::Channels;
        texture.channel[channel] = slot;
        texture.channels = channel == kRed ? 1 : channel == kAlpha ? 4 : 3;
        return add(material, std::move(texture), std::string(info.id).c_str(),
                   fmt::format("{} ({})", what, "RGBA"[channel]), {slot.image.get()},
                   transformOf(slot));
    }

    // glTF keeps roughness and metallic in one image.
    static void setReflectance(MaterialTextures& uses, const TextureUse& use) {
        uses[MaterialInput::Metallic] = uses[MaterialInput::PerceptualRoughness] = use;
    }

    // Occlusion, roughness and metallic share an image when their texture transforms agree.
    void addChannels(const Material& material, MaterialTextures& uses) {
        PackedTexture texture;
        texture.kind = PackKind::Channels;
        const ImagePtr baked = bakedOcclusion(material);
        texture.channel[kRed] =
            baked ? bakeSlot(baked) : readable(material.occlusionMap, "occlusion");
        texture.channel[kGreen] = readable(material.perceptualRoughnessMap, "roughness");
        texture.channel[kBlue] = readable(material.metallicMap, "metallic");
        const bool occludes = texture.channel[kRed].image != nullptr;
        const bool reflects =
            texture.channel[kGreen].image != nullptr || texture.channel[kBlue].image != nullptr;

        const Transform occlusionTransform = transformOf(texture.channel[kRed]);
        const Transform reflectanceTransform =
            transformOf(texture.channel[kGreen].image != nullptr ? texture.channel[kGreen]
                                                                 : texture.channel[kBlue]);
        if (texture.channel[kGreen].image != nullptr && texture.channel[kBlue].image != nullptr &&
            transformOf(texture.channel[kBlue]) != reflectanceTransform)
            m_plan.warnings.push_back(
                fmt::format("{}: glTF keeps roughness and metallic in one image; the metallic map "
                            "will follow the roughness map's tiling",
                            material.name));

        if (occludes && reflects && occlusionTransform == reflectanceTransform) {
            uses[MaterialInput::Occlusion] = addPacked(material, texture, reflectanceTransform);
            setReflectance(uses, uses[MaterialInput::Occlusion]);
            return;
        }
        if (occludes) {
            PackedTexture alone = texture;
            alone.channel[kGreen] = alone.channel[kBlue] = {};
            uses[MaterialInput::Occlusion] =
                addPacked(material, std::move(alone), occlusionTransform);
        }
        if (reflects) {
            texture.channel[kRed] = {};
            setReflectance(uses, addPacked(material, std::move(texture), reflectanceTransform));
        }
    }

    TextureUse addPacked(const Material& material, PackedTexture texture,
                         const Transform& transform) {
        std::vector<std::string> parts;
        std::vector<const Image*> images;
        if (texture.channel[kRed].image != nullptr)
            parts.emplace_back(texture.channel[kRed].source == kBakeSource ? "baked occlusion"
                                                                           : "occlusion");
        const bool occludes = !parts.empty();
        for (const ImagePtr& image : {texture.channel[kRed].image, texture.channel[kGreen].image,
                                      texture.channel[kBlue].image})
            images.push_back(image.get());
        const bool reflects = images[1] != nullptr || images[2] != nullptr;
        texture.channels = reflects ? 3 : 1;
        if (reflects && occludes)
            parts.front() += " (R)";
        if (images[1] != nullptr)
            parts.emplace_back("roughness (G)");
        if (images[2] != nullptr)
            parts.emplace_back("metallic (B)");
        const char* suffix = !reflects ? "occlusion" : occludes ? "orm" : "metallicRoughness";
        return add(material, std::move(texture), suffix, fmt::format("{}", fmt::join(parts, ", ")),
                   images, transform);
    }

    // A bake has been made for this very scene and lives in the mesh's own texture space: it
    // replaces the occlusion map, as it does in the viewport, instead of darkening twice.
    static MapSlot bakeSlot(ImagePtr image) {
        MapSlot slot;
        slot.source = kBakeSource;
        slot.image = std::move(image);
        slot.channel = MapChannel::R;
        return slot;
    }

    ImagePtr bakedOcclusion(const Material& material) const {
        if (!m_settings.includeBakedAo)
            return nullptr;
        if (const BakeArtifactPtr bake = findBake(m_document, BakeKind::AoTexel))
            for (const TexelBake& texel : bake->texels)
                if (texel.material == material.id)
                    return texel.image;
        if (const BakeArtifactPtr bake = findBake(m_document, BakeKind::LightMap))
            for (const TexelBake& texel : bake->texels)
                if (texel.material == material.id && texel.stride == kLightMapStride)
                    return ambientVisibilityOf(texel);
        return nullptr;
    }

    // Fixes size and name, or finds an identical texture that is planned already.
    TextureUse add(const Material& material, PackedTexture texture, const char* suffix,
                   const std::string& what, const std::vector<const Image*>& images,
                   const Transform& transform) {
        for (const Image* image : images) {
            if (image == nullptr)
                continue;
            // What was stored in 16 bits stays so, in formats that have them.
            if (image->type() == PixelType::U16 && texture.format == ImageFileFormat::Png)
                texture.type = PixelType::U16;
            texture.width = std::max(texture.width, image->width());
            texture.height = std::max(texture.height, image->height());
        }
        const int longest = std::max(texture.width, texture.height);
        if (m_settings.maxTextureSize > 0 && longest > m_settings.maxTextureSize) {
            const double scale = static_cast<double>(m_settings.maxTextureSize) / longest;
            texture.width = std::max(1, static_cast<int>(std::lround(texture.width * scale)));
            texture.height = std::max(1, static_cast<int>(std::lround(texture.height * scale)));
        }

        TextureUse use;
        std::tie(use.scale, use.offset, use.rotationDeg) = transform;
        const auto [known, isNew] =
            m_known.try_emplace(key(texture).hex(), static_cast<int>(m_plan.textures.size()));
        use.texture = known->second;
        if (!isNew) {
            std::string& contents = m_plan.textures[static_cast<std::size_t>(use.texture)].contents;
            if (const std::size_t end = contents.rfind(": " + what); end != std::string::npos)
                contents.insert(end, ", " + material.name);
            else
                contents += fmt::format("; {}: {}", material.name, what);
            return use;
        }
        std::string name = fmt::format("{}_{}", fileSafeName(material.name, "material"), suffix);
        texture.contents = fmt::format("{}: {}", material.name, what);
        if (texture.color.source == kLightMapSource) { // of all materials
            name = kLightMapName;
            texture.contents = "Light map";
        }
        texture.name = m_names.take(m_stem.empty() ? name : fmt::format("{}_{}", m_stem, name));
        m_plan.textures.push_back(std::move(texture));
        return use;
    }

    // Everything the pixels depend on; equal images count as one even when loaded twice.
    Hash key(const PackedTexture& texture) {
        Hasher hasher;
        const auto slot = [&](const MapSlot& map) {
            hasher.value(imageHash(map.image.get())).value(static_cast<int>(map.channel));
        };
        for (const int number : {static_cast<int>(texture.kind), texture.width, texture.height,
                                 texture.channels, static_cast<int>(texture.type),
                                 static_cast<int>(texture.format), texture.flipGreen ? 1 : 0})
            hasher.value(number);
        slot(texture.color);
        for (const MapSlot& channel : texture.channel)
            slot(channel);
        return hasher.finish();
    }

    Hash imageHash(const Image* image) {
        if (image == nullptr)
            return {};
        const auto [known, isNew] = m_hashes.try_emplace(image);
        if (isNew)
            known->second = hashImage(*image);
        return known->second;
    }

    const Document& m_document;
    const ExportSettings& m_settings;
    std::string m_stem;
    TexturePlan m_plan;
    UniqueNames m_names;
    std::map<std::string, int> m_known;
    std::map<const Image*, Hash> m_hashes;
    std::map<std::string, std::vector<std::string>> m_missing; // of one material, by source
};

} // namespace

std::string PackedTexture::formatText() const {
    return fmt::format("{} {}-bit {} {} × {}", format == ImageFileFormat::Jpeg ? "JPEG" : "PNG",
                       type == PixelType::U16 ? 16 : 8,
                       channels == 1   ? "grey"
                       : channels == 3 ? "RGB"
                                       : "RGBA",
                       width, height);
}

TexturePlan planTextures(const Document& document, const std::vector<const Material*>& materials,
                         const ExportSettings& settings, const std::string& stem) {
    Planner planner(document, settings, stem);
    for (const Material* material : materials)
        planner.add(*material);
    return planner.take();
}

} // namespace patina
