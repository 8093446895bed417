// The picture as an equation: the sum of its terms, and every term as the product of its factors.
// The equation bar shows it; what is written here holds for the numbers of the views themselves.
#pragma once

#include "core/document/Document.h"
#include "core/document/Views.h"

#include <cstddef>
#include <optional>
#include <span>

namespace patina {

enum class LightType;

enum class Join { Plus, Times, Over };

struct EquationPart {
    Join join = Join::Plus; // to what stands before it, from left to right; of the first: Plus
    ViewKind kind = 0;
    float constant = 1.0f; // beside the view's number: 1/π or 4
};

struct Equation {
    ViewKind opened = 0; // of which it is the inside: the picture, a term, a factor
    ViewKind result = 0; // what the parts come to: `opened`, or the share of the chosen light
    std::span<const EquationPart> parts;
};

// What a view is made of under a shading model; nothing when it is not opened any further. The
// factors of direct light are those of one light that has a direction (hasFactors()). `transmits`:
// a material lets light through, so that there is a part for it.
[[nodiscard]] std::optional<Equation> equationOf(ViewKind opened, const ShadingModel& model,
                                                 bool transmits = false);

// Whether the factors are those of a chosen light: direct light, diffuse or specular.
[[nodiscard]] constexpr bool isOfOneLight(ViewKind opened) {
    return opened == shading::kViewDirectDiffuse || opened == shading::kViewDirectSpecular;
}

// Whether light of this type comes from one direction, so that D, G, F and N·L are its factors.
// Area lights are integrated over their surface.
[[nodiscard]] bool hasFactors(LightType type);

// Whether the parts before `index` are a sum that is multiplied, and so stand in brackets.
[[nodiscard]] bool closesBracket(const Equation& equation, std::size_t index);

} // namespace patina
