// What the lighting modes have in common.
#pragma once

#include "core/document/Views.h"

#include <algorithm>
#include <glm/vec2.hpp>

namespace patina {

// Light arrives as a bake of radiance transfer says.
[[nodiscard]] bool readsBake(LightingMode mode);

// Classical light, which no occlusion, be it a map or a bake, takes anything from.
[[nodiscard]] bool hidesNothing(LightingMode mode);

// How a view is lit: some stand for a way of their own.
[[nodiscard]] LightingMode lightingOf(ViewKind kind, LightingMode ofDocument);

// Weights of diffuse light (x) and of reflections (y) for View::reflectionMix: both 1 in the
// middle.
[[nodiscard]] constexpr glm::vec2 mixWeights(float reflectionMix) {
    return {std::min(1.0f, 2.0f * (1.0f - reflectionMix)), std::min(1.0f, 2.0f * reflectionMix)};
}

} // namespace patina
