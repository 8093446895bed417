#include "core/trace/document/DocumentTraceInputs.h"

#include "core/document/Document.h"
#include "core/document/ViewChoices.h"
#include "core/light/EnvironmentLookup.h"
#include "core/light/Ibl.h"
#include "core/mix/LightMix.h"

#include <algorithm>
#include <utility>

namespace patina {

TraceInputs traceInputs(const Document& document) {
    TraceInputs inputs;
    inputs.materials = document.materials;
    inputs.materials.emplace_back(); // of meshes whose material is not there
    inputs.model = document.model;
    for (const MeshInstance& instance : document.meshes) {
        if (!instance.visible || !instance.mesh)
            continue;
        const auto material =
            std::ranges::find(document.materials, instance.material, &Material::id);
        inputs.meshes.push_back({instance.id, instance.mesh, instance.placement.matrix(),
                                 static_cast<std::size_t>(material - document.materials.begin())});
    }
    for (const Light* light : activeLights(document))
        inputs.lights.push_back(*light);
    for (const EnvironmentPart& part : environmentParts(document))
        if (part.image)
            inputs.environments.push_back({part.image, part.orientation, part.scale});
    return inputs;
}

std::function<glm::vec3(const glm::vec3& direction)>
blurredBackground(std::shared_ptr<const IblMaps> maps, const EnvironmentPart& shown, float blur) {
    EnvironmentLookup lookup;
    lookup.maps = std::move(maps);
    lookup.orientation = shown.orientation;
    lookup.setScale(shown.scale);
    return [lookup, blur](const glm::vec3& direction) {
        return lookup.prefiltered(blur, direction).value_or(glm::vec3(0.0f));
    };
}

Result<void> setTracedBackground(const Document& document, TraceView& view,
                                 const std::function<Result<IblMaps>(const Image&)>& prepare) {
    const View& look = document.view;
    switch (look.background) {
    case BackgroundMode::Environment:
        return {}; // as it is
    case BackgroundMode::Off:
        view.transparent = true;
        return {};
    case BackgroundMode::Color:
        view.background = [color = look.backgroundColor](const glm::vec3&) { return color; };
        return {};
    case BackgroundMode::Blurred:
        break;
    }
    const EnvironmentPart shown = shownEnvironment(document);
    if (!shown.image)
        return {};
    Result<IblMaps> maps = prepare(*shown.image);
    if (!maps)
        return maps.error();
    view.background = blurredBackground(std::make_shared<const IblMaps>(*std::move(maps)), shown,
                                        look.backgroundBlur);
    return {};
}

} // namespace patina
