#include "core/trace/path/TraceMaterial.h"

#include "core/image/Srgb.h"
#include "core/material/MapUv.h"

#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/exponential.hpp>

namespace patina {
namespace {

bool missing(const MapSlot& map) {
    return map.assigned() && !map.image;
}

// What stands in place of a base colour that is missing: placeholderPattern() of
// shaders/include/material.glsl.
glm::vec3 placeholderPattern(const glm::vec2& uv) {
    const glm::vec2 field = glm::floor(uv * 8.0f);
    return glm::mod(field.x + field.y, 2.0f) < 0.5f ? glm::vec3(1.0f, 0.0f, 1.0f)
                                                    : glm::vec3(0.01f);
}

// KHR_materials_volume: exp(-absorption · distance) is the attenuation colour after the
// attenuation distance. The floor keeps black finite: 1e-6 of the light is left there.
glm::vec3 absorption(const Material& material) {
    if (material.thinWalled || !(material.attenuationDistance > 0.0f))
        return glm::vec3(0.0f);
    return -glm::log(glm::clamp(material.attenuationColor, 1e-6f, 1.0f)) /
           material.attenuationDistance;
}

} // namespace

TraceMap::TraceMap(const MapSlot& slot)
    : m_image(slot.image)
    , m_channel(slot.channel)
    , m_matrix(uvMatrix(slot))
    , m_offset(slot.uvOffset) {
    if (!m_image)
        return;
    m_width = m_image->width();
    m_height = m_image->height();
    m_channels = m_image->channels();
    if (m_image->type() == PixelType::U8)
        m_bytes = reinterpret_cast<const std::uint8_t*>(m_image->bytes().data());
    if (m_image->encoding() == ColorEncoding::Srgb)
        m_decoded = srgbTable8();
    else
        for (std::size_t i = 0; i < m_decoded.size(); ++i)
            m_decoded[i] = static_cast<float>(i) / 255.0f;
}

const std::uint8_t* TraceMap::bytesAt(int x, int y) const {
    return m_bytes + (static_cast<std::size_t>(y) * static_cast<std::size_t>(m_width) +
                      static_cast<std::size_t>(x)) *
                         static_cast<std::size_t>(m_channels);
}

glm::vec4 TraceMap::texel(int x, int y) const {
    if (m_bytes == nullptr)
        return m_image->linear(x, y);
    const std::uint8_t* p = bytesAt(x, y);
    const auto alpha = [](std::uint8_t byte) { return static_cast<float>(byte) / 255.0f; };
    if (m_channels < 3) {
        const float grey = m_decoded[p[0]];
        return {grey, grey, grey, m_channels == 2 ? alpha(p[1]) : 1.0f};
    }
    return {m_decoded[p[0]], m_decoded[p[1]], m_decoded[p[2]], m_channels > 3 ? alpha(p[3]) : 1.0f};
}

TraceMap::Place TraceMap::placeOf(const glm::vec2& uv) const {
    const glm::vec2 moved =
        glm::vec2(m_matrix.x * uv.x + m_matrix.y * uv.y, m_matrix.z * uv.x + m_matrix.w * uv.y) +
        m_offset;
    struct Axis {
        int low, high;
        float fraction;
    };
    const auto axis = [](float coordinate, int size) -> Axis {
        // Into 0…1 before scaling, so that far coordinates stay accurate.
        const float wrapped = std::isfinite(coordinate) ? coordinate - std::floor(coordinate) : 0;
        const float texel = wrapped * static_cast<float>(size) - 0.5f;
        const float base = std::floor(texel);
        int low = static_cast<int>(base); // -1 … size
        low += low < 0 ? size : low >= size ? -size : 0;
        return {low, low + 1 == size ? 0 : low + 1, texel - base};
    };
    const Axis x = axis(moved.x, m_width), y = axis(moved.y, m_height);
    return {x.low, x.high, y.low, y.high, x.fraction, y.fraction};
}

glm::vec4 TraceMap::at(const glm::vec2& uv) const {
    const Place at = placeOf(uv);
    return glm::mix(glm::mix(texel(at.x0, at.y0), texel(at.x1, at.y0), at.fx),
                    glm::mix(texel(at.x0, at.y1), texel(at.x1, at.y1), at.fx), at.fy);
}

glm::vec3 TraceMap::colorAt(const glm::vec2& uv) const {
    // The usual map, without its alpha.
    if (m_bytes != nullptr && m_channel == MapChannel::Rgb && m_channels >= 3) {
        const Place at = placeOf(uv);
        const auto color = [&](int x, int y) {
            const std::uint8_t* p = bytesAt(x, y);
            return glm::vec3(m_decoded[p[0]], m_decoded[p[1]], m_decoded[p[2]]);
        };
        return glm::mix(glm::mix(color(at.x0, at.y0), color(at.x1, at.y0), at.fx),
                        glm::mix(color(at.x0, at.y1), color(at.x1, at.y1), at.fx), at.fy);
    }
    const glm::vec4 c = at(uv);
    switch (m_channel) {
    case MapChannel::Rgb:
        return glm::vec3(c);
    case MapChannel::R:
        return glm::vec3(c.r);
    case MapChannel::G:
        return glm::vec3(c.g);
    case MapChannel::B:
        return glm::vec3(c.b);
    case MapChannel::A:
        return glm::vec3(c.a);
    }
    return glm::vec3(c);
}

float TraceMap::numberAt(const glm::vec2& uv) const {
    if (m_bytes == nullptr || m_channel == MapChannel::A)
        return colorAt(uv).x;
    const Place at = placeOf(uv);
    const int channel =
        m_channels < 3 || m_channel == MapChannel::Rgb ? 0 : static_cast<int>(m_channel) - 1;
    const auto number = [&](int x, int y) { return m_decoded[bytesAt(x, y)[channel]]; };
    return glm::mix(glm::mix(number(at.x0, at.y0), number(at.x1, at.y0), at.fx),
                    glm::mix(number(at.x0, at.y1), number(at.x1, at.y1), at.fx), at.fy);
}

TraceMaterial::TraceMaterial(const Material& material)
    : m_baseColor(material.baseColor)
    // A missing emissive map would set the whole surface aglow.
    , m_emissive(missing(material.emissiveMap) ? glm::vec3(0.0f)
                                               : material.emissive * material.emissiveStrength)
    , m_metallic(material.metallic)
    , m_perceptualRoughness(material.perceptualRoughness)
    , m_diffuseRoughness(material.diffuseRoughness)
    , m_normalStrength(material.normalStrength)
    , m_greenUp(material.normalConvention == NormalConvention::OpenGl ? 1.0f : -1.0f)
    , m_transmission(material.transmission)
    , m_ior(material.ior)
    , m_glass{material.thinWalled, absorption(material)}
    , m_doubleSided(material.doubleSided)
    , m_lacksColor(missing(material.baseColorMap))
    , m_normalBasis(normalBasis(material.normalMap))
    , m_color(material.baseColorMap)
    , m_metal(material.metallicMap)
    , m_rough(material.perceptualRoughnessMap)
    , m_normal(material.normalMap)
    , m_glow(material.emissiveMap)
    , m_clear(material.transmissionMap) {}

shading::SurfaceInputs TraceMaterial::inputsAt(const glm::vec2& uv) const {
    const auto number = [&](float factor, const TraceMap& map) {
        return glm::clamp(map.isThere() ? factor * map.numberAt(uv) : factor, 0.0f, 1.0f);
    };
    shading::SurfaceInputs inputs;
    const glm::vec3 color = m_lacksColor        ? placeholderPattern(uv)
                            : m_color.isThere() ? m_baseColor * m_color.colorAt(uv)
                                                : m_baseColor;
    inputs.baseColor = glm::clamp(color, 0.0f, 1.0f);
    inputs.metallic = number(m_metallic, m_metal);
    inputs.perceptualRoughness = number(m_perceptualRoughness, m_rough);
    inputs.diffuseRoughness = m_diffuseRoughness;
    inputs.transmission = number(m_transmission, m_clear);
    inputs.ior = m_ior;
    return inputs;
}

glm::vec3 TraceMaterial::emissionAt(const glm::vec2& uv) const {
    return emits() && m_glow.isThere() ? m_emissive * m_glow.colorAt(uv) : m_emissive;
}

glm::vec3 TraceMaterial::shadingNormal(const glm::vec3& normal, const glm::vec4& tangent,
                                       const glm::vec2& uv) const {
    if (!m_normal.isThere())
        return normal;
    const glm::vec3 slope =
        shading::decodeNormalTs(glm::vec3(m_normal.at(uv)), m_normalStrength, m_greenUp);
    const glm::vec3 turned(m_normalBasis.x * slope.x + m_normalBasis.y * slope.y,
                           m_normalBasis.z * slope.x + m_normalBasis.w * slope.y, slope.z);
    return shading::normalTsToWorld(turned, normal, tangent);
}

} // namespace patina
