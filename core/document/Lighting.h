// What the lighting modes have in common.
#pragma once

#include "core/document/View.h"
#include "core/document/Views.h"

#include <algorithm>
#include <glm/vec2.hpp>

namespace patina {

// Light arrives as a bake of radiance transfer says.
[[nodiscard]] constexpr bool readsBake(LightingMode mode) {
    return mode == LightingMode::Shadowed || mode == LightingMode::Prt;
}

// Classical light, which no occlusion, be it a map or a bake, takes anything from.
[[nodiscard]] constexpr bool hidesNothing(LightingMode mode) {
    return mode == LightingMode::Cosine || mode == LightingMode::ShIrradiance ||
           mode == LightingMode::Unshadowed;
}

// How a view is lit: some stand for a way of their own.
[[nodiscard]] inline LightingMode lightingOf(ViewKind kind, LightingMode ofDocument) {
    return viewInfo(kind).lighting.value_or(ofDocument);
}

// Weights of diffuse light (x) and of reflections (y) for View::reflectionMix: both 1 in the
// middle.
[[nodiscard]] constexpr glm::vec2 mixWeights(float reflectionMix) {
    return {std::min(1.0f, 2.0f * (1.0f - reflectionMix)), std::min(1.0f, 2.0f * reflectionMix)};
}

} // namespace patina
