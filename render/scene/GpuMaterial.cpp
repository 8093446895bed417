#include "render/scene/GpuMaterial.h"

#include "core/material/MapUv.h"
#include "core/material/Material.h"
#include "render/scene/MapFetches.h"
#include "render/shader/GeneratedShaders.h"

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

MapBlock packMap(const MapSlot& map) {
    return {uvMatrix(map), glm::vec4(map.uvOffset, 0, 0), channelWeights(map.channel)};
}

bool moved(const MapSlot& map) {
    return map.uvScale != glm::vec2(1.0f) || map.uvOffset != glm::vec2(0.0f) ||
           map.uvRotationDeg != 0.0f;
}

bool missing(const MapSlot& map) {
    return map.assigned() && !map.image;
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
    block.normalBasis = normalBasis(m.normalMap);
    block.normalGreenUp = m.normalConvention == NormalConvention::OpenGl ? 1.0f : -1.0f;
    block.placeholder = placeholderShare(m);
    block.diffuseRoughness = m.diffuseRoughness;
    block.ior = m.ior;
    std::size_t numbers = 0;
    for (const MaterialInputInfo& info : kMaterialInputs) {
        if (info.number != nullptr)
            block.numbers[numbers++] = m.*info.number;
        block.maps[info.input] = packMap(m.*info.map);
    }
    return block;
}

static SurfaceFeatures featuresOf(const Material& m,
                                  const PerInput<std::optional<MapFetch>>& fetches) {
    SurfaceFeatures result;
    unsigned& features = result.flags;
    for (const MaterialInputInfo& info : kMaterialInputs) {
        const std::optional<MapFetch>& fetch = fetches[info.input];
        if (!fetch)
            continue;
        const MapSlot& map = m.*info.map;
        if (moved(map))
            features |= HasMovedMaps;
        if (info.role == InputRole::Color && map.channel != MapChannel::Rgb)
            features |= HasPickedColors;
        MapUse& use = result.maps[info.input];
        use.used = true;
        if (readsOneChannel(info)) {
            use.channel = static_cast<std::uint8_t>(fetch->channel);
            use.texelOf = static_cast<std::uint8_t>(fetch->owner);
        }
    }
    if (m.alphaMode == AlphaMode::Mask)
        features |= AlphaMasked;
    if (m.alphaMode == AlphaMode::Blend)
        features |= AlphaBlended;
    if (m.doubleSided)
        features |= DoubleSided;
    if (placeholderShare(m) > 0.0f)
        features |= HasPlaceholder;
    if (m.transmission > 0.0f)
        features |= HasTransmission | (m.thinWalled ? ThinWalled : 0u);
    if (m.ior != shading::kDielectricIor)
        features |= HasIor;
    return result;
}

SurfaceFeatures materialFeatures(const Material& m) {
    return featuresOf(m, mapFetches(m));
}

SurfaceFeatures coverageFeatures(const SurfaceFeatures& features) {
    SurfaceFeatures result;
    if (!features.has(AlphaMasked))
        return result;
    result.flags = features.flags & (AlphaMasked | HasMovedMaps);
    result.maps[MaterialInput::BaseColor] = features.maps[MaterialInput::BaseColor];
    return result;
}

void bindMap(const GpuMaterial& material, MaterialInput input) {
    if (const TexturePtr& texture = material.maps[input])
        texture->bind(mapUnit(input));
}

void updateGpuMaterial(gl::Context& context, TextureCache& textures, const Material& material,
                       GpuMaterial& gpu) {
    gpu.values = packMaterial(material);
    if (gpu.block.empty())
        gpu.block = gl::Buffer(context, "material", sizeof(MaterialBlock));
    gpu.block.writeValue(gpu.values);
    const auto fetches = mapFetches(material);
    for (const MaterialInputInfo& info : kMaterialInputs) {
        const std::optional<MapFetch>& fetch = fetches[info.input];
        const bool owns = fetch && fetch->owner == info.input;
        gpu.maps[info.input] = owns ? textures.texture(fetch->texture) : nullptr;
    }
    gpu.features = featuresOf(material, fetches);
    gpu.alphaMode = material.alphaMode;
    gpu.doubleSided = material.doubleSided;
}

} // namespace patina::render
