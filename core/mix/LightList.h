// What gives light in a document, by name: for reports and panels, and to tell a scene that brings
// light of its own from a bare model.
#pragma once

#include "core/document/Document.h"

#include <string>
#include <vector>

namespace patina {

enum class LightKind { Environment, Light, Glow }; // Glow: a mesh whose material emits

struct LightName {
    LightKind kind = LightKind::Environment;
    std::string name; // of the environment, the light, the mesh
    friend bool operator==(const LightName&, const LightName&) = default;
};

// Those that take part in the mix, environments first, then lights, then visible meshes that glow,
// each in the document's order.
[[nodiscard]] std::vector<LightName> lightNames(const Document& document);
// "environment Studio, light Key, glowing mesh Panel"; "nothing".
[[nodiscard]] std::string lightNamesText(const std::vector<LightName>& names);

// Whether something other than an environment gives light.
[[nodiscard]] bool hasLightOfItsOwn(const Document& document);

} // namespace patina
