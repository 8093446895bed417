#include "core/trace/BakeSurface.h"

#include "core/image/Srgb.h"
#include "core/material/MapUv.h"
#include "core/material/Material.h"

#include <algorithm>
#include <cmath>

namespace patina {
namespace {

void hashMap(Hasher& hasher, const MapSlot& map) {
    hasher.value(map.image ? hashImage(*map.image) : Hash{});
    hasher.value(static_cast<int>(map.channel));
    for (const float number :
         {map.uvScale.x, map.uvScale.y, map.uvOffset.x, map.uvOffset.y, map.uvRotationDeg})
        hasher.value(number);
}

bool samePlaces(const MapSlot& a, const MapSlot& b) {
    return a.image == b.image &&
           (!a.image || (a.channel == b.channel && a.uvScale == b.uvScale &&
                         a.uvOffset == b.uvOffset && a.uvRotationDeg == b.uvRotationDeg));
}

float component(const glm::vec4& texel, MapChannel channel) {
    switch (channel) {
    case MapChannel::G:
        return texel.g;
    case MapChannel::B:
        return texel.b;
    case MapChannel::A:
        return texel.a;
    case MapChannel::Rgb:
    case MapChannel::R:
        break;
    }
    return texel.r;
}

std::uint32_t encode(float value) {
    return linearToSrgb8(std::clamp(value, 0.0f, 1.0f));
}

// The texel of a repeating picture; coordinates that are not finite are taken as 0.
int texelIndex(float coordinate, int size) {
    const float wrapped = std::isfinite(coordinate) ? coordinate - std::floor(coordinate) : 0.0f;
    return std::min(static_cast<int>(wrapped * static_cast<float>(size)), size - 1);
}

} // namespace

BakeSurface bakeSurface(const Material& material) {
    // Light that goes through is none that the body scatters back; where a map says how much, bakes
    // take the surface for opaque.
    const float body = material.transmissionMap.image ? 1.0f : 1.0f - material.transmission;
    return {body * material.baseColor, material.metallic, material.baseColorMap,
            material.metallicMap,      material.opacity,  material.alphaMode,
            material.alphaCutoff};
}

bool sameAlbedoMaps(const BakeSurface& a, const BakeSurface& b) {
    return samePlaces(a.baseColorMap, b.baseColorMap) && samePlaces(a.metallicMap, b.metallicMap);
}

bool hasAlbedoMap(const BakeSurface& surface) {
    return surface.baseColorMap.image != nullptr || surface.metallicMap.image != nullptr;
}

void hashCoverage(Hasher& hasher, const BakeSurface& surface) {
    if (surface.alphaMode == AlphaMode::Opaque)
        return;
    hasher.value(static_cast<int>(surface.alphaMode)).value(surface.opacity);
    hasher.value(surface.alphaMode == AlphaMode::Mask ? surface.alphaCutoff : 0.0f);
    hashMap(hasher, surface.baseColorMap);
}

void hashAlbedo(Hasher& hasher, const BakeSurface& surface) {
    for (const float number :
         {surface.baseColor.r, surface.baseColor.g, surface.baseColor.b, surface.metallic})
        hasher.value(number);
    hashMap(hasher, surface.baseColorMap);
    hashMap(hasher, surface.metallicMap);
}

Coverage::Coverage(const BakeSurface& surface)
    : m_map(surface.baseColorMap)
    , m_opacity(surface.opacity)
    , m_cutoff(surface.alphaCutoff)
    , m_mode(surface.alphaMode) {
    const ImagePtr image = std::move(m_map.image);
    const bool hasAlpha = image && (image->channels() == 2 || image->channels() == 4);
    if (!hasAlpha)
        return;
    m_width = image->width();
    m_height = image->height();
    m_alpha.reserve(static_cast<std::size_t>(m_width) * static_cast<std::size_t>(m_height));
    for (int y = 0; y < m_height; ++y)
        for (int x = 0; x < m_width; ++x)
            m_alpha.push_back(static_cast<std::uint8_t>(std::lround(
                255.0f * std::clamp(image->sample(x, y, image->channels() - 1), 0.0f, 1.0f))));
}

float Coverage::alphaAt(const glm::vec2& uv) const {
    if (m_alpha.empty())
        return m_opacity;
    // Texel centres stand at (i + 0.5) / n; the picture repeats.
    const glm::vec2 place = mapUv(m_map, uv);
    const auto axis = [](float coordinate, int size, int& low, int& high) {
        const float wrapped =
            std::isfinite(coordinate) ? coordinate - std::floor(coordinate) : 0.0f;
        const float texel = wrapped * static_cast<float>(size) - 0.5f, base = std::floor(texel);
        low = (static_cast<int>(base) + size) % size;
        high = (low + 1) % size;
        return texel - base;
    };
    int x0 = 0, x1 = 0, y0 = 0, y1 = 0;
    const float fx = axis(place.x, m_width, x0, x1), fy = axis(place.y, m_height, y0, y1);
    const auto texel = [&](int x, int y) {
        return static_cast<float>(
            m_alpha[static_cast<std::size_t>(y) * static_cast<std::size_t>(m_width) +
                    static_cast<std::size_t>(x)]);
    };
    const float top = texel(x0, y0) + fx * (texel(x1, y0) - texel(x0, y0));
    const float bottom = texel(x0, y1) + fx * (texel(x1, y1) - texel(x0, y1));
    return m_opacity * (top + fy * (bottom - top)) / 255.0f;
}

float Coverage::solidShareAt(const glm::vec2& uv) const {
    if (m_mode == AlphaMode::Opaque)
        return 1.0f;
    const float alpha = alphaAt(uv);
    return m_mode == AlphaMode::Mask ? (alpha >= m_cutoff ? 1.0f : 0.0f) : alpha;
}

bool Coverage::solidAt(const glm::vec2& uv, float chance) const {
    return chance < solidShareAt(uv);
}

std::uint32_t AlbedoTexels::Picture::at(const glm::vec2& uv) const {
    if (texels.empty())
        return 0xffffffffu;
    const float u = matrix.x * uv.x + matrix.y * uv.y + offset.x;
    const float v = matrix.z * uv.x + matrix.w * uv.y + offset.y;
    return texels[static_cast<std::size_t>(texelIndex(v, height)) *
                      static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(texelIndex(u, width))];
}

AlbedoTexels::Picture AlbedoTexels::picture(const MapSlot& map, bool isColor) {
    Picture picture;
    if (!map.image || map.image->empty())
        return picture;
    picture.matrix = uvMatrix(map);
    picture.offset = map.uvOffset;
    const bool large = std::max(map.image->width(), map.image->height()) > kMaxSide;
    const Image small = large ? shrinkImage(*map.image, kMaxSide) : Image();
    const Image& image = large ? small : *map.image;
    picture.width = image.width();
    picture.height = image.height();
    picture.texels.reserve(static_cast<std::size_t>(picture.width) *
                           static_cast<std::size_t>(picture.height));
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const glm::vec4 texel = image.linear(x, y);
            const bool whole = isColor && map.channel == MapChannel::Rgb;
            const float one = component(texel, map.channel);
            picture.texels.push_back(whole ? encode(texel.r) | encode(texel.g) << 8 |
                                                 encode(texel.b) << 16
                                           : encode(one) * 0x010101u);
        }
    return picture;
}

AlbedoTexels::AlbedoTexels(const BakeSurface& surface)
    : m_color(picture(surface.baseColorMap, true))
    , m_metallic(picture(surface.metallicMap, false)) {}

std::uint32_t AlbedoTexels::at(const glm::vec2& uv) const {
    return (m_color.at(uv) & 0xffffffu) | (m_metallic.at(uv) & 0xffu) << 24;
}

DiffuseAlbedo::DiffuseAlbedo(const BakeSurface& surface) {
    const std::array<float, 256>& decode = srgbTable8();
    for (std::size_t code = 0; code < 256; ++code) {
        for (int c = 0; c < 3; ++c)
            m_byCode[static_cast<std::size_t>(c)][code] =
                std::clamp(surface.baseColor[c] * decode[code], 0.0f, 1.0f);
        m_byCode[3][code] = 1.0f - std::clamp(surface.metallic * decode[code], 0.0f, 1.0f);
    }
}

} // namespace patina
