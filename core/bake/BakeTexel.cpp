// Ambient occlusion and radiance transfer per texel, one texture per material.

#include "core/bake/Bake.h"
#include "core/bake/PrtSettingsCheck.h"
#include "core/bake/bounce/TexelBounces.h"
#include "core/bake/transfer/AoSettingsCheck.h"
#include "core/bake/transfer/BakeTracer.h"
#include "core/bake/transfer/TexelTransfer.h"
#include "core/bake/transfer/WorkOrder.h"
#include "core/trace/RayScene.h"

#include <optional>

namespace patina {
namespace {

// Everything the two texel bakes share; `artifact` arrives with kind, order and settings, `prt`
// with those of a transfer bake.
Result<BakeArtifact> bakeTexels(const BakeInputs& inputs, PassSettings settings, int size,
                                const PrtSettings* prt, BakeArtifact artifact, TileSink& sink,
                                const JobContext& job, BakeTracer* tracer) {
    job.setActivity("preparing the scene");
    const Result<BakeGeometry> geometry = makeBakeGeometry(inputs, job);
    if (!geometry)
        return geometry.error();
    const Result<TexelLayout> layout = texelLayout(*geometry, size, job);
    if (!layout)
        return layout.error();
    std::optional<RayScene> scene;
    if (!settings.unshadowed) {
        Result<RayScene> built = RayScene::build(
            *geometry, job, 0, static_cast<double>(layout->points.size()) * settings.samples);
        if (!built)
            return built.error();
        scene.emplace(std::move(*built));
    }
    settings.maxDistance *= static_cast<float>(geometry->unitsPerMetre);

    PassCallbacks callbacks;
    callbacks.range = [&](const PointRange& range, std::span<const float> values) {
        const Id material = layout->partOf(range.first).material;
        forEachTexelRun(*layout, range, settings.stride(), values,
                        [&](int x, int y, int width, std::span<const float> run) {
                            sink.texels(material, size, settings.stride(), x, y, width, run);
                        });
    };
    callbacks.passDone = [&](int samples) { sink.passDone(samples); };
    callbacks.view = [&] { return toSceneUnits(sink.view(), *geometry); };
    Result<std::optional<PassState>> traced =
        scene
            ? tracePoints(tracer,
                          {*scene, layout->points, layout->ranges, settings, callbacks, job})
            : passesOrNothing(openPasses(layout->points, layout->ranges, settings, callbacks, job));
    if (!traced)
        return traced.error();
    artifact.inputs = hashBakeInputs(inputs);
    if (!traced->has_value())
        return artifact;
    const PassState& passes = **traced;

    artifact.settings["size"] = std::to_string(size);
    if (const std::string note = layout->note(); !note.empty())
        artifact.settings["note"] = note;
    noteRays(artifact, passes, settings, job);
    if (holdsTransfer(artifact.kind))
        artifact.texels = finishTexelTransfer(*layout, settings, passes);
    else
        for (const MaterialTexels& part : layout->parts)
            artifact.texels.push_back(
                {part.material, occlusionTexture(*layout, part, passes.values)});
    if (prt && prt->transfer == TransferKind::Interreflected)
        if (std::optional<Error> error = addTexelInterreflection(
                artifact, inputs, *geometry, *scene, *layout, passes, *prt, job))
            return *std::move(error);
    job.setProgress(1.0);
    return artifact;
}

} // namespace

Result<BakeArtifact> bakeAoTexel(const BakeInputs& inputs, const AoSettings& settings,
                                 TileSink& sink, const JobContext& job, BakeTracer* tracer) {
    const Result<PassSettings> passes = aoPassSettings(settings);
    if (!passes)
        return passes.error();
    BakeArtifact artifact;
    artifact.kind = BakeKind::AoTexel;
    artifact.settings = aoSettingsText(artifact.kind, settings, passes->samples);
    return bakeTexels(inputs, *passes, settings.size, nullptr, std::move(artifact), sink, job,
                      tracer);
}

Result<BakeArtifact> bakePrtTexel(const BakeInputs& inputs, const PrtSettings& settings,
                                  TileSink& sink, const JobContext& job, BakeTracer* tracer) {
    const Result<PassSettings> passes = prtPassSettings(settings);
    if (!passes)
        return passes.error();
    BakeArtifact artifact;
    artifact.kind = BakeKind::PrtTexel;
    artifact.order = settings.order;
    artifact.transfer = settings.transfer;
    artifact.settings = prtSettingsText(artifact.kind, settings, passes->samples);
    return bakeTexels(inputs, *passes, settings.size, &settings, std::move(artifact), sink, job,
                      tracer);
}

} // namespace patina
