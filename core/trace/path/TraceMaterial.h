// A material as rays find it: its maps looked up at a point. What the surface shader does with the
// same maps is shaders/surface.frag.
#pragma once

#include "core/material/Material.h"
#include "core/math/Shading.h"

#include <array>
#include <cstdint>
#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace patina {

// A map on its surface: bilinear, repeating, of full size. Pictures of floats are finite.
class TraceMap {
  public:
    TraceMap() = default; // none
    explicit TraceMap(const MapSlot& slot);

    [[nodiscard]] bool isThere() const { return m_image != nullptr; }
    [[nodiscard]] glm::vec4 at(const glm::vec2& uv) const;      // linear RGBA
    [[nodiscard]] glm::vec3 colorAt(const glm::vec2& uv) const; // or the channel that was chosen
    [[nodiscard]] float numberAt(const glm::vec2& uv) const;    // the channel, else the first

  private:
    struct Place { // of a lookup: two columns, two rows, and how far between them
        int x0, x1, y0, y1;
        float fx, fy;
    };
    [[nodiscard]] Place placeOf(const glm::vec2& uv) const;
    [[nodiscard]] const std::uint8_t* bytesAt(int x, int y) const;
    [[nodiscard]] glm::vec4 texel(int x, int y) const;

    ImagePtr m_image;
    const std::uint8_t* m_bytes = nullptr; // of m_image, where it has 8 bits a channel
    int m_width = 0, m_height = 0, m_channels = 0;
    MapChannel m_channel = MapChannel::Rgb;
    glm::vec4 m_matrix{1, 0, 0, 1};
    glm::vec2 m_offset{0.0f};
    std::array<float, 256> m_decoded{}; // of a byte of colour
};

// What light meets that goes through a surface; TraceMaterial::inputsAt() has how much does.
struct TraceGlass {
    bool thinWalled = true;     // a sheet; otherwise the face of a solid body
    glm::vec3 absorption{0.0f}; // of the solid body, per metre, at least 0 (Beer-Lambert)
};

class TraceMaterial {
  public:
    explicit TraceMaterial(const Material& material);

    [[nodiscard]] bool doubleSided() const { return m_doubleSided; }
    [[nodiscard]] shading::SurfaceInputs inputsAt(const glm::vec2& uv) const;
    [[nodiscard]] glm::vec3 emissionAt(const glm::vec2& uv) const; // radiance
    [[nodiscard]] bool emits() const { return m_emissive != glm::vec3(0.0f); }
    // The radiance that the map multiplies.
    [[nodiscard]] const glm::vec3& emissive() const { return m_emissive; }
    // Of a surface with that normal and tangent (surface.vert), world axes; unit.
    [[nodiscard]] glm::vec3 shadingNormal(const glm::vec3& normal, const glm::vec4& tangent,
                                          const glm::vec2& uv) const;
    // Somewhere on the surface.
    [[nodiscard]] bool transmits() const {
        return m_transmission > 0.0f && (m_metallic < 1.0f || m_metal.isThere());
    }
    [[nodiscard]] bool mayBeRough() const {
        return m_perceptualRoughness > shading::kMinPerceptualRoughness;
    }
    [[nodiscard]] float ior() const { return m_ior; }
    [[nodiscard]] const TraceGlass& glass() const { return m_glass; }
    [[nodiscard]] bool hasNormalMap() const { return m_normal.isThere(); }

  private:
    glm::vec3 m_baseColor, m_emissive;
    float m_metallic, m_perceptualRoughness, m_diffuseRoughness, m_normalStrength, m_greenUp;
    float m_transmission, m_ior;
    TraceGlass m_glass;
    bool m_doubleSided, m_lacksColor;
    glm::vec4 m_normalBasis;
    TraceMap m_color, m_metal, m_rough, m_normal, m_glow, m_clear;
};

} // namespace patina
