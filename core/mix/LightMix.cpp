#include "core/mix/LightMix.h"

#include <algorithm>
#include <cmath>

namespace patina {

bool anySolo(const Document& document) {
    const Environment& environment = document.environment;
    return environment.solo || (!environment.second.source.empty() && environment.second.solo) ||
           std::any_of(document.lights.begin(), document.lights.end(),
                       [](const Light& light) { return light.solo; });
}

bool isActive(const Document& document, const Light& light) {
    return light.enabled && (light.solo || !anySolo(document));
}

std::vector<const Light*> activeLights(const Document& document) {
    const bool solo = anySolo(document); // asked once: there may be thousands of lights
    std::vector<const Light*> lights;
    for (const Light& light : document.lights)
        if (light.enabled && (light.solo || !solo))
            lights.push_back(&light);
    return lights;
}

namespace {

// What its radiance is multiplied by; zero: it takes no part.
template <class Part>
glm::vec3 scaleOf(const Document& document, const Part& environment, float share) {
    if (!environment.enabled || (!environment.solo && anySolo(document)))
        return glm::vec3(0.0f);
    return environment.tint * (share * std::exp2(environment.exposureEv));
}

// Where the cross-fade stands: one environment alone is shown in full.
float effectiveFade(const Environment& first) {
    const SecondEnvironment& second = first.second;
    if (!second.image)
        return 0.0f;
    if (first.solo != second.solo)
        return first.solo ? 0.0f : 1.0f;
    return first.fade;
}

} // namespace

std::vector<EnvironmentPart> environmentParts(const Document& document) {
    const Environment& first = document.environment;
    const SecondEnvironment& second = first.second;
    std::vector<EnvironmentPart> parts;
    const auto add = [&](EnvironmentPart::Role role, const auto& environment, float share) {
        const glm::vec3 scale = scaleOf(document, environment, share);
        if (environment.image && scale != glm::vec3(0.0f))
            parts.push_back({role, environment.image, environment.rotationDeg, scale});
    };
    const float fade = effectiveFade(first);
    add(EnvironmentPart::Role::First, first, 1.0f - fade);
    if (second.image)
        add(EnvironmentPart::Role::Second, second, fade);
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
    // Without a picture a grey one stands in, which is mixed all the same.
    return {EnvironmentPart::Role::First, environment.image, environment.rotationDeg,
            scaleOf(document, environment, 1.0f - effectiveFade(environment))};
}

} // namespace patina
