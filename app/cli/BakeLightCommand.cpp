// `patina bake light`: what image-based light is off by, as a light map.
#include "app/cli/BakeRun.h"
#include "app/cli/Commands.h"
#include "app/cli/LightMapRun.h"
#include "app/cli/PreparedLight.h"
#include "app/cli/Report.h"
#include "core/trace/document/DocumentLightMap.h"

#include <nlohmann/json.hpp>

namespace patina::cli {

Result<LightMapInputs> lightMapInputsOf(Session& session, const Document& document) {
    session.job().setActivity("preparing light");
    return lightMapInputs(document,
                          [&](const Image& image) { return prepareLight(image, session.job()); });
}

Result<void> run(Session& session, const BakeLightOptions& options) {
    const LightMapSettings& settings = options.settings;
    session.report().json()["settings"] = {{"scene", options.scene},
                                           {"size", settings.size},
                                           {"samples", settings.samples},
                                           {"smooth", settings.smooth},
                                           {"seed", settings.seed}};
    SceneBake bake{options.scene, options.output, options.work, {}};
    bake.environment = options.environment;
    bake.environmentLayout = options.environmentLayout;
    bake.request.kind = BakeKind::LightMap;
    bake.request.lightMap = settings;
    return bakeScene(session, bake);
}

} // namespace patina::cli
