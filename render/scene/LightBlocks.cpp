#include "render/scene/LightBlocks.h"

#include "core/document/Views.h"
#include "core/edit/ViewReasons.h"
#include "core/light/Light.h"
#include "core/light/Lights.h"
#include "core/mix/LightMix.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>
#include <vector>

namespace patina::render {
namespace {

// The shader's loops: directional lights, points and spots, spheres, rectangles.
int loopOf(LightType type) {
    switch (type) {
    case LightType::Directional:
        return 0;
    case LightType::Point:
    case LightType::Spot:
        return 1;
    case LightType::Sphere:
        return 2;
    case LightType::Rectangle:
        return 3;
    }
    return 0;
}

LightBlock packLight(const Light& light, int shadowSlot) {
    const bool directional = light.type == LightType::Directional;
    LightBlock block;
    block.place = glm::vec4(directional ? light.directionToLight() : light.position,
                            static_cast<float>(shadowSlot));
    const bool ends = hasRange(light.type) && light.range > 0.0f;
    block.color = glm::vec4(lightPower(light), ends ? 1.0f / (light.range * light.range) : 0.0f);
    switch (light.type) {
    case LightType::Spot: {
        const auto [scale, offset] = coneScaleOffset(light);
        block.axis = glm::vec4(light.directionToLight() * scale, offset);
        break;
    }
    case LightType::Point:
    case LightType::Directional:
        block.axis = glm::vec4(0.0f, 0.0f, 0.0f, 1.0f); // a cone that holds every direction
        break;
    case LightType::Sphere:
        block.axis = glm::vec4(light.radius, 0.0f, 0.0f, 0.0f);
        break;
    case LightType::Rectangle: {
        const RectangleAxes axes = rectangleAxes(light);
        block.axis = glm::vec4(0.5f * light.width * axes.x, 0.0f);
        block.side = glm::vec4(0.5f * light.height * axes.y, 0.0f);
        break;
    }
    }
    return block;
}

// Whether a light of many counts within its range alone. One with a shadow map counts everywhere:
// views of shadows count the maps.
bool isRanged(const Light& light, std::span<const Light* const> withMaps) {
    return loopOf(light.type) == 1 && light.range > 0.0f &&
           std::ranges::find(withMaps, &light) == withMaps.end();
}

struct OrderedLights {
    std::vector<const Light*> lights;
    int firstRanged = 0; // of PackedLights, where it is not ends.y
};

// Those that are drawn, in the order of the shader's loops.
OrderedLights orderedLights(const Document& document) {
    OrderedLights result;
    std::vector<const Light*>& lights = result.lights;
    lights = activeLights(document);
    lights.resize(std::min(lights.size(), std::size_t{kMaxLights})); // lightLimits() says so
    const bool many = lights.size() > std::size_t{kUniformLights};
    std::vector<const Light*> withMaps;
    if (many)
        withMaps = castingLights(document);
    withMaps.resize(std::min(withMaps.size(), std::size_t{kMaxShadows}));
    const auto key = [&](const Light* light) {
        return std::pair(loopOf(light->type), many && isRanged(*light, withMaps));
    };
    std::ranges::stable_sort(lights, {}, key);
    result.firstRanged = static_cast<int>(
        std::ranges::lower_bound(lights, std::pair(1, true), {}, key) - lights.begin());
    return result;
}

} // namespace

std::vector<Id> lightOrder(const Document& document) {
    std::vector<Id> ids;
    for (const Light* light : orderedLights(document).lights)
        ids.push_back(light->id);
    return ids;
}

PackedLights packLights(const Document& document, std::span<const Id> shadowSlots) {
    const OrderedLights ordered = orderedLights(document);
    PackedLights packed;
    packed.firstRanged = ordered.firstRanged;
    packed.lights.reserve(ordered.lights.size());
    for (const Light* light : ordered.lights) {
        const bool casts = canCastShadow(light->type) && light->castsShadow;
        const auto slot = casts ? std::find(shadowSlots.begin(), shadowSlots.end(), light->id)
                                : shadowSlots.end();
        packed.lights.push_back(packLight(
            *light, slot == shadowSlots.end() ? -1 : static_cast<int>(slot - shadowSlots.begin())));
        for (int loop = loopOf(light->type); loop < 4; ++loop)
            packed.ends[loop] = static_cast<int>(packed.lights.size());
    }
    return packed;
}

void packLights(const Document& document, std::span<const Id> shadowSlots, FrameBlock& frame) {
    const PackedLights packed = packLights(document, shadowSlots);
    frame.lightEnds = packed.ends;
    if (packed.lights.size() <= frame.lights.size())
        std::ranges::copy(packed.lights, frame.lights.begin());
}

std::vector<LightLimit> lightLimits(const Document& document) {
    std::vector<LightLimit> limits;
    if (const std::size_t count = activeLights(document).size(); count > std::size_t{kMaxLights})
        limits.push_back({"lights", fmt::format("Only the first {} of {} lights are drawn; switch "
                                                "others off to see the rest.",
                                                kMaxLights, count)});
    if (const std::size_t count = castingLights(document).size(); count > std::size_t{kMaxShadows})
        limits.push_back(
            {"shadows", fmt::format("Only the first {} of {} lights with shadows cast "
                                    "them, and the others shine through; switch Shadow "
                                    "off where it matters least.",
                                    kMaxShadows, count)});
    if (whyEmpty(shading::kViewTransmissive, document).empty())
        limits.push_back({"transmission",
                          "Through transmissive materials the raster view shows the "
                          "environment alone, no other mesh and no absorption; "
                          "path tracing shows all."});
    return limits;
}

std::vector<const Light*> castingLights(const Document& document) {
    std::vector<const Light*> lights = activeLights(document);
    std::erase_if(lights, [](const Light* light) {
        return !canCastShadow(light->type) || !light->castsShadow;
    });
    return lights;
}

} // namespace patina::render
