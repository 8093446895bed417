#include "core/mix/LightMix.h"

#include "core/light/Light.h"

#include <algorithm>
#include <cmath>

namespace patina {

bool anySolo(const Document& document) {
    const Environment* second = document.secondEnvironment();
    return document.environment().solo || (second && second->solo) ||
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
glm::vec3 scaleOf(const Document& document, const Environment& environment, bool solo,
                  float share) {
    if (!environment.enabled || (!solo && anySolo(document)))
        return glm::vec3(0.0f);
    return environment.tint * (share * std::exp2(environment.exposureEv));
}

// Where the cross-fade stands: one environment alone is shown in full.
float effectiveFade(const Document& document) {
    const Environment* second = document.secondEnvironment();
    if (!second || !second->image || !second->problem.empty())
        return 0.0f; // a grey that stands in is nothing to fade to
    const bool solo = document.environment().solo;
    if (solo != second->solo)
        return solo ? 0.0f : 1.0f;
    return document.mix.fade;
}

void addPart(std::vector<EnvironmentPart>& parts, EnvironmentPart::Role role,
             const Environment& environment, const glm::vec3& scale) {
    if (environment.image && scale != glm::vec3(0.0f))
        parts.push_back({role, environment.image, orientationOf(environment), scale});
}

// The one part, or what stands where there is none: without a picture a grey one, which is mixed
// all the same.
EnvironmentPart onlyPart(const std::vector<EnvironmentPart>& parts, const Environment& first,
                         const glm::vec3& scale) {
    if (!parts.empty())
        return parts.front();
    return {EnvironmentPart::Role::First, first.image, orientationOf(first), scale};
}

} // namespace

std::vector<EnvironmentPart> environmentParts(const Document& document,
                                              const Environment& environment) {
    std::vector<EnvironmentPart> parts;
    addPart(parts, EnvironmentPart::Role::First, environment,
            scaleOf(document, environment, document.environment().solo, 1.0f));
    return parts;
}

std::vector<EnvironmentPart> environmentParts(const Document& document) {
    const Environment& first = document.environment();
    const float fade = effectiveFade(document);
    std::vector<EnvironmentPart> parts;
    addPart(parts, EnvironmentPart::Role::First, first,
            scaleOf(document, first, first.solo, 1.0f - fade));
    if (const Environment* second = document.secondEnvironment())
        addPart(parts, EnvironmentPart::Role::Second, *second,
                scaleOf(document, *second, second->solo, fade));
    return parts;
}

EnvironmentPart shownEnvironment(const Document& document, const Environment& environment) {
    return onlyPart(environmentParts(document, environment), environment,
                    scaleOf(document, environment, document.environment().solo, 1.0f));
}

EnvironmentPart shownEnvironment(const Document& document) {
    const std::vector<EnvironmentPart> parts = environmentParts(document);
    const Environment& first = document.environment();
    if (parts.size() == 2 && document.mix.blended)
        return {EnvironmentPart::Role::Both,
                document.mix.blended,
                {first.rotationDeg}, // tilt and roll of both are in the picture
                glm::vec3(1.0f)};
    return onlyPart(parts, first,
                    scaleOf(document, first, first.solo, 1.0f - effectiveFade(document)));
}

} // namespace patina
