// How much each channel of the light mix gives, as a mixing desk's meters show it.
#pragma once

#include "core/document/Document.h"

namespace patina {

// Illuminance (lux) at the scene's centre of a surface that faces the light, without shadows; 0
// where it does not shine.
[[nodiscard]] float lightLevel(const Document& document, const Light& light);

// Luminance of the irradiance of a surface that faces up, of a picture as it is (lat-long, F32, 3
// channels): what a lux meter that lies on the ground shows. 10 ms for 2048 × 1024 pixels.
[[nodiscard]] float upwardIlluminance(const Image& picture);

} // namespace patina
