// Everything the shader computed at one pixel, in its own numbers.
#pragma once

#include "core/base/Id.h"
#include "core/document/ToneResponse.h"
#include "core/document/Views.h"
#include "render/view/ViewSettings.h"

#include <array>
#include <bitset>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace patina::render {

struct LightShare {
    Id light = 0;
    glm::vec3 toLight{0.0f};  // unit, world; of area lights: to the centre
    glm::vec3 arriving{0.0f}; // irradiance of a surface that faces the light, shadow included
    float shadow = 1.0f;      // share of the light that is not in shadow
    glm::vec3 diffuse{0.0f}, specular{0.0f}; // reflected radiance
};

struct Inspection {
    int x = 0, y = 0;          // pixel, from the top left
    int width = 0, height = 0; // of the frame that was looked at
    Id mesh = 0, material = 0; // 0: no surface there; then only `final` and `displayed` count
    std::array<glm::vec4, shading::kRecordCount> values{}; // raw, by kView…, kRecord…
    std::bitset<shading::kRecordCount> recorded; // which of these the shader wrote; the rest is 0
    std::array<glm::vec4, shading::kViewCount> contributions{}; // radiance
    std::vector<LightShare> lights;                             // shining, in the document's order
    glm::vec4 radiance{0.0f};  // of the picture before exposure, premultiplied
    Luminance luminance;       // what exposure goes by, where it is automatic
    glm::vec3 exposed{0.0f};   // after exposure, before the tone curve
    glm::vec4 displayed{0.0f}; // 0…1, encoded, as on the screen (straight alpha)
    ViewSettings view; // of the frame: the picture is the sum of its terms, whatever it shows

    [[nodiscard]] bool onSurface() const { return mesh != 0; }
    [[nodiscard]] glm::vec4 value(int record) const {
        return values[static_cast<std::size_t>(record)];
    }
};

// Radiance is recorded premultiplied by its opacity.
[[nodiscard]] inline glm::vec3 straight(const glm::vec4& premultiplied) {
    return premultiplied.w > 0.0f ? glm::vec3(premultiplied) / premultiplied.w : glm::vec3(0.0f);
}

} // namespace patina::render
