#include "render/scene/LightBlocks.h"

#include "core/light/Lights.h"
#include "core/mix/LightMix.h"

#include <algorithm>
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

std::vector<const Light*> shiningLights(const Document& document) {
    std::vector<const Light*> lights;
    for (const Light& light : document.lights)
        if (isActive(document, light))
            lights.push_back(&light);
    return lights;
}

// Those that the frame has room for, in its order.
std::vector<const Light*> packedLights(const Document& document) {
    std::vector<const Light*> lights = shiningLights(document);
    lights.resize(std::min(lights.size(), std::size_t{kMaxLights})); // the caller has said so
    std::stable_sort(lights.begin(), lights.end(), [](const Light* a, const Light* b) {
        return loopOf(a->type) < loopOf(b->type);
    });
    return lights;
}

} // namespace

std::vector<Id> lightOrder(const Document& document) {
    std::vector<Id> ids;
    for (const Light* light : packedLights(document))
        ids.push_back(light->id);
    return ids;
}

void packLights(const Document& document, std::span<const Id> shadowSlots, FrameBlock& frame) {
    const std::vector<const Light*> lights = packedLights(document);
    frame.lightEnds = glm::ivec4(0);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const bool casts = canCastShadow(lights[i]->type) && lights[i]->castsShadow;
        const auto slot = casts ? std::find(shadowSlots.begin(), shadowSlots.end(), lights[i]->id)
                                : shadowSlots.end();
        frame.lights[i] = packLight(*lights[i], slot == shadowSlots.end()
                                                    ? -1
                                                    : static_cast<int>(slot - shadowSlots.begin()));
        for (int loop = loopOf(lights[i]->type); loop < 4; ++loop)
            frame.lightEnds[loop] = static_cast<int>(i) + 1;
    }
}

bool tooManyLights(const Document& document) {
    return shiningLights(document).size() > std::size_t{kMaxLights};
}

std::vector<const Light*> castingLights(const Document& document) {
    std::vector<const Light*> lights = shiningLights(document);
    std::erase_if(lights, [](const Light* light) {
        return !canCastShadow(light->type) || !light->castsShadow;
    });
    return lights;
}

bool tooManyShadows(const Document& document) {
    return castingLights(document).size() > std::size_t{kMaxShadows};
}

} // namespace patina::render
