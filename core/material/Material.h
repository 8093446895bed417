// A metallic-roughness material as plain values. Its editable numbers are described once, in the
// parameter table (core/edit/Parameters.h).
#pragma once

#include "core/base/Id.h"
#include "core/image/Image.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>

namespace patina {

enum class MapChannel { Rgb, R, G, B, A };

// An image that varies a parameter over the surface. Map values multiply the parameter's number
// (the normal map is scaled by it).
struct MapSlot {
    // Where the image came from: an absolute path (UTF-8), "builtin:NAME", or
    // "PATH-OF-MODEL#embedded:INDEX". Empty: no map.
    std::string source;
    ImagePtr image;      // null when there is no map, or when it could not be read
    std::string problem; // why it could not be read; the viewport then shows a placeholder
    MapChannel channel = MapChannel::Rgb;
    glm::vec2 uvScale{1.0f}, uvOffset{0.0f};
    float uvRotationDeg = 0.0f;

    [[nodiscard]] bool assigned() const { return !source.empty() || image != nullptr; }
    // Images compare by identity: they are immutable.
    friend bool operator==(const MapSlot&, const MapSlot&) = default;
};

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

    friend bool operator==(const Material&, const Material&) = default;
};

} // namespace patina
