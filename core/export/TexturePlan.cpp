#include "core/edit/Edit.h"
#include "core/export/Names.h"
#include "core/export/TexturePacking.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <tuple>
#include <utility>

namespace patina {
namespace {

using Transform = std::tuple<glm::vec2, glm::vec2, float>;

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
        uses.baseColor = addBaseColor(material);
        uses.emissive = addColor(material, material.emissiveMap, "emissive", "emissive");
        uses.normal = addNormal(material);
        addChannels(material, uses);
        for (const auto& [source, maps] : std::exchange(m_missing, {}))
            m_plan.warnings.push_back(
                fmt::format("{}: “{}” could not be read and will be left out ({})", material.name,
                            source, fmt::join(maps, ", ")));
    }

    TexturePlan take() { return std::move(m_plan); }

  private:
    // The slot, or an empty one when its image could not be read.
    MapSlot readable(const MapSlot& slot, const char* what) {
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
        // Eight bits show as steps in the reflections of gentle curves: finer maps stay finer.
        if (slot.image->type() != PixelType::U8)
            texture.type = PixelType::U16;
        return add(material, std::move(texture), "normal", "normal", {slot.image.get()},
                   transformOf(slot));
    }

    // Occlusion, roughness and metallic share an image when their texture transforms agree.
    void addChannels(const Material& material, MaterialTextures& uses) {
        PackedTexture texture;
        texture.kind = PackKind::Channels;
        const ImagePtr baked = bakedOcclusion(material);
        texture.occlusion = baked ? bakeSlot(baked) : readable(material.occlusionMap, "occlusion");
        texture.roughness = readable(material.perceptualRoughnessMap, "roughness");
        texture.metallic = readable(material.metallicMap, "metallic");
        const bool occludes = texture.occlusion.image != nullptr;
        const bool reflects =
            texture.roughness.image != nullptr || texture.metallic.image != nullptr;

        const Transform occlusionTransform = transformOf(texture.occlusion);
        const Transform reflectanceTransform =
            transformOf(texture.roughness.image != nullptr ? texture.roughness : texture.metallic);
        if (texture.roughness.image != nullptr && texture.metallic.image != nullptr &&
            transformOf(texture.metallic) != reflectanceTransform)
            m_plan.warnings.push_back(
                fmt::format("{}: glTF keeps roughness and metallic in one image; the metallic map "
                            "will follow the roughness map's tiling",
                            material.name));

        if (occludes && reflects && occlusionTransform == reflectanceTransform) {
            uses.occlusion = uses.metallicRoughness =
                addPacked(material, texture, reflectanceTransform);
            return;
        }
        if (occludes) {
            PackedTexture alone = texture;
            alone.roughness = alone.metallic = {};
            uses.occlusion = addPacked(material, std::move(alone), occlusionTransform);
        }
        if (reflects) {
            texture.occlusion = {};
            uses.metallicRoughness = addPacked(material, std::move(texture), reflectanceTransform);
        }
    }

    TextureUse addPacked(const Material& material, PackedTexture texture,
                         const Transform& transform) {
        std::vector<std::string> parts;
        std::vector<const Image*> images;
        if (texture.occlusion.image != nullptr)
            parts.emplace_back(texture.occlusion.source == kBakeSource ? "baked occlusion"
                                                                       : "occlusion");
        const bool occludes = !parts.empty();
        for (const ImagePtr& image :
             {texture.occlusion.image, texture.roughness.image, texture.metallic.image})
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
        return nullptr;
    }

    // Fixes size and name, or finds an identical texture that is planned already.
    TextureUse add(const Material& material, PackedTexture texture, const char* suffix,
                   const std::string& what, const std::vector<const Image*>& images,
                   const Transform& transform) {
        for (const Image* image : images) {
            if (image == nullptr)
                continue;
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
        const std::string name = fileSafeName(material.name, "material");
        texture.name = m_names.take(m_stem.empty() ? fmt::format("{}_{}", name, suffix)
                                                   : fmt::format("{}_{}_{}", m_stem, name, suffix));
        texture.contents = fmt::format("{}: {}", material.name, what);
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
        slot(texture.occlusion);
        slot(texture.roughness);
        slot(texture.metallic);
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
