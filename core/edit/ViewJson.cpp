#include "core/edit/ViewJson.h"

#include "core/document/ViewChoices.h"
#include "core/edit/Parameters.h"

#include <nlohmann/json.hpp>

namespace patina {

nlohmann::ordered_json describeCamera(const Camera& camera) {
    nlohmann::ordered_json json{{"yawDeg", camera.yawDeg},
                                {"pitchDeg", camera.pitchDeg},
                                {"distance", camera.distance},
                                {"fovDeg", camera.fovDeg},
                                {"target", {camera.target.x, camera.target.y, camera.target.z}}};
    if (camera.lens.depthOfField)
        json["lens"] = {{"fStop", camera.lens.fStop}, {"focusDistance", camera.lens.focusDistance}};
    return json;
}

void describeView(nlohmann::ordered_json& settings, const View& view) {
    settings["exposure"] = {
        {"mode", view.exposureMode == ExposureMode::Automatic ? "automatic" : "fixed"},
        {"ev", view.exposureEv}};
    settings["toneMap"] =
        formatParameterValue(*findParameter("view.toneMap"), static_cast<int>(view.toneMap));
    settings["lighting"] =
        formatParameterValue(*findParameter("view.lighting"), static_cast<int>(view.lighting));
}

} // namespace patina
