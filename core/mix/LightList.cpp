#include "core/mix/LightList.h"

#include "core/document/EnvironmentTitle.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/mix/LightMix.h"

#include <algorithm>
#include <fmt/format.h>

namespace patina {
namespace {

bool glows(const Document& document, const MeshInstance& mesh) {
    const Material* material = document.material(mesh.material);
    return mesh.visible && material != nullptr && material->emissiveStrength > 0.0f &&
           material->emissive != glm::vec3(0.0f);
}

} // namespace

std::vector<LightName> lightNames(const Document& document) {
    std::vector<LightName> names;
    for (const EnvironmentPart& part : environmentParts(document)) {
        const Environment* environment = part.role == EnvironmentPart::Role::Second
                                             ? document.secondEnvironment()
                                             : &document.environment();
        names.push_back({LightKind::Environment, environmentTitle(*environment)});
    }
    for (const Light* light : activeLights(document))
        if (light->intensity > 0.0f)
            names.push_back({LightKind::Light, light->name});
    for (const MeshInstance& mesh : document.meshes)
        if (glows(document, mesh))
            names.push_back({LightKind::Glow, mesh.name});
    return names;
}

std::string lightNamesText(const std::vector<LightName>& names) {
    constexpr std::size_t kMost = 6;
    std::string text;
    for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i) {
        const LightName& one = names[i];
        text += text.empty() ? "" : ", ";
        switch (one.kind) {
        case LightKind::Environment:
            text += fmt::format("environment {}", one.name);
            break;
        case LightKind::Light:
            text += fmt::format("light {}", one.name);
            break;
        case LightKind::Glow:
            text += fmt::format("glowing mesh {}", one.name);
            break;
        }
    }
    if (names.size() > kMost)
        text += fmt::format(", and {} more", names.size() - kMost);
    return text.empty() ? "nothing" : text;
}

bool hasLightOfItsOwn(const Document& document) {
    return std::ranges::any_of(lightNames(document), [](const LightName& one) {
        return one.kind != LightKind::Environment;
    });
}

} // namespace patina
