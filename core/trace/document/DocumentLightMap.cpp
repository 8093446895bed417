#include "core/trace/document/DocumentLightMap.h"

#include "core/bake/document/DocumentBakeInputs.h"
#include "core/bake/domain/BakeHash.h"
#include "core/document/Document.h"
#include "core/light/Ibl.h"
#include "core/mix/LightMix.h"
#include "core/trace/document/DocumentTraceInputs.h"

#include <memory>
#include <utility>

namespace patina {

Result<LightMapInputs> lightMapInputs(const Document& document,
                                      const std::function<Result<IblMaps>(const Image&)>& prepare) {
    LightMapInputs inputs{traceInputs(document), hashBakeInputs(bakeInputs(document)), {}};
    const EnvironmentPart shown = shownEnvironment(document);
    if (!shown.image || shown.scale == glm::vec3(0.0f))
        return inputs;
    Result<IblMaps> maps = prepare(*shown.image);
    if (!maps)
        return maps.error();
    inputs.imageLight.maps = std::make_shared<const IblMaps>(*std::move(maps));
    inputs.imageLight.orientation = shown.orientation;
    inputs.imageLight.setScale(shown.scale);
    return inputs;
}

} // namespace patina
