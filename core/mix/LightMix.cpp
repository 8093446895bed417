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
glm::vec3 scaleOf(const Document& document, const Part& environment, bool solo, float share) {
    if (!environment.enabled || (!solo && anySolo(document)))
        return glm::vec3(0.0f);
    return environment.tint * (share * std::exp2(environment.exposureEv));
}

// Where the cross-fade stands: one environment alone is shown in full.
float effectiveFade(const Document& document, const Environment& first) {
    if (!first.second.image)
        return 0.0f;
    const bool solo = document.environment.solo;
    if (solo != document.environment.second.solo)
        return solo ? 0.0f : 1.0f;
    return first.fade;
}

} // namespace

std::vector<EnvironmentPart> environmentParts(const Document& document, const Environment& first) {
    const SecondEnvironment& second = first.second;
    std::vector<EnvironmentPart> parts;
    const auto add = [&](EnvironmentPart::Role role, const auto& environment, bool solo,
                         float share) {
        const glm::vec3 scale = scaleOf(document, environment, solo, share);
        if (environment.image && scale != glm::vec3(0.0f))
            parts.push_back({role, environment.image, environment.rotationDeg, scale});
    };
    const float fade = effectiveFade(document, first);
    add(EnvironmentPart::Role::First, first, document.environment.solo, 1.0f - fade);
    if (second.image)
        add(EnvironmentPart::Role::Second, second, document.environment.second.solo, fade);
    return parts;
}

std::vector<EnvironmentPart> environmentParts(const Document& document) {
    return environmentParts(document, document.environment);
}

EnvironmentPart shownEnvironment(const Document& document, const Environment& environment) {
    const std::vector<EnvironmentPart> parts = environmentParts(document, environment);
    if (parts.size() == 2 && environment.blended)
        return {EnvironmentPart::Role::Both, environment.blended, environment.rotationDeg,
                glm::vec3(1.0f)};
    if (!parts.empty())
        return parts.front();
    // Without a picture a grey one stands in, which is mixed all the same.
    return {EnvironmentPart::Role::First, environment.image, environment.rotationDeg,
            scaleOf(document, environment, document.environment.solo,
                    1.0f - effectiveFade(document, environment))};
}

EnvironmentPart shownEnvironment(const Document& document) {
    return shownEnvironment(document, document.environment);
}

} // namespace patina
