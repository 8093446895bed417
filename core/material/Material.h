// A metallic-roughness material as plain values. Its editable numbers are described once, in the
// parameter table (core/edit/Parameters.h).
#pragma once

#include "core/base/Id.h"
#include "core/material/MapSlot.h"

#include <glm/vec3.hpp>
#include <string>

namespace patina {

enum class NormalConvention { OpenGl, DirectX }; // green up (+Y) or green down (-Y)
enum class AlphaMode { Opaque, Mask, Blend };

struct Material {
    Id id = 0;
    std::string name = "Material";

    glm::vec3 baseColor{0.8f}; // linear sRGB, 0…1
    MapSlot baseColorMap;
    float metallic = 0.0f; // 0…1
    MapSlot metallicMap;
    float perceptualRoughness = 0.5f; // 0…1, alpha = its square
    float diffuseRoughness = 0.0f;    // of the diffuse lobe: 0 Lambert, 1 dust (Oren-Nayar, EON)
    MapSlot perceptualRoughnessMap;
    float normalStrength = 1.0f; // scales the normal map's xy
    MapSlot normalMap;
    NormalConvention normalConvention = NormalConvention::OpenGl;
    float occlusionStrength = 1.0f; // 0…1
    MapSlot occlusionMap;
    glm::vec3 emissive{0.0f}; // linear sRGB times emissiveStrength, nits
    MapSlot emissiveMap;
    float emissiveStrength = 1.0f;
    float opacity = 1.0f;
    AlphaMode alphaMode = AlphaMode::Opaque;
    float alphaCutoff = 0.5f;
    bool doubleSided = false;
    // Share of the light entering a non-metal that goes through it instead of into its diffuse
    // body, 0…1.
    float transmission = 0.0f;
    MapSlot transmissionMap;
    float ior = 1.5f; // refractive index of the non-metal against air, 1…3
    // A sheet without volume, which light leaves as it came. False: the surface bounds a solid
    // body, which refracts and absorbs.
    bool thinWalled = true;
    glm::vec3 attenuationColor{1.0f}; // of white light after attenuationDistance, linear sRGB
    float attenuationDistance = 0.0f; // metres; 0: the body absorbs nothing

    friend bool operator==(const Material&, const Material&) = default;
};

} // namespace patina
