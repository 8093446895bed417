// The textures of an export: which maps of which materials go into which channels of which image.
// Planning looks only at sizes and types; packing computes the pixels.
#pragma once

#include "core/document/Document.h"
#include "core/export/Export.h"
#include "core/io/ImageIO.h"
#include "core/material/MapSlot.h"
#include "core/material/MaterialInput.h"

#include <array>
#include <string>
#include <vector>

namespace patina {

// A texture as a material refers to it: glTF's textureInfo with KHR_texture_transform.
struct TextureUse {
    int texture = -1; // index into TexturePlan::textures; -1: none
    glm::vec2 scale{1.0f}, offset{0.0f};
    float rotationDeg = 0.0f;
};

using MaterialTextures = PerInput<TextureUse>;

enum class PackKind { Color, Normal, Channels };

// One image to be written.
struct PackedTexture {
    PackKind kind = PackKind::Color;
    std::string name;     // unique file stem: "Body_baseColor"
    std::string contents; // "Body: base colour"
    int width = 0, height = 0;
    int channels = 3; // 1 grey, 3 RGB, 4 RGBA
    PixelType type = PixelType::U8;
    ImageFileFormat format = ImageFileFormat::Png;

    MapSlot color;                  // Color, Normal: the map
    bool flipGreen = false;         // Normal: from DirectX's convention
    std::array<MapSlot, 4> channel; // Channels: of R, G, B and A; each may be without an image

    [[nodiscard]] const char* extension() const { // with the dot
        return format == ImageFileFormat::Jpeg ? ".jpg" : ".png";
    }
    [[nodiscard]] const char* mimeType() const {
        return format == ImageFileFormat::Jpeg ? "image/jpeg" : "image/png";
    }
    [[nodiscard]] std::string formatText() const; // "PNG 8-bit RGB 1024 × 1024"
};

struct TexturePlan {
    std::vector<PackedTexture> textures;
    std::vector<MaterialTextures> materials; // one for each material given
    std::vector<std::string> warnings;
};

// Identical textures are planned once and shared. `stem` starts every name when it is not empty.
[[nodiscard]] TexturePlan planTextures(const Document& document,
                                       const std::vector<const Material*>& materials,
                                       const ExportSettings& settings, const std::string& stem);

// The pixels, ready to be encoded. Cancelled jobs return an empty image.
[[nodiscard]] Image packTexture(const PackedTexture& texture, const JobContext& job);

} // namespace patina
