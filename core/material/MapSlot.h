// A map of a material: an image and how it lies on the surface.
#pragma once

#include "core/image/Image.h"

#include <glm/vec2.hpp>
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

} // namespace patina
