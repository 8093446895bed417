// A material as the surface shader wants it: numbers in a uniform block, maps as textures, and
// which variant of the shader they need.
#pragma once

#include "core/material/Material.h"
#include "render/gl/Buffer.h"
#include "render/gl/Texture.h"
#include "render/scene/Blocks.h"

#include <array>
#include <set>

namespace patina::render {

class TextureCache;

// Bits of a surface variant; the names of the defines are in render/pass/SurfacePass.cpp. What most
// materials do not need, and every uniform that is not read, counts: software OpenGL gathers each
// number of a uniform block for each pixel.
enum SurfaceFeature : unsigned {
    HasMovedMaps = 1u << 24,    // a map is scaled, shifted or turned
    HasPickedColors = 1u << 25, // a colour map gives one of its channels
    HasBaseColorMap = 1u << 0,
    HasMetallicMap = 1u << 1,
    HasRoughnessMap = 1u << 2,
    HasNormalMap = 1u << 3,
    HasOcclusionMap = 1u << 4,
    HasEmissiveMap = 1u << 5,
    RoughnessIsPacked = 1u << 6, // in the same texel as metallic
    OcclusionIsPacked = 1u << 7,
    AlphaMasked = 1u << 8,
    AlphaBlended = 1u << 9,
    DoubleSided = 1u << 10,
    HasPlaceholder = 1u << 11,
    HasTexelAo = 1u << 12,
    HasVertexAo = 1u << 13,
    HasTransfer = 1u << 14,
    HasPunctualLights = 1u << 15, // points, spots, directional lights
    HasAreaLights = 1u << 16,     // spheres, rectangles
    HasShadows = 1u << 17,        // of one spot or directional light
    HasShadows2 = 1u << 18,       // … of a second one …
    HasShadows3 = 1u << 19,
    HasShadows4 = 1u << 20,
    HasDominantLight = 1u << 21, // that stands for the environment
    HasTexelTransfer = 1u << 22, // transfer is looked up in texels
    HasTransferCone = 1u << 23,  // a bake says what is visible
};
inline constexpr int kSurfaceFeatureCount = 24;

// Two bits each: which channel of the map counts, R G B A.
inline constexpr unsigned kMetallicChannelShift = 26, kRoughnessChannelShift = 28,
                          kOcclusionChannelShift = 30;

inline constexpr std::size_t kMaterialMapCount = 6; // texture units 0…5, order of the block

struct GpuMaterial {
    MaterialBlock values;
    gl::Buffer block;
    std::array<const gl::Texture*, kMaterialMapCount> maps{}; // null: none; owned by the cache
    unsigned features = 0;
    AlphaMode alphaMode = AlphaMode::Opaque;
    bool doubleSided = false;
};

// The numbers alone; no OpenGL.
[[nodiscard]] MaterialBlock packMaterial(const Material& material);
// Which maps are usable, shared, missing; no OpenGL.
[[nodiscard]] unsigned materialFeatures(const Material& material);
[[nodiscard]] std::set<ImagePtr> materialImages(const Material& material);

// Rewrites `gpu` after an edit, creating the block on first use.
void updateGpuMaterial(gl::Context& context, TextureCache& textures, const Material& material,
                       GpuMaterial& gpu);

} // namespace patina::render
