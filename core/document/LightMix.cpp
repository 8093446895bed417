#include "core/document/LightMix.h"

#include <algorithm>
#include <cmath>

namespace patina {

bool anySolo(const Document& document) {
    const Environment& environment = document.environment;
    return environment.solo || (!environment.second.source.empty() && environment.second.solo) ||
           std::any_of(document.lights.begin(), document.lights.end(),
                       [](const Light& light) { return light.solo; });
}

bool shines(const Document& document, const Light& light) {
    return light.enabled && (light.solo || !anySolo(document));
}

std::vector<EnvironmentPart> environmentParts(const Document& document) {
    const Environment& first = document.environment;
    const SecondEnvironment& second = first.second;
    const bool solo = anySolo(document);
    const bool fades = second.image != nullptr;
    std::vector<EnvironmentPart> parts;
    const auto add = [&](EnvironmentPart::Role role, const auto& environment, float share) {
        const glm::vec3 scale = environment.tint * (share * std::exp2(environment.exposureEv));
        if (environment.image && environment.enabled && (environment.solo || !solo) &&
            scale != glm::vec3(0.0f))
            parts.push_back({role, environment.image, environment.rotationDeg, scale});
    };
    add(EnvironmentPart::Role::First, first, fades ? 1.0f - first.fade : 1.0f);
    if (fades)
        add(EnvironmentPart::Role::Second, second, first.fade);
    return parts;
}

EnvironmentPart shownEnvironment(const Document& document) {
    const std::vector<EnvironmentPart> parts = environmentParts(document);
    const Environment& environment = document.environment;
    if (parts.size() == 2 && environment.blended)
        return {EnvironmentPart::Role::Both, environment.blended, environment.rotationDeg,
                glm::vec3(1.0f)};
    if (!parts.empty())
        return parts.front();
    return {EnvironmentPart::Role::First, environment.image, environment.rotationDeg,
            glm::vec3(0.0f)};
}

} // namespace patina
