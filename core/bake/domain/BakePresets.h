// How finely to bake, in three steps: rays and the sides of textures. What is baked (kind,
// transport, bands, bounces, distance) they leave alone.
#pragma once

#include "core/bake/domain/BakeRequest.h"

#include <span>
#include <string_view>

namespace patina {

struct BakePreset {
    const char* name;                    // as text: "draft"
    const char* label;                   // for the user: "Draft"
    const char* help;                    // a sentence
    int occlusionSamples, occlusionSize; // rays per element, side of a texture
    int transferSamples, transferSize, bounceSamples;
    int lightMapSamples, lightMapSize;
};

// From coarse to fine; the middle one is what requests begin with.
[[nodiscard]] std::span<const BakePreset> bakePresets();
[[nodiscard]] const BakePreset* findBakePreset(std::string_view name); // null: there is none

[[nodiscard]] BakeRequest withPreset(BakeRequest request, const BakePreset& preset);
// The one whose numbers the request has, as far as its kind knows them; null: none.
[[nodiscard]] const BakePreset* presetOf(const BakeRequest& request);

} // namespace patina
