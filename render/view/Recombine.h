// The colour of a pixel a second time, on the CPU: from the factors that the shader recorded,
// through the functions of shaders/shared that it is made of. What it computed from them is not
// looked at.
#pragma once

#include "core/document/Document.h"
#include "core/math/Shading.h"
#include "render/view/Inspection.h"

#include <array>
#include <optional>
#include <vector>

namespace patina::render {

struct RebuiltLight {
    Id light = 0;
    // Directional, point and spot lights: the angles and terms of their one direction.
    float NoL = 0.0f, NoH = 0.0f, VoH = 0.0f;
    float D = 0.0f, V = 0.0f;                    // V = G / (4 N·L N·V)
    glm::vec3 F{0.0f}, diffuseBrdf{0.0f};        // without kD
    float diffuseShare = 0.0f, lobeShare = 0.0f; // area lights: form factors, 0…1
    glm::vec3 diffuse{0.0f}, specular{0.0f};     // reflected radiance

    [[nodiscard]] glm::vec3 sum() const { return diffuse + specular; }
};

struct RebuiltPixel {
    shading::SurfaceTerms surface;
    bool transfer = false;     // the irradiance is baked transfer's, that of lights included
    bool radiosity = false;    // with transfer: it is radiosity's
    bool lightMap = false;     // a light map corrects the irradiance and what is reflected
    float ao = 1.0f;           // factor on the irradiance: 1 where baked transfer knows the shadows
    float open = 1.0f;         // of the specular lobe
    glm::vec3 reflected{0.0f}; // radiance that the lobe's albedo multiplies
    glm::vec2 mix{1.0f};       // weights of diffuse light and of reflections
    std::vector<RebuiltLight> lights; // as in Inspection::lights
    // Diffuse and specular image-based, direct diffuse and specular, emission: radiance.
    std::array<glm::vec3, kTermCount> terms{};
    glm::vec3 sum{0.0f}; // of the terms that the picture is made of
    float alpha = 1.0f;  // of the surface
    // What lies behind a blended surface, premultiplied; zero where the sum is the whole picture.
    glm::vec3 rest{0.0f};
    glm::vec3 radiance{0.0f}; // straight: what exposure begins with
    glm::vec3 exposed{0.0f};
    std::optional<glm::vec3> displayed; // 0…1, encoded; nothing: OpenColorIO runs on the GPU only
};

// What the material says of the point that the pixel shows, its maps included.
[[nodiscard]] shading::SurfaceInputs surfaceInputs(const Inspection& pixel,
                                                   const Material& material);

// `pixel` must lie on a surface.
[[nodiscard]] RebuiltPixel recombine(const Inspection& pixel, const Document& document);

// Exposure and display of `radiance` in the light of that picture; works beside surfaces, too.
void expose(RebuiltPixel& rebuilt, const Inspection& pixel, const Document& document);

} // namespace patina::render
