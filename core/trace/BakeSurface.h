// What light meets on a mesh: the colour of its diffuse reflection, and where rays pass through it.
#pragma once

#include "core/base/Hash.h"
#include "core/material/MapSlot.h"

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

namespace patina {

struct Material;
enum class AlphaMode; // of core/material/Material.h

// The part of a material that transport depends on.
struct BakeSurface {
    glm::vec3 baseColor{0.8f}; // linear sRGB
    float metallic = 0.0f;     // metals have no diffuse reflection
    MapSlot baseColorMap, metallicMap;
    float opacity = 1.0f;
    AlphaMode alphaMode{}; // opaque
    float alphaCutoff = 0.5f;
    friend bool operator==(const BakeSurface&, const BakeSurface&) = default;
};

[[nodiscard]] BakeSurface bakeSurface(const Material& material);

// Both surfaces read the same texels at the same places, whatever their factors.
[[nodiscard]] bool sameAlbedoMaps(const BakeSurface& a, const BakeSurface& b);

// Adds what decides where rays pass through; nothing for an opaque surface.
void hashCoverage(Hasher& hasher, const BakeSurface& surface);
// Adds what the diffuse albedo consists of.
void hashAlbedo(Hasher& hasher, const BakeSurface& surface);

// Where a surface is solid: opacity times the alpha of the base colour map, as the viewport has it.
class Coverage {
  public:
    explicit Coverage(const BakeSurface& surface);

    // 0…1 at texture coordinates, bilinear.
    [[nodiscard]] float alphaAt(const glm::vec2& uv) const;
    // Share of the rays that stop there: 0 or 1 of a mask.
    [[nodiscard]] float solidShareAt(const glm::vec2& uv) const;
    // Whether a ray stops. Mask: alpha reaches the cutoff. Blend: by chance with probability alpha,
    // `chance` being even in [0, 1).
    [[nodiscard]] bool solidAt(const glm::vec2& uv, float chance) const;

  private:
    MapSlot m_map; // its place only
    float m_opacity, m_cutoff;
    AlphaMode m_mode;
    int m_width = 0, m_height = 0;
    std::vector<std::uint8_t> m_alpha; // empty: the map has none
};

// The maps of a surface at most kMaxSide texels a side, averaged in linear light: what a ray of a
// hemisphere of some hundred sees of a texture, in an order that a cache can follow. Kept by
// whoever looks up often; factors of the material may change meanwhile.
class AlbedoTexels {
  public:
    static constexpr int kMaxSide = 1024;

    explicit AlbedoTexels(const BakeSurface& surface);

    // Base colour (sRGB curve) in the lower 24 bits, metallic (the same curve) in the upper 8.
    [[nodiscard]] std::uint32_t at(const glm::vec2& uv) const;

  private:
    struct Picture {
        glm::vec4 matrix{1, 0, 0, 1};
        glm::vec2 offset{0.0f};
        int width = 0, height = 0;
        std::vector<std::uint32_t> texels; // empty: white
        [[nodiscard]] std::uint32_t at(const glm::vec2& uv) const;
    };
    static Picture picture(const MapSlot& map, bool isColor);

    Picture m_color, m_metallic;
};

// Whether there is anything to look up.
[[nodiscard]] bool hasAlbedoMap(const BakeSurface& surface);

// Diffuse albedo of texels and factors: base colour × (1 - metallic), each channel in 0…1 as the
// surface shader clamps it.
class DiffuseAlbedo {
  public:
    explicit DiffuseAlbedo(const BakeSurface& surface);
    [[nodiscard]] glm::vec3 uniform() const { return of(0xffffffffu); } // where nothing is mapped
    [[nodiscard]] glm::vec3 of(std::uint32_t texel) const {
        const float diffuse = m_byCode[3][texel >> 24];
        return {diffuse * m_byCode[0][texel & 0xffu], diffuse * m_byCode[1][texel >> 8 & 0xffu],
                diffuse * m_byCode[2][texel >> 16 & 0xffu]};
    }

  private:
    // For each code of a texel: red, green, blue times their factors, and the share that is not
    // metal.
    std::array<std::array<float, 256>, 4> m_byCode;
};

} // namespace patina
