// A baked light map for engines: per material the irradiance that is to be added to image-based
// light, how its reflections differ, and bent normals, as EXR files beside the scene, and the few
// lines of GLSL that use them. Formulas: docs/maths/light-map.md.
#pragma once

#include "core/bake/domain/BakeArtifact.h"
#include "core/image/Image.h"

#include <array>
#include <string>
#include <string_view>

namespace patina {

// Linear floats in the texture space of TEXCOORD_0, row 0 at its v = 0.
enum class LightMapPart {
    Irradiance,  // RGB: to be added to the environment's at the shading normal; may be negative
    Reflections, // RGBA, 3 × 3 tiles, of harmonic i the one in column i % 3, row i / 3 from the
                 // top: RGB to be added to the prefiltered radiance, A: the share of that which is
                 // missing, below 0: there is more
    BentNormal,  // RGB: mean open direction, world, its length the ambient visibility, 0…1
};

struct LightMapPartInfo {
    LightMapPart part;
    std::string_view suffix; // of its file's name
    std::string_view key;    // in the glTF
    std::string_view contents;
};
inline constexpr std::array<LightMapPartInfo, 3> kLightMapParts{{
    {LightMapPart::Irradiance, "irradiance", "irradiance", "irradiance to be added"},
    {LightMapPart::Reflections, "reflections", "reflections", "reflections, 3 × 3 harmonics"},
    {LightMapPart::BentNormal, "bent-normal", "bentNormal", "bent normal × ambient visibility"},
}};

// The longer side of a part's picture for a map of `side` texels.
[[nodiscard]] int lightMapPartSide(LightMapPart part, int side);

// `texels`: of a light map bake. A map of more than `maxSide` texels (0: any) is averaged down to
// it, the tiles each for itself.
[[nodiscard]] Image lightMapPartImage(const TexelBake& texels, LightMapPart part, int maxSide);

// Ambient visibility alone, as BakeKind::AoTexel has it.
[[nodiscard]] ImagePtr ambientVisibilityOf(const TexelBake& texels);

// A fragment shader's functions that read the first two; GLSL 3.30.
[[nodiscard]] std::string lightMapShader(const std::string& scene);

} // namespace patina
