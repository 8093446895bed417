#include "render/scene/GpuMaterial.h"

#include "core/material/MapUv.h"
#include "render/scene/TextureCache.h"

#include <glm/geometric.hpp>
#include <utility>

namespace patina::render {

namespace {

// Of a colour map: Rgb is the colour itself.
glm::vec4 channelWeights(MapChannel channel) {
    switch (channel) {
    case MapChannel::Rgb:
        return {-1, 0, 0, 0};
    case MapChannel::R:
        return {1, 0, 0, 0};
    case MapChannel::G:
        return {0, 1, 0, 0};
    case MapChannel::B:
        return {0, 0, 1, 0};
    case MapChannel::A:
        return {0, 0, 0, 1};
    }
    return {-1, 0, 0, 0};
}

// Of a map of numbers, which reads one channel: its index; Rgb means red.
unsigned channelIndex(MapChannel channel) {
    switch (channel) {
    case MapChannel::Rgb:
    case MapChannel::R:
        return 0;
    case MapChannel::G:
        return 1;
    case MapChannel::B:
        return 2;
    case MapChannel::A:
        return 3;
    }
    return 0;
}

MapBlock packMap(const MapSlot& map) {
    return {uvMatrix(map), glm::vec4(map.uvOffset, 0, 0), channelWeights(map.channel)};
}

bool moved(const MapSlot& map) {
    return map.uvScale != glm::vec2(1.0f) || map.uvOffset != glm::vec2(0.0f) ||
           map.uvRotationDeg != 0.0f;
}

// A map that is turned or mirrored on the surface takes its slopes along: its x points where u'
// grows, its y where v' shrinks, in the frame (tangent, bitangent) = (growing u, shrinking v).
glm::vec4 normalBasis(const MapSlot& map) {
    const glm::vec4 m = uvMatrix(map);
    const auto unit = [](glm::vec2 d, glm::vec2 fallback) {
        const float length = glm::length(d);
        return length > 0.0f ? d / length : fallback;
    };
    const glm::vec2 x = unit({m.x, -m.y}, {1, 0});
    const glm::vec2 y = unit({-m.z, m.w}, {0, 1});
    return {x.x, y.x, x.y, y.y};
}

bool missing(const MapSlot& map) {
    return map.assigned() && !map.image;
}

bool sameTexels(const MapSlot& a, const MapSlot& b) {
    return a.image && a.image == b.image && a.uvScale == b.uvScale && a.uvOffset == b.uvOffset &&
           a.uvRotationDeg == b.uvRotationDeg;
}

// In the order of the texture units.
std::array<const MapSlot*, kMaterialMapCount> slots(const Material& m) {
    return {&m.baseColorMap, &m.metallicMap,  &m.perceptualRoughnessMap,
            &m.normalMap,    &m.occlusionMap, &m.emissiveMap};
}

// How much of the surface the pattern covers: all of it in place of a base colour that is missing.
// Where numbers are missing, the material's factor stands for them, and the colour that is there
// can still be judged; their slots say what they lack.
float placeholderShare(const Material& m) {
    return missing(m.baseColorMap) ? 1.0f : 0.0f;
}

} // namespace

MaterialBlock packMaterial(const Material& m) {
    MaterialBlock block;
    block.baseColor = glm::vec4(m.baseColor, m.opacity);
    // A missing emissive map would set the whole surface aglow.
    const float emission = missing(m.emissiveMap) ? 0.0f : m.emissiveStrength;
    block.emissive = glm::vec4(m.emissive * emission, m.alphaCutoff);
    block.metallic = m.metallic;
    block.perceptualRoughness = m.perceptualRoughness;
    block.occlusionStrength = m.occlusionStrength;
    block.normalStrength = m.normalStrength;
    block.normalBasis = normalBasis(m.normalMap);
    block.normalGreenUp = m.normalConvention == NormalConvention::OpenGl ? 1.0f : -1.0f;
    block.placeholder = placeholderShare(m);
    block.diffuseRoughness = m.diffuseRoughness;
    block.baseColorMap = packMap(m.baseColorMap);
    block.metallicMap = packMap(m.metallicMap);
    block.roughnessMap = packMap(m.perceptualRoughnessMap);
    block.normalMap = packMap(m.normalMap);
    block.occlusionMap = packMap(m.occlusionMap);
    block.emissiveMap = packMap(m.emissiveMap);
    return block;
}

unsigned materialFeatures(const Material& m) {
    unsigned features = 0;
    const auto maps = slots(m);
    for (std::size_t i = 0; i < maps.size(); ++i)
        if (maps[i]->image)
            features |= 1u << i; // HasBaseColorMap … HasEmissiveMap
    for (const MapSlot* map : maps)
        if (map->image && moved(*map))
            features |= HasMovedMaps;
    for (const MapSlot* map : {&m.baseColorMap, &m.emissiveMap})
        if (map->image && map->channel != MapChannel::Rgb)
            features |= HasPickedColors;
    for (const auto& [map, shift] : {std::pair(&m.metallicMap, kMetallicChannelShift),
                                     std::pair(&m.perceptualRoughnessMap, kRoughnessChannelShift),
                                     std::pair(&m.occlusionMap, kOcclusionChannelShift)})
        if (map->image)
            features |= channelIndex(map->channel) << shift;
    if (sameTexels(m.metallicMap, m.perceptualRoughnessMap))
        features |= RoughnessIsPacked;
    if (sameTexels(m.metallicMap, m.occlusionMap))
        features |= OcclusionIsPacked;
    if (m.alphaMode == AlphaMode::Mask)
        features |= AlphaMasked;
    if (m.alphaMode == AlphaMode::Blend)
        features |= AlphaBlended;
    if (m.doubleSided)
        features |= DoubleSided;
    if (placeholderShare(m) > 0.0f)
        features |= HasPlaceholder;
    return features;
}

std::set<ImagePtr> materialImages(const Material& material) {
    std::set<ImagePtr> images;
    for (const MapSlot* map : slots(material))
        if (map->image)
            images.insert(map->image);
    return images;
}

void updateGpuMaterial(gl::Context& context, TextureCache& textures, const Material& material,
                       GpuMaterial& gpu) {
    gpu.values = packMaterial(material);
    if (gpu.block.empty())
        gpu.block = gl::Buffer(context, "material", sizeof(MaterialBlock));
    gpu.block.writeValue(gpu.values);
    const auto maps = slots(material);
    for (std::size_t i = 0; i < maps.size(); ++i)
        gpu.maps[i] = maps[i]->image ? textures.texture(maps[i]->image) : nullptr;
    gpu.features = materialFeatures(material);
    gpu.alphaMode = material.alphaMode;
    gpu.doubleSided = material.doubleSided;
}

} // namespace patina::render
