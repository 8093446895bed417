// A material as the surface shader wants it: numbers in a uniform block, maps as textures, and
// which variant of the shader they need.
#pragma once

#include "core/material/MaterialInput.h"
#include "render/gl/Buffer.h"
#include "render/scene/Blocks.h"
#include "render/scene/TextureCache.h"

#include <cstdint>

namespace patina::render {

// Bits of a surface variant; the names of the defines are in render/pass/SurfacePass.cpp. What most
// materials do not need, and every uniform that is not read, counts: software OpenGL gathers each
// number of a uniform block for each pixel.
enum SurfaceFeature : unsigned {
    HasMovedMaps = 1u << 0,    // a map is scaled, shifted or turned
    HasPickedColors = 1u << 1, // a colour map gives one of its channels
    AlphaMasked = 1u << 2,
    AlphaBlended = 1u << 3,
    DoubleSided = 1u << 4,
    HasPlaceholder = 1u << 5,
    HasTexelAo = 1u << 6,
    HasVertexAo = 1u << 7,
    HasTransfer = 1u << 8,
    HasPunctualLights = 1u << 9, // points, spots, directional lights
    HasAreaLights = 1u << 10,    // spheres, rectangles
    HasShadows = 1u << 11,       // of one spot or directional light
    HasShadows2 = 1u << 12,      // … of a second one …
    HasShadows3 = 1u << 13,
    HasShadows4 = 1u << 14,
    HasDominantLight = 1u << 15, // that stands for the environment
    HasTexelTransfer = 1u << 16, // transfer is looked up in texels
    HasTransferCone = 1u << 17,  // a bake says what is visible
    HasTransmission = 1u << 18,  // MaterialInputInfo::rare
    HasIor = 1u << 19,           // a refractive index other than the standard one
    ThinWalled = 1u << 20,       // with HasTransmission
    HasLightMap = 1u << 21,      // corrects image-based light
    HasRadiosity = 1u << 22,     // with HasTransfer: that of radiosity's elements
    HasShIrradiance = 1u << 23,  // nine coefficients in place of the exact irradiance
};
inline constexpr int kSurfaceFeatureCount = 24;

// How a variant reads the map of an input.
struct MapUse {
    bool used = false;
    // Of an input that reads one channel: which of its texture, R G B A; and the input whose texel
    // that is (MapFetch::owner).
    std::uint8_t channel = 0;
    std::uint8_t texelOf = 0;
    friend auto operator<=>(const MapUse&, const MapUse&) = default;
};

struct SurfaceFeatures {
    unsigned flags = 0; // of SurfaceFeature
    PerInput<MapUse> maps;
    [[nodiscard]] bool has(unsigned feature) const { return (flags & feature) != 0; }
    friend auto operator<=>(const SurfaceFeatures&, const SurfaceFeatures&) = default;
};

// What says where a surface has holes: for passes that draw no light.
[[nodiscard]] SurfaceFeatures coverageFeatures(const SurfaceFeatures& features);

struct GpuMaterial {
    MaterialBlock values;
    gl::Buffer block;
    PerInput<TexturePtr> maps; // of the inputs that own a fetch; null: none
    SurfaceFeatures features;
    AlphaMode alphaMode = AlphaMode::Opaque;
    bool doubleSided = false;
};

// The numbers alone; no OpenGL.
[[nodiscard]] MaterialBlock packMaterial(const Material& material);
// Which maps are usable, shared, missing; no OpenGL.
[[nodiscard]] SurfaceFeatures materialFeatures(const Material& material);

// Binds the texture that the input owns, if there is one, to its unit.
void bindMap(const GpuMaterial& material, MaterialInput input);

// Rewrites `gpu` after an edit, creating the block on first use. Textures that it showed before,
// and that nobody else shows, are gone then.
void updateGpuMaterial(gl::Context& context, TextureCache& textures, const Material& material,
                       GpuMaterial& gpu);

} // namespace patina::render
