// `patina bake light`: what image-based light is off by, as a light map.
#include "app/cli/BakeOutput.h"
#include "app/cli/BakeRun.h"
#include "app/cli/Commands.h"
#include "app/cli/PreparedLight.h"
#include "app/cli/Report.h"
#include "app/cli/SceneSetup.h"
#include "core/bake/BakeMemory.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/bake/file/BakeFileSize.h"
#include "core/bake/lightmap/LightMapBake.h"
#include "core/base/DiskSpace.h"
#include "core/trace/document/DocumentLightMap.h"

#include <nlohmann/json.hpp>

namespace patina::cli {

Result<void> run(Session& session, const BakeLightOptions& options) {
    const LightMapSettings& settings = options.settings;
    session.report().json()["settings"] = {{"scene", options.scene},
                                           {"size", settings.size},
                                           {"samples", settings.samples},
                                           {"smooth", settings.smooth},
                                           {"seed", settings.seed}};
    if (Result<void> fits = checkBakeOutput(options.output, BakeKind::LightMap); !fits)
        return fits;
    session.beginPhase();
    SceneRequest request{options.scene, options.environment, options.environmentLayout, {}};
    const Result<Document> document = openSceneFor(session, request);
    if (!document)
        return document.error();
    const BakeInputs geometry = bakeInputs(*document);
    BakeRequest bake;
    bake.kind = BakeKind::LightMap;
    bake.lightMap = settings;
    if (Result<void> fits = checkBakeFile(bake, geometry); !fits)
        return fits;
    const std::uint64_t bytes = bakeFileBytes(bake, geometry);
    if (Result<void> fits = checkDiskSpace(options.output, bytes, bytes); !fits)
        return fits;
    if (Result<void> fits = checkBakeMemory(bake, geometry, availableMemory()); !fits)
        return fits;
    session.beginPhase();
    session.job().setActivity("preparing light");
    const Result<LightMapInputs> inputs = lightMapInputs(
        *document, [&](const Image& image) { return prepareLight(image, session.job()); });
    if (!inputs)
        return inputs.error();
    session.beginPhase();
    session.allowPartialResult();
    const Result<BakeArtifact> artifact = bakeLightMap(*inputs, settings, session.job());
    if (!artifact)
        return artifact.error();
    reportBake(session, geometry, *artifact);
    session.report().json()["partial"] = session.interrupted();
    return writeBake(session, *document, *artifact, options.output, {});
}

} // namespace patina::cli
