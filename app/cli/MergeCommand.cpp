#include "app/cli/BakeOutput.h"
#include "app/cli/BakeRun.h"
#include "app/cli/Commands.h"
#include "app/cli/LightMapRun.h"
#include "app/cli/LongRadiosity.h"
#include "app/cli/LongRun.h"
#include "app/cli/SceneSetup.h"
#include "app/cli/TracedPicture.h"
#include "core/bake/Bake.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/bake/domain/BakeOptions.h"
#include "core/bake/transfer/BakeMerge.h"
#include "core/base/FileLock.h"
#include "core/radiosity/file/RadiosityFile.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

namespace patina::cli {

Result<void> run(Session& session, const MergeOptions& options) {
    nlohmann::ordered_json& json = session.report().json();
    json["settings"] = {{"parts", options.parts}};
    if (looksLikeFilm(options.parts.front()))
        return mergeFilms(session, options);
    if (radiosity::looksLikeRadiosity(options.parts.front()))
        return mergeRadiosity(session, options);
    const std::vector<std::filesystem::path> files(options.parts.begin(), options.parts.end());
    const Result<std::vector<BakePart>> parts = readBakeParts(files);
    if (!parts)
        return parts.error();
    const BakeManifest& first = parts->front().manifest;
    if (Result<void> output = checkBakeOutput(options.output, first.kind); !output)
        return output;
    const Result<FileLock> lock = FileLock::take(options.output);
    if (!lock)
        return lock.error();

    // Fitting and bounces need the surfaces, and the file names its targets after them.
    session.beginPhase();
    SceneRequest request;
    request.scene = options.scene.empty() ? first.scene : options.scene;
    request.environment = first.environment;
    request.environmentLayout = first.environmentLayout;
    request.sets = first.sets;
    json["settings"]["scene"] = request.scene;
    Result<Document> document = openSceneFor(session, request);
    if (!document) {
        Error error = document.error();
        if (!first.environment.empty() && error.file == first.environment)
            error.message += "; it is the environment of the parts: put it there again";
        else if (options.scene.empty())
            error.message += "; it is the scene of the parts: name it with --scene if it is "
                             "elsewhere now";
        return error;
    }
    const BakeInputs inputs = bakeInputs(*document);
    BakeManifest here = first;
    here.scene = absoluteSource(request.scene);
    here.inputs = hashBakeInputs(inputs);
    if (here.albedo != Hash{})
        here.albedo = hashBakeAlbedo(inputs);
    std::optional<LightMapInputs> light;
    if (first.kind == BakeKind::LightMap) {
        Result<LightMapInputs> prepared = lightMapInputsOf(session, *document);
        if (!prepared)
            return prepared.error();
        light.emplace(*std::move(prepared));
        here.light = hashLightMapLight(light->scene);
    }
    JoiningTracer tracer(*parts, here);

    TileSink nobodyWatches;
    session.beginPhase();
    const BakeRequest baked = requestFromText(first.kind, first.settings);
    const Result<BakeArtifact> artifact =
        light ? bakeLightMap(*light, baked.lightMap, session.job(), &tracer)
              : bake(baked, inputs, nobodyWatches, session.job(), &tracer);
    if (!artifact)
        return artifact.error();
    reportBake(session, inputs, *artifact);
    return writeBake(session, *document, *artifact, options.output, first.storage);
}

} // namespace patina::cli
